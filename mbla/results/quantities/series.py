"""Positions of travelling loads, each a row."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mbla.arrays import FloatArray
from mbla.model.model import Model
from mbla.questions.travel_position import TravelPosition
from mbla.results.quantities.group import Group
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, factor_of, position_of, series_of


@dataclass(frozen=True)
class Position:
    """A load case that is a position of a travelling load."""

    model: Model
    of: Series
    case: CaseResult

    @property
    def travel(self) -> TravelPosition:
        """Where the load is."""
        return position_of(self.case)


def positions(results: Results) -> Iterator[Position]:
    """Of every travelling load."""
    for series in series_of(results.cases):
        yield from (Position(results.model, series, case) for case in series.cases)


POSITIONS = Group[Iterator[Position]](positions, table="series", rows="")


@POSITIONS.quantity("table")
def series(position: Position) -> str:
    """Load case of the deck."""
    return position.of.name


@POSITIONS.quantity("table")
def case(position: Position) -> str:
    """Load case."""
    return position.case.load_case.name


@POSITIONS.quantity("table", name="position")
def number(position: Position) -> int:
    """Number of the position, from 1."""
    return position.travel.number


@POSITIONS.quantity("table")
def count(position: Position) -> int:
    """Positions on the path."""
    return position.travel.count


@POSITIONS.quantity("table", dims="axis", unit="length")
def point(position: Position) -> FloatArray:
    """Where the first axle stands, or the only force."""
    return position.travel.point


@POSITIONS.quantity("table", unit="length")
def distance(position: Position) -> float:
    """Its distance along the path, of which it may be off."""
    return position.travel.distance


@POSITIONS.quantity("table", rule="open")
def block(position: Position) -> str:
    """The block that carries it; none: it is off the path and does not act."""
    carrier = int(position.travel.blocks[0])
    return position.model.blocks.name(carrier) if carrier >= 0 else ""


@POSITIONS.quantity("table")
def axles(position: Position) -> str:
    """Distances along the path of all axles, the first one first."""
    return " ".join(f"{place:.9g}" for place in position.travel.distances.tolist())


@POSITIONS.quantity("table")
def status(position: Position) -> str:
    """Status."""
    return position.case.status.value


@POSITIONS.quantity("table", rule="open")
def load_factor(position: Position) -> float:
    """Load factor; inf: no multiple brings anything down; none: no result."""
    return factor_of(position.case)


@POSITIONS.quantity("table")
def worst(position: Position) -> bool:
    """The least load factor; none where some position has no result."""
    return position.case is position.of.worst
