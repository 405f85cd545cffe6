"""One primal–dual step on the equations of elastic joints: its direction, and how far that stays within the law.

The direction goes towards products σ of the law (:mod:`mbla.solution.law.elimination`); where it is blocked early,
second-order terms are taken in (Mehrotra 1992, doi:10.1137/0802028), then corrections of products that lie far off
(Gondzio 1996, doi:10.1007/BF00249643).
"""

from __future__ import annotations

import numpy as np

from mbla.solution.cone_solvers.cone_vectors import cones_to_boundary, lines_to_boundary
from mbla.solution.law.elastic_joints import ElasticJoints, StepState, lengths
from mbla.solution.law.elimination import Eliminated
from mbla.solution.law.interface_law import SHARE
from mbla.solution.law.joint_equations import JointStep, Products, Residual, products_of

LONG = 0.9
"""Share of a direction from which it is gone without corrections."""

CORRECTIONS, BEYOND, GAIN, FAR_OFF = 2, 0.3, 0.03, 10.0
"""Corrections of outlying products at most; how far beyond the end of the step they look; by how much one must make the
step longer to be kept; factor from σ from which a product is outlying."""

BEYOND_ALL = 1e100
"""Change of shear or slip with which the equations are as good as singular."""


def direction_of(step: JointStep, state: StepState, residual: Residual, sigma: float) -> tuple[StepState, float] | None:
    """Direction towards products σ and how much of it stays within the law, at most 1; None where it is singular."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # seen below, or by the reach
        return _direction_of(step, state, residual, sigma)


def _direction_of(
    step: JointStep, state: StepState, residual: Residual, sigma: float
) -> tuple[StepState, float] | None:
    linear = Eliminated.at(step, state)
    if linear is None:
        return None
    joints = step.joints
    wanted = residual.products.towards(sigma, joints)
    direction = linear.direction(residual, wanted)
    if not np.isfinite(direction.u).all():
        return None
    reach = min(1.0, reach_of(joints, state, direction))
    if reach > LONG:
        return direction, reach
    wanted = wanted.plus(_second_order(linear, direction, reach * reach))
    trial = linear.direction(residual, wanted)
    longer = min(1.0, reach_of(joints, state, trial))
    if longer > reach:
        direction, reach = trial, longer
    return _corrected(linear, state, residual, wanted, (direction, reach), sigma)


def _corrected(
    linear: Eliminated,
    state: StepState,
    residual: Residual,
    wanted: Products,
    begun: tuple[StepState, float],
    sigma: float,
) -> tuple[StepState, float]:
    """A direction and its reach, with outlying products taken back as long as that makes it longer (Gondzio 1996)."""
    joints, (direction, reach) = linear.step.joints, begun
    for _ in range(CORRECTIONS):
        if reach > LONG:
            break
        ahead = state.plus(direction, min(1.0, reach + BEYOND))
        wanted = wanted.plus(_outlying(joints, products_of(joints, ahead), sigma))
        trial = linear.direction(residual, wanted)
        longer = min(1.0, reach_of(joints, state, trial))
        if longer < reach + GAIN:
            break
        direction, reach = trial, longer
    return direction, reach


CENTRED, LEAST_AIM, SHORT, HALF = 3, 1e-3, 0.1, 0.5
"""Power of the share of the mean product that a direction towards none leaves, with which the next is aimed at; its
least; reach of such a direction from which it is aimed so, else at a share of the mean."""


def aimed_direction(step: JointStep, state: StepState, residual: Residual) -> tuple[StepState, float] | None:
    """Direction towards products that the state aims at itself (Mehrotra 1992); how much of it stays within the law."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        linear = Eliminated.at(step, state)
        if linear is None:
            return None
        joints = step.joints
        wanted = residual.products.towards(0.0, joints)
        direction = linear.direction(residual, wanted)
        if not np.isfinite(direction.u).all():
            return None
        reach = min(1.0, reach_of(joints, state, direction))
        mean = residual.products.mean(joints)
        ahead = products_of(joints, state.plus(direction, reach)).mean(joints)
        aim = float(np.clip((max(ahead, 0.0) / mean) ** CENTRED, LEAST_AIM, 1.0)) if reach > SHORT else HALF
        sigma = aim * mean
        wanted = residual.products.towards(sigma, joints).plus(_second_order(linear, direction, reach))
        direction = linear.direction(residual, wanted)
        reach = min(1.0, reach_of(joints, state, direction))
        if reach < 0.3:
            plain = residual.products.towards(max(sigma, HALF * mean), joints)
            trial = linear.direction(residual, plain)
            longer = min(1.0, reach_of(joints, state, trial))
            if longer > reach:
                direction, reach, wanted = trial, longer, plain
        return _corrected(linear, state, residual, wanted, (direction, reach), sigma)


def length_of(reach: float) -> float:
    """How far a step goes whose direction stays within the law up to ``reach``."""
    return reach if reach >= 1.0 else SHARE * reach


def reach_of(joints: ElasticJoints, state: StepState, direction: StepState) -> float:
    """How much of a direction leaves every joint within its law; infinite where none binds."""
    lines = [
        (state.normal + joints.program.limits.tension, direction.normal),
        (state.opening, direction.opening),
    ]
    if len(joints.crushable):
        lines += [
            (joints.room(state.normal), -direction.normal[joints.crushable]),
            (state.crushing, direction.crushing),
        ]
    cones = (
        (joints.limit(state.normal), state.shear, joints.friction * direction.normal, direction.shear),
        (state.speed, state.slip, direction.speed, direction.slip),
    )
    reach = [float(lines_to_boundary(value, change).min(initial=np.inf)) for value, change in lines]
    for radius, vector, growth, turn in cones:
        if not np.isfinite(turn).all() or float(np.abs(turn).max(initial=0.0)) > BEYOND_ALL:
            return 0.0
        inside = np.maximum(radius * radius - (vector * vector).sum(axis=0), 0.0)
        mixed, ahead = radius * growth - (vector * turn).sum(axis=0), growth * growth - (turn * turn).sum(axis=0)
        reach.append(float(cones_to_boundary(inside, mixed, ahead).min(initial=np.inf)))
    most = min(reach)
    for law, own, change in zip(joints.laws, state.interfaces, direction.interfaces, strict=True):
        most = law.reach(own, change, state.normal, direction.normal, min(1.0, most))
    return most


def _second_order(linear: Eliminated, direction: StepState, share: float) -> Products:
    """What a direction changes of the products in the second order, with a share taken back."""
    joints = linear.step.joints
    growth = joints.friction * direction.normal
    return Products(
        normal=-share * direction.normal * direction.opening,
        sliding=-share * (growth * direction.speed + (direction.shear * direction.slip).sum(axis=0)),
        turning=-share * (growth * direction.slip + direction.speed * direction.shear),
        crushing=share * direction.normal[joints.crushable] * direction.crushing,
        interfaces=tuple(
            -share * one.second_order(turn, direction.normal)
            for one, turn in zip(linear.interfaces, direction.interfaces, strict=True)
        ),
    )


def _outlying(joints: ElasticJoints, ahead: Products, sigma: float) -> Products:
    """Changes that bring products back within a factor of σ; of a pair those are p ± ‖q‖."""
    least, most = sigma / FAR_OFF, sigma * FAR_OFF
    size = lengths(ahead.turning)
    larger = np.clip(ahead.sliding + size, least, most)
    smaller = np.clip(ahead.sliding - size, least, most)
    turned = (0.5 * (larger - smaller) - size) / np.maximum(size, 1e-300)
    return Products(
        normal=np.clip(ahead.normal, least, most) - ahead.normal,
        sliding=0.5 * (larger + smaller) - ahead.sliding,
        turning=turned * ahead.turning,
        crushing=np.clip(ahead.crushing, least, most) - ahead.crushing,
        interfaces=tuple(
            np.clip(one, law.conditions.weight * least, law.conditions.weight * most) - one
            for law, one in zip(joints.laws, ahead.interfaces, strict=True)
        ),
    )
