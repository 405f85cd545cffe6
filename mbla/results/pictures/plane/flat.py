"""Whether a case can be told in a plane figure, and how the plane is looked at.

It can where every block is a prism across one horizontal direction, no block lies behind another, and whatever moves,
loads and is loaded stays in the plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import Scene

ALONG = 1e-3
"""sine of the angle up to which a face or a motion lies in the plane: geometry from files has coordinates of three
decimals"""
BEHIND = 1e-2
"""share of a block's outline that may be covered by another: blocks may overlap by the tolerance of contacts"""


@dataclass(frozen=True)
class Flat:
    """The plane of a figure.

    towards : (3,) unit, horizontal, from the structure to the eye
    faces   : (n,) faces of blocks that are seen
    """

    towards: FloatArray
    faces: IntArray

    @property
    def right(self) -> FloatArray:
        """(3,) unit, to the right of the page; up is z."""
        return np.asarray(np.cross([0.0, 0.0, 1.0], self.towards))

    def project(self, points: FloatArray) -> FloatArray:
        """Points, or vectors, on the page, (n, 2) from (n, 3)."""
        return np.column_stack([points @ self.right, points[:, 2]])


def flat_of(scene: Scene, options: PictureOptions, kind: str = "mechanism") -> Flat | None:
    """The plane in which a case can be drawn; None where it needs a picture in space or the view asks for one.

    A model is drawn in the plane of its loads where there is one, and else in any.
    """
    in_plane = [normal for normal in _directions(scene.model.blocks) if _in_plane(scene, normal)]
    others = [normal for normal in _directions(scene.model.blocks) if kind == "model"]
    for normal in (*in_plane, *others):
        eye = _eye(normal, options)
        if eye is None or not _prisms(scene.model, scene.contacts, normal):
            continue
        faces = np.flatnonzero(scene.model.blocks.face_normals @ eye > 1 - ALONG)
        if not _one_behind_another(scene.model.blocks, Flat(eye, faces)):
            return Flat(eye, faces)
    return None


def _directions(blocks: Blocks) -> list[FloatArray]:
    """Horizontal normals of the faces of the first block, each once; the direction of the least extent first."""
    normals = blocks.face_normals[blocks.block_of_face == 0]
    normals = normals[np.abs(normals[:, 2]) <= ALONG]
    kept: list[FloatArray] = []
    for normal in normals:
        if all(np.abs(other @ normal) < 1 - ALONG for other in kept):
            kept.append(normal)
    return sorted(kept, key=lambda normal: float(np.ptp(blocks.vertices @ normal)))


def _eye(normal: FloatArray, options: PictureOptions) -> FloatArray | None:
    """Unit vector to the eye along a normal; from -y or from +x unless the view says the other side."""
    normal = np.array([normal[0], normal[1], 0.0]) / np.hypot(normal[0], normal[1])
    if options.view is None:
        usual = -normal[1] if abs(normal[1]) >= abs(normal[0]) else normal[0]
        return np.asarray(normal if usual > 0 else -normal)
    azimuth, elevation = np.deg2rad(options.view)
    eye = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    along = float(eye @ normal)
    return None if abs(along) < 1 - ALONG**2 else normal * np.sign(along)


def _prisms(model: Model, contacts: Contacts, normal: FloatArray) -> bool:
    """Every face of blocks along or across the direction; joints and grounds seen edge-on."""
    across = np.abs(model.blocks.face_normals @ normal)
    joints = np.abs(contacts.normals @ normal)
    grounds = [abs(float(ground.normal @ normal)) for ground in model.grounds]
    return bool(np.all((across <= ALONG) | (across >= 1 - ALONG)) and np.all(joints <= ALONG)) and all(
        value <= ALONG for value in grounds
    )


def _in_plane(scene: Scene, normal: FloatArray) -> bool:
    """Loads and motion leave nothing across the plane."""
    case = scene.case.load_case
    motion = scene.mechanics.mechanism if scene.mechanics is not None else scene.case.solution.certificate
    size = float(scene.model.blocks.sizes.max())
    vectors = [case.live_load[scene.model.free], case.dead_load[scene.model.free]]
    vectors += [] if motion is None else [motion]
    for rows in vectors:
        first, second = rows[:, :3], rows[:, 3:]
        # moments are forces times length, rotations velocities over length
        arm = size if rows is motion else 1 / size
        largest = max(np.abs(first).max(initial=0.0), arm * np.abs(second).max(initial=0.0))
        out_of_plane = second - (second @ normal)[:, None] * normal
        if max(np.abs(first @ normal).max(initial=0.0), arm * np.abs(out_of_plane).max(initial=0.0)) > ALONG * largest:
            return False
    return True


def _one_behind_another(blocks: Blocks, flat: Flat) -> bool:
    outlines = [shapely.Polygon(polygon) for polygon in face_polygons(blocks, flat, blocks.vertices)]
    owner = blocks.block_of_face[flat.faces]
    first, second = shapely.STRtree(outlines).query(outlines, predicate="overlaps")
    within, around = shapely.STRtree(outlines).query(outlines, predicate="within")
    first, second = np.concatenate([first, within]), np.concatenate([second, around])
    other = owner[first] != owner[second]
    pairs = np.array(outlines, dtype=object)
    common = shapely.area(shapely.intersection(pairs[first[other]], pairs[second[other]]))
    return bool(np.any(common > BEHIND * shapely.area(pairs[first[other]])))


def face_polygons(blocks: Blocks, flat: Flat, vertices: FloatArray) -> list[FloatArray]:
    """Outlines of the faces that are seen, on the page, (n, 2) each."""
    page = flat.project(vertices)
    return [page[blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]] for face in flat.faces]


def seen_edges(blocks: Blocks, flat: Flat, edges: IntArray) -> IntArray:
    """Edges that bound the faces that are seen, (n, 2) vertices."""
    corner_face = blocks.face_of_corner
    front = np.zeros(len(blocks.vertices), dtype=bool)
    front[blocks.loops[np.isin(corner_face, flat.faces)]] = True
    return edges[front[edges].all(axis=1)]


def joint_ends(contacts: Contacts, flat: Flat) -> IntArray:
    """The farthest contact points of each interface along its trace on the page, rows of points (n_interfaces, 2)."""
    owner = contacts.interface_of_point
    trace = np.cross(contacts.normals, flat.towards)
    place = np.einsum("ij,ij->i", contacts.points - contacts.centroids[owner], trace[owner])
    order = np.lexsort((place, owner))
    return np.column_stack([order[contacts.point_start[:-1]], order[contacts.point_start[1:] - 1]])
