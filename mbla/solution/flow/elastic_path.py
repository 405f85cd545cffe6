"""The load that a structure reaches from its stress-free assembly: the greatest on the path of elastic joints.

Without dilatancy many states fit the law of rigid joints. Joints with a stiffness select one: from the structure at
rest under its dead load the live load is driven by its own displacement, step by step, with what the joints remember.
The greatest load factor on that path does not depend on how stiff the joints are, for displacements are counted in
units of the elastic displacement of the structure at its associative load (all joints stuck), and the path ends at 50.

A step is one primal–dual step of :mod:`mbla.solution.law.joint_step` on an implicit step of length h; what is not gone
of it is made up for in the next one. The products of the law are n₀²/(κ h): they smooth the law, the less the longer
the steps and the larger κ. The step of the greatest load is solved once more until the law holds.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.solution.flow.fall import Fall
from mbla.solution.flow.gravity_step import Gravity
from mbla.solution.flow.greatest_steps import GreatestSteps
from mbla.solution.flow.path_record import ElasticPath, PathStep, Stop
from mbla.solution.flow.peak_step import PeakStep, at_rest_of, centred, with_openings
from mbla.solution.flow.settings import PathSettings
from mbla.solution.flow.unit_of_displacement import Measure, mean_live_load
from mbla.solution.law.brittle import let_go, share_until_break, without
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import direction_of, length_of

BREAKS = 1e-7
"""Reach of a direction with which a path breaks down."""

ENDS = 0.01
"""Distance from the end of the path, relative, at which the path is at its end: a step as short as the rest would have
larger openings than its products allow."""

AT_BREAK, AIM, NEARLY = 12, 1.003, 0.99
"""The step to the break of a tie: most lengths that are tried; factor on the length, so that the tie reaches its
strength; and ratio of a length without break to one with it, or to the estimate, that is near enough."""


def follow(joints: ElasticJoints, gravity: Gravity, measure: Measure, settings: PathSettings) -> ElasticPath:
    """The path from the structure at rest."""
    path = _SmoothedPath(joints, gravity, measure.load_factor, measure.displacement, settings)
    path.begin(measure.motion)
    stop = Stop.BUDGET
    for _ in range(settings.steps):
        ended = path.advance()
        if ended is not None:
            stop = ended
            break
    return path.result(stop)


@dataclass
class _SmoothedPath:
    """A path on its way.

    scale, unit : load factor and displacement that it is measured by
    h, kappa : length of the next step, in time, and smoothing κ
    force    : n₀
    peaks    : steps among which the greatest load factor is
    risen    : greatest load factor so far, and displacement at which it last rose by a thousandth
    least    : least load factor of the steps that count since then
    low      : steps in a row that do not rise below the peak
    fallen   : load factor from which it falls: the greatest since a tie broke last
    blocked  : steps in a row that were blocked, since the last re-centring and in all
    in_balance : steps up to the last one that counts
    good     : length of the last step that went well
    """

    joints: ElasticJoints
    gravity: Gravity
    scale: float
    unit: float
    settings: PathSettings
    state: StepState = field(init=False)
    memory: Memory = field(init=False)
    h: float = field(init=False)
    kappa: float = field(init=False)
    force: float = field(init=False)
    peaks: GreatestSteps = field(init=False)
    good: float = field(init=False)
    low: Fall = field(init=False)
    displacement: float = 0.0
    risen: tuple[float, float] = (0.0, 0.0)
    least: float = 0.0
    fallen: float = 0.0
    broken: list[tuple[float, int]] = field(default_factory=list)
    blocked: tuple[int, int] = (0, 0)
    in_balance: int = 0
    recentred: int = 0
    factorizations: int = 1
    steps: list[PathStep] = field(default_factory=list)

    def begin(self, motion: FloatArray) -> None:
        """At rest, moving as if all joints were stuck."""
        joints, live = self.joints, self.joints.program.live_load
        self.force = max(self.gravity.force, mean_live_load(joints.program, self.scale))
        self.peaks = GreatestSteps(self.force, self.unit, self.settings)
        self.h, self.kappa = self.settings.first * self.unit, self.settings.smoothing
        self.good, self.memory, self.low = self.h, self.gravity.memory, Fall(self.settings)
        at_rest = replace(self.gravity.state, u=motion / float(live @ motion))
        step = JointStep(joints, self.memory, self.h)
        self.state = centred(joints, at_rest_of(step, at_rest, self.sigma), self.sigma, 0.99)

    @property
    def sigma(self) -> float:
        """Products of the law in the next step."""
        return self.force**2 / (self.kappa * self.h)

    def advance(self) -> Stop | None:
        """One step; why the path ends after it, None where it goes on."""
        left = (self.settings.until - self.displacement) * self.unit
        if self.h > left:  # the last steps end where the path does
            self._shorten(left)
        elif 2.0 * self.h > left:
            self._shorten(0.5 * left)
        step, sigma = JointStep(self.joints, self.memory, self.h), self.sigma
        before = with_openings(step, self.state, sigma)
        found = direction_of(step, before, residual_of(step, before), sigma)
        self.factorizations += 1
        if found is None or found[1] < BREAKS:
            return Stop.BROKE_DOWN
        direction, reach = found
        self.state, length = before.plus(direction, length_of(reach)), length_of(reach)
        if self.displacement + length * self.h / self.unit > 0.5 * self.settings.until and self.peaks.half is None:
            self.peaks.half = self.peaks.top
        self.displacement += length * self.h / self.unit
        gone = PeakStep(replace(step, length=length * self.h), sigma, self.state, self.displacement)
        breaking = np.zeros(0, dtype=np.int64)
        if len(self._share_until_break(gone)[1]):
            breaking, gone = self._breaking(gone)
        self.memory = gone.memory
        counted = self._counts(None if len(breaking) else gone)
        opened, slide = self.memory.yielding(self.joints, self.state.normal)
        step_gone = PathStep(self.displacement, self.state.factor, counted, reach, opened, slide)
        self.steps.append(self.settings.seen(step_gone))
        ended = self._ended(counted, reach)
        if len(breaking):
            self._let_go(breaking)
        return ended or self._next(reach)

    def _breaking(self, gone: PeakStep) -> tuple[IntArray, PeakStep]:
        """Points that break in a step that is gone, and the step solved, with which they come there early.

        The peak may be where the first of them breaks.
        """
        whole = self.peaks.solve(gone)
        share, breaking = self._share_until_break(whole)
        if not len(breaking):
            return breaking, whole
        low, high = (0.0, 0.0), (whole.step.length, 1.0 / max(share, 1e-300))  # lengths, and how near they lead
        before = None
        for _ in range(AT_BREAK):
            length = low[0] + (AIM - low[1]) / (high[1] - low[1]) * (high[0] - low[0])
            there = replace(gone, step=replace(gone.step, length=length))
            sharp = self.peaks.solve(there)
            if sharp.state is there.state:
                break
            near = 1.0 / max(self._share_until_break(sharp)[0], 1e-300)
            if near < 1.0:  # the other end counts half where the same one moves again
                before, high = sharp, (high[0], 1.0 + 0.5 * (high[1] - 1.0)) if before is not None else high
                low = (length, near)
            else:
                low = (low[0], 1.0 - 0.5 * (1.0 - low[1])) if before is None else low
                high = (length, near)
            if 1.0 <= near < 1.0 / NEARLY:
                before = sharp
            if 1.0 <= near < 1.0 / NEARLY or low[0] > NEARLY * high[0]:
                break
        if before is not None:
            self.peaks.take(before)
        return breaking, whole

    def _share_until_break(self, gone: PeakStep) -> tuple[float, IntArray]:
        if not self.joints.brittle.any():
            return np.inf, np.zeros(0, dtype=np.int64)
        opened = gone.step.length * self.joints.velocities(gone.state.u)[0]
        return share_until_break(self.joints, self.memory, opened)

    def _shorten(self, h: float) -> None:
        """A shorter step, as smooth as it was."""
        self.kappa, self.h = self.kappa * self.h / h, h

    def _let_go(self, points: IntArray) -> None:
        """Points that break lose their force; whether it falls is seen from there."""
        self.broken += [(self.displacement, point) for point in points.tolist()]
        self.state = let_go(self.joints, self.state, points, self.sigma)
        self.joints, self.memory = without(self.joints, self.memory, points)
        self.fallen, self.low = 0.0, Fall(self.settings)

    def _counts(self, gone: PeakStep | None) -> bool:
        """Whether the state is in balance; the peak where it is the greatest, unless there is no step for it."""
        unbalanced, state = self.joints.unbalanced(self.state), self.state
        if float(np.abs(unbalanced).max(initial=0.0)) >= self.settings.counted:
            return False
        if gone is not None:
            self.peaks.keep(gone)
        self.in_balance, self.fallen = len(self.steps) + 1, max(self.fallen, state.factor)
        if state.factor > 1.001 * self.risen[0]:
            self.risen, self.least = (state.factor, self.displacement), state.factor
        self.least = min(self.least, state.factor)
        return True

    def _ended(self, counted: bool, reach: float) -> Stop | None:
        """Falls, flat, far, stuck, or None."""
        settings = self.settings
        below = counted and self.fallen > 0.0 and reach > 0.2
        below = below and self.state.factor < (1.0 - settings.dropped) * self.fallen
        self.low = self.low.after(below, self.displacement, self.state.factor)
        if self.low.is_over(self.displacement):
            return Stop.FALLS
        level = self.state.factor <= max(settings.back[0] * self.least, settings.back[1] * self.risen[0])
        if counted and level and self.displacement > max(settings.settled, 2.2 * self.risen[1]):
            return Stop.FLAT
        if self.displacement >= settings.until * (1.0 - ENDS):
            return Stop.FAR
        if settings.late:
            return Stop.LATE
        short = reach < settings.short
        self.blocked = (self.blocked[0] + 1, self.blocked[1] + 1) if short else (0, 0)
        wandering = len(self.steps) - self.in_balance if self.in_balance else 0
        return Stop.STUCK if self.blocked[1] >= 12 or wandering >= settings.wandering else None

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
        if self.blocked[0] >= 2 and self.displacement > settings.settled and self.peaks.load_factor > 0.0:
            half = [s.load_factor for s in self.steps if s.displacement <= 0.5 * self.displacement and s.counted]
            passed = self.displacement > max(0.5 * settings.until, settings.passed * self.risen[1])
            if passed or self.peaks.load_factor < 1.005 * max(half, default=0.0):
                return Stop.FLAT
        if self.blocked[0] >= 2:
            self._recentre()
        if reach >= 0.2:
            self.good = self.h
        return None

    def _least_smoothing(self) -> float:
        """κ with which smoothing takes its share of the live power."""
        share, from_there = self.settings.smoothed
        share *= min(1.0, from_there / self.displacement) if self.displacement > 0.0 else 1.0
        wanted = self.joints.n_products * self.force**2 / (share * self.scale * self.h)
        return float(min(1.0, wanted))

    def _recentre(self) -> None:
        """Blocked: on the central path of the present forces, with ten times the products."""
        self.recentred += 1
        self.kappa /= 10.0
        if self.blocked[1] > 2:
            self.h = max(self.h, 0.3 * self.good)
        self.blocked = (0, self.blocked[1])
        self.state = centred(self.joints, self.state, self.sigma, 0.95)

    def result(self, stop: Stop) -> ElasticPath:
        """The path, with the steps of its peaks solved."""
        peaks = self.peaks
        top = peaks.greatest(onwards=not self.broken, late=stop is Stop.LATE)
        half = peaks.solve(peaks.half) if stop is Stop.FAR and peaks.half is not None else None
        spent = self.factorizations + peaks.spent + self.gravity.steps
        found = (top, half, stop, tuple(self.steps), self.unit, spent, self.recentred, tuple(self.broken))
        return ElasticPath(*found)
