"""Blocks as arrays: the polyhedra of the whole model in flat, ragged form."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray, row_of_item
from mbla.model.labels import BlockLabels


@dataclass(frozen=True)
class Blocks:
    """Closed polyhedra, faces outwards.

    vertices         : (n_vertices, 3) m; blocks share none
    vertex_start     : (n_blocks + 1,)  vertices of block b are vertices[vertex_start[b]:vertex_start[b + 1]]
    loops            : (n_corners,)     vertex (row of ``vertices``) at each corner of each face, counter-clockwise
                       seen from outside
    loop_start       : (n_faces + 1,)   corners of face f are loops[loop_start[f]:loop_start[f + 1]]
    face_start       : (n_blocks + 1,)  faces of block b are face_start[b] ... face_start[b + 1] - 1
    facet_of_face    : (n_faces,)       faces of one block that lie on one plane and share edges carry one number;
                       numbered from 0 over the whole model, in order of blocks
    face_normals     : (n_faces, 3)     unit, outward
    convex           : (n_blocks,)      true where every vertex lies behind every face
    volumes          : (n_blocks,) m3
    centroids        : (n_blocks, 3) m
    densities        : (n_blocks,) kg/m3
    added_masses     : (n_blocks,) kg, what blocks carry along beside their own mass
    added_mass_points : (n_blocks, 3) m, its centroid; that of the block where there is none
    groups           : group of each block
    group_indices    : (n_blocks,)      position of the block in its group, from 0
    labels           : members and positions within the group
    (units: those of the deck; m, kg stand for them)
    """

    vertices: FloatArray
    vertex_start: IntArray
    loops: IntArray
    loop_start: IntArray
    face_start: IntArray
    facet_of_face: IntArray
    face_normals: FloatArray
    convex: np.typing.NDArray[np.bool_]
    volumes: FloatArray
    centroids: FloatArray
    densities: FloatArray
    added_masses: FloatArray
    added_mass_points: FloatArray
    groups: tuple[str, ...]
    group_indices: IntArray
    labels: BlockLabels

    def __len__(self) -> int:
        return len(self.volumes)

    def name(self, block: int) -> str:
        """``facade[12]``: group and index, as selectors write it."""
        return f"{self.groups[block]}[{self.group_indices[block]}]"

    @cached_property
    def sizes(self) -> FloatArray:
        """Block size to which tolerances are relative: cube root of the volume, (n_blocks,) m."""
        return np.cbrt(self.volumes)

    @cached_property
    def masses(self) -> FloatArray:
        """Own and added mass, (n_blocks,) kg."""
        return self.volumes * self.densities + self.added_masses

    @cached_property
    def block_of_vertex(self) -> IntArray:
        """(n_vertices,)."""
        return row_of_item(self.vertex_start)

    @cached_property
    def block_of_face(self) -> IntArray:
        """(n_faces,)."""
        return row_of_item(self.face_start)
