"""What an item is made of, and what its kind may know besides it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.surface import GroundSurface


@dataclass(frozen=True)
class ItemPart:
    """Polyhedra of one group: the item's own, or the item's with ``suffix`` after it; ``fixed`` ones do not move.

    member : part of a composite item, such as "lintel": of all the blocks, or of each; empty where there is none
    labels : (n,) positions of the blocks by name, from 0; those that the kind says it gives
    material : name of the material, where it is not that of the item
    """

    polyhedra: Polyhedra
    suffix: str = ""
    fixed: bool = False
    member: str | Sequence[str] = ""
    labels: Mapping[str, IntArray] = field(default_factory=dict)
    material: str | None = None


@dataclass(frozen=True)
class GroundPart:
    """Rigid ground that an item brings along: one plane under some of its blocks.

    point, normal : (3,) of the plane, normal unit and towards the structure
    blocks        : those that it carries, increasing; counted through all parts of the item
    joint         : joint law; that of contacts where None
    """

    point: FloatArray
    normal: FloatArray
    blocks: IntArray
    joint: str | None


def level_ground(
    blocks: IntArray, joint: str | None, point: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> GroundPart:
    """Level ground at a point under blocks of an item, (n,)."""
    return GroundPart(np.array(point), np.array([0.0, 0.0, 1.0]), blocks, joint)


@dataclass(frozen=True)
class Generated:
    """An item of the deck as raw polyhedra, and surfaces that support, in its own coordinates (before its transform).

    Surfaces are rigid ground under whatever lies on them.
    """

    parts: tuple[ItemPart, ...]
    grounds: tuple[GroundPart, ...] = ()
    surfaces: tuple[GroundSurface, ...] = ()
    notices: tuple[Notice, ...] = field(default=())


@dataclass(frozen=True)
class ItemContext:
    """What a generator may know besides its item.

    tolerance : contacts.tolerance, relative to block size
    resolve_file : path of a file named by the value at a key path below the item
    length : the deck's unit of length
    """

    tolerance: float
    resolve_file: Callable[[KeyPath, str], Path]
    length: str = "m"


class ItemRefused(Exception):  # noqa: N818 - an answer, not a defect
    """The item cannot be built; key paths below the item, and what is wrong there."""

    def __init__(self, *findings: Finding) -> None:
        self.findings = findings
        super().__init__("; ".join(message for _, message in findings))


Generator: TypeAlias = Callable[[Any, ItemContext], Generated]
"""Turns an item of one kind into polyhedra in its own coordinates; raises ItemRefused with everything wrong with it."""
