"""The central path followed by arc length, forwards through its turning points.

In vaults the path folds: σ goes down, up again and down. Whatever only reduces σ stops at the first fold, Newton's
matrix being singular there; arc length goes round it (Allgower and Georg 2003, doi:10.1137/1.9780898719154). One step::

    predictor   along the tangent, at most 0.9 of the way to the boundary of the cones
    corrector   Newton's method in the plane across the tangent; each factorisation gives the Newton step and the new
                tangent, and a last Newton step is made with the factors at hand once the point is close

Steps are measured in relative changes (``Metric``). The sense of the path is known
from its start: dσ along it changes sign with the determinant, so that a tangent that turns too far, or against that
sign, tells of a jump to another stretch of the path; such a step is rejected and made shorter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path.central_path import (
    CentralPath,
    LinearStep,
    linear_step,
    missing_at,
    off_path,
)
from mbla.solution.nonassociative.interior_path.descent import Metric
from mbla.solution.nonassociative.joint_equations import Iterate, Missing, step_to_boundary

FIRST_STEP, LEAST_STEP = 0.5, 1e-9
"""Length of the first step, and of one at which the path is given up, in relative changes."""

SHARE_OF_ROOM = 0.9
"""Predictor: share of the way to the boundary."""

CLOSE = 1e-2
"""Distance from the path at which one more Newton step with the factors at hand is enough. At 0.1 steps jumped."""

MOST_CORRECTIONS = 5
GROWTH = (3.0, 2.5, 1.8, 1.2, 0.9, 0.7)
"""Change of the step length by the number of corrections that were needed."""

SHRINK = 0.3
CONTRACTION = 0.7
"""A correction longer than this share of the one before says that Newton's method does not converge."""

FIRST_CORRECTION = 0.5
"""Largest correction in steps: a longer one lands elsewhere on the path."""

TURN = 0.6
"""Least cosine between tangents before and after a step."""

REFRESH = (2, 5, 9)
"""Rejections in a row after which the point itself is corrected again: a tangent of a point off the path misleads."""

ON_PATH = 1e-9


@dataclass(frozen=True)
class Stage:
    """Where the following of a path has come to.

    direction : unit tangent, in the sense of the path
    folds     : turning points passed
    """

    point: Iterate
    direction: Iterate
    factorizations: int
    folds: int
    step: float


@dataclass
class _Follower:
    """What stays the same along a path, and what is counted."""

    path: CentralPath
    sense: float = 0.0
    factorizations: int = 0

    def linear(self, point: Iterate, left: Missing) -> LinearStep | None:
        self.factorizations += 1
        return linear_step(self.path, point, left)

    def unit(self, linear: LinearStep, metric: Metric) -> Iterate:
        """Unit tangent in the sense of the path."""
        size = self.sense * linear.factors.sign() / _length(metric.coordinates(linear.tangent))
        return linear.tangent.times(size)


def follow(path: CentralPath, first: Iterate, most: int) -> Iterator[Stage]:
    """Go along the path from its first point, towards small σ; ends where steps become too short or after ``most``.

    most : factorisations
    """
    follower = _Follower(path)
    linear = follower.linear(first, missing_at(path, first))
    if linear is None:
        return
    follower.sense = -linear.factors.sign()
    direction = follower.unit(linear, Metric(path.joints, first))
    point, step, folds, rejected = first, FIRST_STEP, 0, 0
    while follower.factorizations < most and step > LEAST_STEP:
        length = min(step, SHARE_OF_ROOM * step_to_boundary(path.joints, point, direction))
        moved = _step(follower, point, direction, length)
        if moved is None:
            step, rejected = SHRINK * length, rejected + 1
            if rejected in REFRESH:
                point, direction = _refreshed(follower, point, direction)
            continue
        folds += int(np.sign(moved.direction.log_sigma) != np.sign(direction.log_sigma))
        point, direction, rejected = moved.point, moved.direction, 0
        step = GROWTH[moved.corrections] * length
        yield Stage(point, direction, follower.factorizations, folds, length)


@dataclass(frozen=True)
class _Moved:
    point: Iterate
    direction: Iterate
    corrections: int


def _step(follower: _Follower, base: Iterate, direction: Iterate, length: float) -> _Moved | None:
    """One predictor and its corrections; None where the step is rejected."""
    path, metric = follower.path, Metric(follower.path.joints, base)
    across = metric.coordinates(direction)
    point, before = base.plus(direction, length), float("inf")
    for count in range(MOST_CORRECTIONS + 1):
        left = missing_at(path, point)
        linear = follower.linear(point, left)
        if linear is None:
            return None
        correction, size = _correction(linear, metric, across)
        if not size <= FIRST_CORRECTION * length or size > CONTRACTION * before:  # also where size is not a number
            return None
        if step_to_boundary(path.joints, point, correction) < 1.0 / SHARE_OF_ROOM:
            return None
        close, before = off_path(path, point, left) < CLOSE, size
        point = point.plus(correction)
        if close:
            return _accepted(follower, direction, point, linear, count)
    return None


def _accepted(
    follower: _Follower, before: Iterate, point: Iterate, linear: LinearStep, corrections: int
) -> _Moved | None:
    metric = Metric(follower.path.joints, point)
    direction = follower.unit(linear, metric)
    old, new = metric.coordinates(before), metric.coordinates(direction)
    turn = _dot(old, new) / max(_length(old), 1e-300)
    return _Moved(point, direction, corrections) if turn >= TURN else None


def _correction(linear: LinearStep, metric: Metric, across: FloatArray) -> tuple[Iterate, float]:
    """Newton step that stays in the plane across the tangent, and its length; infinite where there is none."""
    newton, tangent = metric.coordinates(linear.newton), metric.coordinates(linear.tangent)
    along = _dot(across, tangent)
    if along == 0.0 or not np.isfinite(along):
        return linear.newton, float("inf")
    amount = -_dot(across, newton) / along
    return linear.newton.plus(linear.tangent, amount), _length(newton + amount * tangent)


def _refreshed(follower: _Follower, point: Iterate, direction: Iterate) -> tuple[Iterate, Iterate]:
    """The same point nearer to the path, and the tangent there."""
    path, metric = follower.path, Metric(follower.path.joints, point)
    across, latest = metric.coordinates(direction), None
    for _ in range(MOST_CORRECTIONS - 1):
        left = missing_at(path, point)
        linear = follower.linear(point, left)
        if linear is None:
            break
        latest = linear
        correction, size = _correction(linear, metric, across)
        if off_path(path, point, left) < ON_PATH or not np.isfinite(size):
            break
        if step_to_boundary(path.joints, point, correction) < 1.0 / SHARE_OF_ROOM:
            break
        point = point.plus(correction)
    return point, direction if latest is None else follower.unit(latest, Metric(path.joints, point))


def _dot(first: FloatArray, second: FloatArray) -> float:
    """Scalar product of long vectors; not by BLAS, whose threads cost more than they gain on a busy machine."""
    return float((first * second).sum())


def _length(vector: FloatArray) -> float:
    return float(np.sqrt(_dot(vector, vector)))
