"""Positions of travelling loads, each a row."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mbla.model.model import Model
from mbla.questions.travel_position import TravelPosition
from mbla.results.outcome import figure_of
from mbla.results.quantities.group import Field, Group
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, series_of


@dataclass(frozen=True)
class Position:
    """A load case that is a position of a travelling load."""

    model: Model
    of: Series
    case: CaseResult

    @property
    def travel(self) -> TravelPosition:
        """Where the load is."""
        return self.case.load_case.question.place


def positions(results: Results) -> Iterator[Position]:
    """Of every travelling load."""
    for series in series_of(results.cases):
        yield from (Position(results.model, series, case) for case in series.cases)


POSITIONS = Group[Iterator[Position]](positions, files="table", table="series", rows="")


@POSITIONS.quantity()
def series(position: Position) -> str:
    """Load case of the deck."""
    return position.of.name


@POSITIONS.quantity()
def case(position: Position) -> str:
    """Load case."""
    return position.case.load_case.name


POSITIONS.of(lambda position: position.travel).fields(
    TravelPosition,
    position=Field("number of the position, from 1", attribute="number"),
    count=Field("positions on the path"),
    point=Field("where the first axle stands, or the only force", "axis", unit="length"),
    distance=Field("its distance along the path, of which it may be off", unit="length"),
)


@POSITIONS.quantity(rule="open")
def block(position: Position) -> str:
    """The block that carries it; none: it is off the path and does not act."""
    carrier = int(position.travel.blocks[0])
    return position.model.blocks.name(carrier) if carrier >= 0 else ""


@POSITIONS.quantity()
def axles(position: Position) -> str:
    """Distances along the path of all axles, the first one first."""
    return " ".join(f"{place:.9g}" for place in position.travel.distances.tolist())


POSITIONS.of(lambda position: position.case).fields(CaseResult, status=Field("status"))


@POSITIONS.quantity(rule="open")
def load_factor(position: Position) -> float:
    """Load factor; inf: no multiple brings anything down; none: no result."""
    return figure_of(position.case)


@POSITIONS.quantity()
def worst(position: Position) -> bool:
    """The least load factor; none where some position has no result."""
    return position.case is position.of.worst
