"""Where a step of the interior-point method starts: afresh, or near the motion of the step before.

Near a motion v every joint is put on the central path of its law for that motion. With trial forces a = x̄ − v/ρ, the
anchor's less what the motion takes away, and products σ (without the dilatancy, which Newton's method adds)::

    N − y/ρ = a_N,   N y = σ              N = (a_N + √(a_N² + 4σ/ρ)) / 2
    T − w/ρ = a_T,   l s + T·w = σ,  l w + s T = 0
        T = l ω/s θ,   w = −ω θ,   s = e + √(e² + ω²),   e = σ/2l,   θ = a_T/‖a_T‖,   l ω/s + ω/ρ = ‖a_T‖

This is the return map of ``joint_law``, rounded off: joints fit their law and the motion, and only the
balance of forces is missing. The last equation grows with ω and is solved by bisection.

Measured against starts with the velocities of the step before but pressed joints without shear: 291 factorisations in
all steps in place of 417 on a planar wall of 1,012 blocks, 92 in place of 94 on a spatial one of 410. With products ten
times smaller, used for every step, the planar wall took many more and shorter steps; see ``START_SHARE`` in
:mod:`mbla.solution.nonassociative.law_steps` for where they pay.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_joints import Iterate, StepProblem

BISECTIONS = 50
"""Down to rounding."""


def fresh_start(step: StepProblem, load_factor: float) -> Iterate:
    """All joints on the central path, pressed by the mean size of the anchor's forces, without shear."""
    program, limits, live = step.program, step.program.limits, step.program.live_load
    size = _size(step)
    u = np.zeros_like(live) if step.fixed_load else live / (live @ live)
    normal = np.minimum(np.full(program.n_points, size) + limits.tension, _half_of_the_room(step))
    product = _product(step, step.stiffness.velocities(u))
    nothing = np.zeros((program.n_points, program.components - 1))
    return Iterate(
        u=u,
        factor=load_factor,
        normal=normal,
        opening=product / normal,
        shear=nothing,
        slip=nothing,
        speed=product / step.limit(normal),
        crushing=product / step.room(normal),
    )


def start_near(step: StepProblem, load_factor: float, velocities: FloatArray, share: float = 1.0) -> Iterate:
    """All joints on the central path of their law for velocities of the blocks, (n_rows,).

    share : of the usual products; the less, the nearer
    """
    v = step.stiffness.velocities(velocities)
    product, trial = share * _product(step, v), step.anchor - v / step.rho
    pressed = trial[:, 0] + step.program.limits.tension
    root = np.sqrt(pressed**2 + 4.0 * product / step.rho)
    normal = np.where(pressed > 0.0, 0.5 * (pressed + root), 2.0 * product / step.rho / (root + np.abs(pressed)))
    normal = np.minimum(normal, _half_of_the_room(step))
    limit = step.limit(normal)
    sheared = np.linalg.norm(trial[:, 1:], axis=1)
    theta = trial[:, 1:] / np.maximum(sheared, 1e-300)[:, None]
    half = 0.5 * product / limit
    sliding = _sliding(limit, half, sheared, step.rho)
    speed = half + np.hypot(half, sliding)
    return Iterate(
        u=velocities,
        factor=load_factor,
        normal=normal,
        opening=product / normal,
        shear=(limit * sliding / speed)[:, None] * theta,
        slip=-sliding[:, None] * theta,
        speed=speed,
        crushing=product / step.room(normal),
    )


def _sliding(limit: FloatArray, half: FloatArray, sheared: FloatArray, rho: float) -> FloatArray:
    """ω with l ω/s + ω/ρ = ‖a_T‖."""
    low, high = np.zeros_like(limit), rho * sheared
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = limit * middle / (half + np.hypot(half, middle)) + middle / rho > sheared
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return low


def _size(step: StepProblem) -> float:
    """Root mean square of the anchor's forces."""
    return float(np.sqrt((step.anchor**2).mean())) or 1.0


def _product(step: StepProblem, velocities: FloatArray) -> float:
    """Σ of a start: the mean force times the mean speed of joints that move and give by as much."""
    size = _size(step)
    return size * (float(np.abs(velocities).mean()) + step.rho * size)


def _half_of_the_room(step: StepProblem) -> FloatArray:
    limits = step.program.limits
    return 0.5 * (limits.compression + limits.tension)
