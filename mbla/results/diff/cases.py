"""One load case in two results: the figures of the record, mechanism, modes and reactions.

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
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.mechanics import load_on_structure, reactions_of
from mbla.results.collapse.motion import displacements_at
from mbla.results.diff.matching import Factors, Matching, match_interfaces
from mbla.results.outcome import law_residual, least_answer, least_factor, result_of
from mbla.results.record.columns import CASE_COLUMNS
from mbla.results.record.quantity import unit_text
from mbla.results.record.scene import Scene
from mbla.results.results import CaseResult
from mbla.solution.solution import Status

LEAST_TOLERANCE = 1e-6
"""Relative difference of answers that counts as zero: the accuracy to which solved programs agree."""
NOISE = 1e-9
"""Share of the loads below which a difference of reactions is rounding."""
ANSWERS = ("load_factor", "angle", "reaction_force", "reaction_moment")
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
    name: (column, place)
    for column in CASE_COLUMNS
    for place, name, _ in column.quantity.components()
    if name in (*ANSWERS, *FURTHER)
}
"""column of each, and its place in it"""


@dataclass(frozen=True)
class Figure:
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


def figure(name: str, unit: str | None, values: tuple[float, float], tolerance: float, least: float = 0.0) -> Figure:
    """The difference of two values against a relative tolerance; ``least`` is the size below which they count as it."""
    first, second = values
    if math.isnan(first) or math.isnan(second):
        return Figure(name, unit, values, math.nan, tolerance, math.isnan(first) and math.isnan(second))
    size = max(abs(first), least) or abs(second)
    difference = (second - first) / size if size > 0.0 else 0.0
    return Figure(name, unit, values, difference, tolerance, abs(difference) <= tolerance)


@dataclass(frozen=True)
class MotionComparison:
    """Mechanisms.

    angle    : degrees between them; None where they cannot be compared
    compared : what is: ``mechanism``, or ``motion without equilibrium``; why not where it is not
    """

    angle: float | None
    compared: str


@dataclass(frozen=True)
class ModeComparison:
    """How many interfaces both results have, how many A alone and B alone, and modes where they differ.

    changed : bodies as A names them, centroid in A (3,), modes in A and in B
    """

    compared: int
    only: tuple[int, int]
    changed: tuple[tuple[str, FloatArray, tuple[str, str]], ...]


@dataclass(frozen=True)
class CaseComparison:
    """What differs in a load case; pairs are of A and of B.

    flow_rule : with scheme and contact model
    answers   : load factor, angle or reaction
    figures   : what else is known of the load factor
    modes     : None where one of the two has no mechanism that is a result
    reactions : by support, force in B less that in A, (3,) in the unit of A, where it differs; the largest first
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
    reactions: dict[str, FloatArray]
    load: float
    time: tuple[float, float]

    @property
    def differs(self) -> bool:
        """Whether status or answer do; forces, modes and bounds may differ where these do not."""
        return self.status[0] is not self.status[1] or not all(answer.same for answer in self.answers)


def compare_cases(
    first: Scene, second: Scene, matching: Matching, factors: Factors, tolerance: float | None
) -> CaseComparison:
    """A load case of A with that of B.

    tolerance : relative, of answers; None for the sum of what the two are good to, at least 1e-6
    """
    own, its = _case(first), _case(second)
    if tolerance is None:
        tolerance = max(accuracy_of(own) + accuracy_of(its), LEAST_TOLERANCE)
    answer, figures = _figures(first, second, factors, tolerance)
    results = result_of(own) is not None and result_of(its) is not None
    return CaseComparison(
        name=own.load_case.name,
        status=(own.status, its.status),
        flow_rule=(_rule(own), _rule(its)),
        answers=(answer,),
        figures=figures,
        mechanism=_motions(first, second, matching, factors.length),
        modes=_modes(first, second, matching, factors.length) if results else None,
        reactions=_reactions(first, second, matching, factors) if results else {},
        load=_load(first),
        time=(own.solution.seconds, its.solution.seconds),
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


def _figures(first: Scene, second: Scene, factors: Factors, tolerance: float) -> tuple[Figure, tuple[Figure, ...]]:
    """What a user asks of the case, and the further figures that one of the two has."""
    load_case = _case(first).load_case

    def compared(name: str) -> Figure:
        unit = COLUMNS[name][0].quantity.unit
        values = _value(first, name), _value(second, name) * factors.of(unit)
        own = name == load_case.question.column
        least = (least_answer if own else least_factor)(first.model, load_case)
        return figure(name, None if unit == "1" else unit_text(unit, first.model.units), values, tolerance, least)

    asked = {_case(scene).load_case.question.column for scene in (first, second)}
    answer = compared(asked.pop() if len(asked) == 1 else "load_factor")
    further = [compared(name) for name in FURTHER]
    return answer, tuple(found for found in further if not np.isnan(found.values).all())


def _value(scene: Scene, name: str) -> float:
    """A figure of a load case; nan where there is none."""
    column, place = COLUMNS[name]
    values = column.of(scene)
    return math.nan if values is None else float(values[0][place])


def _motions(first: Scene, second: Scene, matching: Matching, length: float) -> MotionComparison:
    """Angle between mechanisms that are results, or between motions that prove the lack of equilibrium."""
    if not matching.comparable:
        words = f"only {min(matching.shares):.0%} of the volume has a match in the other"
        return MotionComparison(None, words)
    falls = all(_case(scene).status is Status.NO_EQUILIBRIUM for scene in (first, second))
    what = "motion without equilibrium" if falls else "mechanism"
    motions = {letter: _motion(scene, falls=falls) for letter, scene in (("A", first), ("B", second))}
    without = [letter for letter, motion in motions.items() if motion is None]
    if motions["A"] is None or motions["B"] is None:
        verb = "has" if len(without) == 1 else "have"
        return MotionComparison(None, f"{' and '.join(without)} {verb} no {what} that is a result")
    angle = angle_between(first.model.blocks, motions["A"], motions["B"], matching, length)
    if angle is None:
        return MotionComparison(None, "a motion is zero")
    return MotionComparison(angle, what)


def _motion(scene: Scene, *, falls: bool) -> FloatArray | None:
    """Mechanism of a result, or motion of a fall, (n_blocks, 6)."""
    found = result_of(_case(scene))
    return scene.certificate if falls else None if found is None else found.mechanism


def angle_between(
    blocks: Blocks, first: FloatArray, second: FloatArray, matching: Matching, length: float
) -> float | None:
    """Degrees between mechanisms (n_blocks, 6) of A and of B; None where one of them is zero.

    length : of B's unit of length in that of A
    """
    rows = matching.bodies[: len(blocks)]
    there = rows >= 0
    other = np.where(there[:, None], second[rows] * np.repeat([length, 1.0], 3), 0.0)
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


def _modes(first: Scene, second: Scene, matching: Matching, length: float) -> ModeComparison:
    """Modes of two mechanisms at the interfaces that both have."""
    assert first.interfaces is not None  # asked for results only
    assert second.interfaces is not None
    rows = match_interfaces(first.contacts, second.contacts, matching, length)
    both = np.flatnonzero(rows >= 0)
    own, other = first.interfaces.modes[both], second.interfaces.modes[rows[both]]
    changed = [
        (
            "/".join(first.model.body_name(int(body)) for body in first.contacts.bodies[row]),
            first.contacts.centroids[row],
            (InterfaceMode(old).name.lower(), InterfaceMode(new).name.lower()),
        )
        for row, old, new in zip(both.tolist(), own.tolist(), other.tolist(), strict=True)
        if old != new
    ]
    only = len(rows) - len(both), len(second.contacts) - len(np.unique(rows[both]))
    return ModeComparison(len(both), only, tuple(changed))


def _reactions(first: Scene, second: Scene, matching: Matching, factors: Factors) -> dict[str, FloatArray]:
    """Changes of the forces of supports by more than rounding, the largest first."""
    names = {  # grounds are named by coordinates, blocks may have changed their order
        second.model.body_name(int(other)): first.model.body_name(body)
        for body, other in enumerate(matching.bodies)
        if other >= 0
    }
    a = _forces(first)
    b = {names.get(name, name): factors.force * force for name, force in _forces(second).items()}
    changes = {name: b.get(name, np.zeros(3)) - a.get(name, np.zeros(3)) for name in a | b}
    sizes = {name: float(np.linalg.norm(change)) for name, change in changes.items()}
    notable = [name for name, size in sizes.items() if size > NOISE * _load(first)]
    return {name: changes[name] for name in sorted(notable, key=lambda name: -sizes[name])}


def _forces(scene: Scene) -> dict[str, FloatArray]:
    """Force of each support on the structure, (3,), by its name."""
    assert scene.mechanics is not None  # asked for results only
    reactions = reactions_of(scene.model, scene.contacts, _case(scene).load_case, scene.mechanics)
    return {reaction.support: reaction.wrench[:3] for reaction in reactions}


def _load(scene: Scene) -> float:
    """Size of the loads on the free blocks at the load factor; of the dead load where there is none."""
    found = result_of(_case(scene))
    load = load_on_structure(scene.model, _case(scene).load_case, 0.0 if found is None else found.load_factor)
    return float(np.linalg.norm(load[:3]))
