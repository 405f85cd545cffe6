"""Conditions of the convex contact model on resultants and motions, written a second time for verification.

Closed forms in place of the rows of the cone program. With N' = N + f_t A, m = (−M_2, M_1), V = μN + cA:

*Torsion.* R = μ N' w + (c − μ f_t) A, w the gauge of what is left of the area; t = max(‖T‖ − V + R, 0), m = |M_n|/ρ.
The curve t² = (R' − m)(R' + (1 − θ) m) through (t, m) has the size

    R' = ½ [θ m + √(θ² m² + 4 (1 − θ) m² + 4 t²)]

and R' ≤ R is the condition. A motion with slip η, rotation ω and opening δ(x) = δ_0 + δ_1·x dissipates at most

    c' A P + f_t A δ_0,     P = max of η·T + ρ ω m over the curve of size 1,     c' = c − μ f_t

provided that δ(x) ≥ μ ‖η‖ + μ (P − ‖η‖) w(x) everywhere, that is at the corners of w's graph.

*Crushing.* N'³ ≤ F Q_1 Q_2, or F Q²; a motion with opening δ(x) dissipates F max of X Y (Ω − αX − βY) over 0 ≤ X, Y ≤ 1
for a rectangle, F max of (1 − s)² (s h − δ_0) over 0 ≤ s ≤ 1 for other outlines, h = max of −δ_1·x over the outline.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.convex.friction_curve import rectangle_curve
from mbla.program.convex.shapes import InterfaceShapes, interface_shapes


@dataclass(frozen=True)
class InterfaceLaws:
    """Strengths of all interfaces in the deck's units, forces over the whole area.

    shapes     : outlines, torsional radii
    friction   : (n,) μ
    cohesion   : (n,) cA
    tension    : (n,) f_t A
    strength   : (n,) (f_c + f_t) A, inf where unlimited
    torsional  : (n,) false where the interface has no shear strength at all
    crushable  : (n,) with a stress block
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
        """C' A = (c − μ f_t) A."""
        return np.asarray(self.cohesion - self.friction * self.tension)


def interface_laws(model: Model, contacts: Contacts) -> InterfaceLaws:
    """Strengths of all interfaces."""
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
        torsional=(friction > 0) | (cohesion > 0),
        crushable=np.isfinite(strength) & shapes.convex,
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


def _reduced_normal(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """N' w: the normal force over what is left of the area, in terms of torsional radius, (n,)."""
    shapes, moment = laws.shapes, np.column_stack([-resultants[:, 5], resultants[:, 4]])
    normal = resultants[:, 0] + laws.tension
    offset = _largest(shapes, (shapes.edge_slopes() * moment[shapes.interface_of_corner]).sum(axis=1))
    rho, gradient, _ = _rectangle_terms(shapes)
    arms = np.abs(np.einsum("nsj,nj->ns", shapes.axes, moment))
    of_rectangle = 2.0 / rho * (gradient * arms).sum(axis=1)
    return np.asarray(normal - np.where(shapes.rectangles, of_rectangle, offset))


def _rectangle_terms(shapes: InterfaceShapes) -> tuple[FloatArray, FloatArray, FloatArray]:
    """ρ, gradient of ρ and sides, of a unit square where the interface is no rectangle."""
    sides = np.where(shapes.rectangles[:, None], shapes.sides, 1.0)
    rho, _, gradient = rectangle_curve(sides)
    return rho, gradient, sides


def _largest(shapes: InterfaceShapes, of_corner: FloatArray) -> FloatArray:
    """Largest value over the corners of each hull."""
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
    at_corner = laws.friction * slip - motions[:, 0] + _largest(shapes, -_tilt(shapes, motions))
    lack = np.maximum(lack, at_corner)
    for side in (0, 1):
        middle = np.abs(np.einsum("nj,nj->n", shapes.axes[:, side], _slope(motions))) * 0.5 * sides[:, side]
        left = 1.0 - gradient[:, side] * sides[:, side] / rho
        at_middle = laws.friction * (slip + more * left) - motions[:, 0] + middle
        lack = np.where(shapes.rectangles, np.maximum(lack, at_middle), lack)
    dissipated = laws.own_cohesion * support + laws.tension * motions[:, 0]
    return np.where(laws.torsional, dissipated, 0.0), np.where(laws.torsional, lack, np.abs(motions).max(axis=1))


def _slope(motions: FloatArray) -> FloatArray:
    """Gradient of the opening along tangent 1 and tangent 2, (n, 2)."""
    return np.column_stack([-motions[:, 5], motions[:, 4]])


def _tilt(shapes: InterfaceShapes, motions: FloatArray) -> FloatArray:
    """Opening at the corners of the hulls by rotation alone, (n_corners,)."""
    return np.asarray((shapes.corners * _slope(motions)[shapes.interface_of_corner]).sum(axis=1))


def sliding_power(laws: InterfaceLaws, resultants: FloatArray, motions: FloatArray) -> FloatArray:
    """What slip and twist dissipate at given resultants where they do not dilate, (n,)."""
    total, share = shear_strength(laws, resultants)
    slip = np.hypot(motions[:, 1], motions[:, 2])
    support = curve_support(slip, np.abs(motions[:, 3]) * laws.shapes.radii, laws.shapes.thetas)
    return np.where(laws.torsional, np.maximum(share, 0.0) * support + np.maximum(total - share, 0.0) * slip, 0.0)


def crushing_excess(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """What the force over the area left, Q, lacks for N'³ = F Q_1 Q_2, negative inside, (n,) [force]."""
    shapes, moment = laws.shapes, np.column_stack([-resultants[:, 5], resultants[:, 4]])
    normal = resultants[:, 0] + laws.tension
    needed = np.sqrt(np.maximum(normal, 0.0) ** 3 / np.where(laws.crushable, laws.strength, 1.0))
    left = normal - _largest(shapes, (shapes.edge_slopes() * moment[shapes.interface_of_corner]).sum(axis=1))
    sides = np.where(shapes.rectangles[:, None], shapes.sides, 1.0)
    q = normal[:, None] - 2.0 * np.abs(np.einsum("nsj,nj->ns", shapes.axes, moment)) / sides
    lack = 0.5 * (np.hypot(q[:, 0] - q[:, 1], 2.0 * needed) - q.sum(axis=1))
    return np.where(laws.crushable, np.where(shapes.rectangles, lack, needed - left), -np.inf)


def crushing_power(laws: InterfaceLaws, motions: FloatArray) -> FloatArray:
    """What crushing motions of interfaces, (n, 6), dissipate, (n,)."""
    shapes, closing, slope = laws.shapes, -motions[:, 0], -_slope(motions)
    sides = np.where(shapes.rectangles[:, None], shapes.sides, 1.0)
    arms = 0.5 * sides * np.abs(np.einsum("nsj,nj->ns", shapes.axes, slope))
    of_rectangle = _largest_block(closing + arms.sum(axis=1), arms[:, 0], arms[:, 1])
    reach = np.maximum(_largest(shapes, -_tilt(shapes, motions)), 0.0)
    s = np.clip((reach - 2.0 * closing) / np.maximum(3.0 * reach, 1e-300), 0.0, 1.0)
    of_other = np.maximum((1.0 - s) ** 2 * (closing + s * reach), 0.0)
    block = np.where(shapes.rectangles, of_rectangle, of_other)
    strength = np.where(laws.crushable, laws.strength, 0.0)
    dissipated = strength * block + laws.tension * motions[:, 0]
    impossible = np.where(np.any(motions != 0, axis=1), np.inf, 0.0)
    return np.asarray(np.where(laws.crushable, dissipated, impossible))


def _largest_block(total: FloatArray, alpha: FloatArray, beta: FloatArray) -> FloatArray:
    """Max of X Y (Ω − αX − βY) over 0 ≤ X, Y ≤ 1: inside, on one of the sides 1, or at the corner."""

    def value(x: FloatArray, y: FloatArray) -> FloatArray:
        return np.asarray(x * y * (total - alpha * x - beta * y))

    def ratio(part: FloatArray, whole: FloatArray) -> FloatArray:
        return np.asarray(np.clip(part / np.maximum(whole, 1e-300), 0.0, 1.0))

    one = np.ones_like(total)
    inside = value(ratio(total, 3.0 * alpha), ratio(total, 3.0 * beta))
    on_x, on_y = value(one, ratio(total - alpha, 2.0 * beta)), value(ratio(total - beta, 2.0 * alpha), one)
    return np.asarray(np.maximum.reduce([inside, on_x, on_y, np.zeros_like(total)]))
