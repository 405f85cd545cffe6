"""Paths of joints of other stiffnesses in shear, beside that of the deck: how far its load factor hangs on that.

``accuracy: reference`` follows two. Where the stiffness may decide one is followed whatever the accuracy. Load factors
that differ by more than :data:`SAME` are no single answer: the least of them counts, approximate.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from mbla.deck.sections.analysis import AnalysisSection
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.flow.path_of_part import PathOfPart
from mbla.solution.flow.path_record import UNENDED
from mbla.solution.flow.settings import ratios_beside, second_ratio
from mbla.solution.solution import PathByStiffness

LOW, SAME = 0.1, 0.05
"""Share of the associative load factor below which stiffness may decide, and of the load factor by which two
stiffnesses may differ."""


def ratios_asked(found: PathOfPart, associative: AssociativeResult, analysis: AnalysisSection) -> tuple[float, ...]:
    """Ratios of stiffness of paths that the analysis, or doubt, asks for beside the one that was found."""
    ratio = analysis.path.ratio
    if analysis.accuracy == "reference" and found.path is not None:
        return ratios_beside(ratio)
    return (second_ratio(ratio),) if may_hang_on_stiffness(found, associative) else ()


def may_hang_on_stiffness(found: PathOfPart, associative: AssociativeResult) -> bool:
    """Whether how stiff joints are may decide: where associative flow locks, and far below its load factor."""
    above = associative.state
    return above is None or found.load_factor < LOW * above.load_factor


def another_answer(
    followed: Mapping[float, PathOfPart], shown: float, nothing: float, above: float, *, doubtful: bool
) -> float | None:
    """The ratio of the path that does not come to the load factor of the one shown, the least; None where all do.

    nothing  : load factor that is next to none
    above    : what no load factor exceeds
    doubtful : where stiffness may decide, so that a path without an answer is another one
    """
    own = followed[shown]
    apart = [
        ratio
        for ratio, other in followed.items()
        if (doubtful or not math.isnan(_answer(other, above))) and not _agree(own, other, nothing)
    ]
    return min(apart, key=lambda ratio: _or_last(followed[ratio].load_factor), default=None)


def load_factors(
    followed: Mapping[float, PathOfPart], shown: float, live: float, above: float
) -> tuple[PathByStiffness, ...]:
    """Of the model, on all paths but the one whose state is shown.

    live  : load factor of the model for one of the program
    above : what no load factor exceeds
    """
    others = sorted(ratio for ratio in followed if ratio != shown)
    return tuple(PathByStiffness(ratio, _answer(followed[ratio], above) * live) for ratio in others)


def _answer(path: PathOfPart, above: float) -> float:
    """The load factor of a path; nan where its greatest was not seen."""
    return path.load_factor if path.is_answer and not path.gains(UNENDED, above) else math.nan


def _agree(found: PathOfPart, other: PathOfPart, nothing: float) -> bool:
    """Whether paths of joints of two stiffnesses come to one load factor, or none to any."""
    one, two = found.load_factor, other.load_factor
    return one == two or (other.is_answer and same(one, two, nothing)) or max(abs(one), abs(two)) <= nothing


def same(one: float, two: float, nothing: float) -> bool:
    """Whether two load factors are one answer, whichever stiffness joints have."""
    return abs(one - two) <= SAME * max(abs(one), abs(two), nothing)


def _or_last(load_factor: float) -> float:
    return math.inf if math.isnan(load_factor) else load_factor
