"""What a transformation did to the load factors of a scene: equal, moved as admitted, or an exception."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import MblaError
from mbla.results.collapse.mechanics import support_reactions
from mbla.results.results import CaseResult
from tests.properties.scenes import Scene, Solved, bounds_of, solve_scene, value_of, with_analysis

OF_PATHS = 1e-3
"""Relative difference of load factors on paths of elastic joints that steps and rounding make."""
SAME = 1e-6
"""relative difference of load factors that counts as none"""
NOTHING = 1e-8
"""difference of load factors that are 0 counted as none: nothing but accuracy is left of them"""
MET = 1e-9
"""bounds that cross by this much, relatively, have met"""
VECTORS = 1e-6
"""difference of the sum of reactions, over the sum of loads, that counts as none"""


class Relation(StrEnum):
    """How the load factor may move."""

    EQUAL = "equal"
    RISES = "never lower"
    FALLS = "never higher"


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


class Verdict(StrEnum):
    """Of one load case under one transformation."""

    EQUAL = "equal"
    MOVED = "moved as admitted"
    WITHIN = "within what paths differ by"
    OTHER = "another state"
    NOTHING = "no result"
    EXCEPTION = "exception"


@dataclass(frozen=True)
class Comparison:
    """One load case under one transformation.

    difference : relative; nan where a figure is missing
    words      : what is wrong, empty where nothing is
    """

    scene: str
    case: str
    transformation: str
    verdict: Verdict
    difference: float
    words: str = ""


def compare(scene: Scene, solved: Solved, transformation: Transformation) -> list[Comparison]:
    """All load cases under one transformation; empty where it does not apply or there is nothing to compare."""
    pairs = [(number, case) for number, case in enumerate(solved.cases) if not math.isnan(value_of(case))]
    other_scene = transformation.make(scene, solved) if pairs else None
    if other_scene is None:
        return []
    try:
        other = solve_scene(other_scene)
    except MblaError as error:
        words = f"refused: {error}"
        return [
            Comparison(scene.name, case.load_case.name, transformation.name, Verdict.EXCEPTION, math.nan, words)
            for _, case in pairs
        ]
    found = []
    for number, case in pairs:
        if scene.deck.analysis.flow_rule == "associative":
            one = _judged(scene, case, other.cases[number], transformation)
            words = one.words or _vectors(scene, solved, other, number, transformation)
            wrong = words and one.verdict is not Verdict.NOTHING
            found.append(Comparison(*_names(one), Verdict.EXCEPTION, one.difference, words) if wrong else one)
        else:
            found.append(_judged_without_normality(scene, case, other.cases[number], transformation))
    return found


def _names(one: Comparison) -> tuple[str, str, str]:
    return one.scene, one.case, one.transformation


def _judged(scene: Scene, case: CaseResult, other: CaseResult, how: Transformation) -> Comparison:
    before, after = how.ratio * value_of(case), value_of(other)
    names = (scene.name, case.load_case.name, how.name)
    if math.isnan(after):
        words = f"{other.status}: {other.solution.reason or '; '.join(other.checks.failures)}"
        verdict = Verdict.EXCEPTION if how.relation is Relation.EQUAL else Verdict.NOTHING
        return Comparison(*names, verdict, math.nan, words)
    difference = relative(before, after)
    if abs(difference) <= SAME:
        words = "" if how.relation is not Relation.EQUAL else _bounds_apart(case, other, how.ratio)
        return Comparison(*names, Verdict.EXCEPTION if words else Verdict.EQUAL, difference, words)
    admitted = {Relation.RISES: difference > 0, Relation.FALLS: difference < 0}.get(how.relation, False)
    if admitted:
        return Comparison(*names, Verdict.MOVED, difference)
    if how.relation is not Relation.EQUAL and not _contradicted(case, other, how.relation):
        return Comparison(*names, Verdict.EQUAL, difference)  # beyond 1e-6, within what both have proved
    return Comparison(*names, Verdict.EXCEPTION, difference, f"{before:.9g} became {after:.9g} ({other.status})")


def _contradicted(case: CaseResult, other: CaseResult, relation: Relation) -> bool:
    """Whether proved bounds say that the factor moved against its relation; true where one has no bounds."""
    before, after = bounds_of(case), bounds_of(other)
    if relation is Relation.FALLS:
        return not after[0] <= before[1] * (1 + MET) + NOTHING
    return not after[1] >= before[0] * (1 - MET) - NOTHING


def relative(before: float, after: float) -> float:
    """Difference over the larger of the two; 0 where both are the same infinity, or both next to nothing."""
    if before == after or max(abs(before), abs(after)) <= NOTHING:
        return 0.0
    if math.isinf(before) or math.isinf(after):
        return math.copysign(math.inf, after - before)
    return (after - before) / max(abs(before), abs(after))


def _bounds_apart(case: CaseResult, other: CaseResult, ratio: float) -> str:
    """Proved bounds of one and the same figure must overlap."""
    low, high = (ratio * bound for bound in bounds_of(case))
    other_low, other_high = bounds_of(other)
    if any(math.isnan(bound) for bound in (low, high, other_low, other_high)) or (low, high) == (other_low, other_high):
        return ""  # infinite ones too: a table that nothing stands on
    room = MET * max(abs(high), abs(other_high)) + NOTHING
    if max(low, other_low) <= min(high, other_high) + room:
        return ""
    return f"bounds {low:.12g} to {high:.12g} and {other_low:.12g} to {other_high:.12g} exclude each other"


def _vectors(scene: Scene, solved: Solved, other: Solved, number: int, how: Transformation) -> str:
    """Reactions of all supports together turn as vectors do."""
    if how.turn is None or len(solved.model.guides) or solved.model.mirrors:
        return ""
    case, image = solved.cases[number], other.cases[number]
    if not case.load_case.question.multiplies or case.solution.mechanics is None or image.solution.mechanics is None:
        return ""
    sums = []
    for each, one in ((solved, case), (other, image)):
        assert one.solution.mechanics is not None
        reactions = support_reactions(each.model, each.contacts, one.solution.mechanics.contact_forces)
        sums.append(np.sum([reaction.wrench[:3] for reaction in reactions], axis=0))
    loads = case.load_case.dead_load + case.solution.mechanics.load_factor * case.load_case.live_load
    size = float(np.abs(loads[~solved.model.fixed, :3]).sum())
    apart = float(np.abs(how.turn(scene) @ sums[0] - sums[1]).max())
    weights = abs(solved.model.total_weight - other.model.total_weight)
    if apart <= VECTORS * size and weights <= 1e-9 * solved.model.total_weight:
        return ""
    return f"reactions differ by {apart / size:.1e} of the loads, weights by {weights:.1e}"


def without_normality(scene: Scene) -> Scene:
    """The scene without dilatancy."""
    return with_analysis(scene, flow_rule="non_associative", accuracy="standard", standing=True)


def _judged_without_normality(scene: Scene, case: CaseResult, other: CaseResult, how: Transformation) -> Comparison:
    """No theorem says that the factor is unique: the same, else inside the range of states of one of the two."""
    before, after = value_of(case), value_of(other) / how.ratio
    names = (scene.name, case.load_case.name, how.name)
    if math.isnan(after):
        words = f"{other.status}: {other.solution.reason or '; '.join(other.checks.failures)}"
        return Comparison(*names, Verdict.EXCEPTION, math.nan, words)
    difference = relative(before, after)
    above = other.checks.kinematic_bound
    if math.isfinite(after) and math.isfinite(above) and value_of(other) > above * (1 + 1e-5) + NOTHING:
        words = f"{value_of(other):.9g} above the associative bound {above:.9g}"
        return Comparison(*names, Verdict.EXCEPTION, difference, words)
    if abs(difference) <= SAME:
        return Comparison(*names, Verdict.EQUAL, difference)
    if math.isinf(difference):
        return Comparison(*names, Verdict.EXCEPTION, difference, f"{case.status} became {other.status}")
    if abs(difference) <= OF_PATHS:
        return Comparison(*names, Verdict.WITHIN, difference)
    return Comparison(*names, Verdict.OTHER, difference, f"{before:.6g} became {after:.6g}")
