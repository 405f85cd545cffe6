"""The measure of steps along the path: relative changes at the contacts, and how far the cones let a step go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path.central_path import CentralPath, PathVector

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
