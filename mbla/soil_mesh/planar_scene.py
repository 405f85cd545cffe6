r"""Rigid bodies in a plane that slip and open along straight edges; the first of them are triangular cells of soil.

Body b moves with velocity :math:`v(x) = u_b + ω_b R (x − x_b)` about a fixed centre x_b, R a quarter turn to the left.
An edge of length ℓ leads from its first point to its second, t is its unit tangent and n = R t its normal, towards the
body on its left. At each of its two ends the bodies slip and open by

.. math:: s = t · (v_l − v_r), \quad j = n · (v_l − v_r).

With associative flow, cohesion c, friction μ, tensile strength f_t ≤ c/μ and compressive strength f_c the load factor
is

.. math:: λ = \min \; \sum_{ends} \frac{ℓ}{2} [c p + f_t (j − μ p + d) + f_c d] − P_D
          \quad subject\ to \quad P_L = 1, \quad p ≥ |s|, \quad j − μ p + d ≥ 0, \quad d ≥ 0,

P_D and P_L the powers of dead and live loads. It is a linear program, and all of it depends on the points x.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray

NOTHING = -1
"""body of an edge's side that does not move"""


@dataclass(frozen=True)
class PlanarScene:
    """Bodies and edges, in any units that fit each other; strengths are forces per length, of the whole width.

    triangles            : (n_cells, 3) points of the cells, counter-clockwise; they are the first bodies
    edges                : (n_edges, 2) points
    sides                : (n_edges, 2) body on the left and on the right, ``NOTHING`` for what does not move
    friction             : (n_edges,) coefficient
    cohesion             : (n_edges,)
    tensile_strength     : (n_edges,) what is above c/μ counts as that
    compressive_strength : (n_edges,) inf where unlimited
    centres              : (n_bodies, 2) points that bodies turn about
    ways                 : (3 n_bodies, n_ways) motions u, ω of the bodies that unknowns stand for: a unit matrix where
                           none is guided
    dead, live           : (n_bodies, 3) forces and moments about centres, whatever the points
    dead_density, live_density : (n_cells, 2) forces per area of cells, besides
    tops                 : (n_tops, 2) points, from left to right, of edges of the outline that strips may press on
    under                : (n_tops,) cells below
    dead_strips, live_strips : (n, 4) strips of the top: where each begins and ends along the first axis, and its force
                           per length along that, besides
    """

    triangles: IntArray
    edges: IntArray
    sides: IntArray
    friction: FloatArray
    cohesion: FloatArray
    tensile_strength: FloatArray
    compressive_strength: FloatArray
    centres: FloatArray
    ways: sp.csr_array
    dead: FloatArray
    live: FloatArray
    dead_density: FloatArray
    live_density: FloatArray
    tops: IntArray = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    under: IntArray = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    dead_strips: FloatArray = field(default_factory=lambda: np.empty((0, 4)))
    live_strips: FloatArray = field(default_factory=lambda: np.empty((0, 4)))

    @property
    def loaded(self) -> bool:
        """Whether there is a live load."""
        return bool(self.live.any() or self.live_density.any() or self.live_strips.any())

    @property
    def tension(self) -> FloatArray:
        """Tensile strength, at most at the apex of the cone of friction, (n_edges,)."""
        apex = np.divide(self.cohesion, self.friction, out=np.full(len(self.edges), np.inf), where=self.friction > 0.0)
        return np.asarray(np.minimum(self.tensile_strength, apex))


@dataclass(frozen=True)
class EdgeLines:
    """Edges at given points: ends (n_edges, 2, 2), lengths (n_edges,), unit tangents and normals (n_edges, 2)."""

    ends: FloatArray
    lengths: FloatArray
    tangents: FloatArray
    normals: FloatArray


def edge_lines(scene: PlanarScene, points: FloatArray) -> EdgeLines:
    """Edges of a scene whose points, (n_points, 2), are given."""
    ends = points[scene.edges]
    along = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(along, axis=1)
    tangents = along / lengths[:, None]
    return EdgeLines(ends, lengths, tangents, turned(tangents))


def turned(vectors: FloatArray) -> FloatArray:
    """Vectors, (..., 2), a quarter turn to the left."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def cross(one: FloatArray, other: FloatArray) -> FloatArray:
    """Component of the cross product across the plane, (...), of vectors (..., 2)."""
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
