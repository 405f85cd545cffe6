"""Conditions of the convex contact model on resultants and motions, written a second time for verification.

Closed forms in place of the rows of the cone program. With N' = N + f_t A, m = (−M_2, M_1), V = μN + cA:

*Torsion.* R = μ N' w + (c − μ f_t) A, w the gauge of the reduced area; t = max(‖T‖ − V + R, 0), m = |M_n|/ρ.
The curve t² = (R' − m)(R' + (1 − θ) m) through (t, m) has the size

    R' = ½ [θ m + √(θ² m² + 4 (1 − θ) m² + 4 t²)]

and R' ≤ R is the condition. A motion with slip η, rotation ω and opening δ(x) = δ_0 + δ_1·x dissipates at most

    c' A P + f_t A δ_0,     P = max of η·T + ρ ω m over the curve of size 1,     c' = c − μ f_t

provided that δ(x) ≥ μ ‖η‖ + μ (P − ‖η‖) w(x) everywhere, that is at the corners of w's graph.

*Crushing*, from fields of stress, not from cones. A motion that closes the points of an interface by c(x) = −δ(x)
dissipates f_c ∫ max(c, 0), summed up over triangles in closed form. Forces N' and m are those of some field of stress
between 0 and f_c if, for every direction θ,

    m·θ ≤ first moment along θ of full stress over the part of area N'/f_c that lies farthest along θ

which is N' times its centroid. The direction in which that is closest is found from a coarse round of them by halving.
A block of full stress around the force point, the copy of the outline shrunk by s, proves most interfaces safe
beforehand: N' ≤ F (1 − s)².
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.resultants.shapes import (
    Fan,
    InterfaceShapes,
    corner_weights,
    interface_shapes,
    mean_positive,
    positive_share,
    second_moments,
)


@dataclass(frozen=True)
class InterfaceLaws:
    """Strengths of all interfaces in the deck's units, forces over the full area.

    shapes     : outlines, torsional radii
    friction   : (n,) μ
    cohesion   : (n,) cA
    tension    : (n,) f_t A
    strength   : (n,) (f_c + f_t) A, inf where unlimited
    torsional  : (n,) false where the interface has no shear strength at all
    crushable  : (n,) with a compressive strength
    """

    shapes: InterfaceShapes
    friction: FloatArray
    cohesion: FloatArray
    tension: FloatArray
    strength: FloatArray
    torsional: BoolArray
    crushable: BoolArray

    @property
    def own_cohesion(self) -> FloatArray:
        """The cohesion c' A = (c − μ f_t) A, (n,) [force]."""
        return np.asarray(self.cohesion - self.friction * self.tension)


def interface_laws(model: Model, contacts: Contacts, contact_model: str) -> InterfaceLaws:
    """Strengths of all interfaces; only the convex contact model limits their torsion."""
    laws = [model.joints[contacts.joint_names[joint]] for joint in contacts.joints]
    shapes, areas = interface_shapes(contacts), contacts.areas
    friction = np.array([law.friction for law in laws])
    cohesion = np.array([law.cohesion for law in laws]) * areas
    tension = np.array([law.tensile_strength for law in laws]) * areas
    strength = np.array([law.compressive_strength for law in laws]) * areas + tension
    return InterfaceLaws(
        shapes=shapes,
        friction=friction,
        cohesion=cohesion,
        tension=tension,
        strength=strength,
        torsional=(contact_model == "convex") & ((friction > 0) | (cohesion > 0)),
        crushable=np.isfinite(strength),
    )


def torsion_excess(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """R' − R of every interface, negative inside, (n,) [force]; interfaces without shear strength have none."""
    shear = np.hypot(resultants[:, 1], resultants[:, 2])
    twist = np.abs(resultants[:, 3]) / laws.shapes.radii
    total, share = shear_strength(laws, resultants)
    beyond = np.maximum(shear - np.maximum(total - share, 0.0), 0.0)
    theta = laws.shapes.thetas
    size = 0.5 * (theta * twist + np.sqrt((theta * twist) ** 2 + 4.0 * (1.0 - theta) * twist**2 + 4.0 * beyond**2))
    return np.where(laws.torsional, size - share, -np.inf)


def shear_strength(laws: InterfaceLaws, resultants: FloatArray) -> tuple[FloatArray, FloatArray]:
    """V and R of every interface, (n,) [force]."""
    total = laws.friction * resultants[:, 0] + laws.cohesion
    reduced = laws.friction * _reduced_normal(laws, resultants) + laws.own_cohesion
    return total, np.minimum(total, reduced)


def moment_of(resultants: FloatArray) -> FloatArray:
    """M = (−M_2, M_1): first moments of the normal stress along tangent 1 and tangent 2, (n, 2)."""
    return np.column_stack([-resultants[:, 5], resultants[:, 4]])


def _reduced_normal(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """N' w: the normal force over the reduced area, in terms of torsional radius, (n,)."""
    shapes, moment = laws.shapes, moment_of(resultants)
    normal = resultants[:, 0] + laws.tension
    offset = largest(shapes, (shapes.edge_slopes() * moment[shapes.interface_of_corner]).sum(axis=1))
    rho, gradient, _ = _rectangle_terms(shapes)
    arms = np.abs(np.einsum("nsj,nj->ns", shapes.axes, moment))
    of_rectangle = 2.0 / rho * (gradient * arms).sum(axis=1)
    return np.asarray(normal - np.where(shapes.rectangles, of_rectangle, offset))


def _rectangle_terms(shapes: InterfaceShapes) -> tuple[FloatArray, FloatArray, FloatArray]:
    """ρ (n,), gradient of ρ with respect to both sides (n, 2), and sides, of a unit square where it is no rectangle.

    The mean distance from the middle of a rectangle a × b with the diagonal d, and its derivative::

        12 ρ = 2 d + a²/b asinh(b/a) + b²/a asinh(a/b)
        12 ∂ρ/∂a = d/a + 2 a/b asinh(b/a) − b²/a² asinh(a/b)
    """
    sides = np.where(shapes.rectangles[:, None], shapes.sides, 1.0)
    other, diagonal = sides[:, ::-1], np.hypot(*sides.T)[:, None]
    along, across = sides / other * np.arcsinh(other / sides), other / sides * np.arcsinh(sides / other)
    rho = (2.0 * diagonal[:, 0] + sides[:, 0] * along[:, 0] + other[:, 0] * across[:, 0]) / 12.0
    gradient = (diagonal / sides + 2.0 * along - other / sides * across) / 12.0
    return rho, gradient, sides


def largest(shapes: InterfaceShapes, of_corner: FloatArray) -> FloatArray:
    """Largest value over the corners of each hull, (n,), of values at all corners, (n_corners,)."""
    if len(of_corner) == 0:
        return np.zeros(0)
    return np.asarray(np.maximum.reduceat(of_corner, shapes.start[:-1]))


def curve_support(slip: FloatArray, twist: FloatArray, theta: FloatArray) -> FloatArray:
    """P: greatest power of forces on the curve of size 1 with slip ‖η‖ and twist |ρω|, (n,)."""
    inner = (2.0 * twist) ** 2 + ((2.0 - theta) * slip) ** 2
    root = np.sqrt((theta * twist) ** 2 + (1.0 - theta) * inner)
    round_part = inner / np.maximum(2.0 * (theta * twist + root), 1e-300)
    return np.where(2.0 * twist <= theta * slip, slip, round_part)


def torsion_power(laws: InterfaceLaws, motions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What torsional motions of interfaces dissipate at most, (n,), and what opening they lack, (n,).

    motions : (n, 6) dual to the resultants. Normal forces N' add N' times the lack.
    """
    shapes = laws.shapes
    slip = np.hypot(motions[:, 1], motions[:, 2])
    support = curve_support(slip, np.abs(motions[:, 3]) * shapes.radii, shapes.thetas)
    more = support - slip
    rho, gradient, sides = _rectangle_terms(shapes)
    lack = laws.friction * support - motions[:, 0]  # at the centroid
    at_corner = laws.friction * slip - motions[:, 0] + largest(shapes, -tilt(shapes, motions))
    lack = np.maximum(lack, at_corner)
    for side in (0, 1):
        middle = np.abs(np.einsum("nj,nj->n", shapes.axes[:, side], opening_slope(motions))) * 0.5 * sides[:, side]
        left = 1.0 - gradient[:, side] * sides[:, side] / rho
        at_middle = laws.friction * (slip + more * left) - motions[:, 0] + middle
        lack = np.where(shapes.rectangles, np.maximum(lack, at_middle), lack)
    dissipated = laws.own_cohesion * support + laws.tension * motions[:, 0]
    return np.where(laws.torsional, dissipated, 0.0), np.where(laws.torsional, lack, np.abs(motions).max(axis=1))


def opening_slope(motions: FloatArray) -> FloatArray:
    """Gradient of the opening along tangent 1 and tangent 2, (n, 2)."""
    return np.column_stack([-motions[:, 5], motions[:, 4]])


def tilt(shapes: InterfaceShapes, motions: FloatArray) -> FloatArray:
    """Opening at the corners of the hulls by rotation alone, (n_corners,)."""
    return np.asarray((shapes.corners * opening_slope(motions)[shapes.interface_of_corner]).sum(axis=1))


ROUNDED, LEAST = 1e-3, 1e-6
"""Of the path of elastic joints, over V: what the rest V − R of the strength is rounded by, and the least R."""


def sliding_power(
    laws: InterfaceLaws, resultants: FloatArray, motions: FloatArray, *, rounded: bool = False
) -> FloatArray:
    """What slip and twist dissipate at given resultants where they do not dilate, (n,).

    rounded : by the law of the path of elastic joints: with √((V − R)² + (ε V)²) in the place of V − R
    """
    total, share = shear_strength(laws, resultants)
    if rounded:
        share = np.maximum(total - np.hypot(total - share, ROUNDED * total), LEAST * total)
    slip = np.hypot(motions[:, 1], motions[:, 2])
    support = curve_support(slip, np.abs(motions[:, 3]) * laws.shapes.radii, laws.shapes.thetas)
    return np.where(laws.torsional, np.maximum(share, 0.0) * support + np.maximum(total - share, 0.0) * slip, 0.0)


DIRECTIONS = 32
"""In the first round, around an outline whose radii of gyration are all one."""

BISECTIONS = 48
"""Of an interval in which the line that ends full stress lies, or a direction."""


def crushing_power(laws: InterfaceLaws, motions: FloatArray, most: float = np.inf) -> FloatArray:
    """What crushing motions of interfaces dissipate at most, (n,); inf where one that cannot crush closes.

    motions : (n, 6) dual to the resultants
    most    : normal force that no solution comes near, with which an interface closes at most where it closes most
    """
    shapes = laws.shapes
    closing = -motions[shapes.interface_of_corner, 0] - tilt(shapes, motions)
    fan = Fan.of(shapes)
    block = np.bincount(fan.interface, fan.share * mean_positive(closing[fan.corners]), len(motions))
    by_strength = np.where(laws.crushable, laws.strength, 0.0) * block
    if np.isfinite(most):
        by_strength = np.minimum(by_strength, (most + laws.tension) * np.maximum(largest(shapes, closing), 0.0))
    dissipated = by_strength + laws.tension * motions[:, 0]
    impossible = np.where(np.any(motions != 0, axis=1), np.inf, 0.0)
    return np.asarray(np.where(laws.crushable, dissipated, impossible))


NOT_PRESSED = 1e-14
"""Normal force, over moment by radius, in place of none and of tension, which no moment is carried with."""


def crushing_excess(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """By how much forces exceed every field of stress, negative inside, (n,) [force].

    Moments count over radii of gyration.
    """
    shapes, normal, moment = laws.shapes, resultants[:, 0] + laws.tension, moment_of(resultants)
    strength = np.where(laws.crushable, laws.strength, 1.0)
    shrunk = largest(shapes, (shapes.edge_slopes() * moment[shapes.interface_of_corner]).sum(axis=1))
    left = np.maximum(normal - shrunk, 0.0)  # N' (1 − s)
    of_copy = np.where(normal > 0.0, np.sqrt(np.maximum(normal, 0.0) ** 3 / strength) - left, shrunk - normal)
    found = np.where(laws.crushable, of_copy, -np.inf)
    rows = np.flatnonzero(found > 0.0)
    if len(rows):
        carried = np.linalg.norm(moment[rows], axis=1) / shapes.radii[rows]
        pressed = np.maximum(normal[rows], np.maximum(NOT_PRESSED * carried, np.finfo(np.float64).tiny))
        found[rows] = np.maximum(_exact_excess(shapes, rows, pressed, moment[rows], strength[rows]), -normal[rows])
    return found


def _exact_excess(
    shapes: InterfaceShapes, rows: IntArray, normal: FloatArray, moment: FloatArray, strength: FloatArray
) -> FloatArray:
    """The same for the given interfaces, all of them pressed, by the search over directions.

    Everything counts over the normal force: over the strength nothing would be left of it where that is far larger.
    """
    outlines = _Outlines.of(shapes, rows, normal / strength)
    wanted: FloatArray = np.linalg.solve(outlines.roots, (moment / normal[:, None])[..., None])[..., 0].astype(
        np.float64
    )
    angles = np.arange(DIRECTIONS) * (2.0 * np.pi / DIRECTIONS)
    beyond = np.stack([_beyond(outlines, wanted, np.full(len(rows), angle))[0] for angle in angles])
    middle = angles[beyond.argmax(axis=0)]
    lower, upper = middle - angles[1], middle + angles[1]
    for _ in range(BISECTIONS):
        middle = 0.5 * (lower + upper)
        rises = _beyond(outlines, wanted, middle)[1] > 0.0
        lower, upper = np.where(rises, middle, lower), np.where(rises, upper, middle)
    most = np.maximum(beyond.max(axis=0), _beyond(outlines, wanted, middle)[0])
    return np.asarray(np.maximum(normal * most, normal - strength))


def _beyond(outlines: _Outlines, wanted: FloatArray, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Moment along a direction beyond what full stress gives, over the normal force; its derivative by the angle."""
    along = np.column_stack([np.cos(angle), np.sin(angle)])
    across = np.column_stack([-along[:, 1], along[:, 0]])
    first = _middle_of_end(outlines, along)
    return ((wanted - first) * along).sum(axis=1), ((wanted - first) * across).sum(axis=1)


def _middle_of_end(outlines: _Outlines, along: FloatArray) -> FloatArray:
    """Centroid of the part of given area that lies farthest along a direction, (n, 2)."""
    fan = outlines.fan
    of_corner = (outlines.corners * along[outlines.owner]).sum(axis=1)
    n = len(along)
    lower, upper = np.full(n, np.inf), np.full(n, -np.inf)
    np.minimum.at(lower, outlines.owner, of_corner)
    np.maximum.at(upper, outlines.owner, of_corner)
    for _ in range(BISECTIONS):
        middle = 0.5 * (lower + upper)
        beyond = of_corner[fan.corners] - middle[fan.interface][:, None]
        area = np.bincount(fan.interface, fan.share * positive_share(beyond), n)
        more = area > outlines.part
        lower, upper = np.where(more, middle, lower), np.where(more, upper, middle)
    # ∫ x over the end = d/dθ ∫ max(x·θ − d, 0): from the mean of the positive part and how it changes with the corners.
    # The level below which it begins, of which there is always something beyond
    beyond = of_corner[fan.corners] - lower[fan.interface][:, None]
    weights = fan.share[:, None] * corner_weights(beyond)
    terms = weights[..., None] * outlines.corners[fan.corners]
    area = np.bincount(fan.interface, weights.sum(axis=1), n)
    return np.stack([np.bincount(fan.interface, terms[..., axis].sum(axis=1), n) / area for axis in (0, 1)], axis=1)


@dataclass(frozen=True)
class _Outlines:
    """Outlines of chosen interfaces in coordinates in which their second moments of area are those of a unit circle.

    corners : (n_corners, 2); owner : (n_corners,) row of the outline; part : (n,) share of the area under full stress
    roots   : (n, 2, 2) from these coordinates to those in the plane of the interface
    """

    corners: FloatArray
    owner: IntArray
    fan: Fan
    part: FloatArray
    roots: FloatArray

    @classmethod
    def of(cls, shapes: InterfaceShapes, rows: IntArray, part: FloatArray) -> _Outlines:
        """Of the interfaces ``rows``, (n,), with the share of the area under full stress, (n,), cut to 0 ... 1."""
        fan, place = Fan.of_some(shapes, rows), np.full(len(shapes.convex), -1)
        place[rows] = np.arange(len(rows))
        roots = np.asarray(np.linalg.cholesky(second_moments(shapes, rows)), dtype=np.float64)
        owner = place[shapes.interface_of_corner]
        inside = np.flatnonzero(owner >= 0)
        corners = np.zeros_like(shapes.corners)
        corners[inside] = np.linalg.solve(roots[owner[inside]], shapes.corners[inside][..., None])[..., 0]
        number = np.cumsum(owner >= 0) - 1
        fan = Fan(fan.interface, number[fan.corners], fan.share)
        return cls(corners[inside], owner[inside], fan, np.clip(part, 0.0, 1.0), roots)
