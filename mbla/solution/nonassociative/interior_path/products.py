"""How a change acts on the products of the path at every contact, and the price of a change.

The products of one contact are p_N = (N + f_t) y, p_d = (f_c − N) d, p_s = l s + T·w and the vector l w + s T. With
weights that rise with a product above its target σ, a change z of the contact costs::

    ½ Σ weight (relative change of the product − what is wanted)² + ½ δ ‖z‖²

Wanted: σ − p over p for a product above its target, ln(σ/p), at most a factor e, for one below; none of the vector.
‖z‖ is the local norm of the cones (second derivative of −ln of their determinant; Nesterov and Todd 1997,
doi:10.1287/moor.22.1.1): relative changes, of the distance to the boundary too. The changes of s and d concern one
contact alone and are eliminated here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path.central_path import CentralPath, PathVector

HEAVIEST = 100.0
"""Ratio of product to target beyond which its weight no longer grows."""

NEAREST = 1e-14
"""Least relative distance from the boundary of a cone that is told from rounding."""


@dataclass(frozen=True)
class Products:
    """The products at a point: normal, crushing, slip_size, and the length of the vector, (n_points,).

    crushing and the slip products are zero where the contact has none
    """

    normal: FloatArray
    crushing: FloatArray
    slip_size: FloatArray
    vector: FloatArray

    def largest(self) -> float:
        """The largest of all products."""
        return max(float(part.max(initial=0.0)) for part in (self.normal, self.crushing, self.slip_size, self.vector))


@dataclass(frozen=True)
class LocalCost:
    """½ zᵀH z + G·z at every contact for z = (dx, dq), and the way back to the eliminated changes.

    hessian  : (n_points, 2 components, 2 components)
    gradient : (n_points, 2 components)
    held     : (n_points, components) force components that cannot change
    size_row, size_gradient : ds = −(size_row·z + size_gradient)
    crushing_row, crushing_gradient : dd likewise, with ds appended to z
    """

    hessian: FloatArray
    gradient: FloatArray
    held: np.typing.NDArray[np.bool_]
    size_row: FloatArray
    size_gradient: FloatArray
    crushing_row: FloatArray
    crushing_gradient: FloatArray


def products_at(path: CentralPath, point: PathVector) -> Products:
    """All products at a point."""
    to_opening, to_crushing, strength = path.margins(point.forces)
    shear = point.forces[:, 1:]
    size = strength * point.slip_size + (shear * point.slip).sum(axis=1)
    vector = strength[:, None] * point.slip + point.slip_size[:, None] * shear
    return Products(
        normal=to_opening * point.opening,
        crushing=np.where(path.crushable, to_crushing * point.crushing, 0.0),
        slip_size=np.where(path.frictional, size, 0.0),
        vector=np.where(path.frictional, np.linalg.norm(vector, axis=1), 0.0),
    )


def local_cost(path: CentralPath, point: PathVector, target: float, damping: float) -> LocalCost:
    """Cost of changes towards products equal to ``target``, with damping δ."""
    c, n = path.program.components, path.program.n_points
    size, crush = 2 * c, 2 * c + 1  # places of ds and dd behind dx and dq = (dy − dd, dw)
    hessian, gradient = np.zeros((n, 2 * c + 2, 2 * c + 2)), np.zeros((n, 2 * c + 2))
    to_opening = path.margins(point.forces)[0]
    row = np.zeros((n, 2 * c + 2))
    row[:, 0], row[:, c], row[:, crush] = 1.0 / to_opening, 1.0 / point.opening, 1.0 / point.opening
    _add_product(hessian, gradient, row, to_opening * point.opening, target)
    hessian[:, 0, 0] += damping / to_opening**2
    slack = np.zeros(2 * c + 2)
    slack[[c, crush]] = 1.0
    hessian += (damping / point.opening**2)[:, None, None] * np.outer(slack, slack)
    _add_crushing(path, point, hessian, gradient, target, damping)
    hessian[~path.crushable, crush, :] = hessian[~path.crushable, :, crush] = 0.0
    hessian[~path.crushable, crush, crush] = 1.0
    gradient[~path.crushable, crush] = 0.0
    _add_cones(path, point, hessian, gradient, target, damping)
    hessian, gradient, crushing_row, crushing_gradient = _eliminated(hessian, gradient, crush)
    hessian, gradient, size_row, size_gradient = _eliminated(hessian, gradient, size)
    held = np.zeros((n, c), dtype=bool)
    held[~path.frictional, 1:] = True
    return LocalCost(hessian, gradient, held, size_row, size_gradient, crushing_row, crushing_gradient)


def _wanted(product: FloatArray, target: float) -> FloatArray:
    """Relative change of a product that is too much, with the sign of a residual."""
    above = 1.0 - target / product
    return np.where(product > target, above, np.clip(np.log(product / target), -1.0, 0.0))


def _weight(product: FloatArray, target: float) -> FloatArray:
    return np.clip(product / target, 1.0, HEAVIEST)


def _add_product(
    hessian: FloatArray, gradient: FloatArray, row: FloatArray, product: FloatArray, target: float
) -> None:
    weight = _weight(product, target) ** 2
    hessian += weight[:, None, None] * row[:, :, None] * row[:, None, :]
    gradient += (weight * _wanted(product, target))[:, None] * row


def _add_crushing(
    path: CentralPath, point: PathVector, hessian: FloatArray, gradient: FloatArray, target: float, damping: float
) -> None:
    here = np.flatnonzero(path.crushable)
    if not len(here):
        return
    _, to_crushing, _ = path.margins(point.forces)
    gap, slack = to_crushing[here], point.crushing[here]
    row = np.zeros((len(here), hessian.shape[1]))
    row[:, 0], row[:, -1] = -1.0 / gap, 1.0 / slack
    some, slope = np.zeros((len(here), *hessian.shape[1:])), np.zeros((len(here), hessian.shape[1]))
    _add_product(some, slope, row, gap * slack, target)
    some[:, 0, 0] += damping / gap**2
    some[:, -1, -1] += damping / slack**2
    hessian[here] += some
    gradient[here] += slope


def _add_cones(
    path: CentralPath, point: PathVector, hessian: FloatArray, gradient: FloatArray, target: float, damping: float
) -> None:
    """Products of the two cones, and the local norms of both; nothing at points without friction."""
    c, here = path.program.components, np.flatnonzero(path.frictional)
    size = 2 * c
    _, _, strength = path.margins(point.forces)
    length, slip, scale = strength[here], point.slip[here], point.slip_size[here]
    shear, friction = point.forces[here, 1:], path.program.limits.friction[here]
    product = length * scale + (shear * slip).sum(axis=1)
    vector = length[:, None] * slip + scale[:, None] * shear
    rows = np.zeros((len(here), c, 2 * c + 2))
    rows[:, 0, 0], rows[:, 0, 1:c], rows[:, 0, c + 1 : size], rows[:, 0, size] = friction * scale, slip, shear, length
    rows[:, 1:, 0], rows[:, 1:, size] = friction[:, None] * slip, shear
    diagonal = np.arange(c - 1)
    rows[:, 1 + diagonal, 1 + diagonal] = scale[:, None]
    rows[:, 1 + diagonal, c + 1 + diagonal] = length[:, None]
    extent = np.maximum(product, np.linalg.norm(vector, axis=1))
    rows[:, 0] *= (_weight(product, target) / product)[:, None]
    rows[:, 1:] *= (_weight(extent, target) / extent)[:, None, None]
    first = _weight(product, target) * _wanted(product, target)
    left = np.column_stack([first, vector * (_weight(extent, target) / extent)[:, None]])
    some = rows.transpose(0, 2, 1) @ rows
    force_part = damping * _local_norm(length, shear)
    force_part[:, 0, :] *= friction[:, None]
    force_part[:, :, 0] *= friction[:, None]
    some[:, :c, :c] += force_part
    places = np.concatenate([[size], np.arange(c + 1, size)])
    some[:, places[:, None], places[None, :]] += damping * _local_norm(scale, slip)
    hessian[here] += some
    gradient[here] += np.einsum("kij,ki->kj", rows, left)
    hessian[~path.frictional, size, size] = 1.0


def _local_norm(size: FloatArray, part: FloatArray) -> FloatArray:
    """Second derivative of −½ ln(size² − ‖part‖²), (n, components, components)."""
    length = np.linalg.norm(part, axis=1)
    determinant = np.maximum(size - length, NEAREST * size) * (size + length)
    mirrored = np.column_stack([size, -part]) / determinant[:, None]
    signature = np.diag(np.append(1.0, -np.ones(part.shape[1])))
    return np.asarray(2.0 * mirrored[:, :, None] * mirrored[:, None, :] - signature / determinant[:, None, None])


def _eliminated(
    hessian: FloatArray, gradient: FloatArray, last: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The cost without its last variable, at place ``last``, and row and offset that give it back."""
    pivot = hessian[:, last, last]
    row, offset = hessian[:, last, :last] / pivot[:, None], gradient[:, last] / pivot
    reduced = hessian[:, :last, :last] - row[:, :, None] * hessian[:, last, None, :last]
    return reduced, gradient[:, :last] - row * gradient[:, last, None], row, offset
