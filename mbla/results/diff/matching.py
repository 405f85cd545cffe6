"""Which block, ground, interface and contact point of one result is which of the other.

Blocks are the same by name (group and index) where those lie at the same places; where the names are the same but in
another order, or are others, by place; where the shape was changed but the names are the same, by name.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.deck.units import KILOGRAMS, METRES, NEWTONS, Units
from mbla.model.model import Model
from mbla.results.record.quantity import UnitKind

SAME_PLACE = 1e-3
"""Distance of two points that are one, over the block size: the default tolerance of contacts."""

NEAR = 0.25
"""Distance of centroids, over the block size, up to which blocks of other names may be one another: less than half the
distance of neighbours."""

ENOUGH = 0.9
"""Share of the volume of either model that must be matched for mechanisms to be comparable."""

CANDIDATES = 32
"""Contact points looked at near one place; where eight blocks meet there are 24 of interfaces."""


@dataclass(frozen=True)
class Matching:
    """Rows of B for the rows of A, -1 where there is none.

    bodies  : (n_blocks + n_grounds of A,)
    by      : ``name`` or ``place``
    moved   : (n_blocks of A,) distance of the centroids over the block size; nan without a match
    shares  : of the volumes of A and of B that are matched
    """

    bodies: IntArray
    by: str
    moved: FloatArray
    shares: tuple[float, float]

    @property
    def comparable(self) -> bool:
        """Whether motions of the two can be compared."""
        return min(self.shares) >= ENOUGH


def match_models(first: Model, second: Model, factors: Factors) -> Matching:
    """Blocks and grounds of two models."""
    places = second.blocks.centroids * factors.length
    sizes = first.blocks.sizes
    by_name = _by_name(first, second)
    found, by = by_name, "name"
    if not _in_place(first, places, by_name):
        by_place = _by_place(first.blocks.centroids, places, sizes)
        complete = (by_name >= 0).all() and len(first.blocks) == len(second.blocks)
        if not complete or _in_place(first, places, by_place):
            found, by = by_place, "place"
    moved = np.full(len(found), np.nan)
    there = found >= 0
    moved[there] = np.linalg.norm(places[found[there]] - first.blocks.centroids[there], axis=1) / sizes[there]
    volumes, others = first.blocks.volumes, second.blocks.volumes
    shares = float(volumes[there].sum() / volumes.sum()), float(others[found[there]].sum() / others.sum())
    return Matching(np.concatenate([found, _grounds(first, second, factors)]), by, moved, shares)


def _by_name(first: Model, second: Model) -> IntArray:
    rows = {second.blocks.name(block): block for block in range(len(second.blocks))}
    return np.array([rows.get(first.blocks.name(block), -1) for block in range(len(first.blocks))], dtype=np.int64)


def _in_place(first: Model, places: FloatArray, found: IntArray) -> bool:
    """Whether every block has a match at its own place, and no other block of B is left."""
    if (found < 0).any() or len(found) != len(places) or len(np.unique(found)) != len(found):
        return False
    off = np.linalg.norm(places[found] - first.blocks.centroids, axis=1)
    return bool((off <= SAME_PLACE * first.blocks.sizes).all())


def _by_place(centroids: FloatArray, places: FloatArray, sizes: FloatArray) -> IntArray:
    """Blocks that are each other's nearest, (n,)."""
    from scipy.spatial import cKDTree

    distance, nearest = cKDTree(places).query(centroids)
    _, back = cKDTree(centroids).query(places)
    nearest, back = np.asarray(nearest), np.asarray(back)
    mutual = (back[nearest] == np.arange(len(centroids))) & (distance <= NEAR * sizes)
    return np.where(mutual, nearest, -1).astype(np.int64)


def _grounds(first: Model, second: Model, factors: Factors) -> IntArray:
    """Planes that are one another, as body numbers of B; each is taken once."""
    scale = float(np.ptp(first.blocks.vertices, axis=0).max())
    free = list(range(len(second.grounds)))
    found = []
    for ground in first.grounds:
        for other in free:
            plane = second.grounds[other]
            off = float((plane.point * factors.length - ground.point) @ ground.normal)
            if np.abs(plane.normal - ground.normal).max() <= SAME_PLACE and abs(off) <= SAME_PLACE * scale:
                found.append(len(second.blocks) + other)
                free.remove(other)
                break
        else:
            found.append(-1)
    return np.array(found, dtype=np.int64)


def match_interfaces(
    first: Contacts, second: Contacts, matching: Matching, sizes: FloatArray, length: float
) -> IntArray:
    """Interface of B for each of A, (n_interfaces,); -1 where there is none between the same bodies in that place."""
    tolerance = _tolerances(first, sizes)
    return _match(
        first.centroids,
        _pairs(matching.bodies[first.bodies]),
        second.centroids * length,
        _pairs(second.bodies),
        tolerance,
    )


def match_points(first: Contacts, second: Contacts, matching: Matching, sizes: FloatArray, length: float) -> IntArray:
    """Contact point of B for each of A, (n_points,); -1 where there is none of the same bodies in that place."""
    owner, other = first.interface_of_point, second.interface_of_point
    return _match(
        first.points,
        _pairs(matching.bodies[first.bodies])[owner],
        second.points * length,
        _pairs(second.bodies)[other],
        _tolerances(first, sizes)[owner],
    )


def _tolerances(contacts: Contacts, sizes: FloatArray) -> FloatArray:
    """Distance within which places of an interface are one, by the smaller of its blocks; grounds have no size."""
    of_bodies = np.concatenate([sizes, np.full(int(contacts.bodies.max(initial=-1)) + 1, np.inf)])
    return np.asarray(SAME_PLACE * of_bodies[contacts.bodies].min(axis=1))


def _pairs(bodies: IntArray) -> IntArray:
    """Two bodies in ascending order, (n, 2): block numbers may have changed their order."""
    return np.sort(bodies, axis=1)


def _match(
    points: FloatArray, pairs: IntArray, others: FloatArray, other_pairs: IntArray, tolerance: FloatArray
) -> IntArray:
    """Row of ``others`` at the place of each point and between the same bodies, the nearest; -1 where there is none."""
    from scipy.spatial import cKDTree

    if not len(points) or not len(others):
        return np.full(len(points), -1, dtype=np.int64)
    count = min(CANDIDATES, len(others))
    distance, rows = cKDTree(others).query(points, k=np.arange(1, count + 1))
    rows = np.asarray(rows)
    same = (other_pairs[rows] == pairs[:, None, :]).all(axis=2) & (distance <= tolerance[:, None])
    found = rows[np.arange(len(points)), same.argmax(axis=1)]
    return np.where(same.any(axis=1), found, -1).astype(np.int64)


@dataclass(frozen=True)
class Factors:
    """What numbers in the units of B are multiplied with to be in those of A."""

    length: float
    force: float
    mass: float

    def of(self, unit: UnitKind) -> float:
        """What a quantity in such a unit is multiplied with."""
        length, force = self.length, self.force
        factors: dict[UnitKind, float] = {"length": length, "area": length**2, "volume": length**3, "force": force}
        factors |= {"moment": force * length, "stress": force / length**2}
        return factors.get(unit, 1.0)


def factors_between(first: Units, second: Units) -> Factors:
    """From the units of ``second`` to those of ``first``."""
    return Factors(
        METRES[second.length] / METRES[first.length],
        NEWTONS[second.force] / NEWTONS[first.force],
        KILOGRAMS[second.mass] / KILOGRAMS[first.mass],
    )
