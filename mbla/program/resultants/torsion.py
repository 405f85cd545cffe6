"""Torsion of interfaces, with shear and with the area that an eccentric force leaves.

Dry friction, N at the point p of the interface, first moments m = N p = (−M_2, M_1). A uniform pressure around p covers
the homothetic copy of a convex outline by 1 − s, s being the gauge of p (0 at the centroid, 1 on the outline), or of a
rectangle a × b the rectangle a − 2|p_1| by b − 2|p_2|. Its torsional radius ρ' is at least ρ w, with w linear in m::

    w = min over edges e of (1 − s_e·p)
    polygon: s_e = ν_e/d_e      rectangle: s_e = (2/ρ)(± ∂ρ/∂a, ± ∂ρ/∂b)

the first exactly, the second because ρ(a, b) is convex and homogeneous of degree 1, so that its tangent lies below it.
The shear strength V = μN + cA is divided: the share that acts as over the full area, R ≤ μ N w + cA, carries torsion
and shear by the safe curve of :mod:`mbla.program.resultants.friction_curve`; the rest carries shear alone::

    (T − T', M_n) within the safe curve of R        ‖T'‖ ≤ V − R

that is, with t = max(‖T‖ − V + R, 0) and m = |M_n|/ρ:  t² ≤ (R − m)(R + (1 − θ) m), m ≤ R.

Why this form: a planar hinge slides with all of V while its force point is on an edge, and a central joint follows the
curve; this is the smallest convex set that holds both. Convexity has its price. A force V at a corner of the interface,
at right angles to its arm, has more moment about the centroid than the condition allows (0.707 against 0.383 for a
square), though a single point in contact would carry it; were these forces admitted, all convex combinations of them
would be, and those are the contact forces at the corners that overstate torsion. The points at the corners stay in the
program with their own cones: they hold the force point inside the outline, and shear to where the pressure is.

How good it is, against uniform pressure around the force point, for rectangles 1 : 1, 2 : 1 and 5 : 1 with the force
point up to three quarters of the way to the outline (in brackets: contact forces at the corners alone):

- torsion without shear: 0.87 to 1.00 of it, exact where the force is central (1.85 to 2.6 times);
- shear and torsion together, central force: 0.85 to 1.00 of it in any direction (1.00 to 1.96 times);
- eccentric force, shear and torsion in any combination: at a quarter of the way 0.77 to 1.39 of it, half-way 0.51 to
  1.90, at three quarters 0.25 to 2.1 (up to 2.36, 2.98 and 2.8 times). Shear towards or away from the force point is
  exact.

As rows: σ is the multiplier of V and R together, η the slip, k± torsion in both senses, ζ and γ what the reduced area
adds: multipliers z_e ≥ 0 of the conditions R ≤ μ N (1 − s_e·p) + cA enter by ζ = Σ z_e and γ = Σ z_e s_e alone, and
exist where ζ ≥ γ·q for all corners q of the polar polygon of the s_e: those of the outline, or for a rectangle the four
points (± ρ/(2 ∂ρ/∂a), 0), (0, ± ρ/(2 ∂ρ/∂b)).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.solids.ragged import next_item
from mbla.program.resultants.conditions import M1, M2, MN, T1, T2, ConditionRows, N, Triplets
from mbla.program.resultants.friction_curve import rectangle_curve
from mbla.program.resultants.shapes import InterfaceShapes

UNKNOWNS = 8
"""Of an interface: η_1, η_2, σ, k+, k−, ζ, γ_1, γ_2."""


@dataclass(frozen=True)
class TorsionLimits:
    """Interfaces with friction or cohesion, and what bounds their torsion.

    interfaces : (n,) rows of the contacts
    friction   : (n,)
    cohesion   : (n,) cA [force]
    radii      : (n,) ρ [m]
    thetas     : (n,) θ
    corners    : (n_corners, 2) q_k [m], interface by interface, counter-clockwise
    start      : (n + 1,) first corner of each
    """

    interfaces: IntArray
    friction: FloatArray
    cohesion: FloatArray
    radii: FloatArray
    thetas: FloatArray
    corners: FloatArray
    start: IntArray

    def only(self, chosen: BoolArray) -> TorsionLimits:
        """Those of some of the interfaces, (n,)."""
        counts = np.diff(self.start)
        of_each = {
            name: getattr(self, name)[chosen] for name in ("interfaces", "friction", "cohesion", "radii", "thetas")
        }
        return TorsionLimits(**of_each, corners=self.corners[np.repeat(chosen, counts)], start=starts(counts[chosen]))


def torsion_limits(shapes: InterfaceShapes, friction: FloatArray, cohesion: FloatArray) -> TorsionLimits:
    """Limits of all interfaces that have shear strength; friction and cohesion are (n_interfaces,)."""
    chosen = (friction > 0) | (cohesion > 0)
    corners = shapes.corners.copy()
    rectangular = np.flatnonzero(shapes.rectangles)
    if len(rectangular):
        rho, _, gradient = rectangle_curve(shapes.sides[rectangular])
        reach = (0.5 * rho[:, None] / gradient)[:, :, None] * shapes.axes[rectangular]
        rows = shapes.start[rectangular][:, None] + np.arange(4)
        corners[rows] = np.concatenate([reach, -reach], axis=1)
    return TorsionLimits(
        interfaces=np.flatnonzero(chosen),
        friction=friction[chosen],
        cohesion=cohesion[chosen],
        radii=shapes.radii[chosen],
        thetas=shapes.thetas[chosen],
        corners=corners[chosen[shapes.interface_of_corner]],
        start=starts(np.diff(shapes.start)[chosen]),
    )


def torsion_rows(limits: TorsionLimits, n_interfaces: int) -> ConditionRows:
    """The condition of all interfaces in the form of the cone program."""
    n = len(limits.interfaces)
    column = UNKNOWNS * np.arange(n)
    cost = np.zeros(UNKNOWNS * n)
    cost[column + 2] = limits.cohesion
    motion, row = Triplets.none(), 6 * limits.interfaces
    motion.add(row + N, column + 2, limits.friction)
    motion.add(row + T1, column, 1.0)
    motion.add(row + T2, column + 1, 1.0)
    motion.add(row + MN, column + 3, 1.0 / limits.radii)
    motion.add(row + MN, column + 4, -1.0 / limits.radii)
    motion.add(row + M1, column + 7, -limits.friction)
    motion.add(row + M2, column + 6, limits.friction)
    cones, sizes = _cones(limits, column)
    shape = (int(sizes.sum()), UNKNOWNS * n)
    return ConditionRows(motion.matrix((6 * n_interfaces, UNKNOWNS * n)), cost, cones.matrix(shape), sizes)


def _cones(limits: TorsionLimits, column: IntArray) -> tuple[Triplets, IntArray]:
    """k± ≥ 0 and ζ ≥ γ·q;  (σ, η, (θσ − 2 (k+ + k−))/(2 − θ)) and (σ − ζ, η) in second-order cones."""
    n, n_corners, theta = len(column), len(limits.corners), limits.thetas
    owner = np.repeat(column, np.diff(limits.start))
    cones = Triplets.none()
    twist = (column[:, None] + np.array([3, 4])).ravel()
    cones.add(np.arange(2 * n), twist, 1.0)
    corner = 2 * n + np.arange(n_corners)
    cones.add(corner, owner + 5, 1.0)
    for axis in (0, 1):
        cones.add(corner, owner + 6 + axis, -limits.corners[:, axis])
    curve = 2 * n + n_corners + 4 * np.arange(n)
    rest = 6 * n + n_corners + 3 * np.arange(n)
    for first in (curve, rest):
        cones.add(first, column + 2, 1.0)
        cones.add(first + 1, column, 1.0)
        cones.add(first + 2, column + 1, 1.0)
    cones.add(rest, column + 5, -1.0)
    cones.add(curve + 3, column + 2, theta / (2.0 - theta))
    for sense in (3, 4):
        cones.add(curve + 3, column + sense, -2.0 / (2.0 - theta))
    sizes = np.concatenate([np.ones(2 * n + n_corners), np.full(n, 4), np.full(n, 3)]).astype(np.int64)
    return cones, sizes


def reducing_slopes(limits: TorsionLimits) -> FloatArray:
    """S of the edge that leaves each corner q: s·q = 1 at both ends."""
    q = limits.corners
    after = q[next_item(limits.start)]
    det = q[:, 0] * after[:, 1] - q[:, 1] * after[:, 0]
    return np.asarray(np.column_stack([after[:, 1] - q[:, 1], q[:, 0] - after[:, 0]]) / det[:, None])
