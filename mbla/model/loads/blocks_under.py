"""Which block lies under a point, or under each part of a line or of a rectangle.

One looks from the point in a direction: the block is the one that the point lies in, or else the first one ahead.
As blocks do not overlap, that is the block of the first face ahead through which the direction leads *out*, so that
points on a top face and points inside a block need no case of their own.
Faces are outlines in the plane across the direction; a line there crosses their edges where what lies under it changes,
and a rectangle is divided by them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import plane_axes, unit
from mbla.model.solids.polygons import Polygons, polygons_from_loops
from mbla.model.solids.ragged import items_of_rows
from mbla.process.late import shapely

GRAZING = 1e-9
"""cosine between a face's normal and the direction, below which the direction runs along the face"""
BEHIND = 1e-6
"""a point may lie behind the outer side of a block by this share of the block's size and still be taken to lie on it"""

OVERLAY = 1e-12
"""share of the sides of a rectangle to which the edges that divide it are rounded"""


@dataclass(frozen=True)
class Below:
    """Some blocks, seen in a direction.

    towards : (3,) that one looks in; chosen : (n,) blocks
    """

    blocks: Blocks
    towards: FloatArray
    chosen: IntArray

    @cached_property
    def down(self) -> FloatArray:
        """Unit direction, (3,)."""
        return unit(self.towards)

    @cached_property
    def hair(self) -> float:
        """Distance that decides nothing but on which side of a joint a point lies; refused blocks have no size."""
        sizes = self.blocks.sizes[self.chosen]
        return BEHIND * float(sizes[sizes > 0].min(initial=1e300))

    def flat(self, points: FloatArray) -> FloatArray:
        """Points in the plane across the direction, (n, 2)."""
        return np.asarray(points @ plane_axes(self.down[None])[0].T)

    @cached_property
    def faces(self) -> IntArray:
        """Faces that the direction does not run along, (n_faces,)."""
        faces = items_of_rows(self.blocks.face_start, self.chosen)
        return faces[np.abs(self.blocks.face_normals[faces] @ self.down) > GRAZING]

    @cached_property
    def outlines(self) -> Polygons:
        """Of these faces, (n_faces,)."""
        corners, start = self.blocks.corners_of(self.faces)
        return polygons_from_loops(self.flat(corners), start)

    @cached_property
    def tree(self) -> Any:
        """To search these outlines."""
        return shapely.STRtree(self.outlines)

    def under(self, points: FloatArray) -> IntArray:
        """The block under each point (n, 3), -1 where there is none."""
        places, near_by = shapely.points(self.flat(points)), {"predicate": "dwithin", "distance": self.hair / 2}
        row, hit = self.tree.query(places, **near_by)
        face = self.faces[hit]
        owner, normals = self.blocks.block_of_face[face], self.blocks.face_normals[face]
        leads = normals @ self.down
        first = self.blocks.vertices[self.blocks.loops[self.blocks.loop_start[face]]]
        away = np.einsum("ij,ij->i", first - points[row], normals) / leads
        out = np.flatnonzero((leads > 0) & (away > BEHIND * self.blocks.sizes[owner]))
        order = out[np.lexsort((owner[out], np.round(away[out] / self.hair), row[out]))]
        found = np.full(len(points), -1)
        found[row[order][::-1]] = owner[order][::-1]  # of each point the first comes last, and counts
        return found

    def at(self, points: FloatArray) -> IntArray:
        """The block under each point (n, 3), (n,), -1 where there is none; on a joint that with the lower number."""
        first, second = self.hair * plane_axes(self.down[None])[0]
        around = [self.under(points + one * first + other * second) for one in (-1, 1) for other in (-1, 1)]
        none = np.iinfo(np.int64).max
        lowest = np.where(np.stack(around) >= 0, around, none).min(axis=0)
        return np.where(lowest < none, lowest, -1)

    def parts(self, begin: FloatArray, end: FloatArray) -> tuple[FloatArray, IntArray]:
        """Parts of a line between two points, (3,): ends from 0 to 1 along it, (n + 1,), and what lies under them just
        left and just right of it, (2, n), which differs where the line runs along a joint, or along an edge.
        """
        aside = unit(np.cross(end - begin, self.down)) * self.hair
        sides = [np.stack([begin, end]) + sign * aside for sign in (-1.0, 1.0)]
        ends = [np.array([0.0, 1.0])]
        for each in map(self.flat, sides):
            line, along = shapely.LineString(each), each[1] - each[0]
            crossed = self.outlines[self.tree.query(line, predicate="intersects")]
            places = shapely.get_coordinates(shapely.intersection(shapely.boundary(crossed), line))
            ends.append(np.clip((places - each[0]) @ along / (along @ along), 0.0, 1.0))
        cuts = np.unique(np.concatenate(ends))
        cuts = cuts[np.append(True, np.diff(cuts) > self.hair / np.linalg.norm(end - begin))]
        cuts[-1] = 1.0
        middles = (cuts[:-1] + cuts[1:])[:, None] / 2
        blocks = np.stack([self.under(each[0] + middles * (each[1] - each[0])) for each in sides])
        changes = np.append(True, (blocks[:, 1:] != blocks[:, :-1]).any(axis=0))
        return np.append(cuts[:-1][changes], 1.0), blocks[:, changes]

    def pieces(self, corner: FloatArray, sides: FloatArray) -> tuple[Polygons, IntArray]:
        """Pieces of a rectangle, polygons (n,) whose coordinates are shares of its sides, and what lies under each,
        (n,), -1 where nothing does.

        corner : (3,) from which its sides, (2, 3), lead
        """
        axes = plane_axes(self.down[None])[0]
        base, across = corner @ axes.T, sides @ axes.T
        whole = shapely.Polygon(base + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) @ across)
        met = self.outlines[self.tree.query(whole, predicate="intersects")]
        shares = shapely.transform(met, lambda places: (places - base) @ np.linalg.inv(across))
        unit_square = shapely.box(0.0, 0.0, 1.0, 1.0)
        inside = shapely.intersection(shapely.boundary(shares), unit_square)
        lines = shapely.union_all([shapely.boundary(unit_square), *inside], grid_size=OVERLAY)
        found = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
        middles = shapely.get_coordinates(shapely.point_on_surface(found))
        return found, self.under(corner + middles @ sides)
