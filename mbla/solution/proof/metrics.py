"""Metrics in which forces and velocities are repaired: Hessians of the barriers of their cones.

The barrier of a cone ‖T‖ ≤ s is −log(s² − ‖T‖²), that of a half-line −log of its slack. Forces and velocities have two
or three components.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.linear_algebra.block_products import block_diagonal, inverses

TINY = 1e-100
"""Stands for zero slack: its square and the square of its inverse are within the range of numbers."""


def force_metric(limits: YieldLimits, x: FloatArray) -> sp.csr_array:
    """Inverse Hessian of the barriers of all yield conditions at forces strictly inside, block-diagonal.

    A row for each number of x, (n_points, components).
    """
    return block_diagonal(force_blocks(limits, x))


@np.errstate(over="ignore", invalid="ignore")
def force_blocks(limits: YieldLimits, x: FloatArray) -> FloatArray:
    """Blocks of ``force_metric``, one for each point.

    Points without shear strength keep T = 0. Not finite where squares of forces are beyond the range of numbers.

    x : (n_points, components)  non-dimensional, compression positive; the blocks are (n_points, components, components)
    """
    mu, s = limits.friction, limits.cohesion + limits.friction * x[:, 0]
    t = x[:, 1:]
    shearless = (mu == 0) & (limits.cohesion == 0)
    s = np.where(shearless, 1.0, s)
    det = np.maximum(s**2 - (t**2).sum(axis=1), TINY)
    hessian = _cone_hessian(np.column_stack([-mu * s, t]), det)
    hessian[:, 0, 0] -= 2.0 * mu**2 / det
    hessian[:, range(1, x.shape[1]), range(1, x.shape[1])] += (2.0 / det)[:, None]
    slack = np.maximum(x[:, 0] + limits.tension, TINY)
    cut_off = (limits.cohesion > 0) | (mu == 0)
    hessian[:, 0, 0] += np.where(cut_off, slack**-2, 0.0)
    finite = np.isfinite(limits.compression)
    hessian[finite, 0, 0] += np.maximum(limits.compression[finite] - x[finite, 0], TINY) ** -2
    inverse = _inverse(hessian)
    inverse[shearless, 1:, :] = 0.0
    inverse[shearless, :, 1:] = 0.0
    return inverse


@np.errstate(over="ignore", invalid="ignore")
def velocity_hessian(friction: FloatArray, v: FloatArray) -> FloatArray:
    """Hessian of −log(v_N² − μ² ‖v_T‖²) at velocities strictly inside; −log v_N² where μ = 0.

    Not finite where squares of velocities are beyond the range of numbers.

    friction : (n,); v : (n, components)  opening positive; the Hessians are (n, components, components)
    """
    squared = friction**2
    det = np.maximum(v[:, 0] ** 2 - squared * (v[:, 1:] ** 2).sum(axis=1), TINY)
    hessian = _cone_hessian(np.column_stack([-v[:, 0], squared[:, None] * v[:, 1:]]), det)
    hessian[:, 0, 0] -= 2.0 / det
    hessian[:, range(1, v.shape[1]), range(1, v.shape[1])] += (2.0 * squared / det)[:, None]
    return hessian


def _cone_hessian(gradient: FloatArray, det: FloatArray) -> FloatArray:
    gradient = gradient * (2.0 / det)[:, None]
    return np.asarray(gradient[:, :, None] * gradient[:, None, :])


def _inverse(hessian: FloatArray) -> FloatArray:
    """Inverse of each block; scaled to unit diagonal, so that points with forces 1e-12 of the others keep accuracy."""
    size = 1.0 / np.sqrt(np.maximum(np.einsum("nii->ni", hessian), TINY))
    unit = hessian * size[:, :, None] * size[:, None, :] + 1e-14 * np.eye(hessian.shape[1])[None]
    return np.asarray(inverses(unit) * size[:, :, None] * size[:, None, :])


def roots(blocks: FloatArray) -> FloatArray:
    """L with L Lᵀ each block, (n, k, k), of its unit-diagonal eigenvectors."""
    size = np.sqrt(np.maximum(np.einsum("nii->ni", blocks), TINY))
    values, vectors = np.linalg.eigh(blocks / size[:, :, None] / size[:, None, :])
    return np.asarray(size[:, :, None] * vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :])
