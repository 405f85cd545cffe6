"""The capacity curve of a load case: made by steps, and found again from their forces and mechanisms alone.

Poses follow from the mechanisms, contacts from the poses, and with these every row is judged as a load case at rest is
(:mod:`mbla.solution.verification.residuals`): v_N + g/D̄ takes the place of v_N with the gaps g and the live work D̄ for
which it was solved. No matrix of the program stage is used for it and no solver called.

Where it ends, and how much it depends on the size of its steps: :mod:`mbla.solution.pushover.followed`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray, starts
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids, solids_of
from mbla.contacts.moved import MovedSearch
from mbla.contacts.tied import tied
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose, turns_and_slides
from mbla.model.ties.moved import TieHistory
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.glued import with_tie_contacts
from mbla.solution.pushover.control import MOVES, Control
from mbla.solution.pushover.followed import (
    STEP_DEPENDENCE,
    StepErrors,
    followed,
    greatest_value,
    step_dependence,
    step_errors,
)
from mbla.solution.pushover.pushed import CurveEnd, CurveRow, PushedSteps
from mbla.solution.pushover.step_program import StepProgram, moved_solids, ties_left
from mbla.solution.pushover.steps import LARGEST_MOTION, LARGEST_TURN, OFF, Pushover, Step, history_after, work_of
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Mechanics, Solution
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.case import Case, InterfaceTerms
from mbla.solution.verification.residuals import residuals_of

BY_ITSELF_SHARE, NOTABLE_DROP = 3.0, 0.02
"""Energy that the dead load loses in a step over its live work from which blocks drop in it, and over the greatest live
work of the curve from which that is said."""

SHORTER_THAN_ASKED = 0.9
"""Median step over the one asked for from which steps are said to be shorter."""

WHOLE = 1.0 - 1e-6
"""Share of the live work of a whole step that counts as all of it."""

ALIKE = 0.9
"""Cosine between the motions of two steps below which they are two mechanisms."""


@dataclass(frozen=True)
class MovedCase(Case):
    """A step: contact points come into touch at the end of it, where their gaps are used up.

    gaps     : (n_points,) m over the live work for which it was solved
    greatest : load factor to which what is left unexplained of the power is relative, besides that of the step
    """

    gaps: FloatArray
    greatest: float

    def balance(self, live_power: float, dead_power: float, frictional: float, mechanism: FloatArray) -> float:
        """The greatest load factor of the curve: power that blocks lose as they drop excuses nothing."""
        return max(abs(live_power), self.greatest, self.scale.least_factor(mechanism))

    def velocities(self, mechanism: FloatArray) -> FloatArray:
        """Velocities at the contact points, opening from where they touch, (n_points, 3)."""
        v = super().velocities(mechanism)
        v[:, 0] += self.gaps
        return v

    def interface_terms(self, mechanics: Mechanics) -> InterfaceTerms:
        """The work that normal forces do while gaps close."""
        return InterfaceTerms(dissipated=float(mechanics.contact_forces[:, 0] @ self.gaps))


def why_not_pushed(model: Model, solution: Solution, solved: bool) -> str:
    """What keeps a pushover from being done, in words; empty where nothing does."""
    crush = any(np.isfinite(law.compressive_strength) for law in model.joints.values())
    against = {
        "the load case is not solved": not solved or solution.mechanics is None,
        "guided blocks turn and move besides": turns_and_slides(model.guides),
        "joints can crush": crush,
        "flow_rule: livesley": solution.flow_rule == "livesley",
        "contact_model: convex": solution.conditions_on_interfaces,
    }
    return ", ".join(words for words, holds in against.items() if holds)


SAME_STATE = 5e-3
"""Share of the load factor within which the least state of rigid joints is that of the path."""


def start_of(solution: Solution) -> Mechanics:
    """The state that a pushover starts from: of rigid joints where a search found it, else that of elastic ones."""
    own, least = solution.mechanics, solution.least
    assert own is not None  # else there is no curve
    if least is None or abs(least.load_factor - own.load_factor) > SAME_STATE * abs(own.load_factor):
        return own
    return least


def no_pushover(against: str) -> Message:
    """The remark on what keeps a pushover from being done."""
    return Message("pushover-not-done", f"there is no pushover: {against}")


def pushed(
    model: Model,
    contacts: Contacts,
    section: ContactsSection,
    case: LoadCase,
    solution: Solution,
    settings: SolverSettings,
    log: Log,
    solved: bool,
    tell: Callable[[Callable[[], Solution]], None] = lambda so_far: None,
) -> Solution:
    """The solution of a load case with its capacity curve, or with a remark that says why there is none.

    model : as it may move under the load case
    tell  : told how to make the solution with the steps that are done by then
    """
    against = why_not_pushed(model, solution, solved)
    if against or solution.mechanics is None or case.pushover is None:
        return replace(solution, remarks=(*solution.remarks, no_pushover(against)))
    search, (first, built) = MovedSearch(model, contacts, section), _as_built(model, contacts, start_of(solution))
    control = Control.of(model, case, first.mechanism)
    push = Pushover(model, built.contacts, search, case, control, StepProgram(settings, log), case.pushover.step)
    done: list[Step] = []

    def with_curve(steps: list[Step], errors: StepErrors, end: CurveEnd) -> Solution:
        found = replace(
            solution,
            pushed=_record(steps, errors.rows),
            curve_end=end,
            curve_end_error=errors.displacement,
            curve_last_error=errors.load_factor,
        )
        found = replace(found, curve=curve_of(model, contacts, section, case, found))
        return replace(found, remarks=(*solution.remarks, *pushover_remarks(model, contacts, case, found)))

    tell(lambda: with_curve(done, StepErrors.unknown(len(done)), CurveEnd.STOPPED) if done else solution)
    steps, end = followed(push, first, done)
    return with_curve(steps, step_errors(push, first, steps, end), end)


def _step_remarks(case: LoadCase, solution: Solution) -> Iterator[Message]:
    """Remarks where the curve depends on its step, and where steps are shorter than asked for."""
    assert case.pushover is not None  # else there is no curve
    asked = case.pushover
    curve, share, end = solution.curve, step_dependence(case, solution), solution.curve_end_error
    if share > STEP_DEPENDENCE:
        words = f"with steps of twice the size figures of the pushover change by up to {share:.2g} of the greatest"
        words += f", and its end by {end:.2g} from {curve[-1].displacement:.3g}" if np.isfinite(end) else ""
        yield Message("pushover-depends-on-step", words)
    made = np.abs(np.diff([row.displacement for row in curve]))
    if len(made) and (middle := float(np.median(made))) < SHORTER_THAN_ASKED * asked.step:
        words = f"steps of the pushover are {middle:.3g} long in the middle, not {asked.step:.6g} as asked: a "
        words += f"block moves by at most {LARGEST_MOTION:g} of its size and turns by {LARGEST_TURN:g} rad in one"
        yield Message("pushover-steps-shorter", words)


def pushover_remarks(model: Model, contacts: Contacts, case: LoadCase, solution: Solution) -> tuple[Message, ...]:
    """What a reader of a capacity curve must know, from its rows and its first mechanism.

    model : as it may move under the load case
    """
    curve, remarks = solution.curve, list[Message]()
    assert solution.mechanics is not None  # else there is no curve
    first, _ = _as_built(model, contacts, start_of(solution))
    speed = Control.of(model, case, first.mechanism).speed(model, Pose.at_rest(len(model.blocks)), first.mechanism)
    if not speed > MOVES * float(np.linalg.norm(first.mechanism[:, :3], axis=1).max()):
        words = "the control point of the pushover does not go the way in which its displacement counts at first"
        remarks.append(Message("control-point-at-rest", words))
    if fall := dropped(curve):
        words = f"blocks drop without the live load where the control point has moved by {fall[0]:.6g}, and lose "
        words += f"{fall[1]:.2g} of the greatest live work: what is pushed on may fall there"
        remarks.append(Message("pushover-drops", words))
    rough = [row for row in curve[1:] if row.residual > SOLVED_RESIDUAL]
    if rough:
        worst = max(rough, key=lambda row: row.residual)
        words = f"{len(rough)} of {len(curve) - 1} steps of the pushover violate the joint law by more than "
        words += f"{SOLVED_RESIDUAL:g}, step {worst.step} the most, by {worst.residual:.2g}"
        remarks.append(Message("pushover-rough", words))
    return (*remarks, *_step_remarks(case, solution))


def _record(steps: list[Step], errors: FloatArray) -> PushedSteps:
    return PushedSteps(
        work=np.array([step.led for step in steps]),
        scale=np.array([step.scale for step in steps]),
        load_factors=np.array([step.load_factor for step in steps]),
        mechanisms=np.stack([step.mechanism for step in steps]),
        fallen=np.stack([step.fallen for step in steps]),
        point_start=starts(np.array([len(step.forces) for step in steps])),
        forces=np.vstack([step.forces for step in steps]),
        errors=errors,
    )


def _as_built(model: Model, contacts: Contacts, first: Mechanics) -> tuple[Mechanics, Solids]:
    """Limit analysis and its solids with ties among the contacts, which need no prestress here."""
    ties = replace(model.ties, prestress=np.zeros(len(model.ties)))
    solids = tied(solids_of(replace(model, ties=ties), contacts))
    return with_tie_contacts(first, solids), solids


def begun_by(model: Model, contacts: Contacts, solution: Solution) -> Solution:
    """The solution with the forces and the mechanism of limit analysis for step 0 of its pushover, as they must be."""
    steps = solution.pushed
    if steps is None or solution.mechanics is None:
        return solution
    first, _ = _as_built(model, contacts, start_of(solution))
    if int(steps.point_start[1]) != len(first.contact_forces):
        return solution
    factors, mechanisms, forces = steps.load_factors.copy(), steps.mechanisms.copy(), steps.forces.copy()
    factors[0], mechanisms[0], forces[: len(first.contact_forces)] = (
        first.load_factor,
        first.mechanism,
        first.contact_forces,
    )
    return replace(solution, pushed=replace(steps, load_factors=factors, mechanisms=mechanisms, forces=forces))


def curve_of(
    model: Model, contacts: Contacts, section: ContactsSection, case: LoadCase, solution: Solution
) -> tuple[CurveRow, ...]:
    """Rows of the curve from forces and mechanisms of its steps; those of step 0 are the ones of limit analysis.

    model : as it may move under the load case

    A step whose forces are not those of the contact points of its pose has residuals of nan. Gaps close over no less
    than a whole step, from there or from the pose before, whatever that is said to be for which it was solved.
    """
    steps = solution.pushed
    assert solution.mechanics is not None  # else there is no curve
    assert steps is not None
    assert case.pushover is not None
    first, built = _as_built(model, contacts, start_of(solution))
    search, control = MovedSearch(model, contacts, section), Control.of(model, case, first.mechanism)
    rows: list[CurveRow] = []
    greatest = greatest_value(case, steps.load_factors)
    work, before = np.zeros(4), np.zeros(4)
    history, last, whole = TieHistory.at_rest(model.ties), Pose.at_rest(len(model.blocks)), np.inf
    for number, pose in enumerate(steps.poses):
        mechanics, fallen = _mechanics_of(steps, number) if number else first, steps.fallen[number]
        if number:
            whole = min(work_of(model, control, case.pushover.step, last, steps.mechanisms[number - 1]), whole)
            own = work_of(model, control, case.pushover.step, pose, mechanics.mechanism)
            least = min(whole, own / (1.0 + OFF))
            scale = steps.scale[number] if steps.scale[number] >= WHOLE * least else whole
            history = history_after(model, history, last, steps.work[number] * steps.mechanisms[number - 1], pose)
            ties = ties_left(model, pose, fallen, history)
            solids, loads, found = moved_solids(model, search.at(pose, fallen), case, pose, fallen, *ties)
            gaps, whole = found.gaps / scale, scale
        else:
            solids, gaps = built, np.zeros(len(first.contact_forces))
            loads = solids.load_case(case)
        last = pose
        overlap = 0.0 if number == 0 else abs(float(found.gaps.min(initial=0.0)))
        step = MovedCase(solids.model, solids.contacts, loads, gaps, greatest)
        residual, powers = np.nan, np.zeros(4)
        if len(gaps) == len(mechanics.contact_forces):
            of_solids = replace(mechanics, mechanism=solids.solid_motions(mechanics.mechanism))
            dilatancy = step.limits.dilatancy_by(solution.flow_rule)
            residual, powers = residuals_of(step, of_solids, dilatancy).largest, _powers(step, of_solids)
        changed = number > 0 and _alike(model, steps.mechanisms[number - 1], mechanics.mechanism) < ALIKE
        work = work + 0.5 * (before + (before if changed else powers)) * steps.work[number]
        row = CurveRow(
            step=number,
            displacement=control.displacement(model, pose),
            load_factor=mechanics.load_factor,
            reaction=np.nan if case.settlement is None else case.settlement.reaction(mechanics.load_factor),
            error=float(steps.errors[number]),
            residual=residual,
            overlap=overlap,
            live_work=float(work[0]),
            friction=float(work[1]),
            tie_work=float(work[2]),
            potential=float(work[3]),
            new_mechanism=changed,
            debris=int(fallen.sum()),
            broken=0 if number == 0 else int((~model.ties.of_fill).sum() - (~solids.model.ties.of_fill).sum()),
        )
        rows.append(row)
        before = powers
    return tuple(rows)


def dropped(curve: Sequence[CurveRow]) -> tuple[float, float] | None:
    """Where blocks first drop by a notable energy of the dead load without live work, and all that is lost so.

    Displacement of the control point, m, and energy over the greatest live work; None where nothing does.
    """
    size = max((abs(row.live_work) for row in curve), default=0.0)
    falls = [
        (before.displacement, lost)
        for before, after in pairwise(curve)
        if (lost := before.potential - after.potential - (after.tie_work - before.tie_work))
        > BY_ITSELF_SHARE * abs(after.live_work - before.live_work)
    ]
    lost = sum(energy for _, energy in falls)
    return (falls[0][0], lost / size) if lost > NOTABLE_DROP * size else None


def _mechanics_of(steps: PushedSteps, number: int) -> Mechanics:
    own = slice(int(steps.point_start[number]), int(steps.point_start[number + 1]))
    forces, none = steps.forces[own], np.zeros(0)
    return Mechanics(float(steps.load_factors[number]), forces, none, steps.mechanisms[number], none.astype(np.int64))


def _powers(step: MovedCase, mechanics: Mechanics) -> FloatArray:
    """Power of the live load, of friction, of ties and against the dead load, (4,)."""
    v, limits = Case.velocities(step, mechanics.mechanism), step.limits
    strength = limits.friction * mechanics.contact_forces[:, 0] + limits.cohesion
    dead, live = step.powers(mechanics.mechanism)
    tied = step.contacts.tie_points
    friction, of_ties = float(strength @ np.hypot(v[:, 1], v[:, 2])), -mechanics.contact_forces[tied, 0] @ v[tied, 0]
    return np.array([mechanics.load_factor * live, friction, float(of_ties), -dead])


def _alike(model: Model, one: FloatArray, other: FloatArray) -> float:
    """Cosine between two motions, (n_blocks, 6), rotations with half the block size as arm, by volume."""
    scale = np.sqrt(model.blocks.volumes)[:, None] * np.repeat([[1.0, 1.0]], len(one), axis=0)
    scale[:, 1] *= model.blocks.sizes / 2
    first, second = (each * np.repeat(scale, 3, axis=1) for each in (one, other))
    size = float(np.linalg.norm(first) * np.linalg.norm(second))
    return float(np.vdot(first, second)) / size if size > 0.0 else 1.0
