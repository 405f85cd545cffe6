"""Cracks: interfaces that open in one surface, and yield lines of walls that bend.

Connected are interfaces that share a place; a chain may lead over joints that only slide or turn between those that
open, as the bed joints of a stepped crack do.

The interfaces on both sides of which there are different parts lie along a line that steps from joint to joint. A
broken line of as few pieces as lead through them is fitted by least squares, weighted by area: linear in the distance
along the direction in which they spread most, with its corners at some of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.plane import meeting_boxes
from mbla.model.solids.ragged import items_of_rows
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion, interface_radii
from mbla.results.collapse.joint_planes import ClusterJoints
from mbla.solution.solution import Mechanics

TOUCH = 0.01
"""distance of contact points, over the radius of the smaller interface, up to which they are one place"""


def touching_pairs(contacts: Contacts, interfaces: IntArray) -> IntArray:
    """Pairs of rows of ``interfaces`` that share a place, each pair once, (n, 2)."""
    size = interface_radii(contacts)[interfaces]
    points = contacts.points[items_of_rows(contacts.point_start, interfaces)]
    row = np.repeat(np.arange(len(interfaces)), np.diff(contacts.point_start)[interfaces])
    lower, upper = points - TOUCH / 2 * size[row, None], points + TOUCH / 2 * size[row, None]
    near, other = meeting_boxes(lower, upper, lower, upper, np.inf)
    apart = np.linalg.norm(points[near] - points[other], axis=1)
    pairs = np.sort(np.stack([row[near], row[other]], axis=1), axis=1)
    pairs = pairs[(pairs[:, 0] != pairs[:, 1]) & (apart <= TOUCH * size[pairs].min(axis=1))]
    return np.unique(pairs, axis=0)


# --- Cracks: interfaces between the same two clusters that open, as far as they are connected -----------------------


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
    pairs = touching_pairs(contacts, moving)
    same = np.all(joints.pairs[moving[pairs[:, 0]]] == joints.pairs[moving[pairs[:, 1]]], axis=1)
    return connected_labels(pairs[same], len(moving))


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
    points = items_of_rows(contacts.point_start, interfaces)
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


# --- Yield lines: where a part breaks off, as the eye follows it over many joints ------------------------------


LEAST = 6
"""interfaces from which they form a line of their own; fewer are hinges, cracks or sliding planes by their names"""
STRAIGHT = 0.05
"""distance of interfaces from their line over its length, root of the mean square, up to which it leads through them"""
MOST_PIECES = 3
CORNERS = 8
"""places along a line at which corners are tried"""


@dataclass(frozen=True)
class YieldLine:
    """Where two parts move apart.

    parts       : the heavier one first; rest (0) second
    interfaces  : (n,) between them
    points      : (n, 3) m, ends and corners of the line, the lowest end first
    off         : of the interfaces from it, root of the mean square, over its length
    """

    parts: tuple[int, int]
    interfaces: IntArray
    points: FloatArray
    off: float

    @property
    def length(self) -> float:
        """Along all of its pieces, m."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    @property
    def inclination(self) -> float:
        """To the horizontal from end to end, degrees."""
        step = self.points[-1] - self.points[0]
        return float(np.degrees(np.arctan2(abs(step[2]), np.linalg.norm(step[:2]))))


def yield_lines(contacts: Contacts, parts: IntArray, n_grounds: int) -> tuple[YieldLine, ...]:
    """Between parts, (n_blocks,), the longest first."""
    of_body = np.append(parts, np.zeros(n_grounds, dtype=np.int64))
    pairs = np.sort(of_body[contacts.bodies], axis=1)
    found = []
    for first, second in np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0).tolist():
        interfaces = np.flatnonzero((pairs == (first, second)).all(axis=1))
        if len(interfaces) >= LEAST:
            points, off = _broken_line(contacts, interfaces)
            found.append(YieldLine((first, second) if first else (second, first), interfaces, points, off))
    return tuple(sorted(found, key=lambda line: -line.length))


def _broken_line(contacts: Contacts, interfaces: IntArray) -> tuple[FloatArray, float]:
    """Ends and corners, (n, 3) m, the lower end first, and how far off the interfaces are, over the length."""
    places, areas = contacts.centroids[interfaces], contacts.areas[interfaces]
    middle = np.average(places, axis=0, weights=areas)
    along = np.linalg.svd((places - middle) * np.sqrt(areas)[:, None], full_matrices=False)[2][0]
    distance = (places - middle) @ along
    inner = np.unique(np.quantile(distance, np.linspace(0, 1, CORNERS + 2)))[1:-1]
    best = _fitted(places, areas, distance, ())
    for pieces in range(2, MOST_PIECES + 1):
        if best[1] <= STRAIGHT:
            break
        tried = [_fitted(places, areas, distance, corners) for corners in combinations(inner, pieces - 1)]
        best = min((best, *tried), key=lambda fit: fit[1])
    points, off = best
    corners = contacts.points[items_of_rows(contacts.point_start, interfaces)]
    points = np.clip(points, corners.min(axis=0), corners.max(axis=0))
    return np.asarray(points if points[0, 2] <= points[-1, 2] else points[::-1]), off


def _fitted(
    places: FloatArray, areas: FloatArray, distance: FloatArray, corners: tuple[float, ...]
) -> tuple[FloatArray, float]:
    """The broken line with corners at these distances: its points, (n, 3) m, and how far off, over its length."""
    knots = np.array([distance.min(), *corners, distance.max()])
    shares = np.stack([np.interp(distance, knots, row) for row in np.eye(len(knots))], axis=1)
    weights = np.sqrt(areas)[:, None]
    points: FloatArray = np.linalg.lstsq(weights * shares, weights * places, rcond=None)[0].astype(np.float64)
    off = np.sqrt(np.average(((places - shares @ points) ** 2).sum(axis=1), weights=areas))
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return points, float(off) / (length or 1.0)
