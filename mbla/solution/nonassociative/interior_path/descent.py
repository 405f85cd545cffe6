"""Down to the exact law by changes of least cost, where the path folds too often to be followed.

A point near the law need not lie on the central path: it is enough that all products are small. So the products are
brought down together, each step being the least relative change that lowers them as wanted while equilibrium and
compatibility hold: a step of Levenberg (1944, doi:10.1090/qam/10666) and Marquardt (1963, doi:10.1137/0111030) in the
local norm of the cones. Near a turning point the products that resist simply lag behind, and no line has to be
followed: in a cross vault of 184 blocks 300 steps went from a residual of 5e-3 to below 1e-6, where 6,000
factorisations along the path, through 268 folds, had stayed above 1e-4.

The target is a share of the median product, but no less than a share of the largest, so that stragglers are waited
for. Damping grows where the cones stop a step and shrinks where they do not.

Steps are measured by relative changes at the contacts, and by how far the cones let them go.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path.central_path import CentralPath, missing_at
from mbla.solution.nonassociative.interior_path.least_change import least_change
from mbla.solution.nonassociative.joint_equations import Iterate, JointEquations, Missing, step_to_boundary

TARGET = 0.85
"""Share of the median product that a step aims at. With 0.7 stragglers remain more often, with 0.5 nearly always."""

STRAGGLERS, MORE = 100.0, 3.0
"""Largest ratio of the largest product to the target, and its growth where waiting was in vain."""

WAIT, GAIN = 40, 0.8
"""Steps within which the target must fall to this share, or stragglers are left further behind."""

LEAST_SIZE = 1e-6
"""Share of a full step at which the descent is given up."""

SHARE_OF_ROOM = 0.9
"""Share of the way to the boundary of the cones that a step may go."""

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 0.1, 1e-3, 1e2
SHORT, LONG = 0.2, 0.6
"""Shares of the full step below which damping is raised threefold, and above which it is halved."""


def descend(path: CentralPath, first: Iterate, most: int) -> Iterator[Iterate]:
    """Points nearer and nearer to the law, one per factorisation, at most ``most``."""
    path = replace(path, pull=0.0, start=None)
    joints, point, damping = path.joints, first, FIRST_DAMPING
    stragglers, lowest, waited = STRAGGLERS, float("inf"), 0
    for _ in range(most):
        missing = missing_at(path, point)
        target = max(TARGET * float(np.median(missing.normal_product)), _largest(missing) / stragglers)
        change = least_change(joints, point, missing, target, damping)
        if change is None:
            return
        size = min(1.0, SHARE_OF_ROOM * step_to_boundary(joints, point, change))
        while size > LEAST_SIZE and not inside(joints, point.plus(change, size)):
            size *= 0.5
        if not size > LEAST_SIZE:
            return
        point = replace(point.plus(change, size), log_sigma=float(np.log(target)))
        stragglers, lowest, waited = _patience(stragglers, lowest, waited, target)
        damping = damping * 3.0 if size < SHORT else damping * 0.5 if size > LONG else damping
        damping = min(max(damping, LEAST_DAMPING), MOST_DAMPING)
        yield point


def _largest(missing: Missing) -> float:
    """The largest of all products."""
    lengths = np.linalg.norm(missing.shear_direction, axis=1)
    parts = (missing.normal_product, missing.crushing_product, missing.shear_product, lengths)
    return max(float(part.max(initial=0.0)) for part in parts)


def _patience(stragglers: float, lowest: float, waited: int, target: float) -> tuple[float, float, int]:
    """How far stragglers may lie behind from now on, the target to beat, and the steps since it was beaten."""
    if target < GAIN * lowest:
        return stragglers, target, 0
    return (stragglers * MORE, lowest, 0) if waited >= WAIT else (stragglers, lowest, waited + 1)


@dataclass(frozen=True)
class Metric:
    """Weights of the changes at one point of the path: one over each positive quantity."""

    joints: JointEquations
    point: Iterate

    def coordinates(self, change: Iterate) -> FloatArray:
        """Relative changes of all contact quantities and the change of ln σ behind them, one vector, (n_changes,)."""
        joints, point, limit = self.joints, self.point, self.joints.limit(self.point.normal)
        return np.concatenate(
            [
                change.normal / point.normal,
                change.normal[joints.crushable] / joints.room(point.normal),
                (change.shear / limit[:, None]).ravel(),
                change.opening / point.opening,
                change.crushing / point.crushing,
                change.speed / point.speed,
                (change.slip / point.speed[:, None]).ravel(),
                [change.log_sigma],
            ]
        )


def inside(joints: JointEquations, point: Iterate) -> bool:
    """Whether a point lies strictly within all half-lines and cones; rounding can take a step across."""
    margins = (
        point.normal,
        point.opening,
        joints.room(point.normal),
        point.crushing,
        joints.limit(point.normal) - np.linalg.norm(point.shear, axis=1),
        point.speed - np.linalg.norm(point.slip, axis=1),
    )
    return all(bool((margin > 0.0).all()) for margin in margins)
