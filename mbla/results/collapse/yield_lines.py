"""Yield lines: where a main part breaks off, as the eye follows it over many joints.

The interfaces on both sides of which there are different main parts lie along a line that steps from joint to joint. A
broken line of as few pieces as lead through them is fitted by least squares, weighted by area: linear in the distance
along the direction in which they spread most, with its corners at some of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.cluster_joints import points_of

LEAST = 6
"""interfaces from which they form a line of their own; fewer are hinges, cracks or sliding planes by their names"""
STRAIGHT = 0.05
"""distance of interfaces from their line over its length, root of the mean square, up to which it leads through them"""
MOST_PIECES = 3
CORNERS = 8
"""places along a line at which corners are tried"""


@dataclass(frozen=True)
class YieldLine:
    """Where two main parts move apart.

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
    """Between main parts, (n_blocks,), the longest first."""
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
    corners = contacts.points[points_of(contacts, interfaces)]
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
