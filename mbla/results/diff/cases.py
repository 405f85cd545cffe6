"""One load case in two results: the figures of the record, and the mechanism.

Figures of B are brought into the units of A. The angle between two mechanisms is as the kinetic energy of the blocks
measures it: cos φ = ⟨u, v⟩/√(⟨u, u⟩⟨v, v⟩) with ⟨u, v⟩ = ∫ρ u·v dV over the blocks that both have, by points that have
the inertia of a box. It is 0 degrees for the same motion, however scaled; 90 where nothing of the one is in the other;
180 for the opposite motion.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.units import METRES, NEWTONS
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.motion import displacements_at
from mbla.results.diff.matching import Matching
from mbla.results.outcome import law_residual, least_answer, least_factor, result_of
from mbla.results.quantities.quantity import UnitKind, unit_text
from mbla.results.quantities.registry import CASE_COLUMNS
from mbla.results.record.scene import Scene
from mbla.results.results import CaseResult
from mbla.solution.solution import Status

LEAST_TOLERANCE = 1e-6
"""Relative difference of answers that counts as zero: the accuracy to which solved programs agree."""
ANSWERS = ("load_factor", "angle", "reaction_force", "reaction_moment", "peak_displacement", "first_period")
"""figures of the record of which each load case has one"""
FURTHER = (
    "associative_load_factor",
    "static_bound",
    "kinematic_bound",
    "least_load_factor",
    "torsion_load_factor",
    "path_last",
)
"""figures that are compared besides"""
COLUMNS = {
    name: (quantity, place)
    for quantity in CASE_COLUMNS
    for place, name, _ in quantity.components()
    if name in (*ANSWERS, *FURTHER)
}
"""quantity of each, and its place in it"""


@dataclass(frozen=True)
class ComparedFigure:
    """A quantity of the record in A and in B, both in the unit of A; nan where there is none.

    difference : (B - A) over A, at least over a least size, over B where A is zero; nan where one of them is missing
    same       : within the tolerance, or missing in both
    """

    name: str
    unit: str | None
    values: tuple[float, float]
    difference: float
    tolerance: float
    same: bool


def figure(
    name: str, unit: str | None, values: tuple[float, float], tolerance: float, least: float = 0.0
) -> ComparedFigure:
    """The difference of two values against a relative tolerance; ``least`` is the size below which they count as it."""
    first, second = values
    if math.isnan(first) or math.isnan(second):
        return ComparedFigure(name, unit, values, math.nan, tolerance, math.isnan(first) and math.isnan(second))
    size = max(abs(first), least) or abs(second)
    difference = (second - first) / size if size > 0.0 else 0.0
    return ComparedFigure(name, unit, values, difference, tolerance, abs(difference) <= tolerance)


@dataclass(frozen=True)
class MotionComparison:
    """Mechanisms.

    angle    : degrees between them; None where they cannot be compared
    compared : what is: ``mechanism``, or ``motion without equilibrium``; why not where it is not
    """

    angle: float | None
    compared: str


@dataclass(frozen=True)
class CaseComparison:
    """What differs in a load case; pairs are of A and of B.

    flow_rule : with scheme and contact model
    answers   : load factor, angle or reaction
    figures   : what else is known of the load factor
    """

    name: str
    status: tuple[Status, Status]
    flow_rule: tuple[str, str]
    answers: tuple[ComparedFigure, ...]
    figures: tuple[ComparedFigure, ...]
    mechanism: MotionComparison

    @property
    def differs(self) -> bool:
        """Whether status or answer do; mechanism and bounds may differ where these do not."""
        return self.status[0] is not self.status[1] or not all(answer.same for answer in self.answers)


def compare_cases(first: Scene, second: Scene, matching: Matching, tolerance: float | None) -> CaseComparison:
    """A load case of A with that of B.

    tolerance : relative, of answers; None for the sum of what the two are good to, at least 1e-6
    """
    own, its = _case(first), _case(second)
    if tolerance is None:
        tolerance = max(accuracy_of(own) + accuracy_of(its), LEAST_TOLERANCE)
    answer, figures = _figures(first, second, tolerance)
    return CaseComparison(
        name=own.load_case.name,
        status=(own.status, its.status),
        flow_rule=(_rule(own), _rule(its)),
        answers=(answer,),
        figures=figures,
        mechanism=_motions(first, second, matching),
    )


def _case(scene: Scene) -> CaseResult:
    assert scene.case is not None  # made of one
    return scene.case


def accuracy_of(case: CaseResult) -> float:
    """What a load factor is good to, relatively: its gap with associative flow, else its largest residual."""
    value = case.checks.gap if case.solution.flow_rule == "associative" else law_residual(case.checks)
    return 0.0 if result_of(case) is None or math.isnan(value) else value


def _rule(case: CaseResult) -> str:
    solution = case.solution
    words = [solution.flow_rule, solution.scheme, "" if solution.contact_model == "concave" else solution.contact_model]
    return ", ".join(word for word in words if word)


def _figures(first: Scene, second: Scene, tolerance: float) -> tuple[ComparedFigure, tuple[ComparedFigure, ...]]:
    """What a user asks of the case, and the further figures that one of the two has."""
    load_case = _case(first).load_case
    units, its = first.model.units, second.model.units
    force = NEWTONS[its.force] / NEWTONS[units.force]
    length = METRES[its.length] / METRES[units.length]
    factors: dict[UnitKind, float] = {"force": force, "moment": force * length, "length": length}

    def compared(name: str) -> ComparedFigure:
        unit = COLUMNS[name][0].unit
        values = _value(first, name), _value(second, name) * factors.get(unit, 1.0)
        own = name == load_case.question.column
        least = (least_answer if own else least_factor)(first.model, load_case)
        return figure(name, None if unit == "1" else unit_text(unit, units), values, tolerance, least)

    asked = {_case(scene).load_case.question.column for scene in (first, second)}
    answer = compared(asked.pop() if len(asked) == 1 else "load_factor")
    further = [compared(name) for name in FURTHER]
    return answer, tuple(found for found in further if not np.isnan(found.values).all())


def _value(scene: Scene, name: str) -> float:
    """A figure of a load case; nan where there is none."""
    quantity, place = COLUMNS[name]
    value = quantity.of(scene)
    return math.nan if value is None else float(np.asarray(value)[place])


def _motions(first: Scene, second: Scene, matching: Matching) -> MotionComparison:
    """Angle between mechanisms that are results, or between motions that prove the lack of equilibrium."""
    if not matching.comparable:
        words = f"only {matching.share:.0%} of the volume has a match in the other"
        return MotionComparison(None, words)
    falls = all(_case(scene).status is Status.NO_EQUILIBRIUM for scene in (first, second))
    what = "motion without equilibrium" if falls else "mechanism"
    motions = {letter: _motion(scene, falls=falls) for letter, scene in (("A", first), ("B", second))}
    without = [letter for letter, motion in motions.items() if motion is None]
    if motions["A"] is None or motions["B"] is None:
        verb = "has" if len(without) == 1 else "have"
        return MotionComparison(None, f"{' and '.join(without)} {verb} no {what} that is a result")
    angle = angle_between(first.model.blocks, motions["A"], motions["B"], matching)
    if angle is None:
        return MotionComparison(None, "a motion is zero")
    return MotionComparison(angle, what)


def _motion(scene: Scene, *, falls: bool) -> FloatArray | None:
    """Mechanism of a result, or motion of a fall, (n_blocks, 6)."""
    found = result_of(_case(scene))
    return scene.certificate if falls else None if found is None else found.mechanism


def angle_between(blocks: Blocks, first: FloatArray, second: FloatArray, matching: Matching) -> float | None:
    """Degrees between mechanisms (n_blocks, 6) of A and of B; None where one of them is zero."""
    rows = matching.blocks
    there = rows >= 0
    other = np.where(there[:, None], second[rows] * np.repeat([matching.length, 1.0], 3), 0.0)
    own = np.where(there[:, None], first, 0.0)
    owner = blocks.block_of_vertex
    # the corners, drawn in by √3: as many points with the mass and, for a box, the inertia of the block
    points = blocks.centroids[owner] + (blocks.vertices - blocks.centroids[owner]) / math.sqrt(3.0)
    masses = blocks.masses if blocks.masses.any() else blocks.volumes
    weights = np.sqrt(masses / np.bincount(owner))[owner]
    u, v = (_unit(weights[:, None] * displacements_at(blocks, motion, owner, points)) for motion in (own, other))
    if u is None or v is None:
        return None
    # between unit vectors; the arc cosine alone loses small angles to rounding
    return math.degrees(2.0 * math.atan2(float(np.linalg.norm(u - v)), float(np.linalg.norm(u + v))))


def _unit(motion: FloatArray) -> FloatArray | None:
    """Of length 1, (n, 3); None for no motion, or one that is no number."""
    largest = float(np.abs(motion).max(initial=0.0))
    if largest == 0.0 or not math.isfinite(largest):
        return None
    return np.asarray(motion / largest / np.linalg.norm(motion / largest))
