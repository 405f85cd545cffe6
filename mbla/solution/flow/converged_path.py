"""The path of elastic joints with every step solved: a reference for the one of single directions, and for limit cases.

Each implicit step is solved until the law of its joints holds, so that what they remember is exact. The load factor
does not hang on the length of the steps then, and rises to its limit and stays there. That takes some twenty
factorisations a step: it pays where the structure stands at its limit, next to which all smoothing is too much.
"""

from __future__ import annotations

from dataclasses import replace

from mbla.solution.flow.fall import ELASTIC, Fall
from mbla.solution.flow.gravity_step import Gravity
from mbla.solution.flow.path_record import ElasticPath, PathStep, Stop
from mbla.solution.flow.peak_step import EXACT, PeakStep, at_rest_of, centred, solved_peak
from mbla.solution.flow.settings import PathSettings
from mbla.solution.flow.unit_of_displacement import Measure
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.joint_equations import JointStep

ROUGH, SHORTEST = 100.0 * EXACT, 1e-3
"""Misfit above which a step is halved, and its length in units below which the path is stuck."""


def follow_solved(
    joints: ElasticJoints, gravity: Gravity, measure: Measure, settings: PathSettings, *, needed: bool = True
) -> ElasticPath:
    """The path from the structure at rest, of joints without brittle ties.

    needed : whether no other path has a state, so that it is followed however slowly
    """
    path = _ConvergedPath(joints, gravity, measure, settings, needed=needed)
    stop = None
    while stop is None:
        stop = path.advance()
    spent = gravity.steps + path.factorizations
    half = path.half if stop is Stop.FAR else None
    curve = tuple(path.steps)
    return ElasticPath(path.top, half, stop, curve, measure.displacement, spent, path.halved)


class _ConvergedPath:
    """A path on its way: state and memory of the joints, length of the next step in units, displacement, and peaks."""

    def __init__(
        self, joints: ElasticJoints, gravity: Gravity, measure: Measure, settings: PathSettings, *, needed: bool
    ) -> None:
        self.needed, motion = needed, measure.motion
        self.joints, self.measure, self.settings, self.memory = joints, measure, settings, gravity.memory
        self.force = max(gravity.force, measure.force_of(joints.program))
        self.state = replace(gravity.state, u=motion / float(joints.program.live_load @ motion))
        self.length, self.displacement = settings.first, 0.0
        self.top: PeakStep | None = None
        self.half: PeakStep | None = None
        self.steps: list[PathStep] = []
        self.factorizations, self.halved, self.low = 0, 0, Fall(settings)

    def advance(self) -> Stop | None:
        """One step, or half of it next time where it could not be solved; why the path ends, None where it goes on."""
        until = self.settings.until
        length = min(self.length, until - self.displacement)
        there = self._solved(length)
        if there.misfit > ROUGH:
            self.length, self.halved = 0.5 * length, self.halved + 1
            return Stop.STUCK if self.length < SHORTEST else self._over()
        self.state, self.memory = there.state, there.memory
        self.displacement += length
        if self.top is None or there.state.factor > self.top.state.factor:
            self.top = there
        if self.displacement <= 0.5 * until:
            self.half = self.top
        opened, slide = self.memory.yielding(self.joints, there.state.normal)
        step = PathStep(self.displacement, there.state.factor, counted=True, reach=1.0, open=opened, slide=slide)
        self.steps.append(self.settings.seen(step))
        growth, longest = self.settings.solved
        self.length = min(growth * length, max(longest * self.displacement, self.settings.first))
        below = there.state.factor < (1.0 - self.settings.dropped) * self.top.state.factor
        self.low = self.low.after(below, self.displacement, there.state.factor)
        if self.low.is_over(self.displacement):
            return Stop.FALLS
        if self.displacement >= until * (1.0 - 1e-9):
            return Stop.FAR
        return self._over()

    def _over(self) -> Stop | None:
        """Whether time or factorisations are over."""
        if self.settings.late:
            return Stop.LATE
        most, crawling = self.settings.spent
        crawls = not self.needed and self.factorizations > crawling and self.displacement < ELASTIC
        return Stop.BUDGET if crawls or self.factorizations > most else None

    def _solved(self, length: float) -> PeakStep:
        """A step of a length in units."""
        h = length * self.measure.displacement
        sigma = self.force**2 / (self.settings.smoothing * h)
        step = JointStep(self.joints, self.memory, h)
        start = centred(self.joints, at_rest_of(step, self.state, sigma), sigma, 0.95)
        there, spent = solved_peak(PeakStep(step, sigma, start, self.displacement + length), self.force)
        self.factorizations += spent
        return there
