"""Contact points carried along by the blocks that touch there: where they are at any pose, and how far apart.

A contact point is a material point of the *slave*, the body whose corner it is, on a face of the *host*, the other
body. Normal and frame of the point turn with the host, so that the gap is the distance from that face wherever the
point slides. The offset, the position of the point of b relative to the point of a in that frame, is the gap across the
joint and the slip along it. A force at the slave's point does exactly the work of the offset on both bodies, so that
the equilibrium matrix is the derivative of the offsets by the poses::

    w = F (x_b − x_a),    dw = Aᵀ du

An interface that has not slid keeps its points when contacts are searched anew, with their history and with the
stiffness that depends on the number of points.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.contacts import Contacts
from mbla.contacts.moved import MovedContacts
from mbla.model.pose import Pose

SLID = 0.005
"""Slip over the size of the smaller block from which an interface gets new points."""

ALIGNED = 1e-14
"""By how much the cosine of two unit normals that are the same may lie below 1."""


SAME_CORNER = 1e-6
"""Distance over the size of the smaller block within which corners of two faces are the same."""


@dataclass(frozen=True)
class Placed:
    """Points at a pose.

    points  : (n, 3) m, of the slaves
    frames  : (n, 3, 3) rows: normal, tangents
    offsets : (n, 3) m, gap and slip
    """

    points: FloatArray
    frames: FloatArray
    offsets: FloatArray


@dataclass(frozen=True)
class CarriedPoints:
    """Contact points in the frames of their bodies: blocks first, then grounds, which do not move.

    centroids : (n_blocks, 3) m, as built
    bodies    : (n, 2) a and b
    host      : (n,) whether b is the host, else a
    arms      : (2, n, 3) m, of the points of a and b from the centroids, in the frames of these bodies
    frames    : (n, 3, 3) in the frame of the host
    """

    centroids: FloatArray
    bodies: IntArray
    host: BoolArray
    arms: FloatArray
    frames: FloatArray

    @staticmethod
    def at_pose(centroids: FloatArray, bodies: IntArray, host: BoolArray, placed: Placed, pose: Pose) -> CarriedPoints:
        """Points that are there at a pose."""
        apart = np.einsum("ni,nij->nj", placed.offsets, placed.frames)
        other = np.where(host[:, None], placed.points + apart, placed.points - apart)
        ends = np.stack([np.where(host[:, None], placed.points, other), np.where(host[:, None], other, placed.points)])
        none = np.zeros((len(bodies), 3))
        points = CarriedPoints(centroids, bodies, host, np.stack([none, none]), placed.frames)
        arms = np.stack([points._back(pose, side, ends[side]) for side in (0, 1)])
        frames = placed.frames @ points._rotations(pose, points.hosts)
        return replace(points, arms=arms, frames=frames)

    def at(self, pose: Pose) -> Placed:
        """Where they are there."""
        ends = [self._places(pose, side) for side in (0, 1)]
        frames = self.frames @ self._rotations(pose, self.hosts).transpose(0, 2, 1)
        offsets = np.einsum("nij,nj->ni", frames, ends[1] - ends[0])
        return Placed(np.where(self.host[:, None], *ends), frames, offsets)

    @property
    def hosts(self) -> IntArray:
        """(n,) bodies."""
        return np.where(self.host, self.bodies[:, 1], self.bodies[:, 0])

    @property
    def slaves(self) -> IntArray:
        """(n,) bodies."""
        return np.where(self.host, self.bodies[:, 0], self.bodies[:, 1])

    def centres(self, pose: Pose, bodies: IntArray) -> FloatArray:
        """Centroids of bodies there, (n, 3); the origin for grounds."""
        every = np.concatenate([self.centroids + pose.shift, np.zeros((1, 3))])
        return every[np.minimum(bodies, len(pose.shift))]

    def _rotations(self, pose: Pose, bodies: IntArray) -> FloatArray:
        every = np.concatenate([pose.rotation, np.eye(3)[None]])
        return every[np.minimum(bodies, len(pose.rotation))]

    def _places(self, pose: Pose, side: int) -> FloatArray:
        own = self.bodies[:, side]
        turned = np.einsum("nij,nj->ni", self._rotations(pose, own), self.arms[side])
        return np.asarray(self.centres(pose, own) + turned)

    def _back(self, pose: Pose, side: int, places: FloatArray) -> FloatArray:
        own = self.bodies[:, side]
        return np.asarray(np.einsum("nji,nj->ni", self._rotations(pose, own), places - self.centres(pose, own)))


def _on_faces(
    contacts: Contacts, found: MovedContacts, host: BoolArray, normals: FloatArray, origins: FloatArray
) -> Placed:
    """Points on the face of their slave, with the normal of the face of their host and the distance from it.

    host : (n_points,) whether b is it; normals, origins : (n_points, 2, 3) of both faces, any of grounds
    """
    of_point, frames = contacts.interface_of_point, contacts.frames
    ground = found.faces[of_point, 0] < 0  # has the normal of the contact, at the gap that was found
    along, every = frames[:, 0], np.arange(len(host))
    slave_side, host_side = np.where(host, 0, 1), np.where(host, 1, 0)
    own, origin = normals[every, slave_side], origins[every, slave_side]
    way = np.einsum("ni,ni->n", origin - contacts.points, own) / np.einsum("ni,ni->n", along, own)
    points = contacts.points + way[:, None] * along
    normal = np.where(host[:, None], -1.0, 1.0) * normals[every, host_side]
    normal = np.where(ground[:, None], along, normal)
    distance = np.einsum("ni,ni->n", points - origins[every, host_side], normal) * np.where(host, -1.0, 1.0)
    gaps = np.where(ground, found.gaps, distance - found.ignored[of_point])
    first = frames[:, 1] - np.einsum("ni,ni->n", frames[:, 1], normal)[:, None] * normal
    first /= np.linalg.norm(first, axis=1)[:, None]
    offsets = np.zeros_like(points)
    offsets[:, 0] = gaps
    return Placed(points, np.stack([normal, first, np.cross(normal, first)], axis=1), offsets)


@dataclass(frozen=True)
class Touching:
    """Contacts of moved blocks, their points carried along, and what became of those before.

    contacts : there
    faces    : (n_interfaces, 2) facets
    points   : carried
    sizes    : (n_points,) m, of the smaller block
    before   : (n_points,) number of the same point among those before; −1 of new ones
    overlap  : greatest, over the size of the smaller block
    """

    contacts: Contacts
    faces: IntArray
    points: CarriedPoints
    sizes: FloatArray
    before: IntArray
    overlap: float

    @staticmethod
    def found(
        centroids: FloatArray, sizes: FloatArray, corners: FloatArray, found: MovedContacts, pose: Pose
    ) -> Touching:
        """New points: those of the body whose corner they are, on the face of the other, whose normal they have.

        centroids, sizes : of the bodies that move, as built; of these the contacts are
        corners : (n_points, 2) m, distance from the nearest corner of both faces
        """
        contacts, of_point = found.contacts, found.contacts.interface_of_point
        bodies, faces = contacts.bodies[of_point], found.faces
        on_ground = faces[:, 0] < 0
        normals, origins = found.facets.normals[faces], found.facets.origins[faces]  # of grounds any, not used
        first, second = (np.einsum("ni,ni->n", contacts.normals, normals[:, side]) for side in (0, 1))
        of_first, of_second = first > 1.0 - ALIGNED, (second < -1.0 + ALIGNED) & ~on_ground
        smaller = np.append(sizes, np.full(int(bodies.max(initial=0)) + 1, np.inf))[bodies].min(axis=1)
        nearer = corners[:, 0] < corners[:, 1] - SAME_CORNER * smaller  # a corner of a
        host = np.where(
            (of_first != of_second)[of_point], (of_second & ~of_first)[of_point], nearer & ~on_ground[of_point]
        )
        placed = _on_faces(contacts, found, host, normals[of_point], origins[of_point])
        points = CarriedPoints.at_pose(centroids, bodies, host, placed, pose)
        new = np.full(len(bodies), -1)
        return Touching(contacts, found.faces, points, smaller, new, found.overlap)

    def slips(self, placed: Placed) -> FloatArray:
        """Of the points since they were made, over the size of the smaller block, (n_points,)."""
        return np.asarray(np.abs(placed.offsets[:, 1:]).max(axis=1) / self.sizes)

    def renewed(self, found: Touching, pose: Pose) -> Touching:
        """What was found there, with the points of interfaces that were there before and have not slid."""
        if not len(self.contacts):  # nothing touched
            return found
        kept = self._same_interfaces(found, self.slips(self.points.at(pose)) > SLID)
        own, new = self.contacts.point_start, found.contacts.point_start
        counts = np.where(kept >= 0, np.diff(own)[kept], np.diff(new))
        point_start = starts(counts)
        of_interface = np.repeat(np.arange(len(counts)), counts)
        within = np.arange(len(of_interface)) - point_start[of_interface]
        stays = kept[of_interface] >= 0
        old = (own[kept[of_interface]] + within)[stays]
        fresh = (new[of_interface] + within)[~stays]
        there, anew = self.points.at(pose), found.points.at(pose)

        def mixed(mine: np.ndarray, theirs: np.ndarray) -> np.ndarray:
            result = np.empty((len(stays), *theirs.shape[1:]), dtype=theirs.dtype)
            result[stays], result[~stays] = mine[old], theirs[fresh]
            return result

        contacts, mine = found.contacts, self.contacts
        points, frames = mixed(there.points, anew.points), mixed(there.frames, anew.frames)
        outline, areas, centroids = contacts.outline.copy(), contacts.areas.copy(), contacts.centroids.copy()
        same = kept >= 0
        outline[same], areas[same] = mine.outline[kept[same]], mine.areas[kept[same]]
        if same.any():
            centroids[same] = np.add.reduceat(points, point_start[:-1])[same] / counts[same, None]
        contacts = replace(
            contacts,
            areas=areas,
            centroids=centroids,
            outline=outline,
            point_start=point_start,
            points=points,
            frames=frames,
            point_areas=mixed(mine.point_areas, contacts.point_areas),
        )
        placed, host = (
            Placed(points, frames, mixed(there.offsets, anew.offsets)),
            mixed(self.points.host, found.points.host),
        )
        carried = CarriedPoints.at_pose(self.points.centroids, contacts.bodies[of_interface], host, placed, pose)
        before = np.full(len(stays), -1)
        before[stays] = old
        return Touching(contacts, found.faces, carried, mixed(self.sizes, found.sizes), before, found.overlap)

    def _same_interfaces(self, found: Touching, slid: BoolArray) -> IntArray:
        """Number among the interfaces here of each of those found, (n,); −1 of those that are new or have slid."""
        moved = np.zeros(len(self.contacts.bodies), dtype=bool)
        np.logical_or.at(moved, self.contacts.interface_of_point, slid)
        every = np.vstack([np.hstack([each.contacts.bodies, each.faces]) for each in (self, found)])
        number = np.unique(every, axis=0, return_inverse=True)[1].ravel()
        n = len(moved)
        mine, theirs = number[:n], number[n:]
        size = int(number.max(initial=-1)) + 1
        alone = (np.bincount(mine, minlength=size) == 1) & (np.bincount(theirs, minlength=size) == 1)
        row = np.full(size, -1)
        row[mine] = np.where(moved, -1, np.arange(n))
        return np.where(alone[theirs], row[theirs], -1)
