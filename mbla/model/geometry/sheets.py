"""Sheets: polyhedra that are no solids but open surfaces, and the flat outlines that they consist of.

Modellers draw the ground as one face among the blocks, exports list such a face once for each of its sides, and split
it into triangles. A terrain is a sheet of many flat parts.
"""

from __future__ import annotations

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray
from mbla.errors import Refusal
from mbla.model.geometry.repeated_faces import face_codes
from mbla.model.geometry.welding import take_faces, weld
from mbla.model.solids.facets import can_be_split, find_facets, split_faces
from mbla.model.solids.measures import face_geometry, faces_to_turn, find_edges, volumes_and_centroids
from mbla.model.solids.plane import plane_axes, unit
from mbla.model.solids.polyhedra import Polyhedra, turn_faces
from mbla.model.solids.ragged import row_ranges

FLAT = 0.02
"""greatest thickness of a sheet, over the diagonal of its box, that counts as one flat face"""
CLOSED = 1e-9
"""volume over the cube of the diagonal up to which a closed surface encloses nothing: a face and its back"""
LOST = 1e-6
"""difference of the area of faces and of their union, relative, that is rounding of files"""


ROUNDING = 1e-5
"""distance from a plane over the size of a face up to which it is flat: far less than the tolerance of contacts, which
is that of blocks, and these may be far smaller than the surface they stand on"""


class NotFlatError(Refusal):
    """A face of a sheet that is neither flat nor can be split into triangles."""


def sheets(polyhedra: Polyhedra) -> tuple[BoolArray, BoolArray]:
    """Which polyhedra enclose nothing, and which of these are one flat face, (n,) each."""
    count = len(polyhedra)
    welded = weld(polyhedra).polyhedra
    lone = np.unique(welded.block_of_face[welded.face_of_corner[welded.faces_at_edge == 1]])
    start = polyhedra.vertex_start
    local = polyhedra.local_vertices
    diagonals = np.linalg.norm(np.subtract(*row_ranges(local, start)), axis=1)
    volumes = volumes_and_centroids(polyhedra)[0]
    found = np.zeros(count, dtype=bool)
    found[lone] = True
    found |= np.abs(volumes) <= CLOSED * diagonals**3
    flat = found.copy()
    for row in np.flatnonzero(found).tolist():
        points = local[start[row] : start[row + 1]]
        flat[row] = np.ptp(points @ fitted_plane(points)[1]) <= FLAT * diagonals[row]
    return found, flat


def fitted_plane(points: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Middle of points (n, 3), unit normal of the plane fitted to them, and their least extent in it over the most."""
    middle = points.mean(axis=0)
    _, extents, axes = np.linalg.svd(points - middle, full_matrices=False)
    return middle, axes[2], float(extents[1] / extents[0]) if extents[0] > 0.0 else 0.0


def flat_outlines(sheet: Polyhedra, tolerance: float) -> list[FloatArray]:
    """Outlines of the flat parts of one sheet, corners (n, 3) each, exactly plane.

    tolerance : distance of corners from a plane, over the size of a face, that one may have which is not convex

    Faces that lie in one plane and share edges are one part, where that has no hole. Faces that are not flat are taken
    as triangles.

    Raises NotFlatError for a face that is neither convex nor flat.
    """
    sheet = weld(sheet).polyhedra
    once = np.zeros(len(sheet.block_of_face), dtype=bool)
    once[np.unique(face_codes(sheet, oriented=False), return_index=True)[1]] = True
    sheet = take_faces(sheet, once & (face_geometry(sheet).areas > 0.0))
    faces = face_geometry(sheet)
    sizes = np.sqrt(faces.areas)
    bent = np.flatnonzero(faces.deviations > ROUNDING * sizes)
    if len(bent):
        convex = can_be_split(sheet, faces, bent)
        refused = bent[~convex & (faces.deviations[bent] > tolerance * sizes[bent])]
        bent = bent[convex]
        if len(refused):
            wrong = int(refused[0])
            words = f"its face {wrong} is not flat: corners leave its plane by {faces.deviations[wrong]:.3g}"
            raise NotFlatError("surface-unfit", words)
    if len(bent):
        sheet, _ = split_faces(sheet, faces, bent, np.full(len(bent), -1))
    sheet = turn_faces(sheet, faces_to_turn(sheet, find_edges(sheet))[0])
    faces = face_geometry(sheet)
    allowed = np.array([ROUNDING * float(np.sqrt(np.median(faces.areas)))]) if len(faces.areas) else np.zeros(1)
    part = find_facets(sheet, find_edges(sheet), faces, allowed)
    return [outline for number in range(int(part.max(initial=-1)) + 1) for outline in _united(sheet, part == number)]


def _united(sheet: Polyhedra, chosen: BoolArray) -> list[FloatArray]:
    """Outline of faces in one plane; each by itself where together they have a hole."""
    rows = np.flatnonzero(chosen)
    loops = [sheet.vertices[sheet.loop(face)] for face in rows.tolist()]
    if len(loops) > 1:
        faces = face_geometry(sheet)
        normal = unit((faces.areas[rows, None] * faces.normals[rows]).sum(axis=0))
        middle = np.concatenate(loops).mean(axis=0)
        axes = plane_axes(normal[None])[0]
        each = shapely.make_valid([shapely.Polygon((loop - middle) @ axes.T) for loop in loops])
        union = shapely.union_all(each)
        area = shapely.area(each).sum()
        one = isinstance(union, shapely.Polygon) and not union.interiors
        if one and abs(union.area - area) <= LOST * area:
            return [shapely.get_coordinates(union.exterior)[:-1] @ axes + middle]
    return [flattened(loop) for loop in loops]


def flattened(corners: FloatArray) -> FloatArray:
    """Corners (n, 3) moved into the plane fitted to them."""
    middle, normal, _ = fitted_plane(corners)
    return np.asarray(corners - ((corners - middle) @ normal)[:, None] * normal)
