r"""Exact derivatives of what a planar scene is made of by its points, at a given mechanism.

With the rotation :math:`ω = ω_l − ω_r` of one side of an edge against the other, an end at x has

.. math:: ∂s = (j/ℓ) n·(∂x_2 − ∂x_1) − ω n·∂x, \quad ∂j = −(s/ℓ) n·(∂x_2 − ∂x_1) + ω t·∂x, \quad ∂ℓ = t·(∂x_2 − ∂x_1),

x being the first or the second point, :math:`x_1` or :math:`x_2`. The area of a cell has the derivative
:math:`-R (x_{k+1} − x_{k+2}) / 2` by its corner k.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import areas_of
from mbla.soil_mesh.planar_program import Mechanism
from mbla.soil_mesh.planar_scene import EdgeLines, PlanarScene, edge_lines, turned
from mbla.soil_mesh.strips import strip_power_gradient


@dataclass(frozen=True)
class PointDerivatives:
    """Derivatives by the coordinates x, y of point after point, (2 n_points,), motions, p and d being kept.

    slips, openings : (2 n_edges, 2 n_points) of s and j at ends
    cost            : (2 n_points,) of what the program minimises
    live_power      : (2 n_points,)
    """

    slips: sp.csr_array
    openings: sp.csr_array
    cost: FloatArray
    live_power: FloatArray


@dataclass(frozen=True)
class Jumps:
    """Slip and opening at both ends of edges, (n_edges, 2), and the turn ω of their left sides against the right."""

    slips: FloatArray
    openings: FloatArray
    turns: FloatArray


def jumps_at(scene: PlanarScene, lines: EdgeLines, motions: FloatArray) -> Jumps:
    """Jumps of bodies with motions u, ω, (n_bodies, 3)."""
    moving = np.vstack([motions, np.zeros((1, 3))])[scene.sides]  # the last row is that of NOTHING
    centres = np.vstack([scene.centres, np.zeros((1, 2))])[scene.sides]
    arms = turned(lines.ends[:, :, None] - centres[:, None])
    velocities = moving[:, None, :, :2] + moving[:, None, :, 2:] * arms
    jump = velocities[:, :, 0] - velocities[:, :, 1]
    return Jumps(
        np.einsum("ekx,ex->ek", jump, lines.tangents),
        np.einsum("ekx,ex->ek", jump, lines.normals),
        moving[:, 0, 2] - moving[:, 1, 2],
    )


def derivatives_at(scene: PlanarScene, points: FloatArray, mechanism: Mechanism) -> PointDerivatives:
    """Derivatives at points, (n_points, 2)."""
    lines = edge_lines(scene, points)
    jumps = jumps_at(scene, lines, mechanism.motions)
    n, t, turns = lines.normals[:, None, None], lines.tangents[:, None, None], jumps.turns[:, None, None, None]
    towards = np.array([-1.0, 1.0])[None, None, :, None]  # of the first and of the second point
    own = np.eye(2)[None, :, :, None]  # the point that is the end itself
    by_length = lines.lengths[:, None, None, None]
    slips = towards * jumps.openings[:, :, None, None] / by_length * n - own * turns * n  # edge, end, point, coordinate
    openings = -towards * jumps.slips[:, :, None, None] / by_length * n + own * turns * t
    dead, live = _power_derivatives(scene, points, mechanism.motions)
    per_length = _cost_per_length(scene, mechanism, jumps)
    cost = per_length[:, None, None] * towards[:, 0] * lines.tangents[:, None]
    cost = cost + (scene.tension * lines.lengths / 2.0)[:, None, None] * openings.sum(axis=1)
    gradient = np.zeros_like(points)
    np.add.at(gradient, scene.edges, cost)
    return PointDerivatives(
        _by_points(scene, slips, points.size), _by_points(scene, openings, points.size), gradient.ravel() - dead, live
    )


def _cost_per_length(scene: PlanarScene, mechanism: Mechanism, jumps: Jumps) -> FloatArray:
    """What edges cost over their lengths, (n_edges,)."""
    tension = scene.tension
    crush = np.where(np.isfinite(scene.compressive_strength), scene.compressive_strength + tension, 0.0)
    costs = ((scene.cohesion - tension * scene.friction), tension, crush)
    parts = (mechanism.slips, jumps.openings, mechanism.overlaps)
    return sum((cost * part.mean(axis=1) for cost, part in zip(costs, parts, strict=True)), np.zeros(len(tension)))


def _by_points(scene: PlanarScene, values: FloatArray, n: int) -> sp.csr_array:
    """Values of edge, end, point of the edge and coordinate, (n_edges, 2, 2, 2), as a matrix, (2 n_edges, n)."""
    columns = 2 * scene.edges[:, None, :, None] + np.arange(2)
    rows = np.arange(2 * len(scene.edges)).reshape(-1, 2, 1, 1)
    places = tuple(np.broadcast_to(each, values.shape).ravel() for each in (rows, columns))
    return sp.csr_array((values.ravel(), places), shape=(2 * len(scene.edges), n))


def area_derivatives(triangles: IntArray, points: FloatArray) -> sp.csr_array:
    """Of the areas of triangles by the coordinates of the points, (n_triangles, 2 n_points)."""
    columns = (2 * triangles[:, :, None] + np.arange(2)).ravel()
    rows = np.repeat(np.arange(len(triangles)), 6)
    values = _by_corner(points[triangles]).ravel()
    return sp.csr_array((values, (rows, columns)), shape=(len(triangles), points.size))


def _by_corner(corners: FloatArray) -> FloatArray:
    """Derivatives of the areas of triangles by their corners, (n, 3, 2)."""
    return -turned(np.roll(corners, -1, axis=1) - np.roll(corners, -2, axis=1)) / 2.0


def _power_derivatives(scene: PlanarScene, points: FloatArray, motions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Of the powers of dead and live densities and strips, (2 n_points,)."""
    n, corners = len(scene.triangles), points[scene.triangles]
    areas, middle = areas_of(scene.triangles, points), corners.mean(axis=1)
    velocity = motions[:n, :2] + motions[:n, 2:] * turned(middle - scene.centres[:n])
    by_area = _by_corner(corners)
    found = []
    for density, strips in ((scene.dead_density, scene.dead_strips), (scene.live_density, scene.live_strips)):
        gradient = strip_power_gradient(scene, points, strips, motions)
        by_middle = (areas * motions[:n, 2] / 3.0)[:, None] * -turned(density)
        own = (velocity * density).sum(axis=1)[:, None, None] * by_area + by_middle[:, None]
        np.add.at(gradient, scene.triangles, own)
        found.append(gradient.ravel())
    return found[0], found[1]
