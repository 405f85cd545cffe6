"""One load case in two results: status, figures, mechanism, modes, reactions, time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.mechanics import guide_reactions, load_on_structure, support_reactions
from mbla.results.diff.matching import Factors, Matching
from mbla.results.diff.motion import ModeComparison, angle_between, compare_modes
from mbla.results.listing.answers import reaction_of, reaction_unit
from mbla.results.outcome import associative_of, extent_of, law_residual, least_and_greatest, range_of, result_of
from mbla.results.results import CaseResult, Results
from mbla.results.tilt_angle import angle_of
from mbla.solution.solution import Mechanics, Status

LEAST_TOLERANCE = 1e-6
"""Relative difference of answers that is none: the accuracy to which solved programs agree."""

ZERO = 1e-3
"""Share of dead over live load, and of the unit of a reaction: smaller figures are compared as if they were that."""

NOISE = 1e-9
"""Share of the loads below which a difference of reactions is rounding."""


@dataclass(frozen=True)
class ReactionChange:
    """Force of a support on the structure in B less that in A, (3,) in the unit of A."""

    support: str
    change: FloatArray


@dataclass(frozen=True)
class CaseComparison:
    """What differs in a load case.

    settings  : flow rule and scheme in A and in B
    answers   : load factor, angle and reaction, those that the case has
    figures   : least and greatest found, associative factor, bounds, range and peak
    angle     : degrees between the mechanisms; None where they cannot be compared
    angle_of  : what is compared: ``mechanism``, or ``motion without equilibrium``; why not where it is not
    modes     : None where one of the two has no mechanism that is a result
    reactions : supports whose force differs, the largest change first
    load      : size of the loads on free blocks in A, to which changes of reactions are relative
    seconds   : in A and in B
    """

    name: str
    statuses: tuple[Status, Status]
    rules: tuple[str, str]
    answers: tuple[Figure, ...]
    figures: tuple[Figure, ...]
    angle: float | None
    angle_of: str
    modes: ModeComparison | None
    reactions: tuple[ReactionChange, ...]
    load: float
    seconds: tuple[float, float]

    @property
    def differs(self) -> bool:
        """Whether status or answer do; forces, modes and bounds may differ where these do not."""
        return self.statuses[0] is not self.statuses[1] or not all(answer.same for answer in self.answers)


def accuracy_of(case: CaseResult) -> float:
    """What a load factor is good to, relatively: its gap with associative flow, else its largest residual."""
    value = case.checks.gap if case.solution.flow_rule == "associative" else law_residual(case.checks)
    return 0.0 if result_of(case) is None or math.isnan(value) else value


def compare_cases(
    first: Results,
    case: CaseResult,
    second: Results,
    other: CaseResult,
    matching: Matching,
    factors: Factors,
    tolerance: float | None = None,
) -> CaseComparison:
    """Compare a load case of A with that of B.

    tolerance : relative, of answers; None for the sum of what the two are good to, at least 1e-6
    """
    if tolerance is None:
        tolerance = max(accuracy_of(case) + accuracy_of(other), LEAST_TOLERANCE)
    own, its = result_of(case), result_of(other)
    angle, what = _angle(first, case, second, other, matching, factors.length)
    modes = None
    if own is not None and its is not None:
        modes = compare_modes(first, (case, other), second, (own, its), matching, factors.length)
    changes, load = _reactions(first, case, second, other, matching, factors)
    return CaseComparison(
        name=case.load_case.name,
        statuses=(case.status, other.status),
        rules=(_rule(case), _rule(other)),
        answers=_answers(first.model, case, other, factors, tolerance),
        figures=_figures(first.model, case, other, tolerance),
        angle=angle,
        angle_of=what,
        modes=modes,
        reactions=changes,
        load=load,
        seconds=(case.solution.seconds, other.solution.seconds),
    )


def _rule(case: CaseResult) -> str:
    solution = case.solution
    words = [solution.flow_rule, solution.scheme, "" if solution.contact_model == "concave" else solution.contact_model]
    return ", ".join(word for word in words if word)


def _factor(mechanics: Mechanics | None) -> float:
    return math.nan if mechanics is None else mechanics.load_factor


def _answers(
    model: Model, case: CaseResult, other: CaseResult, factors: Factors, tolerance: float
) -> tuple[Figure, ...]:
    """What a user asks of the case; a reaction is converted, load factors and angles are pure numbers."""
    own, its = case.load_case, other.load_case
    if own.settlement is not None and its.settlement is not None and own.settlement.turns == its.settlement.turns:
        scale = factors.force * (factors.length if own.settlement.turns else 1.0)
        values = [math.nan if value is None else value for value in (reaction_of(case), reaction_of(other))]
        least, unit = ZERO * own.settlement.unit, reaction_unit(model, own.settlement)
        return (figure("reaction", unit, values[0], values[1] * scale, tolerance, least),)
    if own.tilt is not None and its.tilt is not None:
        return (figure("angle", "degree", angle_of(case), angle_of(other), tolerance),)
    least = least_factor(model, own)
    return (figure("load factor", "", _factor(result_of(case)), _factor(result_of(other)), tolerance, least),)


def least_factor(model: Model, load_case: LoadCase) -> float:
    """A share of dead over live load on the free blocks: load factors below are compared as if they were that."""
    dead, live = (float(np.abs(load[model.free, :3]).sum()) for load in (load_case.dead_load, load_case.live_load))
    return ZERO * dead / live if live > 0.0 else 0.0


def _figures(model: Model, case: CaseResult, other: CaseResult, tolerance: float) -> tuple[Figure, ...]:
    """Figures beside the answer that one of the two has."""
    least = least_factor(model, case.load_case)
    none = (math.nan, math.nan)
    ranges = [range_of(each) or none for each in (case, other)]
    several = extent_of(model, case) is not None or extent_of(model, other) is not None
    extents = [least_and_greatest(model, each) if several else none for each in (case, other)]
    values = {
        "associative load factor": [_factor(associative_of(each)) for each in (case, other)],
        "static bound": [each.checks.static_bound for each in (case, other)],
        "kinematic bound": [each.checks.kinematic_bound for each in (case, other)],
        "least load factor found": [ends[0] for ends in extents],
        "greatest load factor found": [ends[1] for ends in extents],
        "range, lower end": [ends[0] for ends in ranges],
        "range, upper end": [ends[1] for ends in ranges],
        "peak": [each.checks.peak_load_factor for each in (case, other)],
    }
    return tuple(
        figure(name, "", pair[0], pair[1], tolerance, least)
        for name, pair in values.items()
        if not (math.isnan(pair[0]) and math.isnan(pair[1]))
    )


def _angle(
    first: Results, case: CaseResult, second: Results, other: CaseResult, matching: Matching, length: float
) -> tuple[float | None, str]:
    """Angle between mechanisms that are results, or between motions that prove the lack of equilibrium."""
    if not matching.comparable:
        return None, f"only {min(matching.shares):.0%} of the volume has a match in the other"
    own, its = result_of(case), result_of(other)
    if own is not None and its is not None:
        motions, what = (own.mechanism, its.mechanism), "mechanism"
    elif case.status is other.status is Status.NO_EQUILIBRIUM:
        if case.solution.certificate is None or other.solution.certificate is None:
            return None, "no motion is given"
        motions, what = (case.solution.certificate, other.solution.certificate), "motion without equilibrium"
    else:
        without = [name for name, found in (("A", own), ("B", its)) if found is None]
        return None, f"{' and '.join(without)} {'has' if len(without) == 1 else 'have'} no mechanism that is a result"
    angle = angle_between(first.model.blocks, motions[0], motions[1], matching, length)
    return angle, what if angle is not None else "a motion is zero"


def _reactions(
    first: Results, case: CaseResult, second: Results, other: CaseResult, matching: Matching, factors: Factors
) -> tuple[tuple[ReactionChange, ...], float]:
    """Supports whose force changes by more than rounding, the largest change first, and the size of the loads."""
    own, its = result_of(case), result_of(other)
    if own is None or its is None:
        return (), 0.0
    names = _names_in(first.model, second.model, matching)
    a = _forces(first, case, own, {})
    b = {name: factors.force * force for name, force in _forces(second, other, its, names).items()}
    load = float(np.linalg.norm(load_on_structure(first.model, case.load_case, own.load_factor)[:3]))
    none = np.zeros(3)
    changes = [ReactionChange(name, b.get(name, none) - a.get(name, none)) for name in dict.fromkeys([*a, *b])]
    sizes = [float(np.linalg.norm(change.change)) for change in changes]
    order = [row for row in np.argsort(sizes)[::-1].tolist() if sizes[row] > NOISE * load]
    return tuple(changes[row] for row in order), load


def _forces(results: Results, case: CaseResult, mechanics: Mechanics, names: dict[str, str]) -> dict[str, FloatArray]:
    """Force of each support on the structure, under the name that A has for it."""
    reactions = (
        *support_reactions(results.model, results.contacts, mechanics.contact_forces),
        *guide_reactions(results.model, results.contacts, case.load_case, mechanics),
    )
    return {names.get(reaction.support, reaction.support): reaction.wrench[:3] for reaction in reactions}


def _names_in(first: Model, second: Model, matching: Matching) -> dict[str, str]:
    """Name in A of bodies of B: grounds are named by coordinates, blocks may have changed their order."""
    return {
        second.body_name(int(other)): first.body_name(body) for body, other in enumerate(matching.bodies) if other >= 0
    }


@dataclass(frozen=True)
class Figure:
    """Values in A and in B, both in the unit of A; nan where there is none.

    difference : (B - A) over A, at least over ``least``, over B where A is zero; nan where one of them is missing
    same       : within the tolerance, or missing in both
    """

    name: str
    unit: str
    first: float
    second: float
    difference: float
    tolerance: float
    same: bool


def figure(name: str, unit: str, first: float, second: float, tolerance: float, least: float = 0.0) -> Figure:
    """The difference of two values against a relative tolerance; ``least`` is the size below which they count as it."""
    if math.isnan(first) or math.isnan(second):
        return Figure(name, unit, first, second, math.nan, tolerance, math.isnan(first) and math.isnan(second))
    size = max(abs(first), least) or abs(second)
    difference = (second - first) / size if size > 0.0 else 0.0
    return Figure(name, unit, first, second, difference, tolerance, abs(difference) <= tolerance)
