"""Paths from one state at rest, until one is an answer: once more where it is lost or smoothing is too much for it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray
from mbla.program.reductions.restrict import ChosenPart
from mbla.solution.flow.converged_path import follow_solved
from mbla.solution.flow.elastic_path import follow
from mbla.solution.flow.gravity_step import Gravity
from mbla.solution.flow.path_record import ElasticPath, Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.flow.unit_of_displacement import Measure, measure_of, pressed_points
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL

NEGLIGIBLE = 1e-6
"""Reaction at rest over the part's own unit of load that is none."""

ALIKE, LINEAR = 4.0, 0.5
"""Factor within which a measure is of the size of what was found, and share of the elastic load at the end of the path
from which nothing has given way."""


@dataclass(frozen=True)
class AtRest:
    """What is followed, under its dead load.

    settings : of its paths
    part     : which alone is followed; None for all
    begins   : load factor from which that of its paths counts
    """

    joints: ElasticJoints
    gravity: Gravity
    settings: PathSettings
    part: ChosenPart | None = None
    begins: float = 0.0

    @property
    def twists(self) -> bool:
        """Whether normal forces bound interfaces beside their points: where a path is blocked there, brought back it
        was up to 4 % low on a vault on piers.
        """
        return any(law.conditions.points is not None for law in self.joints.laws)

    @property
    def pressed(self) -> BoolArray:
        """Points that are pressed, (n_points,)."""
        return pressed_points(self.joints, self.gravity.memory.normal, self.gravity.force)


@dataclass(frozen=True)
class Followed:
    """The path that counts, why it ended, and all that were followed."""

    path: ElasticPath
    stop: Stop
    paths: tuple[ElasticPath, ...]


def followed(rest: AtRest, measure: Measure) -> Followed:
    """By a measure that is known."""

    def along(by: PathSettings) -> ElasticPath:
        return follow(rest.joints, rest.gravity, measure, by)

    settings = rest.settings
    path = along(settings)
    paths = [path]
    if is_too_rough(path, rest):
        path = follow_solved(rest.joints, rest.gravity, measure, settings)
        paths.append(path)
    elif not rest.twists and _misses(path, APPROXIMATE_RESIDUAL if rest.joints.laws else 0.0):
        paths.append(follow_solved(rest.joints, rest.gravity, measure, settings, needed=False))
        path = _better(settings, *paths)
    elif settings.again and (is_lost(path, settings) or (rest.twists and path.recentred)):
        paths.append(along(replace(settings, most_smoothing=2.0, first=0.5 * settings.first)))
        path = _better(settings, *paths)
    return Followed(path, path.stop, tuple(paths))


def _misses(path: ElasticPath, most: float) -> bool:
    """Whether the step of the peak could not be solved, and misses the law by more than a share."""
    return path.peak is not None and not path.peak.is_solved and path.peak.misfit > most


def _better(settings: PathSettings, lost: ElasticPath, again: ElasticPath) -> ElasticPath:
    """Of two paths the one that has a state at all; that is an answer, if not lower; with the greater load factor."""
    with_state = [path for path in (lost, again) if path.peak is not None and not _misses(path, APPROXIMATE_RESIDUAL)]
    if len(with_state) == 1:
        return with_state[0]
    if again.stop.answers and again.load_factor >= (1.0 - settings.same) * lost.load_factor:
        return again
    return again if again.load_factor > lost.load_factor else lost


def measured_by_itself(rest: AtRest, first: float) -> Followed:
    """Without a load factor of associative flow: measured by what is found, beginning with one in its place."""
    scale, linear, paths = first, False, list[ElasticPath]()
    for _ in range(rest.settings.measures):
        found = followed(rest, measure_of(rest.joints, scale, rest.pressed))
        paths += found.paths
        peak, last = found.path.load_factor, found.path.displacement * scale
        was, linear = linear, peak > LINEAR * last and found.stop is Stop.FAR
        if was and linear:
            return Followed(found.path, Stop.UNBOUNDED, tuple(paths))
        if not found.stop.answers or (not linear and scale / ALIKE <= peak <= ALIKE * scale):
            break
        if not peak > NEGLIGIBLE * first:  # it moves at once
            break
        scale = peak
    return replace(found, paths=tuple(paths))


def is_too_rough(path: ElasticPath, rest: AtRest) -> bool:
    """Whether smoothing may be more than the load factor: the step of the peak came to another one as it was solved."""
    joints, counted = rest.joints, [step.load_factor for step in path.steps if step.counted]
    if joints.program.facts.settling_support or rest.twists or joints.brittle.any():
        return False
    changed = abs(path.load_factor - max(counted, default=0.0)) > rest.settings.rough * path.load_factor
    return path.peak is None or changed


def is_lost(path: ElasticPath, settings: PathSettings) -> bool:
    """Whether a path ended without an answer near its peak, or far below it after it was brought back."""
    stuck, brought_back = settings.lost
    if path.stop in (Stop.STUCK, Stop.BROKE_DOWN):
        return path.moving > stuck * path.load_factor
    return path.recentred > 0 and path.moving < brought_back * path.load_factor


def as_it_gives_way(rest: AtRest, own_unit: float) -> tuple[AtRest, float]:
    """A support that is held, as it gives way; the reaction at rest in units of its live load, to measure paths by.

    Where that is nothing the part's own unit of load stands for it.

    The dead load has that reaction in the place of the one that was chosen: λ of its paths is what is lost of it.

    own_unit : load factor that is the part's own unit
    """
    program, factor = rest.joints.program, rest.gravity.state.factor
    live = program.live_load
    chosen = -float(program.dead_load @ live) / float(live @ live)
    shifted = replace(program, dead_load=program.dead_load + factor * live)
    joints = replace(rest.joints, program=shifted)
    gravity = replace(rest.gravity, state=replace(rest.gravity.state, factor=0.0))
    own, reaction = replace(rest.settings, dropped=np.inf), abs(chosen - factor)
    scale = reaction if reaction > NEGLIGIBLE * own_unit else own_unit
    return replace(rest, joints=joints, gravity=gravity, settings=own, begins=factor), scale
