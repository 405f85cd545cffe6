r"""Shear and torsion that a uniformly pressed area carries together, and a safe description of it by a cone.

A rigid area A slides about a centre of rotation c. Friction opposes the motion with μσ at every point, σ = N/A, so
that with e = (x − c)/‖x − c‖ (all per μN, moments about the centroid, which is the origin)::

    ρ(c) = 1/A ∫ ‖x − c‖ dA        E(c) = 1/A ∫ e dA = −∇ρ        T = E turned by 90°        M = ρ(c) + c·E

All c together give the limit curve (limit surface of Goyal, Ruina and Papadopoulos 1991,
doi:10.1016/0043-1648(91)90104-3). Over a polygon both integrals are sums over edges: with h the distance of the edge
from c (positive inside), ν its outward normal, s along it, R = √(h² + s²)::

    I = ∫ R ds = ½ [s R + h² asinh(s/|h|)]        A ρ = Σ h I / 3        A E = Σ ν I   (up to sign)

*Safe curve.* With t = ‖T‖/(μN), m = |M|/(μN ρ)::

    t² ≤ (1 − m)(1 + (1 − θ) m),   0 ≤ m ≤ 1,   0 ≤ θ ≤ 1

is convex, a second-order cone for any θ, and exact in pure shear and in pure torsion. θ = 0 is the ellipse often used,
which is *outside* the limit curve of every shape tried: by 7 % for a square, 15 % for a slender rectangle. θ = 1 is the
limit curve of a line turned about points on it. Near pure torsion the limit curve is m = 1 − t²/(2 ρ κ), κ being the
least eigenvalue of the Hessian of ρ, and the safe curve m = 1 − t²/(2 − θ): hence θ = 2 − 2 ρ κ, for a rectangle
a × b, a ≥ b::

    θ = 2 − (4 ρ/b) asinh(b/a)                 0.651 for a square, 0.858 for 2 : 1, 0.989 for 10 : 1

With it the safe curve is inside the limit curve for rectangles of every aspect tried (1 to 100) without any shrinking.
Other outlines are not symmetric about a point: there ρ is the largest for which the curve stays inside, found from a
set of centres c. It falls short of the pure torsion that is possible by less than 1 % for trapezia, 3 % for a triangle
3 : 1, 8 % for 10 : 1.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.plane import signed_areas

DIRECTIONS = 24
RADII = np.concatenate([np.linspace(0.02, 1.0, 14), np.geomspace(1.3, 30.0, 8)])
"""Centres of rotation that a curve is fitted to: directions, and distances relative to the radius of the area."""

MARGIN = 2e-3
"""Taken off a fitted radius: the least over a finite set of centres is above the true one by less than this."""

WORTHWHILE = 0.99
"""The smallest θ is taken that costs at most 1 % of the pure torsion."""

ALIKE = 1e-9
"""Relative difference up to which edges count as equally long."""

SMALL_ARRAY = 2_000_000
"""Entries of an array of outlines × centres × edges that are worked on at once."""


def friction(outlines: FloatArray, centres: FloatArray) -> tuple[FloatArray, FloatArray]:
    """ρ(c) (n, k) and E(c) (n, k, 2) of polygons for centres of rotation.

    outlines : (n, m, 2) corners of n polygons, counter-clockwise
    centres  : (n, k, 2)
    """
    along = np.roll(outlines, -1, axis=1) - outlines
    length = np.hypot(along[..., 0], along[..., 1])
    along /= np.maximum(length, 1e-300)[..., None]
    normal = np.stack([along[..., 1], -along[..., 0]], axis=-1)
    arm = outlines[:, None] - centres[:, :, None]
    height = np.einsum("nkmj,nmj->nkm", arm, normal)
    start = np.einsum("nkmj,nmj->nkm", arm, along)
    integral = _primitive(start + length[:, None], height) - _primitive(start, height)
    area = signed_areas(outlines)[:, None]
    rho = (height * integral).sum(axis=2) / (3.0 * area)
    return rho, np.einsum("nkm,nmj->nkj", integral, normal) / area[..., None]


def rectangle_curve(sides: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """ρ (n,), θ (n,) and the gradient of ρ with respect to both sides (n, 2) of rectangles of the given sides."""
    a, b = sides[:, 0], sides[:, 1]
    diagonal = np.hypot(a, b)
    across_a = 0.25 * (b * diagonal + a**2 * np.arcsinh(b / a))  # ∫ R ds over a side of length b
    across_b = 0.25 * (a * diagonal + b**2 * np.arcsinh(a / b))
    rho = (a * across_a + b * across_b) / (3.0 * a * b)
    gradient = np.column_stack([(across_a - rho * b) / (a * b), (across_b - rho * a) / (a * b)])
    long, short = np.maximum(a, b), np.minimum(a, b)
    theta = 2.0 - 4.0 * rho / short * np.arcsinh(short / long)
    return rho, np.clip(theta, 0.0, 1.0), gradient


def fitted_curves(outlines: FloatArray) -> tuple[FloatArray, FloatArray]:
    """ρ (n,) and θ (n,) of safe curves of polygons about their centroids.

    outlines : (n, m, 2) corners relative to the centroid, counter-clockwise
    """
    n, m, _ = outlines.shape
    outlines = _along_longest_edge(outlines)
    at_once = max(1, SMALL_ARRAY // (m * DIRECTIONS * len(RADII)))
    parts = [_fitted(outlines[first : first + at_once]) for first in range(0, n, at_once)]
    return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])


def safe_torsion(shear: FloatArray, theta: FloatArray) -> FloatArray:
    """M on the safe curve at a given t, both over their greatest values; arrays of shapes that fit each other."""
    room = np.maximum(1.0 - shear**2, 0.0)
    return np.asarray(2.0 * room / np.maximum(theta + np.sqrt(theta**2 + 4.0 * (1.0 - theta) * room), 1e-300))


def centres_of_rotation(outlines: FloatArray) -> FloatArray:
    """Centres that cover the limit curves, (n, k, 2)."""
    angle = 2.0 * np.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
    star = (RADII[:, None, None] * np.column_stack([np.cos(angle), np.sin(angle)])).reshape(-1, 2)
    size = np.hypot(outlines[..., 0], outlines[..., 1]).max(axis=1)
    return np.asarray(size[:, None, None] * np.vstack([np.zeros(2), star]))


def _along_longest_edge(outlines: FloatArray) -> FloatArray:
    """Outlines turned so that their longest edge is along the first axis: fits must not depend on the frame."""
    edges = np.roll(outlines, -1, axis=1) - outlines
    lengths = np.hypot(edges[..., 0], edges[..., 1])
    longest = (lengths >= (1.0 - ALIKE) * lengths.max(axis=1, keepdims=True)).argmax(axis=1)
    rows = np.arange(len(outlines))
    first = edges[rows, longest] / lengths[rows, longest, None]
    second = np.stack([-first[:, 1], first[:, 0]], axis=1)
    return np.asarray(np.stack([(outlines * axis[:, None]).sum(axis=2) for axis in (first, second)], axis=2))


def _fitted(outlines: FloatArray) -> tuple[FloatArray, FloatArray]:
    centres = centres_of_rotation(outlines)
    rho, mean = friction(outlines, centres)
    shear = np.hypot(mean[..., 0], mean[..., 1])
    torsion = rho + (centres * mean).sum(axis=2)

    def radius(theta: FloatArray) -> FloatArray:
        safe = safe_torsion(shear, theta[:, None])
        ratio = np.where(safe > 1e-6, torsion / np.maximum(safe, 1e-6), np.inf)
        return np.asarray(ratio.min(axis=1) * (1.0 - MARGIN))

    one = np.ones(len(outlines))
    sharpest = np.clip(2.0 - 2.0 * rho[:, 0] * _least_curvature(outlines), 0.0, 1.0)
    best_theta, best = one, radius(one)
    for share in (2.0 / 3.0, 1.0 / 3.0, 0.0):
        theta = sharpest + share * (1.0 - sharpest)
        found = radius(theta)
        good = found >= WORTHWHILE * radius(one)
        best_theta, best = np.where(good, theta, best_theta), np.where(good, found, best)
    return best, best_theta


def _least_curvature(outlines: FloatArray) -> FloatArray:
    """Least eigenvalue of the Hessian of ρ at the centroid, (n,), by central differences of its gradient −E."""
    step = 1e-4 * np.hypot(outlines[..., 0], outlines[..., 1]).max(axis=1)
    ends = step[:, None, None] * np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    mean = friction(outlines, ends)[1]
    hessian = -np.stack([mean[:, 0] - mean[:, 1], mean[:, 2] - mean[:, 3]], axis=1) / (2.0 * step[:, None, None])
    return np.asarray(np.linalg.eigvalsh(0.5 * (hessian + hessian.transpose(0, 2, 1)))[:, 0])


def _primitive(s: FloatArray, height: FloatArray) -> FloatArray:
    """½ [s R + h² asinh(s/|h|)], whose second term vanishes with h."""
    return np.asarray(0.5 * (s * np.hypot(s, height) + height**2 * np.arcsinh(s / np.maximum(np.abs(height), 1e-150))))


def disc_radius(area: FloatArray) -> FloatArray:
    """ρ of the disc of equal area: no area of any shape, with holes or without, has a smaller one."""
    return np.asarray(2.0 / 3.0 * np.sqrt(area / np.pi))
