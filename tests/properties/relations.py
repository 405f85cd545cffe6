"""What a transformation does to a load factor: one row of the table of metamorphic checks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from mbla.arrays import FloatArray
from tests.properties.scenes import Scene, Solved


class Relation(StrEnum):
    """How the load factor may move."""

    EQUAL = "equal"
    RISES = "never lower"
    FALLS = "never higher"
    ENCLOSED = "between both polyhedra"


@dataclass(frozen=True)
class Transformation:
    """One row of the table.

    make    : the other scene from the scene and what came out of it; None where it does not apply
    reason  : why the relation holds
    ratio   : new load factor over the old one where they are equal but for scale
    any_flow : also tried without normality
    turn    : by which vectors turn
    """

    name: str
    relation: Relation
    reason: str
    make: Callable[[Scene, Solved], Scene | None]
    ratio: float = 1.0
    any_flow: bool = False
    turn: Callable[[Scene], FloatArray] | None = None
