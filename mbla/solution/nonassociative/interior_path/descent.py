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
from mbla.solution.nonassociative.interior_path.central_path import CentralPath, PathVector, residuals
from mbla.solution.nonassociative.interior_path.condensed_matrix import MatrixMap
from mbla.solution.nonassociative.interior_path.products import LocalCost, local_cost, products_at
from mbla.solution.nonassociative.interior_path.saddle_matrix import LeastChange, least_change, saddle_map

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


def descend(path: CentralPath, pattern: MatrixMap, first: PathVector, most: int) -> Iterator[PathVector]:
    """Points nearer and nearer to the law, one per factorisation, at most ``most``."""
    shape = (path.program.n_points, path.program.components)
    nothing = (np.zeros(len(path.program.live_load)), 0.0, np.zeros(shape), 0.0)
    path = replace(path, pull=0.0, start=nothing)
    saddle, point, damping = saddle_map(pattern), first, FIRST_DAMPING
    stragglers, lowest, waited = STRAGGLERS, float("inf"), 0
    for _ in range(most):
        products = products_at(path, point)
        target = max(TARGET * float(np.median(products.normal)), products.largest() / stragglers)
        cost = local_cost(path, point, target, damping)
        solved = least_change(path, saddle, cost, residuals(path, point))
        if solved is None:
            return
        change = _whole(path, cost, solved)
        size = min(1.0, SHARE_OF_ROOM * room(path, point, change))
        while size > LEAST_SIZE and not inside(path, point.plus(change, size)):
            size *= 0.5
        if not size > LEAST_SIZE:
            return
        point = replace(point.plus(change, size), log_sigma=float(np.log(target)))
        stragglers, lowest, waited = _patience(stragglers, lowest, waited, target)
        damping = damping * 3.0 if size < SHORT else damping * 0.5 if size > LONG else damping
        damping = min(max(damping, LEAST_DAMPING), MOST_DAMPING)
        yield point


def _patience(stragglers: float, lowest: float, waited: int, target: float) -> tuple[float, float, int]:
    """How far stragglers may lie behind from now on, the target to beat, and the steps since it was beaten."""
    if target < GAIN * lowest:
        return stragglers, target, 0
    return (stragglers * MORE, lowest, 0) if waited >= WAIT else (stragglers, lowest, waited + 1)


def _whole(path: CentralPath, cost: LocalCost, solved: LeastChange) -> PathVector:
    """The change of a point, with the changes that were eliminated at the contacts."""
    c = path.program.components
    motion = np.concatenate([solved.forces, solved.slacks], axis=1)
    size = -(_dot(cost.size_row, motion) + cost.size_gradient)
    with_size = np.concatenate([motion, size[:, None]], axis=1)
    crushing = np.where(path.crushable, -(_dot(cost.crushing_row, with_size) + cost.crushing_gradient), 0.0)
    frictional = path.frictional
    return PathVector(
        velocities=solved.velocities,
        load_factor=solved.load_factor,
        forces=solved.forces,
        opening=solved.slacks[:, 0] + crushing,
        crushing=crushing,
        slip_size=np.where(frictional, size, 0.0),
        slip=np.where(frictional[:, None], solved.slacks[:, 1:c], 0.0),
        log_sigma=0.0,
    )


def _dot(rows: FloatArray, vectors: FloatArray) -> FloatArray:
    return np.asarray((rows * vectors).sum(axis=1))


TOUCHING = 1e-10
"""Relative rounding of a double root: a cone whose size alone changes is left through its tip."""


@dataclass(frozen=True)
class Metric:
    """Weights of the changes at one point of the path: one over each positive quantity, zero where there is none."""

    normal: FloatArray
    to_crushing: FloatArray
    shear: FloatArray
    opening: FloatArray
    crushing: FloatArray
    slip: FloatArray

    def coordinates(self, change: PathVector) -> FloatArray:
        """Relative changes of all contact quantities and the change of ln σ, one vector."""
        normal = change.forces[:, 0]
        return np.concatenate(
            [
                normal * self.normal,
                normal * self.to_crushing,
                (change.forces[:, 1:] * self.shear[:, None]).ravel(),
                change.opening * self.opening,
                change.crushing * self.crushing,
                change.slip_size * self.slip,
                (change.slip * self.slip[:, None]).ravel(),
                [change.log_sigma],
            ]
        )


def metric_at(path: CentralPath, point: PathVector) -> Metric:
    """Metric of relative changes at a point of the path."""
    to_opening, to_crushing, strength = path.margins(point.forces)
    return Metric(
        normal=1.0 / to_opening,
        to_crushing=np.where(path.crushable, 1.0 / to_crushing, 0.0),
        shear=np.where(path.frictional, 1.0 / strength, 0.0),
        opening=1.0 / point.opening,
        crushing=np.where(path.crushable, 1.0 / np.where(path.crushable, point.crushing, 1.0), 0.0),
        slip=np.where(path.frictional, 1.0 / point.slip_size, 0.0),
    )


def room(path: CentralPath, point: PathVector, change: PathVector) -> float:
    """Largest multiple of a change that stays within all half-lines and cones; infinite where none binds."""
    to_opening, to_crushing, strength = path.margins(point.forces)
    crushable, frictional = path.crushable, path.frictional
    normal, friction = change.forces[:, 0], path.program.limits.friction
    return min(
        _half_lines(to_opening, normal),
        _half_lines(point.opening, change.opening),
        _half_lines(to_crushing[crushable], -normal[crushable]),
        _half_lines(point.crushing[crushable], change.crushing[crushable]),
        _cones(
            strength[frictional],
            point.forces[frictional, 1:],
            (friction * normal)[frictional],
            change.forces[frictional, 1:],
        ),
        _cones(
            point.slip_size[frictional],
            point.slip[frictional],
            change.slip_size[frictional],
            change.slip[frictional],
        ),
    )


def inside(path: CentralPath, point: PathVector) -> bool:
    """Whether a point lies strictly within all half-lines and cones; rounding can take a step across."""
    to_opening, to_crushing, strength = path.margins(point.forces)
    frictional = path.frictional
    half_lines = (to_opening, to_crushing, point.opening, point.crushing[path.crushable])
    in_force = strength > np.linalg.norm(point.forces[:, 1:], axis=1)
    in_slip = point.slip_size > np.linalg.norm(point.slip, axis=1)
    return all(bool((part > 0.0).all()) for part in half_lines) and bool((in_force & in_slip)[frictional].all())


def _half_lines(value: FloatArray, change: FloatArray) -> float:
    fastest = float((-change / value).max(initial=0.0))
    return 1.0 / fastest if fastest > 0.0 else float("inf")


def _cones(size: FloatArray, part: FloatArray, size_change: FloatArray, part_change: FloatArray) -> float:
    """Least positive h with size + h size_change = ‖part + h part_change‖, from inside."""
    length = np.linalg.norm(part, axis=1)
    constant = (size - length) * (size + length)
    linear = size * size_change - (part * part_change).sum(axis=1)
    square = size_change**2 - (part_change**2).sum(axis=1)
    under_root = linear**2 - square * constant
    below = np.sqrt(np.maximum(under_root, 0.0)) - linear
    binds = (under_root >= -TOUCHING * linear**2) & (below > 0.0)
    return float(np.where(binds, constant / np.where(binds, below, 1.0), np.inf).min(initial=np.inf))
