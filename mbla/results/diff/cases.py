"""One load case in two results: what the record says of it, figure by figure, and mechanism, modes, reactions, time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.mechanics import load_on_structure, reactions_of
from mbla.results.diff.matching import Factors, Matching
from mbla.results.diff.motion import ModeComparison, angle_between, compare_modes
from mbla.results.outcome import law_residual, result_of
from mbla.results.record.cases import CASE_COLUMNS
from mbla.results.record.quantity import unit_text
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status

LEAST_TOLERANCE = 1e-6
"""Relative difference of answers that is none: the accuracy to which solved programs agree."""

ZERO = 1e-3
"""Share of dead over live load, and of the unit of a reaction: smaller figures are compared as if they were that."""

NOISE = 1e-9
"""Share of the loads below which a difference of reactions is rounding."""

COMPARED = (
    "load_factor",
    "angle",
    "reaction_force",
    "reaction_moment",
    "associative_load_factor",
    "static_bound",
    "kinematic_bound",
    "least_load_factor",
    "greatest_load_factor",
    "range_lower",
    "range_upper",
    "peak_load_factor",
)
"""figures of the record that are compared; of the first four the one that is asked for"""
COLUMNS = {
    name: (column, place)
    for column in CASE_COLUMNS
    for place, name, _ in column.quantity.components()
    if name in COMPARED
}
"""column of each, and its place in it"""


@dataclass(frozen=True)
class Figure:
    """A quantity of the record in A and in B, both in the unit of A; nan where there is none.

    difference : (B - A) over A, at least over ``least``, over B where A is zero; nan where one of them is missing
    same       : within the tolerance, or missing in both
    """

    name: str
    unit: str | None
    values: tuple[float, float]
    difference: float
    tolerance: float
    same: bool


def figure(name: str, unit: str | None, values: tuple[float, float], tolerance: float, least: float = 0.0) -> Figure:
    """The difference of two values against a relative tolerance; ``least`` is the size below which they count as it."""
    first, second = values
    if math.isnan(first) or math.isnan(second):
        return Figure(name, unit, values, math.nan, tolerance, math.isnan(first) and math.isnan(second))
    size = max(abs(first), least) or abs(second)
    difference = (second - first) / size if size > 0.0 else 0.0
    return Figure(name, unit, values, difference, tolerance, abs(difference) <= tolerance)


@dataclass(frozen=True)
class ReactionChange:
    """Force of a support on the structure in B less that in A, (3,) in the unit of A."""

    support: str
    change: FloatArray


@dataclass(frozen=True)
class MotionComparison:
    """Mechanisms.

    angle    : degrees between them, with its cosine; None where they cannot be compared
    compared : what is: ``mechanism``, or ``motion without equilibrium``; why not where it is not
    """

    angle: float | None
    cosine: float | None
    compared: str


@dataclass(frozen=True)
class CaseComparison:
    """What differs in a load case; pairs are of A and of B.

    flow_rule : with scheme and contact model
    answers   : load factor, angle or reaction
    figures   : what else is known of the load factor
    modes     : None where one of the two has no mechanism that is a result
    reactions : supports whose force differs, the largest change first
    load      : size of the loads on free blocks in A, to which changes of reactions are relative
    time      : seconds that it took to solve
    """

    name: str
    status: tuple[Status, Status]
    flow_rule: tuple[str, str]
    answers: tuple[Figure, ...]
    figures: tuple[Figure, ...]
    mechanism: MotionComparison
    modes: ModeComparison | None
    reactions: tuple[ReactionChange, ...]
    load: float
    time: tuple[float, float]

    @property
    def differs(self) -> bool:
        """Whether status or answer do; forces, modes and bounds may differ where these do not."""
        return self.status[0] is not self.status[1] or not all(answer.same for answer in self.answers)


def accuracy_of(case: CaseResult) -> float:
    """What a load factor is good to, relatively: its gap with associative flow, else its largest residual."""
    value = case.checks.gap if case.solution.flow_rule == "associative" else law_residual(case.checks)
    return 0.0 if result_of(case) is None or math.isnan(value) else value


def compare_cases(
    results: tuple[Results, Results],
    cases: tuple[CaseResult, CaseResult],
    matching: Matching,
    factors: Factors,
    tolerance: float | None = None,
) -> CaseComparison:
    """Compare a load case of A with that of B.

    tolerance : relative, of answers; None for the sum of what the two are good to, at least 1e-6
    """
    if tolerance is None:
        tolerance = max(sum(map(accuracy_of, cases)), LEAST_TOLERANCE)
    own, its = (result_of(case) for case in cases)
    answer, figures = _figures(results, cases, factors, tolerance)
    changes, load = _reactions(results, cases, matching, factors)
    return CaseComparison(
        name=cases[0].load_case.name,
        status=(cases[0].status, cases[1].status),
        flow_rule=(_rule(cases[0]), _rule(cases[1])),
        answers=(answer,),
        figures=figures,
        mechanism=_motions(results[0].model, cases, matching, factors.length),
        modes=None if own is None or its is None else compare_modes(results, cases, matching, factors.length),
        reactions=changes,
        load=load,
        time=(cases[0].solution.seconds, cases[1].solution.seconds),
    )


def _rule(case: CaseResult) -> str:
    solution = case.solution
    words = [solution.flow_rule, solution.scheme, "" if solution.contact_model == "concave" else solution.contact_model]
    return ", ".join(word for word in words if word)


def _figures(
    results: tuple[Results, Results], cases: tuple[CaseResult, CaseResult], factors: Factors, tolerance: float
) -> tuple[Figure, tuple[Figure, ...]]:
    """What a user asks of the case, and the figures beside it that one of the two has."""
    scenes = [scene_of(*each) for each in zip(results, cases, strict=True)]
    model, load_case = results[0].model, cases[0].load_case

    def compared(name: str) -> Figure:
        unit = COLUMNS[name][0].quantity.unit
        values = _value(scenes[0], name), _value(scenes[1], name) * factors.of(unit)
        least = 0.0 if unit == "degree" else least_factor(model, load_case)
        if load_case.settlement is not None and unit in ("force", "moment"):
            least = ZERO * load_case.settlement.unit
        return figure(name, None if unit == "1" else unit_text(unit, model.units), values, tolerance, least)

    asked = {_asked(case.load_case) for case in cases}
    answer = compared(asked.pop() if len(asked) == 1 else "load_factor")
    several = any(_value(each, "least_load_factor") < _value(each, "greatest_load_factor") for each in scenes)
    further = [name for name in COMPARED[4:] if several or name not in ("least_load_factor", "greatest_load_factor")]
    return answer, tuple(found for found in map(compared, further) if not np.isnan(found.values).all())


def _asked(load_case: LoadCase) -> str:
    """The quantity that answers a load case."""
    if load_case.settlement is not None:
        return "reaction_moment" if load_case.settlement.turns else "reaction_force"
    return "load_factor" if load_case.tilt is None else "angle"


def _value(scene: Scene, name: str) -> float:
    """A figure of a load case; nan where there is none."""
    column, place = COLUMNS[name]
    values = column.of(scene)
    return math.nan if values is None else float(values[0][place])


def least_factor(model: Model, load_case: LoadCase) -> float:
    """A share of dead over live load on the free blocks: load factors below are compared as if they were that."""
    dead, live = (float(np.abs(load[model.free, :3]).sum()) for load in (load_case.dead_load, load_case.live_load))
    return ZERO * dead / live if live > 0.0 else 0.0


def _motions(model: Model, cases: tuple[CaseResult, CaseResult], matching: Matching, length: float) -> MotionComparison:
    """Angle between mechanisms that are results, or between motions that prove the lack of equilibrium."""
    if not matching.comparable:
        words = f"only {min(matching.shares):.0%} of the volume has a match in the other"
        return MotionComparison(None, None, words)
    found = [result_of(case) for case in cases]
    motions = [None if mechanics is None else mechanics.mechanism for mechanics in found]
    what = "mechanism"
    if all(case.status is Status.NO_EQUILIBRIUM for case in cases):
        motions, what = [case.solution.certificate for case in cases], "motion without equilibrium"
        if any(motion is None for motion in motions):
            return MotionComparison(None, None, "no motion is given")
    if motions[0] is None or motions[1] is None:
        without = [letter for letter, motion in zip("AB", motions, strict=True) if motion is None]
        words = f"{' and '.join(without)} {'has' if len(without) == 1 else 'have'} no mechanism that is a result"
        return MotionComparison(None, None, words)
    angle = angle_between(model.blocks, motions[0], motions[1], matching, length)
    if angle is None:
        return MotionComparison(None, None, "a motion is zero")
    return MotionComparison(angle, math.cos(math.radians(angle)), what)


def _reactions(
    results: tuple[Results, Results], cases: tuple[CaseResult, CaseResult], matching: Matching, factors: Factors
) -> tuple[tuple[ReactionChange, ...], float]:
    """Supports whose force changes by more than rounding, the largest change first, and the size of the loads."""
    own, its = (result_of(case) for case in cases)
    if own is None or its is None:
        return (), 0.0
    first, second = results[0].model, results[1].model
    a = _forces(results[0], cases[0], own)
    names = {  # grounds are named by coordinates, blocks may have changed their order
        second.body_name(int(other)): first.body_name(body) for body, other in enumerate(matching.bodies) if other >= 0
    }
    b = {names.get(name, name): factors.force * force for name, force in _forces(results[1], cases[1], its).items()}
    load = float(np.linalg.norm(load_on_structure(first, cases[0].load_case, own.load_factor)[:3]))
    none = np.zeros(3)
    changes = [ReactionChange(name, b.get(name, none) - a.get(name, none)) for name in dict.fromkeys([*a, *b])]
    sizes = [float(np.linalg.norm(change.change)) for change in changes]
    order = [row for row in np.argsort(sizes)[::-1].tolist() if sizes[row] > NOISE * load]
    return tuple(changes[row] for row in order), load


def _forces(results: Results, case: CaseResult, mechanics: Mechanics) -> dict[str, FloatArray]:
    """Force of each support on the structure, (3,), by its name."""
    reactions = reactions_of(results.model, results.contacts, case.load_case, mechanics)
    return {reaction.support: reaction.wrench[:3] for reaction in reactions}
