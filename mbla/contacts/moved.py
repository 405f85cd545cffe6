"""Contacts of blocks that have moved: where faces are near each other, with the gap of every contact point.

Faces of moved blocks are no longer parallel, and a joint that opens about an edge stays a contact at that edge. Two
facets face each other where their normals are opposite within ``FACING``; their outlines are projected along the normal
of the contact, and every corner of the common outline is a contact point with its own gap, the signed distance of the
two planes there. The normal is that of the face on which an edge of the other block stands, and the mean of both
normals where both faces have an edge there. A point outside of the common outline would hold a block without contact.

Bodies that press on each other overlap a little, and so do the faces beside their joint, along a strip as wide as the
overlap. Where two faces share no more than such a strip, or less in width than in depth, other faces keep the bodies
apart. Taken for contacts, such faces jam vaults.

With blocks where they were built these are the contacts that :mod:`mbla.contacts.search` finds: what gaps there within
the tolerance touches, and the gap in the middle of two facets then counts as none later as well. Facets that share an
edge there, at an angle, are no contact then nor later.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.faces.common_surfaces import FacetSearch, find_common_surfaces
from mbla.contacts.faces.facets import Facets, build_facets
from mbla.contacts.joints import joints_of_interfaces, laws_of_nearest
from mbla.contacts.outlines.corners import areas_and_centroids, needed_corners
from mbla.contacts.outlines.overlay import Overlays, gap_at, in_space
from mbla.contacts.outlines.points import interface_points
from mbla.contacts.report import both_fixed
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import Model
from mbla.model.pose import Pose, moved_model
from mbla.model.solids.polygons import Polygons, connected_parts, widths

FACING, HINGED = (float(np.cos(np.radians(angle))) for angle in (50.0, 85.0))
"""Cosine of the angle from opposite up to which facets of moved blocks are in contact: corners that come together at a
larger one have other normals. Facets in contact as built hinge on each other up to the second."""

REACH = 0.05
"""Gap or overlap, over block size, beyond which facets are not in contact: a step moves blocks by less
(:data:`MOVED` of :mod:`mbla.solution.pushover.renewal`), and what overlaps more are the far sides of blocks
whose near ones touch."""

NARROW, EDGE = 1e-6, 1e-3
"""Width of a common surface, over block size: below the first the facets share no more than an edge; below the second
facets that were not in contact as built are none, as beside a pressed joint facets share the width of the overlap."""


@dataclass(frozen=True)
class MovedContacts:
    """Contacts, and the gap of each contact point, (n_points,) m: negative where rounding or a step let blocks overlap.

    faces   : (n_interfaces, 2) facets, numbered as the blocks have them; −1 for ground
    facets  : there
    ignored : (n_interfaces,) m, gap as built that counts as none
    overlap : greatest, over the size of the smaller block
    """

    contacts: Contacts
    gaps: FloatArray
    faces: IntArray
    facets: Facets
    ignored: FloatArray
    overlap: float


class MovedSearch:
    """Finds the contacts of a model anew wherever its blocks have moved to.

    The outlines of facets, which do not change, are made once.
    """

    def __init__(self, model: Model, contacts: Contacts, section: ContactsSection) -> None:
        self.model, self.contacts, self.section = model, contacts, section
        self.facets = build_facets(model.blocks)
        corners = shapely.get_coordinates(self.facets.polygons, return_index=True)
        self._corners, self._facet_of_corner = corners
        self._first = np.flatnonzero(np.diff(self._facet_of_corner, prepend=-1))
        self._corners_of_facets = shapely.extract_unique_points(self.facets.polygons)
        self._edges = self._joined = np.zeros(0, dtype=np.int64)
        self._reach = max(REACH, 2.0 * section.depth_allowed)
        overlays, parts = self._near(model, self.facets, 0.0, NARROW)
        least, greatest = _extreme_gaps(overlays, parts)
        touches = (greatest <= section.tolerance) & (least >= -section.depth_allowed)
        apart = (~touches & (least < section.tolerance)) | (widths(parts) < section.tolerance)
        pair, joined = self._pair(overlays.bodies, overlays.facets), ~apart & touches
        self._edges = np.unique(pair[apart])
        self._joined, first = np.unique(pair[joined], return_index=True)
        middles = gap_at(overlays, np.arange(len(parts)), areas_and_centroids(needed_corners(parts, NARROW))[1])
        self._built = (middles * overlays.sizes)[joined][first]

    def at(self, pose: Pose, fallen: BoolArray | None = None, opened: float = 0.0) -> MovedContacts:
        """Contacts of the model with its blocks there, but those of debris, (n_blocks,).

        opened : gap over the size of blocks, that joints which dilate have at most and touch all the same
        """
        model = moved_model(self.model, pose)
        facets = self._facets(pose)
        overlays, parts = self._near(model, facets, opened, EDGE)
        if fallen is not None and fallen.any():
            loose = np.append(fallen, np.zeros(len(model.grounds), dtype=bool))
            stands = np.asarray(~np.any(loose[overlays.bodies], axis=1))
            overlays, parts = overlays.take(stands), parts[stands]
        order = np.lexsort((overlays.facets[:, 1], overlays.facets[:, 0], overlays.bodies[:, 1], overlays.bodies[:, 0]))
        overlays, parts = overlays.take(order), parts[order]
        built, centroids = self._as_built(overlays, parts, pose)
        given = laws_of_nearest(self.model.interfaces, overlays.bodies, centroids)
        laws, _ = joints_of_interfaces(self.model, self.section, built, centroids, given)
        closed = ~laws.open
        overlays, parts = overlays.take(closed), parts[closed]
        joints = laws.in_use(np.flatnonzero(closed))
        corners = needed_corners(parts, NARROW)
        areas = areas_and_centroids(corners)
        found, _ = interface_points(corners, areas[1], overlays.sizes, self.section.points)
        of_point, size = found.polygon, overlays.sizes
        ignored = self._gaps_as_built(overlays)
        gaps = gap_at(overlays, of_point, found.points) * size[of_point] - ignored[of_point]
        of_model = self.contacts.report, self.contacts.solid_of_block
        contacts = Contacts.on(overlays, areas, found, joints, np.zeros(len(size)), *of_model)
        overlap = max(-float((gaps / size[of_point]).min(initial=0.0)), 0.0)
        return MovedContacts(contacts, gaps, overlays.facets, facets, ignored, overlap)

    def to_corners(self, found: MovedContacts, pose: Pose) -> FloatArray:
        """Distance of contact points from corners of the facets of both bodies, (n_points, 2) m; inf of grounds."""
        contacts, blocks, built = found.contacts, self.model.blocks, self.facets
        distances = np.full((len(contacts.points), 2), np.inf)
        facets = found.faces[contacts.interface_of_point]
        for side in (0, 1):
            row = np.flatnonzero((facets[:, side] >= 0) & (facets[:, side] < len(built)))
            facet = facets[row, side]
            block = built.blocks[facet]
            arms = contacts.points[row] - (blocks.centroids + pose.shift)[block]
            places = np.einsum("nji,nj->ni", pose.rotation[block], arms) + blocks.centroids[block]
            flat = np.einsum("nai,ni->na", built.frames[facet, 1:], places - built.origins[facet])
            distances[row, side] = shapely.distance(self._corners_of_facets[facet], shapely.points(flat))
        return distances

    def _near(self, model: Model, facets: Facets, opened: float, narrow: float) -> tuple[Overlays, Polygons]:
        """Common surfaces within reach, those of facets that are not in contact as built wider than some share."""
        search = FacetSearch(REACH + opened, self._face_each_other, moved=True)
        overlays, shapes, _ = find_common_surfaces(model.blocks, facets, model.grounds, search)
        parts, row = connected_parts(shapes)
        overlays = replace(overlays, facets=self._named(overlays.facets)).take(row)
        least, wide = _extreme_gaps(overlays, parts)[0], widths(parts)
        pair = self._pair(overlays.bodies, overlays.facets)
        built = np.isin(pair, self._joined)
        near = (wide > np.where(built, NARROW, narrow)) & (built | (least > -wide))
        near &= (least > -self._reach) & (least < self._reach + opened)
        near &= ~both_fixed(model, overlays.bodies) & ~np.isin(pair, self._edges)
        if (solid := self.contacts.solid_of_block) is not None:
            body = np.append(solid, len(solid) + np.arange(len(model.grounds)))[overlays.bodies]
            near &= body[:, 0] != body[:, 1]
        return overlays.take(near), parts[near]

    def _gaps_as_built(self, overlays: Overlays) -> FloatArray:
        """Of facets in contact as built that gap in the middle, which counts as none, (n,) m; 0 of others."""
        pair = self._pair(overlays.bodies, overlays.facets)
        place = np.minimum(np.searchsorted(self._joined, pair), max(len(self._joined) - 1, 0))
        if not len(self._joined):
            return np.zeros(len(pair))
        return np.where(self._joined[place] == pair, self._built[place], 0.0)

    def _pair(self, bodies: IntArray, facets: IntArray) -> IntArray:
        """A number for each pair of facets, (n,); ground planes, which have none, go by their bodies."""
        first = np.where(facets[:, 0] < 0, len(self.facets) + bodies[:, 0], facets[:, 0])
        return np.asarray(first * len(self.facets) + facets[:, 1])

    def _facets(self, pose: Pose) -> Facets:
        """The facets there."""
        built, blocks = self.facets, self.model.blocks
        turn = pose.rotation[built.blocks]
        arms = built.origins - blocks.centroids[built.blocks]
        origins = (blocks.centroids + pose.shift)[built.blocks] + np.einsum("fij,fj->fi", turn, arms)
        frames = np.einsum("fij,faj->fai", turn, built.frames)
        row = self._facet_of_corner
        corners = origins[row] + np.einsum("ka,kai->ki", self._corners, frames[row, 1:])
        return replace(
            built,
            origins=origins,
            frames=frames,
            lower=np.minimum.reduceat(corners, self._first),
            upper=np.maximum.reduceat(corners, self._first),
        )

    def _face_each_other(self, bodies: IntArray, pairs: IntArray, first: FloatArray, second: FloatArray) -> BoolArray:
        """Whether facets, (n, 2), with these normals may be in contact, (n,)."""
        against = -np.einsum("ki,ki->k", first, second)
        hinges = (against > HINGED) & (against <= FACING)
        hinges[hinges] = np.isin(self._pair(bodies[hinges], self._named(pairs[hinges])), self._joined)
        return np.asarray((against > FACING) | hinges)

    def _named(self, facets: IntArray) -> IntArray:
        """Facets of blocks by their numbers, −1 for ground surfaces too."""
        return np.where(facets < len(self.facets), facets, -1)

    def _as_built(self, overlays: Overlays, parts: Polygons, pose: Pose) -> tuple[Overlays, FloatArray]:
        """Overlays and centroids with body b where it was built: joint laws go by orientation and place there."""
        block = overlays.bodies[:, 1]
        middle = shapely.get_coordinates(shapely.centroid(parts))
        centroids = in_space(overlays, np.arange(len(overlays)), middle)
        back, blocks = pose.rotation[block], self.model.blocks
        arms = np.einsum("kij,ki->kj", back, centroids - (blocks.centroids + pose.shift)[block])
        frames = np.einsum("kij,kai->kaj", back, overlays.frames)
        return replace(overlays, frames=frames), blocks.centroids[block] + arms


def _extreme_gaps(overlays: Overlays, parts: Polygons) -> tuple[FloatArray, FloatArray]:
    """Least gap over each part, and the greatest distance whatever its sign, (n,) each, over block size."""
    points, row = shapely.get_coordinates(parts, return_index=True)
    if not len(row):
        return np.zeros(0), np.zeros(0)
    gaps, first = gap_at(overlays, row, points), np.flatnonzero(np.diff(row, prepend=-1))
    return np.minimum.reduceat(gaps, first), np.maximum.reduceat(np.abs(gaps), first)
