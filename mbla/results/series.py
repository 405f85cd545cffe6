"""Load cases of a result: those that are asked for by name, and those that are positions of one travelling load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import UsageError
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import Blocks
from mbla.questions.travel_position import TravelPosition
from mbla.results.outcome import figure_of
from mbla.results.results import CaseResult, Results

SAME = 1e-6
"""relative difference of load factors that is rounding: of equal positions the first is the worst"""


@dataclass(frozen=True)
class Series:
    """Positions of one travelling load that were solved, in their order.

    worst : the case with the least load factor; None where that is not known, as some position has no result
    """

    name: str
    cases: tuple[CaseResult, ...]
    worst: CaseResult | None

    @property
    def complete(self) -> bool:
        """Whether every position of the path was solved, none left out by name."""
        return len(self.cases) == self.cases[0].load_case.question.place.count


def worst_known(cases: Sequence[CaseResult]) -> CaseResult:
    """Of some positions of a travelling load the worst; of those that have a load factor where it is not known."""
    factors = np.nan_to_num([figure_of(case) for case in cases], nan=np.inf)
    return _worst(cases) or cases[int(np.argmin(factors))]


def position_to_push(load_case: LoadCase, model: Model, cases: Sequence[CaseResult]) -> CaseResult | None:
    """Of the positions of a travelling load that were solved the one to be pushed, with what is asked of its pushover.

    model : of the deck, where all positions that may be pushed have a pushover
    """
    asked = {each.name: each.pushover for each in model.load_cases if each.deck_name == load_case.deck_name}
    may_be = [case for case in cases if asked.get(case.load_case.name) is not None]
    travelling = series_of(may_be)
    if not travelling:
        return None
    worst = worst_known(travelling[0].cases)
    return replace(worst, load_case=replace(worst.load_case, pushover=asked[worst.load_case.name]))


def detailed_cases(cases: Sequence[CaseResult]) -> tuple[CaseResult, ...]:
    """Those reported in full: of a travelling load the worst position, and positions without result, which hide it.

    The position that is pushed, too.
    """
    travelling = series_of(cases)
    if not travelling:
        return tuple(cases)
    names = {case.load_case.name for case in cases}
    names -= {case.load_case.name for series in travelling for case in series.cases}
    for series in travelling:
        factors = np.array([figure_of(case) for case in series.cases])
        unknown = [case for case, factor in zip(series.cases, factors, strict=True) if np.isnan(factor)]
        pushed = [case for case in series.cases if case.load_case.pushover is not None]
        names |= {case.load_case.name for case in (worst_known(series.cases), *unknown, *pushed)}
    return tuple(case for case in cases if case.load_case.name in names)


def series_of(cases: Sequence[CaseResult]) -> tuple[Series, ...]:
    """All series among the cases, in the order of the deck."""
    members: dict[str, list[CaseResult]] = {}
    for case in cases:
        if case.load_case.question.place.count:
            members.setdefault(case.load_case.question.place.series, []).append(case)
    return tuple(Series(name, tuple(own), _worst(own)) for name, own in members.items())


def _worst(cases: Sequence[CaseResult]) -> CaseResult | None:
    factors = [figure_of(case) for case in cases]
    if np.isnan(factors).any() or not np.isfinite(factors).any():
        return None
    least = min(factors)
    return next(case for case, factor in zip(cases, factors, strict=True) if factor <= least + SAME * abs(least))


def chosen_cases(results: Results, names: Sequence[str] | None) -> tuple[CaseResult, ...]:
    """Cases by name in the order of the deck, None for all; raises UsageError for a name that the result does not have.

    The name of a load that travels stands for all its positions.
    """
    known = {name for case in results.cases for name in _names(case)}
    for name in names or ():
        if name not in known:
            raise no_such_case(results, name)
    return tuple(case for case in results.cases if names is None or not _names(case).isdisjoint(names))


def _names(case: CaseResult) -> set[str]:
    return {case.load_case.name, case.load_case.deck_name}


def no_such_case(results: Results, name: str | None) -> UsageError:
    """The error for a name that the result does not have, or for any case where it has none."""
    if name is None:
        return UsageError("unknown-load-case", "the result has no load case")
    known = ", ".join(case.load_case.name for case in results.cases) or "none"
    return UsageError("unknown-load-case", f"no load case {name} in the result; it has {known}")


ROUNDING = 1e-12
"""share of the load of the axles on a block below which the rest of its load counts as none"""


def without_vehicle(blocks: Blocks, loads: FloatArray, travel: TravelPosition) -> FloatArray:
    """Loads on blocks about their centroids less those of the axles that act, (n_blocks, 6) N and N m.

    Axles that are shared between blocks stay: they act as what lands of them.
    """
    own = travel.apart
    forces, under = travel.forces[own], travel.blocks[own]
    of_axles, sizes = np.zeros_like(loads), np.zeros_like(loads)
    wrenches = np.hstack([forces, np.cross(travel.points[own] - blocks.centroids[under], forces)])
    np.add.at(of_axles, under, wrenches)
    np.add.at(sizes, under, np.abs(wrenches))
    rest = loads - of_axles
    return np.where(np.abs(rest) <= ROUNDING * sizes.max(axis=1, keepdims=True), 0.0, rest)
