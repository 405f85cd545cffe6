"""One block on the ground in time, step by step, written plainly: a second implementation of what frames say.

Velocities are found from six unknowns by Newton steps with a matrix of differences. The work of joints across them is
what the rest of the energy leaves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from mbla.arrays import FloatArray
from mbla.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import BaseMotion, RecordedInterface, RecordedPoint, TimeHistory
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.time_history.history import Peaks, RecordedHistories, TimeHistoryResult
from mbla.solution.time_history.point_spectra import point_spectra
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows
from tests.line import HEAD, line_of

G, DENSITY, STIFFNESS, RATIO, DASHPOT = 9.81, 2000.0, 1e8, 0.4, 1e-3
DECK = (
    HEAD
    + """\
parameters: {mu: 0.5, b: 1, d: 1, h: 1}
joints: {dry: {friction: "=mu", stiffness: {normal: 1e8, ratio: 0.4}}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", "=d", "=h"]}
supports: [{ground: {z: 0}}]
load_cases: {shake: {live: [{acceleration: [1, 0, 0]}]}}
"""
)


@dataclass(frozen=True)
class Shaken:
    """A block, how it is shaken, and what becomes of it."""

    assembly: Assembly
    case: LoadCase
    history: TimeHistory
    result: TimeHistoryResult


@dataclass(frozen=True)
class State:
    """At the begin of a step: place of the centroid, rotation, momentum before, friction kept (4, 2), h before."""

    time: float
    place: FloatArray
    turn: FloatArray
    momentum: FloatArray
    kept: FloatArray
    before: float


@dataclass(frozen=True)
class Step:
    """One step from a state: forces N, T1, T2 (4, 3), velocities and momentum after it."""

    state: State
    forces: FloatArray
    velocity: FloatArray
    momentum: FloatArray


@dataclass(frozen=True)
class Block:
    """A box on the ground: its size, friction, and the acceleration of the base along a direction."""

    size: FloatArray
    friction: float
    motion: Signal
    direction: FloatArray

    @property
    def mass(self) -> float:
        """kg."""
        return DENSITY * float(self.size.prod())

    @property
    def tensor(self) -> FloatArray:
        """Inertia about the centroid."""
        return np.diag(self.mass / 12.0 * ((self.size**2).sum() - self.size**2))

    @property
    def arms(self) -> FloatArray:
        """Corners of the foot from the centroid, (4, 3)."""
        corners = [[x, y, 0.0] for x in (0.0, self.size[0]) for y in (0.0, self.size[1])]
        return np.array(corners) - self.size / 2.0

    @property
    def stiffness(self) -> FloatArray:
        """Across and along, of each corner."""
        return STIFFNESS * float(self.size[0] * self.size[1]) / 4.0 * np.array([1.0, RATIO, RATIO])

    def gain(self, begin: float, end: float) -> FloatArray:
        """Of velocity by the base, by a fine sum over the record."""
        times = np.linspace(begin, end, 4001)
        middle = (times[1:] + times[:-1]) / 2.0
        value = np.interp(middle, self.motion.times, self.motion.values, left=0.0, right=0.0)
        return np.asarray(self.direction * float(value.mean()) * (end - begin))

    def at_rest(self) -> State:
        """Sunk by its weight."""
        sag = np.array([0.0, 0.0, self.mass * G / (4.0 * self.stiffness[0])])
        return State(0.0, self.size / 2.0 - sag, np.eye(3), np.zeros(6), np.zeros((4, 2)), 0.0)

    def steps(self, count: int, h: float) -> Iterator[Step]:
        """From rest."""
        state = self.at_rest()
        for number in range(count + 1):
            step = self._step(state, h)
            yield step
            turn = Rotation.from_rotvec(h * step.velocity[3:]).as_matrix() @ state.turn
            r = self.arms @ state.turn.T
            u = step.velocity[:3] + np.cross(step.velocity[3:], r)
            kept = step.forces[:, 1:] + DASHPOT * self.stiffness[1] * u[:, :2]
            kept = self._within(kept, step.forces[:, 0])
            place = state.place + h * step.velocity[:3]
            state = State((number + 1) * h, place, turn, step.momentum, kept, h)

    def _within(self, shear: FloatArray, normal: FloatArray) -> FloatArray:
        length = np.maximum(np.linalg.norm(shear, axis=1), 1e-300)
        return np.asarray(shear * np.minimum(1.0, self.friction * normal / length)[:, None])

    def spin(self, state: State) -> FloatArray:
        """Angular velocity before the step, with the inertia half a step earlier."""
        turn, spin = state.turn, state.momentum[3:]
        for _ in range(6):
            spin = np.asarray(np.linalg.solve(turn @ self.tensor @ turn.T, state.momentum[3:]), dtype=np.float64)
            turn = Rotation.from_rotvec(-spin * state.before / 2.0).as_matrix() @ state.turn
        return spin

    def masses_ahead(self, state: State, h: float) -> FloatArray:
        """Mass and inertia half a step ahead, (6, 6)."""
        half = Rotation.from_rotvec(self.spin(state) * h / 2.0).as_matrix() @ state.turn
        masses = np.zeros((6, 6))
        masses[:3, :3], masses[3:, 3:] = self.mass * np.eye(3), half @ self.tensor @ half.T
        return masses

    def _step(self, state: State, h: float) -> Step:
        free = state.momentum.copy()
        free[2] -= self.mass * G * (h + state.before) / 2.0
        free[:3] -= self.mass * self.gain(state.time - state.before / 2.0, state.time + h / 2.0)
        masses = self.masses_ahead(state, h)
        r = self.arms @ state.turn.T
        room = (h + DASHPOT) * self.stiffness
        pressed = -self.stiffness[0] * (state.place + r)[:, 2]

        def forces(motion: FloatArray) -> FloatArray:
            u = motion[:3] + np.cross(motion[3:], r)
            normal = np.maximum(pressed - room[0] * u[:, 2], 0.0)
            return np.column_stack([normal, self._within(state.kept - room[1] * u[:, :2], normal)])

        def after(motion: FloatArray) -> FloatArray:
            force = forces(motion)[:, [1, 2, 0]]
            on = np.concatenate([force.sum(axis=0), np.cross(r, force).sum(axis=0)])
            return np.asarray(free + (h + state.before) / 2.0 * on)

        def off(motion: FloatArray) -> FloatArray:
            return np.asarray(motion - np.linalg.solve(masses, after(motion)))

        motion: FloatArray = np.asarray(np.linalg.solve(masses, state.momentum))
        for _ in range(100):
            lacks = off(motion)
            if np.abs(lacks).max() < 1e-12:
                break
            matrix = np.column_stack([(off(motion + e) - lacks) / 1e-7 for e in 1e-7 * np.eye(6)])
            motion = np.asarray(motion - np.linalg.solve(matrix, lacks))
        momentum = after(motion)
        return Step(state, forces(motion), np.asarray(np.linalg.solve(masses, momentum), dtype=np.float64), momentum)


def shaken(
    motion: Signal,
    *,
    friction: float,
    size: tuple[float, float, float],
    duration: float,
    direction: tuple[float, float, float] = (1.0, 0.0, 0.0),
    step: float = 2e-3,
    each: int = 5,
) -> Shaken:
    """A block of a size whose base has an acceleration along a direction; a frame every ``each`` steps."""
    given = {"mu": friction, "b": size[0], "d": size[1], "h": size[2]}
    line = line_of(DECK, *(f"parameters.{name}={value}" for name, value in given.items()))
    history = TimeHistory(
        motions=(BaseMotion("a push", motion, np.array(direction)),),
        forces=(),
        step=step,
        duration=duration,
        damping=0.0,
        contact_damping=0.0,
        every=each * step,
        points=(RecordedPoint("top", 0, np.array(size)),),
        interfaces=(RecordedInterface("foot", np.array([1, 0])),),
        stop_displacement=np.inf,
        stop_at_rest=False,
        rigid=(),
        check=False,
        dead_levers=np.zeros((1, 9)),
        dead_following=np.zeros((1, 6)),
    )
    block = Block(np.array(size), friction, motion, np.array(direction))
    steps = list(block.steps(round(duration / step), step))
    case = replace(line.load_case, time_history=history)
    return Shaken(line.assembly, case, history, _result(block, history, steps, each))


def _result(block: Block, history: TimeHistory, steps: Sequence[Step], each: int) -> TimeHistoryResult:
    shown = [step for number, step in enumerate(steps) if number % each == 0]
    states = [step.state for step in steps]
    histories = _histories(block, history, steps)
    return TimeHistoryResult(
        end=HistoryEnd.DURATION,
        sag=block.mass * G / (4.0 * float(block.stiffness[0])),
        stiffness=(STIFFNESS, RATIO * STIFFNESS),
        rows=_rows(block, steps),
        frames=_frames(block, history, shown[:-1] if shown[-1] is steps[-1] else shown),
        histories=histories,
        peaks=_peaks(block, states, histories),
        spectra=point_spectra(history, histories),
    )


def _peaks(block: Block, states: Sequence[State], histories: RecordedHistories) -> Peaks:
    by = np.array([state.place for state in states]) - states[0].place
    far = np.linalg.norm(by, axis=1)
    last = by[-round(0.1 * (len(by) - 1)) :]
    turns = [float(np.linalg.norm(Rotation.from_matrix(state.turn).as_rotvec())) for state in states]
    return Peaks(
        displacements=np.array([far.max()]),
        times=np.array([states[int(far.argmax())].time]),
        rotations=np.array([max(turns)]),
        residuals=far[-1:],
        ends=np.array([[*(states[-1].place - block.size / 2.0), *Rotation.from_matrix(states[-1].turn).as_rotvec()]]),
        wanders=np.array([np.linalg.norm(last - last[-1], axis=1).max()]),
        openings=np.maximum(histories.openings.max(axis=0), 0.0),
        slips=histories.slips.max(axis=0),
        falling=np.array([np.nan]),
    )


def _frames(block: Block, history: TimeHistory, steps: Sequence[Step]) -> Frames:
    states, n = [step.state for step in steps], len(steps)
    # the ground, body 1, is a; the plane is its, so it is the host
    feet = block.arms + block.size / 2.0
    points = PointSet(
        bodies=np.tile([1, 0], (4, 1)),
        host=np.zeros(4, dtype=bool),
        arms=np.stack([feet, block.arms], axis=1),
        frames=np.tile(np.eye(3)[[2, 0, 1]], (4, 1, 1)),
        laws=np.zeros(4, dtype=np.int64),
        areas=np.full(4, float(block.size[0] * block.size[1]) / 4.0),
        stiffness=np.tile(block.stiffness, (4, 1)),
        dashpot=np.full(4, DASHPOT),
    )
    times = np.array([state.time for state in states])
    return Frames(
        times=times,
        lengths=np.full(n, history.step),
        lengths_before=np.array([state.before for state in states]),
        shifts=np.array([[state.place - block.size / 2.0] for state in states]),
        turns=np.array([[Rotation.from_matrix(state.turn).as_rotvec()] for state in states]),
        solid_of_block=np.zeros(1, dtype=np.int64),
        momenta_before=np.array([[state.momentum] for state in states]),
        momenta=np.array([[step.momentum] for step in steps]),
        velocities=np.array([[step.velocity] for step in steps]),
        base=_base(block, times)[:, 0],
        missed=np.zeros(n, dtype=bool),
        set_of_frame=np.zeros(n, dtype=np.int64),
        point_start=4 * np.arange(n + 1),
        remembered=np.concatenate([np.column_stack([np.zeros(4), state.kept]) for state in states]),
        forces=np.concatenate([step.forces for step in steps]),
        sets=(points,),
    )


def _base(block: Block, times: FloatArray) -> FloatArray:
    """Displacement, velocity and acceleration, (n, 3, 3), by sums in steps of 10 μs."""
    fine = np.arange(0.0, float(times[-1]) + 5e-6, 1e-5)
    value = np.interp((fine[1:] + fine[:-1]) / 2.0, block.motion.times, block.motion.values, left=0.0, right=0.0)
    fast = np.concatenate([[0.0], np.cumsum(value) * 1e-5])
    far = np.concatenate([[0.0], np.cumsum((fast[1:] + fast[:-1]) / 2.0) * 1e-5])
    columns = [np.interp(times, fine, each) for each in (far, fast)]
    columns.append(np.interp(times, block.motion.times, block.motion.values, left=0.0, right=0.0))
    return np.asarray(np.stack(columns, axis=1)[:, :, None] * block.direction)


def _rows(block: Block, steps: Sequence[Step]) -> StepRows:
    n, zeros, whole = len(steps), np.zeros(len(steps)), np.zeros(len(steps), dtype=np.int64)
    states = [step.state for step in steps]
    kinetic, elastic = zeros.copy(), zeros.copy()
    taken = np.zeros((n, 3))
    for row, state in enumerate(states):
        turning = block.spin(state) @ state.momentum[3:]
        kinetic[row] = (state.momentum[:3] ** 2).sum() / (2.0 * block.mass) + turning / 2.0
        if row:
            last, step = states[row - 1], steps[row - 1]
            between = state.time - state.before / 2.0 - last.time + last.before / 2.0
            mean = np.linalg.solve(block.masses_ahead(last, state.before), (state.momentum + last.momentum) / 2.0)
            gain = block.gain(last.time - last.before / 2.0, state.time - state.before / 2.0)
            u = mean[:3] + np.cross(mean[3:], block.arms @ last.turn.T)
            work = -between * step.forces * u[:, [2, 0, 1]]
            taken[row] = -block.mass * mean[:3] @ gain, work[:, 1:].sum(), work[:, 0].sum()
            elastic[row] = float(((step.forces[:, 0] ** 2).sum() / block.stiffness[0]) / 2.0)
            elastic[row] += float((state.kept**2).sum() / block.stiffness[1]) / 2.0
    base, friction, contacts = np.cumsum(taken, axis=0).T
    height = np.array([state.place[2] - state.before * state.momentum[2] / block.mass / 2.0 for state in states])
    potential = block.mass * G * (height - height[0])
    return StepRows(
        times=np.array([state.time for state in states]),
        kinetic=kinetic,
        potential=potential,
        elastic=elastic,
        friction=friction,
        contacts=contacts,
        ties=zeros,
        base=base,
        forces=zeros,
        numerical=kinetic + potential + contacts + friction - base,
        residuals=zeros,
        factorisations=np.arange(n),
        small_steps=whole,
        halved=whole,
        missed=whole,
        pressing=whole,
    )


def _histories(block: Block, history: TimeHistory, steps: Sequence[Step]) -> RecordedHistories:
    states, n, half = [step.state for step in steps], len(steps), block.size / 2.0
    top = np.array([state.place + state.turn @ half for state in states])
    times = np.array([state.time for state in states])
    moves = np.array([[*state.momentum[:3] / block.mass, *block.spin(state)] for state in states])
    arms = np.array([state.turn @ half for state in states])
    speeds = moves[:, :3] + np.cross(moves[:, 3:], arms)
    gains = np.zeros((n, 3))
    for row in range(1, n):
        gain = moves[row] - moves[row - 1]
        between = (states[row].before + states[row - 1].before) / 2.0
        gains[row] = (gain[:3] + np.cross(gain[3:], arms[row])) / between
    middles = times - np.array([state.before for state in states]) / 2.0
    base = _base(block, times)
    gains[0] = base[0, 2]
    gains[1:] += np.diff(_base(block, middles)[:, 1], axis=0) / np.diff(middles)[:, None]
    feet = np.array([state.place + block.arms @ state.turn.T for state in states]) - (block.arms + half)
    forces = np.zeros((n, 1, 3))
    forces[1:, 0] = [step.forces[:, [1, 2, 0]].sum(axis=0) for step in steps[:-1]]
    return RecordedHistories(
        times=times,
        velocity_times=middles,
        displacements=(top - top[0])[:, None],
        velocities=speeds[:, None],
        accelerations=gains[:, None],
        base=base,
        openings=feet[:, :, 2].max(axis=1)[:, None],
        slips=np.hypot(feet[:, :, 0], feet[:, :, 1]).max(axis=1)[:, None],
        forces=forces,
    )
