"""Cracks: interfaces between the same two clusters that open, as far as they are connected.

Connected are interfaces that touch; a chain may lead over joints that only slide or turn between those that
open, as the bed joints of a stepped crack do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.cluster_joints import ClusterJoints, points_of
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.touching import touching_pairs
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class Crack:
    """Open joints between two clusters.

    clusters   : that which moves away, and that from which it does; 0 is at rest and comes second
    interfaces : (n,) open ones, from start to end
    start, end : (3,) m, centroids of the interfaces at both ends; the start is the lower one in z, x, then y
    area       : m2, of the open interfaces
    widest     : (3,) m, the contact point at which it opens most
    share      : opening speed there over the largest contact speed of all
    """

    clusters: tuple[int, int]
    interfaces: IntArray
    start: FloatArray
    end: FloatArray
    area: float
    widest: FloatArray
    share: float

    @property
    def length(self) -> float:
        """From end to end, m."""
        return float(np.linalg.norm(self.end - self.start))


def cracks(
    contacts: Contacts, motion: InterfaceMotion, joints: ClusterJoints, mechanics: Mechanics
) -> tuple[Crack, ...]:
    """By falling opening, then by their first interface."""
    moving = np.flatnonzero(joints.between & (motion.modes != InterfaceMode.STICK))
    if not len(moving):
        return ()
    label = _connected(contacts, joints, moving)
    is_open = motion.modes[moving] == InterfaceMode.OPEN
    speed = float(np.linalg.norm(mechanics.contact_velocities, axis=1).max(initial=0.0)) or 1.0
    opening = moving[is_open][np.argsort(label[is_open], kind="stable")]
    chains = np.split(opening, np.cumsum(np.unique(label[is_open], return_counts=True)[1])[:-1]) if len(opening) else []
    found = [_crack(contacts, joints, mechanics, chain, speed) for chain in chains]
    return tuple(sorted(found, key=lambda crack: (-round(crack.share, 6), int(crack.interfaces.min()))))


def _connected(contacts: Contacts, joints: ClusterJoints, moving: IntArray) -> IntArray:
    """Number of the connected chain of each moving interface."""
    i, j = touching_pairs(contacts, moving)
    same = np.all(joints.pairs[moving[i]] == joints.pairs[moving[j]], axis=1)
    n = len(moving)
    graph = sp.coo_array((np.ones(int(same.sum())), (i[same], j[same])), shape=(n, n))
    return np.asarray(connected_components(graph, directed=False)[1])


def _crack(
    contacts: Contacts, joints: ClusterJoints, mechanics: Mechanics, interfaces: IntArray, speed: float
) -> Crack:
    """In order along the line in which the interfaces spread most."""
    centroids = contacts.centroids[interfaces]
    arms = centroids - centroids.mean(axis=0)
    along = arms @ np.linalg.svd(arms, full_matrices=False)[2][0]
    order = np.argsort(np.round(along / (np.abs(along).max() or 1.0), 6), kind="stable")
    first, last = (np.round(centroids[order[i]], 9)[[2, 0, 1]].tolist() for i in (0, -1))
    order = order[::-1] if last < first else order
    points = points_of(contacts, interfaces)
    opening = mechanics.contact_velocities[points, 0]
    widest = int(np.argmax(np.round(opening / speed, 9)))
    return Crack(
        clusters=joints.clusters(int(interfaces[0])),
        interfaces=interfaces[order],
        start=centroids[order[0]],
        end=centroids[order[-1]],
        area=float(contacts.areas[interfaces].sum()),
        widest=contacts.points[points[widest]],
        share=float(opening[widest] / speed),
    )
