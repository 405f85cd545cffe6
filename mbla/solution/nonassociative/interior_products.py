"""What the products of force left and motion should become in a step of the interior-point method.

The products of a joint are N y, (f_c − N) z and the pair p = l s + T·w, q = l w + s T, which is the product of (l, T)
and (s, w) in the algebra of the second-order cone; its eigenvalues are p ± ‖q‖. In the middle N y = (f_c − N) z = σ,
p = σ, q = 0: both eigenvalues are σ too.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_joints import Iterate, Missing, Products, StepProblem


def wanted(
    step: StepProblem, missing: Missing, target: float, predictor: Iterate | None = None, second: float = 0.0
) -> Products:
    """Changes to products ``target``, less the second-order terms of a predictor weighted by ``second``."""
    plain = Products(
        opening=target - missing.normal_product,
        crushing=target - missing.crushing_product,
        sliding=target - missing.shear_product,
        turning=-missing.shear_direction,
    )
    if predictor is None or second == 0.0:
        return plain
    growth = step.law.slope * predictor.normal
    return plain.plus(
        Products(
            opening=-second * predictor.normal * predictor.opening,
            crushing=second * predictor.normal[step.crushable] * predictor.crushing,
            sliding=-second * (growth * predictor.speed + (predictor.shear * predictor.slip).sum(axis=1)),
            turning=-second * (growth[:, None] * predictor.slip + predictor.speed[:, None] * predictor.shear),
        )
    )


def outlying(step: StepProblem, ahead: Iterate, least: float, most: float) -> Products:
    """Changes that bring products back within limits, by no more than ``most`` downwards.

    Far too large products are better left alone than fought with (Gondzio 1996).
    """

    def back(product: FloatArray) -> FloatArray:
        return np.maximum(np.clip(product, least, most) - product, -most)

    limit = step.limit(ahead.normal)
    head = limit * ahead.speed + (ahead.shear * ahead.slip).sum(axis=1)
    tail = limit[:, None] * ahead.slip + ahead.speed[:, None] * ahead.shear
    size = np.linalg.norm(tail, axis=1)
    larger, smaller = back(head + size), back(head - size)
    way = tail / np.maximum(size, 1e-300)[:, None]
    return Products(
        opening=back(ahead.normal * ahead.opening),
        crushing=back(step.room(ahead.normal) * ahead.crushing),
        sliding=0.5 * (larger + smaller),
        turning=(0.5 * (larger - smaller))[:, None] * way,
    )
