"""Travelling loads and forces that are sought, as objects of the JSON record."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.arrays import FloatArray
from mbla.model.model import Model
from mbla.results.force_range import ForceRange
from mbla.results.outcome import answer_bounds, figure_of
from mbla.results.quantities import series as quantities
from mbla.results.quantities.group import Field
from mbla.results.quantities.series import Position
from mbla.results.record.objects import Object
from mbla.results.results import CaseResult
from mbla.results.series import Series


@dataclass(frozen=True)
class SeriesOfModel:
    """A travelling load and the model that it crosses."""

    model: Model
    series: Series


@dataclass(frozen=True)
class AxleOfPosition:
    """One of a position."""

    position: Position
    number: int


SERIES, AXLE = Object[SeriesOfModel](), Object[AxleOfPosition]()
_KNOWN = {quantity.name: quantity for quantity in quantities.POSITIONS.quantities}
POSITION = Object[Position](
    *(_KNOWN[name] for name in ("case", "position", "point", "distance", "block", "status", "load_factor"))
)
OBJECTIVE, END = Object[ForceRange](), Object[CaseResult]()
_SERIES = SERIES.of(lambda of: of.series)

_SERIES.fields(
    Series,
    name=Field("load case in the deck"),
    complete=Field("whether every position was solved, none left out by name"),
)


@SERIES.key("a position", inside=POSITION)
def positions(of: SeriesOfModel) -> list[Position]:
    """In their order."""
    return [Position(of.model, of.series, case) for case in of.series.cases]


@SERIES.key(inside=POSITION)
def worst(of: SeriesOfModel) -> Position | None:
    """The position with the least load factor; null where it is not known."""
    return None if of.series.worst is None else Position(of.model, of.series, of.series.worst)


@POSITION.key("an axle", inside=AXLE)
def axles(of: Position) -> list[AxleOfPosition]:
    """All axles, the first one first."""
    return [AxleOfPosition(of, number) for number in range(len(of.travel.blocks))]


@AXLE.key(name="point", dims="axis", unit="length")
def point_of_axle(of: AxleOfPosition) -> FloatArray:
    """As of the position."""
    point: FloatArray = of.position.travel.points[of.number]
    return point


@AXLE.key(name="distance", unit="length")
def distance_of_axle(of: AxleOfPosition) -> float:
    """As of the position."""
    return float(of.position.travel.distances[of.number])


@AXLE.key(name="block")
def block_of_axle(of: AxleOfPosition) -> str | None:
    """As of the position."""
    block = int(of.position.travel.blocks[of.number])
    return of.position.model.blocks.name(block) if block >= 0 else None


OBJECTIVE.fields(ForceRange, name=Field("name of the load case in the deck"))


@OBJECTIVE.key()
def at(found: ForceRange) -> float:
    """Load factor of its live loads."""
    return found.question.objective.at


OBJECTIVE.fields(ForceRange, status=Field("the graver status of both ends"))


@OBJECTIVE.key(inside=END)
def least(found: ForceRange) -> CaseResult | None:
    """An end; null where it was not solved."""
    return found.ends.get("least")


@OBJECTIVE.key(inside=END)
def greatest(found: ForceRange) -> CaseResult | None:
    """An end; null where it was not solved."""
    return found.ends.get("greatest")


@END.key(name="case")
def case_of_end(case: CaseResult) -> str:
    """Load case."""
    return case.load_case.name


END.fields(CaseResult, status=Field("status"))


@END.key(unit="force")
def value(case: CaseResult) -> float | None:
    """The force; null where there is none, and where it has no limit."""
    return figure_of(case)


@END.key(unit="force")
def lower_bound(case: CaseResult) -> float | None:
    """Proved: by a mechanism of the least force, by forces of the greatest."""
    return answer_bounds(case)[0]


@END.key(unit="force")
def upper_bound(case: CaseResult) -> float | None:
    """Proved: by forces of the least force, by a mechanism of the greatest."""
    return answer_bounds(case)[1]
