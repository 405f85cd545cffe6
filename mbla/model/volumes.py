"""Volume and centroid of polyhedra, convex or not.

A closed polyhedron with outward faces is the sum of signed tetrahedra from an origin o of its own to the triangles
(c_f, p_i, p_{i+1}) of each face f, with c_f the mean of its corners:

    V = 1/6 sum c_f . (p_i x p_{i+1}),      x = o + 1/(4 V) sum V_i (c_f + p_i + p_{i+1}),

exact for planar faces. Fans about the face's own centre do not depend on which corner is listed first, so that faces
that are not quite planar have one volume, too.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.polyhedra import Polyhedra
from mbla.model.ragged import row_means, row_sums


def volumes_and_centroids(polyhedra: Polyhedra) -> tuple[FloatArray, FloatArray]:
    """Signed volumes (n,), positive where faces point outwards, and centroids (n, 3) in global coordinates.

    Faces must be oriented consistently. Where the volume is zero the centroid is the mean of the vertices.
    """
    local = polyhedra.local_vertices
    tails, heads = local[polyhedra.loops], local[polyhedra.next_loops]
    centres = row_means(tails, polyhedra.loop_start)[polyhedra.face_of_corner]
    tetrahedra = np.einsum("ij,ij->i", centres, np.cross(tails, heads)) / 6
    moments = tetrahedra[:, None] * (centres + tails + heads) / 4
    corner_start = polyhedra.loop_start[polyhedra.face_start]
    volumes = row_sums(tetrahedra, corner_start)
    means = row_means(local, polyhedra.vertex_start)
    centroids = np.divide(row_sums(moments, corner_start), volumes[:, None], out=means, where=volumes[:, None] != 0)
    return volumes, polyhedra.origins + centroids
