"""A structure is followed in time: from rest under its dead load to its end, and once more with half of the step."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.solution.pushover.place import PushedPlace
from mbla.solution.pushover.rest import at_rest
from mbla.solution.pushover.way import RATIO
from mbla.solution.settings import SolverSettings
from mbla.solution.time_history.checkpoint import Checkpoint, Unfinished
from mbla.solution.time_history.frame_record import FrameKeeper
from mbla.solution.time_history.greatest import Greatest
from mbla.solution.time_history.history import HalfStep, TimeHistoryResult
from mbla.solution.time_history.instants import Instants
from mbla.solution.time_history.point_spectra import point_spectra
from mbla.solution.time_history.progress import TimeProgress
from mbla.solution.time_history.remarks import history_remarks
from mbla.solution.time_history.row_keeper import RowKeeper
from mbla.solution.time_history.step.dashpots import dashpots_of, first_period
from mbla.solution.time_history.step.march import DeckStep, March
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.time_state import TimeState
from mbla.solution.time_history.step_rows import HistoryEnd

WINDOW = 0.1
"""Share of the duration, at its end, over which it is seen whether the residual displacement still varies."""

STILL = 1e-10
"""Kinetic energy over total weight times mean size of blocks, with which the structure is at rest."""


Followed: TypeAlias = tuple[TimeHistoryResult, tuple[Message, ...], Checkpoint | None]
"""what there is of a time history, what a reader of it must know, and where it goes on"""
Watch: TypeAlias = Callable[[TimeProgress], None]


def follow(
    assembly: Assembly,
    section: ContactsSection,
    case: LoadCase,
    settings: SolverSettings,
    watch: Watch = lambda progress: None,
    tell: Callable[[Callable[[], Followed]], None] = lambda so_far: None,
    begin: Unfinished | None = None,
) -> tuple[TimeHistoryResult, tuple[Message, ...]]:
    """The time history of a load case that stands under its dead load, and what a reader of it must know.

    watch : told of every step of the deck
    tell  : told how to make the same with the steps that are done by then
    begin : what there is of the same time history, with which it goes on
    """
    started, spent = time.perf_counter(), 0.0 if begin is None else begin.found.seconds
    bodies, model = MovingBodies.of(assembly, section, case), assembly.model
    place, _ = at_rest(bodies.structure, RATIO, prestressed=True)
    if place is None:
        return TimeHistoryResult(HistoryEnd.NO_REST), ()
    way = TimeWay.of(bodies, assembly.contacts, place, settings.deadline, watch)
    way = way if begin is None else way.after(begin)

    def found(end: HistoryEnd) -> TimeHistoryResult:
        made = way.result(end)
        spectra = None if made.histories is None else point_spectra(bodies.history, made.histories)
        return replace(made, spectra=spectra, seconds=spent + time.perf_counter() - started)

    def so_far() -> Followed:
        result = found(HistoryEnd.STOPPED)
        return result, history_remarks(model, assembly.contacts, case, result), way.checkpoint

    tell(so_far)
    end = way.followed()
    result = found(end)
    if bodies.history.check and end is not HistoryEnd.LATE:
        half = _half_step(bodies, assembly.contacts, place, settings, watch)
        result = replace(result, half=half, seconds=spent + time.perf_counter() - started)
    return result, history_remarks(model, assembly.contacts, case, result)


@dataclass
class TimeWay:
    """Steps of a time history, and what is kept of them.

    begin  : the state that the last step has led to, at rest at first
    period, sag : of the structure at rest
    """

    march: March
    begin: TimeState
    period: float
    sag: float
    rows: RowKeeper
    frames: FrameKeeper
    instants: Instants
    greatest: Greatest
    deadline: float | None
    watch: Watch
    started: float = field(default_factory=time.perf_counter)

    @staticmethod
    def of(
        bodies: MovingBodies, contacts: Contacts, place: PushedPlace, deadline: float | None, watch: Watch
    ) -> TimeWay:
        """From rest."""
        joints, at, history = place.joints, place.joints.unloaded(place.pose), bodies.history
        period = first_period(bodies, joints, at, (at.offsets[0] < 0.0).astype(np.float64))
        of_all = history.damping * period / np.pi if history.damping else 0.0
        state = TimeState.at_rest(place, dashpots_of(bodies, joints, at, of_all))
        rest = bodies.structure.blocks_at(place.pose)
        window = round(WINDOW * history.duration / history.step)
        sag = float(np.linalg.norm(rest.shift, axis=1).max(initial=0.0))
        return TimeWay(
            March(bodies, of_all),
            state,
            period,
            sag,
            RowKeeper.of(state),
            FrameKeeper(bodies),
            Instants.of(bodies, contacts, rest),
            Greatest.of(bodies.structure.model, contacts, rest, bodies.down, window),
            deadline,
            watch,
        )

    def after(self, begin: Unfinished) -> TimeWay:
        """The same from where a time history was stopped."""
        found, checkpoint = begin.found, begin.checkpoint
        bodies, state = self.march.bodies, checkpoint.state(self.march.bodies)
        if found.rows is None or found.frames is None or found.histories is None or found.peaks is None:
            return self
        joints = state.joints if checkpoint.in_frames else None
        return replace(
            self,
            begin=state,
            rows=RowKeeper.resumed(found.rows, checkpoint.counts.searches),
            frames=FrameKeeper.resumed(bodies, found.frames, joints),
            instants=self.instants.after(found.histories),
            greatest=self.greatest.after(found.peaks, checkpoint.last),
        )

    @property
    def checkpoint(self) -> Checkpoint | None:
        """Where it goes on; None before the first step."""
        state = self.begin
        if not self.frames.frames:
            return None
        return Checkpoint.of(state, np.stack(self.greatest.last), self.frames.of_last is state.joints)

    def followed(self) -> HistoryEnd:
        """Why it ends; every step is kept as soon as it is made."""
        bodies, history = self.march.bodies, self.march.bodies.history
        before = self.begin
        if not self.instants.kept:
            self.instants.add(before, bodies.structure.blocks_at(before.pose), None, None)
        if before.time > 0.0 and (end := self._end(before)) not in (HistoryEnd.NONE, HistoryEnd.LATE):
            return end  # it was stopped when it had come to its end
        for step in self.march.steps(before, history.step):
            state = step.after
            there = bodies.structure.blocks_at(state.pose)
            if before.time >= len(self.frames.frames) * history.every - 1e-6 * history.step:
                self.frames.add(step.first)
            self.rows.add(step)
            self.instants.add(state, there, before, step)
            self.greatest.add(there, state.time)
            before = self.begin = state
            self.watch(self._progress(state, step))
            end = self._end(state)
            if end is not HistoryEnd.NONE:
                return end
        raise AssertionError("steps go on without end")

    def _to_last_step(self) -> None:
        """Leaves out what is kept of a step that was cut off before all of it was."""
        steps, now = self.begin.counts.steps, self.begin.time
        del self.rows.rows[steps + 1 :], self.instants.kept[steps + 1 :]
        self.frames.before(now - 1e-9 * self.march.bodies.history.step)

    def result(self, end: HistoryEnd) -> TimeHistoryResult:
        """With the steps so far."""
        self._to_last_step()
        bodies = self.march.bodies
        history = bodies.history
        k = bodies.structure.stiffness * float(bodies.structure.of_laws[:, 0].mean())
        shear = k * RATIO * float(bodies.structure.of_laws[:, 1].mean())
        if not self.frames.frames:
            return TimeHistoryResult(end, self.sag, (k, shear), self.period)
        return TimeHistoryResult(
            end=end,
            sag=self.sag,
            stiffness=(k, shear),
            period=self.period,
            damping=history.damping + np.pi * history.step / self.period,
            rows=self.rows.result(),
            frames=self.frames.result(),
            histories=self.instants.result(),
            peaks=self.greatest.result(bodies.structure.blocks_at(self.begin.pose)),
            searches=self.rows.searches,
        )

    def _end(self, state: TimeState) -> HistoryEnd:
        """Why it ends at a state; none where it goes on."""
        history = self.march.bodies.history
        if history.stop_at_collapse and not np.isnan(self.greatest.falling).all():
            return HistoryEnd.COLLAPSE
        if float(self.greatest.displacements.max(initial=0.0)) >= history.stop_displacement:
            return HistoryEnd.DISPLACED
        if state.time >= history.duration - 1e-6 * history.step:
            return HistoryEnd.DURATION
        if history.stop_at_rest and state.time > self.loaded_until and self._rests(state):
            return HistoryEnd.AT_REST
        late = self.deadline is not None and time.monotonic() > self.deadline
        return HistoryEnd.LATE if late else HistoryEnd.NONE

    @property
    def loaded_until(self) -> float:
        """When motion of the base and forces over time are over, s."""
        history = self.march.bodies.history
        signals = [each.signal for each in history.motions] + [each.signal for each in history.forces]
        return max((float(signal.times[-1]) for signal in signals), default=0.0)

    def _rests(self, state: TimeState) -> bool:
        bodies = self.march.bodies
        size = bodies.structure.size * bodies.gravity * float(bodies.masses.sum())
        return state.energies.kinetic < STILL * size

    def _progress(self, state: TimeState, step: DeckStep) -> TimeProgress:
        counts = state.counts
        return TimeProgress(
            time=state.time,
            duration=self.march.bodies.history.duration,
            step=counts.steps,
            factorisations=counts.factorisations,
            residual=step.error,
            balance=self.rows.balance,
            pressing=int((step.first.forces.normal > 0.0).sum()),
            halved=counts.halved,
            missed=counts.missed,
            seconds=time.perf_counter() - self.started,
        )


def _half_step(
    bodies: MovingBodies, contacts: Contacts, place: PushedPlace, settings: SolverSettings, watch: Watch
) -> HalfStep | None:
    """The same with half of the step; None where the time limit cut it off."""
    halved = replace(bodies, history=replace(bodies.history, step=0.5 * bodies.history.step))
    way = TimeWay.of(halved, contacts, place, settings.deadline, lambda progress: watch(replace(progress, half=True)))
    end = way.followed()
    if end is HistoryEnd.LATE:
        return None
    other = way.result(end).peaks
    assert other is not None
    return HalfStep(other.peak, other.peak_time, float(other.residuals.max(initial=0.0)), end)
