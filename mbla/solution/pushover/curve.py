"""The capacity curve of a load case: made by the way of its elastic joints, and found again from its rows alone.

Every row is judged as what it is, a pose at which joints with their law and their history balance the loads
(:mod:`mbla.solution.verification.pushed_rows`). Row 0 is the structure as it starts to move, whose state is that of the
load factor. How much the curve depends on the size of its steps: :mod:`mbla.solution.pushover.followed`.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose, turns_and_slides
from mbla.program.build import crushable_interfaces
from mbla.program.reductions.scene import refined
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.pushover.control import MOVES, Control
from mbla.solution.pushover.followed import STEP_DEPENDENCE, StepErrors, step_dependence, step_errors
from mbla.solution.pushover.place import Row
from mbla.solution.pushover.pose.structure import PushedStructure
from mbla.solution.pushover.pushed import CurveEnd, CurveRow
from mbla.solution.pushover.pushover import NOT_PUSHED, Pushover
from mbla.solution.pushover.record import PushedRows, RecordedRow, RowPoints, recorded
from mbla.solution.pushover.way import Way
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Mechanics, Solution
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.pushed_rows import row_residuals
from mbla.solution.verification.verify import residual_of

BY_ITSELF_SHARE, NOTABLE_DROP = 3.0, 0.02
"""Energy that the dead load loses between two rows over the live work from which blocks drop there, and over the
greatest live work of the curve from which that is said."""

AT_REST = 1e-9
"""Speed of the control point over the greatest with which it does not move."""

MORE_POINTS = "give contacts.points a per_edge or spacing"
"""What helps where joints crush as stress blocks, and have points at their corners alone."""

ALIKE = 0.9
"""Cosine between the motions to two rows below which they are two mechanisms."""


Found: TypeAlias = tuple[Pushover, tuple[Message, ...]]
"""A pushover, and what a reader of it must know."""

RESTS = "the control point does not move as the structure starts to: leave control out, or name blocks that move"
"""Why a curve has no displacement."""


def why_not_pushed(model: Model, contacts: Contacts, case: LoadCase, solution: Solution, solved: bool) -> str:
    """What keeps a pushover from being done, in words; empty where nothing does."""
    at_corners = solution.stress_blocks and _crushes_at_corners(model, contacts)
    against = {
        "the load case is not solved": not solved or solution.mechanics is None,
        "the table collapses at no angle": case.tilt is not None and np.isnan(factor_at_start(case, solution)),
        "guided blocks turn and move besides": turns_and_slides(model.guides),
        f"joints can crush, which is followed at points: {MORE_POINTS}": at_corners,
        "nothing touches it": not len(contacts.points),
        "flow_rule: livesley": solution.flow_rule == "livesley",
        "contact_model: convex": solution.contact_model == "convex",
        RESTS: _rests(model, case, solution),
    }
    against |= dict.fromkeys(_above_start(case, solution), True)
    return ", ".join(words for words, holds in against.items() if holds)


def _above_start(case: LoadCase, solution: Solution) -> Iterator[str]:
    """In words: the end of the curve is asked for at no lower load factor than that of its beginning."""
    asked = case.pushover
    if asked is None or not case.question.multiplies or solution.mechanics is None:
        return
    first = start_of(solution).load_factor
    if asked.until_load_factor >= first > 0.0:
        words = f"its until_load_factor {asked.until_load_factor:g} is not below the load factor {first:.6g} at which "
        yield words + "the structure starts to move: give a lower one"


def _crushes_at_corners(model: Model, contacts: Contacts) -> bool:
    """Whether an interface that can crush has contact points at its corners alone."""
    interface = contacts.interface_of_point
    grid = refined(interface, contacts.points, contacts.frames[:, 0])
    has_grid = np.bincount(interface, grid, len(contacts)) > 0.0
    return bool((crushable_interfaces(model, contacts) & ~has_grid).any())


SAME_STATE = 5e-3
"""Share of the load factor within which the least state of rigid joints is that of the path."""


def start_of(solution: Solution) -> Mechanics:
    """The state that a pushover starts from: of rigid joints where a search found it, else that of elastic ones."""
    own, least = solution.mechanics, solution.least
    assert own is not None  # else there is no curve
    if least is None or abs(least.load_factor - own.load_factor) > SAME_STATE * abs(own.load_factor):
        return own
    return least


def factor_at_start(case: LoadCase, solution: Solution) -> float:
    """Load factor of row 0; of a tilting table its angle in radians. nan where the structure does not start to move."""
    if solution.mechanics is None:
        return np.nan
    return case.question.followed(start_of(solution).load_factor)


def no_pushover(against: str) -> Message:
    """The remark on what keeps a pushover from being done."""
    return Message("pushover-not-done", f"there is no pushover: {against}")


def pushed(
    assembly: Assembly,
    section: ContactsSection,
    case: LoadCase,
    solution: Solution,
    settings: SolverSettings,
    log: Log,
    solved: bool,
    tell: Callable[[Callable[[], Found]], None] = lambda so_far: None,
) -> Found:
    """The capacity curve of a load case and remarks on it, or a remark that says why there is none.

    tell : told how to make the same with the rows that are done by then
    """
    model = assembly.model.of_case(case)
    against = why_not_pushed(model, assembly.contacts, case, solution, solved)
    asked, first = case.pushover, solution.mechanics
    if against or first is None or asked is None:
        return NOT_PUSHED, (no_pushover(against),)
    first = replace(start_of(solution), load_factor=factor_at_start(case, solution))
    structure = PushedStructure.of(assembly, section, case, settings.analysis.flow_rule)
    control = Control.of(model, case, first.mechanism)
    watch = _watched(log)
    ends = asked.until, asked.until_load_factor, asked.steps
    way = Way(structure, control, first, asked.step, *ends, settings.deadline, watch=watch)
    done = [_row_0(model, first)]

    def found(rows: list[RecordedRow], errors: StepErrors, end: CurveEnd) -> Found:
        record = recorded(rows, way.stiffness).with_errors(errors.rows)
        curve = curve_of(assembly, case, solution, record)
        pushover = Pushover(curve, end, errors.displacement, errors.load_factor, record)
        return pushover, pushover_remarks(model, case, solution, pushover)

    tell(lambda: found(done, StepErrors.unknown(len(done)), CurveEnd.STOPPED))
    end = _followed(way, done)
    errors = StepErrors.unknown(len(done))
    if asked.error and end is not CurveEnd.LATE:
        longer = [_row_0(model, first)]
        other = _followed(replace(way, step=2.0 * asked.step, most=2.0), longer)
        errors = step_errors(_figures(model, control, done), end, _figures(model, control, longer), other)
    return found(done, errors, end)


def _watched(log: Log) -> Callable[[int, float, bool], None]:
    """Tells the log of steps; those that are not made have a step of 0."""
    started, count = time.perf_counter(), itertools.count(1)

    def watch(row: int, factor: float, made: bool) -> None:
        seconds = time.perf_counter() - started
        log(IterationRecord(row, next(count), factor, np.nan, np.nan, np.nan, float(made), seconds))

    return watch


def _row_0(model: Model, first: Mechanics) -> RecordedRow:
    none = np.zeros(len(model.blocks), dtype=np.bool_)
    return RecordedRow(first.load_factor, Pose.at_rest(len(none)), none, (0.0, 0.0, 0.0, 0.0, 0.0), RowPoints.none())


def _followed(way: Way, rows: list[RecordedRow]) -> CurveEnd:
    """Why the curve ends; ``rows`` gets each row as soon as it is done."""
    jumps, missed = way.jumps, way.missed
    for found in way.rows():
        if isinstance(found, CurveEnd):
            return found
        rows.append(replace(_recorded(found), jumps=way.jumps - jumps, unsolved=way.missed - missed))
        jumps, missed = way.jumps, way.missed
    raise AssertionError("a way says how it ends")


def _figures(model: Model, control: Control, rows: Sequence[RecordedRow]) -> list[tuple[float, float]]:
    return [(control.displacement(model, row.pose), row.load_factor) for row in rows]


def _recorded(row: Row) -> RecordedRow:
    joints, points = row.joints, row.joints.touching.points
    contacts, n_ties, structure = joints.touching.contacts, len(joints.ties), joints.structure
    at_zero = row.history.values.copy()
    at_zero[1:] += joints.shear_stiffness * row.history.slips
    laws = list(structure.model.joints)
    of_contact = np.array([laws.index(name) for name in contacts.joint_names], dtype=np.int64)
    always = np.zeros((len(row.forces), 3))  # N is what the force of a tie differs from it
    if n_ties and joints.contacts.ties is not None:
        always[-n_ties:, 0] = joints.contacts.ties.offsets
    found = RowPoints(
        bodies=_with_ties(points.bodies, n_ties, -1),
        host=_with_ties(points.host, n_ties, False),
        arms=_with_ties(points.arms.transpose(1, 0, 2), n_ties, 0.0),
        frames=_with_ties(points.frames, n_ties, 0.0),
        laws=np.append(of_contact[contacts.joints][contacts.interface_of_point], joints.ties),
        areas=np.column_stack([np.append(contacts.point_areas, np.zeros(n_ties)), joints.full.facts.areas]),
        history=joints.forces(at_zero) + always,
        forces=row.forces + always,
    )
    fallen = joints.fallen[structure.solids.label]
    energy = row.energy
    energies = (energy.live, energy.friction, energy.ties, energy.crushing, energy.potential)
    return RecordedRow(row.load_factor, structure.blocks_at(row.pose), fallen, energies, found)


def _with_ties(values: np.ndarray, n_ties: int, of_tie: float) -> np.ndarray:
    return np.concatenate([values, np.full((n_ties, *values.shape[1:]), of_tie, dtype=values.dtype)])


def _step_remarks(case: LoadCase, pushover: Pushover) -> Iterator[Message]:
    """The remark where the curve depends on its step."""
    curve, share, end = pushover.curve, step_dependence(case, pushover), pushover.curve_end_error
    if share > STEP_DEPENDENCE:
        words = f"with steps of twice the size figures of the pushover change by up to {share:.2g} of the greatest"
        words += f", and its end by {end:.2g} from {curve[-1].displacement:.3g}" if np.isfinite(end) else ""
        yield Message("pushover-depends-on-step", words)


def pushover_remarks(model: Model, case: LoadCase, solution: Solution, pushover: Pushover) -> tuple[Message, ...]:
    """What a reader of a capacity curve must know, from its rows and its first mechanism.

    model : as it may move under the load case
    """
    curve, remarks = pushover.curve, list[Message]()
    assert solution.mechanics is not None  # else there is no curve
    first = start_of(solution)
    if not _speed(model, Control.of(model, case, first.mechanism), first) > MOVES * _greatest_speed(first):
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
    return (*remarks, *_step_remarks(case, pushover))


def begun_by(case: LoadCase, solution: Solution, rows: PushedRows) -> PushedRows:
    """Rows of a pushover with the load factor at which the structure starts to move in row 0, as it must be."""
    factors, shifts = rows.load_factors.copy(), rows.shifts.copy()
    turns, fallen = rows.turns.copy(), rows.fallen.copy()
    factors[0], shifts[0], turns[0], fallen[0] = factor_at_start(case, solution), 0.0, 0.0, False
    return replace(rows, load_factors=factors, shifts=shifts, turns=turns, fallen=fallen)


def curve_of(assembly: Assembly, case: LoadCase, solution: Solution, rows: PushedRows) -> tuple[CurveRow, ...]:
    """Rows of the curve from poses, points, forces and history on record; row 0 is that of the load factor."""
    model = assembly.model.of_case(case)
    control = Control.of(model, case, start_of(solution).mechanism)
    found = row_residuals(assembly, case, solution.flow_rule, rows)
    poses, factors, start = list(rows.poses), rows.load_factors, "mechanics"
    if solution.least is not None and start_of(solution) is solution.least:
        start = "least"
    begins = residual_of(assembly, case, solution, start)
    curve, figures = list[CurveRow](), [case.question.value_at(float(factor)) for factor in factors]
    motions = [np.zeros((len(model.blocks), 6))]
    for number, pose in enumerate(poses):
        if number:
            motions.append(poses[number - 1].motion_to(pose))
        broken = int((~model.ties.of_fill).sum()) - _ties_left(model, rows.points_of(number)) if number else 0
        curve.append(
            CurveRow(
                step=number,
                displacement=control.displacement(model, pose),
                load_factor=float(factors[number]),
                reaction=figures[number] if case.question.group == "reaction" else np.nan,
                angle=figures[number] if case.question.group == "angle" else np.nan,
                error=float(rows.errors[number]),
                residual=found[number].largest if number else begins,
                overlap=found[number].overlap if number else 0.0,
                live_work=float(rows.energies[number, 0]),
                friction=float(rows.energies[number, 1]),
                tie_work=float(rows.energies[number, 2]),
                crushing=float(rows.energies[number, 3]),
                potential=float(rows.energies[number, 4]),
                new_mechanism=number > 1 and _alike(model, motions[number - 1], motions[number]) < ALIKE,
                jumps=int(rows.jumps[number]),
                unsolved=int(rows.unsolved[number]),
                debris=int(rows.fallen[number].sum()),
                broken=broken,
            )
        )
    return tuple(curve)


def _rests(model: Model, case: LoadCase, solution: Solution) -> bool:
    """Whether the control point does not move at first."""
    if solution.mechanics is None:
        return False
    first = start_of(solution)
    return not abs(_speed(model, Control.of(model, case, first.mechanism), first)) > AT_REST * _greatest_speed(first)


def _speed(model: Model, control: Control, first: Mechanics) -> float:
    """Of the control point as the structure starts to move."""
    return control.speed(model, Pose.at_rest(len(model.blocks)), first.mechanism)


def _greatest_speed(first: Mechanics) -> float:
    return float(np.linalg.norm(first.mechanism[:, :3], axis=1).max())


def _ties_left(model: Model, points: RowPoints) -> int:
    """Ties, but for those of fill, that a row has."""
    own = points.laws[points.bodies[:, 0] < 0]
    return int((~model.ties.of_fill[own]).sum())


def dropped(curve: Sequence[CurveRow]) -> tuple[float, float] | None:
    """Where blocks first drop by a notable energy of the dead load without live work, and all that is lost so.

    Displacement of the control point, m, and energy over the greatest live work; None where nothing does.
    """
    size = max((abs(row.live_work) for row in curve), default=0.0)
    falls = [
        (before.displacement, lost)
        for before, after in pairwise(curve)
        if (lost := before.potential - after.potential - _taken(before, after))
        > BY_ITSELF_SHARE * abs(after.live_work - before.live_work)
    ]
    lost = sum(energy for _, energy in falls)
    return (falls[0][0], lost / size) if lost > NOTABLE_DROP * size else None


def _taken(before: CurveRow, after: CurveRow) -> float:
    """What ties and joints that crush take from one row to the next."""
    return after.tie_work - before.tie_work + after.crushing - before.crushing


def _alike(model: Model, one: FloatArray, other: FloatArray) -> float:
    """Cosine between two motions, (n_blocks, 6), rotations with half the block size as arm, by volume."""
    scale = np.sqrt(model.blocks.volumes)[:, None] * np.repeat([[1.0, 1.0]], len(one), axis=0)
    scale[:, 1] *= model.blocks.sizes / 2
    first, second = (each * np.repeat(scale, 3, axis=1) for each in (one, other))
    size = float(np.linalg.norm(first) * np.linalg.norm(second))
    return float(np.vdot(first, second)) / size if size > 0.0 else 1.0
