"""The path of elastic joints of one part: of what moves where that is less, and once more where it is lost."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.stiffness_shares import shares_of
from mbla.solution.flow.elastic_path import ElasticPath, Stop, elastic_motion, follow
from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.settings import PathSettings
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.moving_part import MovingPart, moving_part

MOST_STEPS_OF_PART = 900
"""Steps of a path that follows what moves alone: each costs less."""

LOW, SHARPER, SAME = 0.1, (1e3, 1e5, 1e7), 0.01
"""Share of the associative load factor below which smoothing is taken back, κ with which that is done in turn, and
change of the load factor that counts as none."""

HELD, FALLEN = 0.985, 0.9
"""Shares of the peak: a path that is stuck above the one, or was brought back and lies below the other, is lost."""


@dataclass(frozen=True)
class PathOfPart:
    """What was followed.

    path    : of the program, or of what moves in it
    gravity : where it began
    joints  : of what was followed
    points  : (n,) points of the program that were followed; None for all
    paths   : how many were followed: more than one where it was lost, or is at the limit of standing
    factorizations : spent on all of it
    """

    path: ElasticPath
    gravity: Gravity
    joints: ElasticJoints
    points: IntArray | None
    paths: int
    factorizations: int

    @property
    def load_factor(self) -> float:
        """λ_p, of the program; nan where no step counts."""
        return self.path.load_factor


def path_of_part(
    program: Program,
    associative: float,
    velocities: FloatArray,
    settings: PathSettings,
    dilatancy: FloatArray | None = None,
    interfaces: Interfaces = NONE,
) -> PathOfPart:
    """The path of a part.

    associative : load factor of associative flow; velocities, (n_rows,), of its mechanism
    dilatancy   : (n_points,) tangents of its angles; none unless given
    interfaces  : of the model that have a law of their own
    """
    part, unit = moving_part(program, velocities, rings=3, few=1500, worthwhile=0.8), None
    followed = ElasticJoints.of(program, shares_of(program), settings.ratio, dilatancy, interfaces.rows_of(program))
    points = None if part is None else part.points
    if part is not None:
        followed, unit, settings = _of_moving(part, followed, associative, settings, dilatancy, interfaces)
    gravity = gravity_step(followed, _force_of_live(followed, associative))

    def along(by: PathSettings) -> ElasticPath:
        return follow(followed, gravity, associative, by, unit)

    path = along(settings)
    paths = [path]
    if is_at_limit(path, associative):
        paths += sharper_paths(path, along, settings)
        path = paths[-1]
    elif is_lost(path):
        paths.append(along(replace(settings, most_smoothing=2.0, first=0.5 * settings.first)))
        path = max(paths, key=lambda one: one.load_factor)
    spent = sum(one.factorizations - gravity.steps for one in paths) + gravity.steps
    return PathOfPart(path, gravity, followed, points, len(paths), spent)


def is_at_limit(path: ElasticPath, associative: float) -> bool:
    """Whether smoothing may be more than the load factor, because the dead load is nearly all that is carried."""
    return path.peak is None or path.load_factor < LOW * abs(associative)


def sharper_paths(
    path: ElasticPath, along: Callable[[PathSettings], ElasticPath], settings: PathSettings
) -> list[ElasticPath]:
    """Paths with less and less smoothing, until the load factor no longer changes."""
    paths = [path]
    for kappa in SHARPER:
        paths.append(along(settings.smoothed_by(kappa)))
        before, now = (one.load_factor for one in paths[-2:])
        if abs(now - before) <= SAME * abs(now):
            break
    return paths[1:]


def is_lost(path: ElasticPath) -> bool:
    """Whether a path ended without an answer near its peak, or far below it after it was brought back."""
    if path.stop in (Stop.STUCK, Stop.BROKE_DOWN, Stop.BUDGET):
        return path.last.factor > HELD * path.load_factor
    return path.stop is Stop.FALLS and path.recentred > 0 and path.last.factor < FALLEN * path.load_factor


def _of_moving(
    part: MovingPart,
    whole: ElasticJoints,
    associative: float,
    settings: PathSettings,
    dilatancy: FloatArray | None,
    interfaces: Interfaces,
) -> tuple[ElasticJoints, float, PathSettings]:
    """Joints of what moves, the unit of displacement of the whole, and settings for it."""
    slope = None if dilatancy is None else dilatancy[part.points]
    rows = interfaces.rows_of(part.program)
    joints = ElasticJoints.of(part.program, whole.normal[part.points], settings.ratio, slope, rows)
    unit, own = _unit(whole, associative), _unit(joints, associative)
    first = settings.first * min(1.0, 2.0 * own / unit)
    share, _ = settings.smoothed
    return joints, unit, replace(settings, first=first, smoothed=(share, np.inf), steps=MOST_STEPS_OF_PART)


def _unit(joints: ElasticJoints, associative: float) -> float:
    """Elastic displacement at the associative load."""
    return float(joints.program.live_load @ elastic_motion(joints)) * abs(associative)


def _force_of_live(joints: ElasticJoints, associative: float) -> float:
    """Mean live load of a point at the associative load."""
    n = max(joints.program.n_points, 1)
    return abs(associative) * float(np.abs(joints.program.live_load).sum()) / n
