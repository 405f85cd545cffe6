"""Faces without area although no two of their corners coincide: all lie on one line, as where a modeller split an
edge and filled the gap with a triangle of no width. The surface closes without them once the vertices on the longest
edge are taken into the face beyond it (``t_junctions``).
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray
from mbla.model.solids.measures import face_geometry
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import row_maxima

FLAT = 1e-6
"""width over the longest edge up to which a face is a line; coordinates in single precision leave some 1e-7"""


def flat_faces(polyhedra: Polyhedra) -> BoolArray:
    """Faces of no width, (n_faces,)."""
    local = polyhedra.local_vertices
    lengths = np.linalg.norm(local[polyhedra.next_loops] - local[polyhedra.loops], axis=1)
    longest = row_maxima(lengths, polyhedra.loop_start)
    return np.asarray(face_geometry(polyhedra).areas <= 0.5 * FLAT * longest**2)
