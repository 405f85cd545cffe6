"""The steps of a path among which its greatest load factor is: kept on the way, solved at its end."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from mbla.solution.flow.peak_step import PeakStep, at_rest_of, centred, solved_peak
from mbla.solution.flow.settings import PathSettings

WITHIN = 0.95
"""Share of its limit within which shear begins in the short step after that of the peak."""


@dataclass
class GreatestSteps:
    """Of a path that is on its way.

    force : n₀
    unit  : of displacement
    settings : of the path
    top   : step of the greatest load factor so far
    near  : steps next below it, the greatest first
    later : the greatest of the steps after it that are smoothed half as much: early ones may be smoothed much
    half  : the greatest over half of the path
    spent : factorisations on solving them
    """

    force: float
    unit: float
    settings: PathSettings
    top: PeakStep | None = None
    near: list[PeakStep] = field(default_factory=list)
    later: PeakStep | None = None
    half: PeakStep | None = None
    spent: int = 0

    @property
    def load_factor(self) -> float:
        """The greatest so far."""
        return 0.0 if self.top is None else self.top.state.factor

    def keep(self, gone: PeakStep) -> None:
        """A step in balance, where it is one of them."""
        factor = gone.state.factor
        greatest = factor if self.top is None else max(self.top.state.factor, factor)
        share, most = self.settings.near
        near = [each for each in (*self.near, gone) if each.state.factor >= (1.0 - share) * greatest]
        self.near = sorted(near, key=lambda each: -each.state.factor)[:most]
        if self.top is None or factor > self.top.state.factor - self.settings.level * self.load_factor:
            self.top, self.later = gone, None
        elif gone.sigma <= 0.5 * self.top.sigma:
            self.later = max(self.later or gone, gone, key=lambda peak: peak.state.factor)

    def take(self, solved: PeakStep) -> None:
        """A step that was solved on the way, where it is the greatest."""
        self.top = solved if solved.state.factor > self.load_factor else self.top

    def solve(self, step: PeakStep) -> PeakStep:
        """A step solved, and what that took counted."""
        solved, spent = solved_peak(step, self.force)
        self.spent += spent
        return solved

    def greatest(self, *, onwards: bool, late: bool) -> PeakStep | None:
        """The step of the greatest load factor, solved as far as it can be.

        onwards         : followed by a short step, unless the load falls in it
        late            : whether time is over, and only that step is solved
        """
        if self.top is None:
            return None
        top = self.solve(self.top)
        if late:
            return top
        for near in self.near:
            if not top.is_solved and near is not self.top:
                top = min(top, self.solve(near), key=lambda peak: peak.misfit)
        if self.later is not None and (not top.is_solved or top.state.factor < self.later.state.factor):
            top = max(top, self.solve(self.later), key=lambda peak: (peak.is_solved, peak.state.factor))
        return self._onwards(top) if onwards and top.is_solved else top

    def _onwards(self, top: PeakStep) -> PeakStep:
        """The short step after that of the peak, solved, unless the load falls in it.

        What the smoothed steps before have left is made up for in the step of the peak, whose motion has that in it.
        """
        length, alike = self.settings.onwards
        step = replace(top.step, memory=top.memory, length=length * self.unit)
        start = top.state
        if not step.joints.laws:  # solved by Newton's method it has no products
            start = centred(step.joints, at_rest_of(step, top.state, top.sigma), top.sigma, WITHIN)
        after = self.solve(replace(top, step=step, state=start))
        level = after.is_solved and abs(after.state.factor - top.state.factor) <= alike * abs(top.state.factor)
        return after if level else top
