"""Load cases that are the positions of one travelling load: one load factor for each, and the worst."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.model.model import TravelPosition
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Status

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
        return len(self.cases) == position_of(self.cases[0]).count


def position_of(case: CaseResult) -> TravelPosition:
    """Where the load stands in a case of a series."""
    assert case.load_case.travel is not None  # what makes it one of a series
    return case.load_case.travel


def factor_of(case: CaseResult) -> float:
    """Load factor of a position; inf where no multiple brings anything down, nan where there is no result."""
    if case.status is Status.UNBOUNDED:
        return np.inf
    found = result_of(case)
    return np.nan if found is None else found.load_factor


def told_cases(cases: Sequence[CaseResult]) -> tuple[CaseResult, ...]:
    """Those told in full: of a travelling load the worst position, and positions without a result, which hide it."""
    told = {case.load_case.name for case in cases if case.load_case.travel is None}
    for series in series_of(cases):
        factors = np.array([factor_of(case) for case in series.cases])
        unknown = [case for case, factor in zip(series.cases, factors, strict=True) if np.isnan(factor)]
        least = series.worst or series.cases[int(np.argmin(np.nan_to_num(factors, nan=np.inf)))]
        told |= {case.load_case.name for case in (least, *unknown)}
    return tuple(case for case in cases if case.load_case.name in told)


def series_of(cases: Sequence[CaseResult]) -> tuple[Series, ...]:
    """All series among the cases, in the order of the deck."""
    members: dict[str, list[CaseResult]] = {}
    for case in cases:
        if case.load_case.travel is not None:
            members.setdefault(case.load_case.travel.series, []).append(case)
    return tuple(Series(name, tuple(own), _worst(own)) for name, own in members.items())


def _worst(cases: Sequence[CaseResult]) -> CaseResult | None:
    factors = [factor_of(case) for case in cases]
    if np.isnan(factors).any() or not np.isfinite(factors).any():
        return None
    least = min(factors)
    return next(case for case, factor in zip(cases, factors, strict=True) if factor <= least + SAME * abs(least))
