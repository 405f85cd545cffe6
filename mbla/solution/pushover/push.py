"""A structure is pushed: the way of its elastic joints is followed, then once more with longer steps."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.pushover.control import Control
from mbla.solution.pushover.curve import curve_of, pushover_remarks
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.followed import StepErrors, step_errors
from mbla.solution.pushover.place import Row
from mbla.solution.pushover.pose.structure import PushedStructure
from mbla.solution.pushover.pushover import NOT_PUSHED, Pushover
from mbla.solution.pushover.record import RecordedRow, RowPoints, recorded
from mbla.solution.pushover.start import factor_at_start, no_pushover, start_of, why_not_pushed
from mbla.solution.pushover.way import Way
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Mechanics, Solution

PushoverResult: TypeAlias = tuple[Pushover, tuple[Message, ...]]
"""A pushover, and what a reader of it must know."""


def push(
    assembly: Assembly,
    section: ContactsSection,
    case: LoadCase,
    solution: Solution,
    settings: SolverSettings,
    log: Log,
    solved: bool,
    tell: Callable[[Callable[[], PushoverResult]], None] = lambda so_far: None,
) -> PushoverResult:
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
    ends = asked.until, asked.until_load_factor, asked.steps
    way = Way(structure, control, first, asked.step, *ends, settings.deadline, watch=_watched(log))
    done = [_row_0(model, first)]

    def found(rows: list[RecordedRow], errors: StepErrors, end: CurveEnd) -> PushoverResult:
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
    always = np.zeros((len(row.forces), 3))  # N is what the force of a tie differs from it
    if n_ties and joints.contacts.ties is not None:
        always[-n_ties:, 0] = joints.contacts.ties.offsets
    found = RowPoints(
        bodies=_with_ties(points.bodies, n_ties, -1),
        host=_with_ties(points.host, n_ties, False),
        arms=_with_ties(points.arms.transpose(1, 0, 2), n_ties, 0.0),
        frames=_with_ties(points.frames, n_ties, 0.0),
        laws=np.append(structure.laws_of(contacts)[contacts.interface_of_point], joints.ties),
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
