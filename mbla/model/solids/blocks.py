"""Blocks as arrays: the polyhedra of the entire model in flat, ragged form.

Labels say where in its group a block lies: the member of a composite item, and counted positions such as the course.
A generator knows them, selectors ask for them (``{group: facade, course: 3}``), and results list them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts, summed
from mbla.deck.kinds.positions import NONE
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import items_of_rows, row_ranges


@dataclass(frozen=True)
class Blocks(Polyhedra):
    """Closed polyhedra, faces outwards.

    vertices         : (n_vertices, 3) m; blocks share none
    vertex_start     : (n_blocks + 1,)  vertices of block b are vertices[vertex_start[b]:vertex_start[b + 1]]
    loops            : (n_corners,)     vertex (row of ``vertices``) at each corner of each face, counter-clockwise
                       seen from outside
    loop_start       : (n_faces + 1,)   corners of face f are loops[loop_start[f]:loop_start[f + 1]]
    face_start       : (n_blocks + 1,)  faces of block b are face_start[b] ... face_start[b + 1] - 1
    facet_of_face    : (n_faces,)       faces of one block that lie on one plane and share edges carry one number;
                       numbered from 0 over the entire model, in order of blocks
    face_normals     : (n_faces, 3)     unit, outward
    convex           : (n_blocks,)      true where every vertex lies behind every face
    volumes          : (n_blocks,) m3
    centroids        : (n_blocks, 3) m
    densities        : (n_blocks,) kg/m3
    added_masses     : (n_blocks,) kg, what blocks carry in addition to their own mass
    added_mass_points : (n_blocks, 3) m, its centroid; that of the block where there is none
    groups           : group of each block
    group_indices    : (n_blocks,)      position of the block in its group, from 0
    labels           : members and positions within the group
    strengths        : (n_blocks, 2) Pa, tensile and compressive strength of the material, inf where none is given;
                       None where none is given of any
    (units: those of the deck; m, kg stand for them)
    """

    facet_of_face: IntArray
    face_normals: FloatArray
    convex: BoolArray
    volumes: FloatArray
    centroids: FloatArray
    densities: FloatArray
    added_masses: FloatArray
    added_mass_points: FloatArray
    groups: tuple[str, ...]
    group_indices: IntArray
    labels: BlockLabels
    strengths: FloatArray | None = None

    def name(self, block: int) -> str:
        """``facade[12]``: group and index, as selectors write it."""
        return f"{self.groups[block]}[{self.group_indices[block]}]"

    @cached_property
    def sizes(self) -> FloatArray:
        """Block size to which tolerances are relative: cube root of the volume, (n_blocks,) m."""
        return np.cbrt(self.volumes)

    @cached_property
    def boxes(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest coordinates of each block, (n_blocks, 3) m."""
        return row_ranges(self.vertices, self.vertex_start)

    def corners_of(self, faces: IntArray) -> tuple[FloatArray, IntArray]:
        """Corners of faces (n,), one after the other, (m, 3), and where those of each start, (n + 1,)."""
        rows = items_of_rows(self.loop_start, faces)
        return self.vertices[self.loops[rows]], starts(np.diff(self.loop_start)[faces])

    @cached_property
    def masses(self) -> FloatArray:
        """Own and added mass, (n_blocks,) kg."""
        return self.volumes * self.densities + self.added_masses

    @cached_property
    def mass_centres(self) -> FloatArray:
        """Centroids of own and added mass, (n_blocks, 3) m; of the volume where there is no mass."""
        share = self.added_masses / np.where(self.masses > 0.0, self.masses, 1.0)
        return self.centroids + share[:, None] * (self.added_mass_points - self.centroids)


@dataclass(frozen=True)
class BlockLabels:
    """Labels of n blocks.

    members   : name of the part of a composite item that a block belongs to, such as "lintel"; empty where none
    positions : (n, len(POSITIONS)) from 0; -1 where the generator gives none of that name
    """

    members: tuple[str, ...]
    positions: IntArray

    def position(self, name: str) -> IntArray:
        """(n,) of the positions of that name."""
        return np.asarray(self.positions[:, POSITIONS.index(name)])


def labels_of(
    count: int, member: str | Sequence[str] = "", positions: Mapping[str, IntArray] = MappingProxyType({})
) -> BlockLabels:
    """Labels of the blocks of one part of an item.

    member    : of all blocks, or of each, (count)
    positions : (count,) by name
    """
    columns = np.full((count, len(POSITIONS)), NONE, dtype=np.int64)
    for name, values in positions.items():
        columns[:, POSITIONS.index(name)] = values
    return BlockLabels((member,) * count if isinstance(member, str) else tuple(member), columns)


def join_labels(parts: Sequence[BlockLabels]) -> BlockLabels:
    """Labels of the blocks of several parts, in order."""
    positions = [labels_of(0).positions, *(part.positions for part in parts)]
    return BlockLabels(tuple(member for part in parts for member in part.members), np.concatenate(positions))


def carried_masses(
    centroids: FloatArray, rows: IntArray, masses: FloatArray, points: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Sums (n_blocks,) of masses (m,) at points (m, 3) that the blocks ``rows`` (m,) carry, and their centroids.

    centroids : (n_blocks, 3) of the blocks, that of the mass where a block carries none
    """
    total = summed(rows, masses, len(centroids))
    moments = summed(rows, masses[:, None] * (points - centroids[rows]), len(centroids))
    return total, centroids + moments / np.where(total > 0.0, total, 1.0)[:, None]


@dataclass(frozen=True)
class PointMasses:
    """Masses that blocks carry, each by itself.

    blocks : (m,); masses : (m,) kg; points : (m, 3) m
    """

    blocks: IntArray
    masses: FloatArray
    points: FloatArray

    def added_to(self, blocks: Blocks) -> Blocks:
        """The blocks with them as all that they carry."""
        total, centres = carried_masses(blocks.centroids, self.blocks, self.masses, self.points)
        return replace(blocks, added_masses=total, added_mass_points=centres)


NO_MASSES = PointMasses(np.empty(0, dtype=np.int64), np.empty(0), np.empty((0, 3)))


def joined_masses(parts: Iterable[PointMasses]) -> PointMasses:
    """All of them."""
    every = [NO_MASSES, *parts]
    return PointMasses(
        np.concatenate([part.blocks for part in every]),
        np.concatenate([part.masses for part in every]),
        np.concatenate([part.points for part in every]),
    )
