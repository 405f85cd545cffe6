"""The load that a structure reaches from its stress-free assembly: the greatest on the path of elastic joints.

Without dilatancy many states fit the law of rigid joints. Joints with a stiffness select one: from the structure at
rest under its dead load the live load is driven by its own displacement, step by step, with what the joints remember.
The greatest load factor on that path does not depend on how stiff the joints are, for displacements are counted in
units of the elastic displacement of the structure at its associative load (all joints stuck), and the path ends at 50.

A step is one primal–dual step of :mod:`mbla.solution.law.joint_step` on an implicit step of length h; what is not gone
of it is made up for in the next one. The products of the law are n₀²/(κ h): they smooth the law, the less the longer
the steps and the larger κ. The step of the greatest load is solved once more without smoothing.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.flow.gravity_step import Gravity
from mbla.solution.flow.peak_step import PeakStep, sharpened_peak, with_openings
from mbla.solution.flow.settings import PathSettings
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState, within
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import direction_of, length_of

LIMP = 1e-6
"""Stiffness of ties over that of joints in the measure of displacement: they may be slack."""

RIGID = 1e8
"""Stiffness of interfaces with a motion of their own in that measure: none of it is elastic."""

BREAKS = 1e-7
"""Reach of a direction with which a path breaks down."""


class Stop(StrEnum):
    """Why a path ended: the first three are answers."""

    FALLS = "falls"
    FLAT = "flat"
    FAR = "far"
    STUCK = "stuck"
    BROKE_DOWN = "breaks down"
    BUDGET = "budget"

    @property
    def answers(self) -> bool:
        """Whether the greatest load factor was seen."""
        return self in (Stop.FALLS, Stop.FLAT, Stop.FAR)


@dataclass(frozen=True)
class PathStep:
    """One step of the path, as the curve has it.

    displacement : after it, in units
    load_factor  : of the program
    counted      : whether the state is in balance well enough
    reach        : of its direction
    """

    displacement: float
    load_factor: float
    counted: bool
    reach: float


@dataclass(frozen=True)
class ElasticPath:
    """A path that was followed.

    peak         : step of the greatest load factor, without smoothing where it could be solved so; None where no step
                   counts
    half         : the same up to half of the displacement; None where the path ends before
    last         : state at the end
    stop         : why it ended
    steps        : the curve
    unit         : of displacement, for a live work of 1 in units of the program
    factorizations : spent
    recentred    : times that it was blocked
    """

    peak: PeakStep | None
    half: PeakStep | None
    last: StepState
    stop: Stop
    steps: tuple[PathStep, ...]
    unit: float
    factorizations: int
    recentred: int

    @property
    def load_factor(self) -> float:
        """λ_p, of the program; nan where no step counts."""
        return float("nan") if self.peak is None else self.peak.state.factor

    @property
    def displacement(self) -> float:
        """At the end, in units."""
        return self.steps[-1].displacement if self.steps else 0.0

    @property
    def gain(self) -> float:
        """Share of the greatest load factor that was gained over the last half of the path; 0 where it ends before."""
        if self.peak is None or self.half is None:
            return 0.0
        return 1.0 - self.half.state.factor / self.load_factor


def elastic_motion(joints: ElasticJoints) -> FloatArray:
    """Displacements of the blocks under the live load with all joints stuck, (n_rows,)."""
    program = joints.program
    n_all = joints.matrix.program.n_points
    tangents = np.zeros((n_all, program.components, program.components))
    tangents[program.n_points :] = RIGID * np.eye(program.components)
    holds = (joints.friction > 0.0) | (program.limits.cohesion > 0.0)
    tangents[: program.n_points, 0, 0] = np.where(holds, joints.normal, LIMP * joints.normal)
    for tangent in range(1, program.components):
        tangents[: program.n_points, tangent, tangent] = joints.shear
    solve = joints.matrix.factorized(tangents, 1e-12 * joints.matrix.size, fixed_load=True)
    if solve is None:
        return np.asarray(program.live_load / float(program.live_load @ program.live_load))
    return np.asarray(-solve(np.append(program.live_load, 0.0))[:-1])


def follow(
    joints: ElasticJoints, gravity: Gravity, associative: float, settings: PathSettings, unit: float | None = None
) -> ElasticPath:
    """The path from the structure at rest.

    associative : load factor of associative flow
    unit        : of displacement; by these joints unless given
    """
    path = _Path(joints, gravity, abs(associative), settings)
    motion = elastic_motion(joints)
    path.unit = float(joints.program.live_load @ motion) * abs(associative) if unit is None else unit
    path.begin(motion)
    stop = Stop.BUDGET
    for _ in range(settings.steps):
        ended = path.advance()
        if ended is not None:
            stop = ended
            break
    return path.result(stop)


@dataclass
class _Path:
    """A path on its way.

    h, kappa : length of the next step, in time, and smoothing κ
    force    : n₀
    top      : step of the greatest load factor so far
    later    : the same of the steps after it: early steps are smoothed more
    half     : the same over half of the path
    risen    : greatest load factor so far, and displacement at which it last rose by a thousandth
    low      : steps in a row below the peak, and the displacement of the first of them
    blocked  : steps in a row that were blocked, since the last re-centring and in all
    good     : length of the last step that went well
    """

    joints: ElasticJoints
    gravity: Gravity
    associative: float
    settings: PathSettings
    unit: float = field(init=False)
    state: StepState = field(init=False)
    memory: Memory = field(init=False)
    h: float = field(init=False)
    kappa: float = field(init=False)
    force: float = field(init=False)
    good: float = field(init=False)
    displacement: float = 0.0
    top: PeakStep | None = None
    later: PeakStep | None = None
    half: PeakStep | None = None
    risen: tuple[float, float] = (0.0, 0.0)
    low: tuple[int, float] = (0, 0.0)
    blocked: tuple[int, int] = (0, 0)
    recentred: int = 0
    factorizations: int = 1
    steps: list[PathStep] = field(default_factory=list)

    def begin(self, motion: FloatArray) -> None:
        """At rest, moving as if all joints were stuck."""
        joints, live = self.joints, self.joints.program.live_load
        n = max(joints.program.n_points, 1)
        self.force = max(self.gravity.force, self.associative * float(np.abs(live).sum()) / n)
        self.h, self.kappa = self.settings.first * self.unit, self.settings.smoothing
        self.good, self.memory = self.h, self.gravity.memory
        at_rest = replace(self.gravity.state, u=motion / float(live @ motion), normal=self._pressed())
        self.state = self._centred(at_rest, 0.99)

    def _pressed(self) -> FloatArray:
        """Normal forces at rest, smoothed as the first step is: (N − N̄) N = σ k_N h, (n_points,)."""
        joints, limits = self.joints, self.joints.program.limits
        trial, product = self.memory.normal + limits.tension, self.sigma * joints.normal * self.h
        root = np.sqrt(trial**2 + 4.0 * product)
        pressed = np.where(trial > 0.0, 0.5 * (trial + root), 2.0 * product / (root + np.abs(trial))) - limits.tension
        middle = 0.5 * (pressed + limits.compression)[joints.crushable]
        pressed[joints.crushable] = np.minimum(pressed[joints.crushable], middle)
        return np.asarray(pressed)

    @property
    def sigma(self) -> float:
        """Products of the law in the next step."""
        return self.force**2 / (self.kappa * self.h)

    @property
    def peak(self) -> float:
        """The greatest load factor so far."""
        return 0.0 if self.top is None else self.top.state.factor

    def _centred(self, state: StepState, share: float) -> StepState:
        """On the central path for the present normal forces and shear, the latter within a share of its limit."""
        joints, sigma = self.joints, self.sigma
        limit = joints.limit(state.normal)
        shear = within(state.shear, limit, share)
        speed = sigma * limit / (limit * limit - (shear * shear).sum(axis=0))
        return replace(
            state,
            opening=sigma / (state.normal + joints.program.limits.tension),
            shear=shear,
            slip=-(speed / limit) * shear,
            speed=speed,
            crushing=sigma / joints.room(state.normal),
            interfaces=tuple(
                law.centred(one, state.normal, sigma) for law, one in zip(joints.laws, state.interfaces, strict=True)
            ),
        )

    def advance(self) -> Stop | None:
        """One step; why the path ends after it, None where it goes on."""
        left = self.settings.until - self.displacement
        if self.h > left * self.unit:  # the last step ends where the path does, as smooth as it was
            self.kappa, self.h = self.kappa * self.h / (left * self.unit), left * self.unit
        step, sigma = JointStep(self.joints, self.memory, self.h), self.sigma
        before = with_openings(step, self.state, sigma)
        found = direction_of(step, before, residual_of(step, before), sigma)
        self.factorizations += 1
        if found is None or found[1] < BREAKS:
            return Stop.BROKE_DOWN
        direction, reach = found
        length = length_of(reach)
        self.state = before.plus(direction, length)
        if self.displacement + length * self.h / self.unit > 0.5 * self.settings.until and self.half is None:
            self.half = self.top
        self.displacement += length * self.h / self.unit
        moved = length * self.h * self.joints.velocities(self.state.u)
        motions = [length * self.h * motion for motion in self.joints.motions(self.state.u)]
        self.memory = self.memory.after(self.joints, moved, self.state.normal, motions)
        counted = self._counts(step, sigma, length)
        self.steps.append(PathStep(self.displacement, self.state.factor, counted, reach))
        return self._ended(counted, reach, sigma) or self._next(reach)

    def _counts(self, step: JointStep, sigma: float, length: float) -> bool:
        """Whether the state is in balance; the peak where it is the greatest."""
        unbalanced, state = self.joints.unbalanced(self.state), self.state
        force, power = self.settings.counted
        counted = float(np.abs(unbalanced).max(initial=0.0)) < force
        counted = counted and abs(float(unbalanced @ state.u)) < power * self.associative
        if counted and (self.later is None or state.factor > self.later.state.factor):
            gone = replace(step, length=length * step.length)
            self.later = PeakStep(gone, sigma, state, self.displacement)
            if state.factor > self.peak:
                self.top, self.later = self.later, None
        if counted and state.factor > 1.001 * self.risen[0]:
            self.risen = (state.factor, self.displacement)
        return counted

    def _ended(self, counted: bool, reach: float, sigma: float) -> Stop | None:
        """Falls, flat, far, stuck, or None."""
        settings = self.settings
        if self.joints.n_products * sigma <= 0.3 * self.associative:
            below = counted and self.peak > 0.0 and reach > 0.2
            below = below and self.state.factor < (1.0 - settings.dropped) * self.peak
            first = self.low[1] if self.low[0] else self.displacement
            self.low = (self.low[0] + 1, first) if below else (0, 0.0)
        if self.low[0] >= 3 and self.displacement >= 1.02 * self.low[1] and self.displacement > 1.0:
            return Stop.FALLS
        settled = self.displacement > settings.settled
        if counted and settled and self.displacement > 2.2 * self.risen[1]:
            return Stop.FLAT
        if self.displacement >= settings.until * (1.0 - 1e-9):
            return Stop.FAR
        short = reach < settings.short
        self.blocked = (self.blocked[0] + 1, self.blocked[1] + 1) if short else (0, 0)
        return Stop.STUCK if self.blocked[1] >= 12 else None

    def _next(self, reach: float) -> Stop | None:
        """Length and smoothing of the next step; a blocked path is brought back, or has gained nothing any more."""
        settings = self.settings
        if reach >= 0.9:
            self.h *= settings.growth
        elif reach > 0.3:
            self.h *= 1.0 + (settings.growth - 1.0) * (reach - 0.3) / 0.6
        elif reach < 0.03:
            self.h *= 0.4
        elif reach < 0.1:
            self.h *= 0.7
        floor = self._least_smoothing()
        if reach < 0.3:
            self.kappa = max(floor, 0.6 * self.kappa) if self.kappa > floor else self.kappa
        elif reach > 0.5:
            self.kappa = min(settings.most_smoothing, 2.0 * self.kappa)
        self.h = min(self.h, max(settings.longest * self.displacement, settings.first) * self.unit)
        if self.blocked[0] >= 2 and self.displacement > settings.settled and self.peak > 0.0:
            half = [s.load_factor for s in self.steps if s.displacement <= 0.5 * self.displacement and s.counted]
            if self.peak < 1.005 * max(half, default=0.0):
                return Stop.FLAT
        if self.blocked[0] >= 2 and self.recentred < settings.recentred:
            self._recentre()
        if reach >= 0.2:
            self.good = self.h
        return None

    def _least_smoothing(self) -> float:
        """κ with which smoothing takes its share of the live power."""
        share, from_there = self.settings.smoothed
        share *= min(1.0, from_there / self.displacement) if self.displacement > 0.0 else 1.0
        wanted = self.joints.n_products * self.force**2 / (share * self.associative * self.h)
        return max(self.settings.least_smoothing, min(1.0, wanted))

    def _recentre(self) -> None:
        """Blocked: on the central path of the present forces, with ten times the products."""
        self.recentred += 1
        self.kappa /= 10.0
        if self.blocked[1] > 2:
            self.h = max(self.h, 0.3 * self.good)
        self.blocked = (0, self.blocked[1])
        self.state = self._centred(self.state, 0.95)

    def result(self, stop: Stop) -> ElasticPath:
        """The path, with its peaks once more without smoothing."""
        spent = self.factorizations + self.gravity.steps
        peaks = [self.top, self.half if stop is Stop.FAR else None]
        for place, peak in enumerate(peaks):
            if peak is not None:
                peaks[place], more = sharpened_peak(peak, self.settings)
                spent += more
        top, half = peaks
        if top is not None and self.later is not None and top.state.factor < self.later.state.factor:
            later, more = sharpened_peak(self.later, self.settings)
            top, spent = max(top, later, key=lambda peak: peak.state.factor), spent + more
        return ElasticPath(top, half, self.state, stop, tuple(self.steps), self.unit, spent, self.recentred)
