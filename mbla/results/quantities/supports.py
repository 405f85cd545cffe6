"""Supports: what each exerts on the structure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mbla.arrays import FloatArray
from mbla.results.collapse.mechanics import SupportReaction, reactions_of
from mbla.results.quantities.group import Group
from mbla.results.quantities.points import FIGURES_WORDS
from mbla.results.record.scene import Scene


@dataclass(frozen=True)
class SupportRow:
    """A support under a load case."""

    scene: Scene
    found: SupportReaction


def _rows(scene: Scene) -> Iterator[SupportRow]:
    """Of supports, then of guides, in the order of the listing."""
    if scene.mechanics is not None:
        found = reactions_of(scene.model, scene.contacts, scene.solved.load_case, scene.mechanics)
        yield from (SupportRow(scene, reaction) for reaction in found)


REACTIONS = Group[Iterator[SupportRow]](_rows, files="table", table="reactions", rows="")


@REACTIONS.quantity()
def support(row: SupportRow) -> str:
    """Ground, block, group or guide."""
    return row.found.support


@REACTIONS.quantity(words=FIGURES_WORDS)
def figures(row: SupportRow) -> str:
    """By name."""
    return row.scene.figures


@REACTIONS.quantity(dims="component", unit="load")
def reaction(row: SupportRow) -> FloatArray:
    """Force on the structure, and its moment about the origin."""
    return row.found.wrench
