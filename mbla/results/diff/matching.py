"""Which block, ground and interface of one result is which of the other.

Blocks are the same by name (group and index) where those lie at the same places; where the names are the same but in
another order, or are others, by place; where the shape was changed but the names are the same, by name.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.deck.units import KILOGRAMS, METRES, NEWTONS, Units
from mbla.model.model import Ground, Model
from mbla.results.record.quantity import UnitKind

SAME_PLACE = 1e-3
"""Distance of two points that are one, over the block size: the default tolerance of contacts."""

NEAR = 0.25
"""Distance of centroids, over the block size, up to which blocks of other names may be one another: less than half the
distance of neighbours."""

ENOUGH = 0.9
"""Share of the volume of either model that must be matched for mechanisms to be comparable."""


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
    found, by = _by_name(first, second), "name"
    if not _in_place(first, places, found):
        by_place = _by_place(first.blocks.centroids, places, first.blocks.sizes)
        complete = (found >= 0).all() and len(first.blocks) == len(second.blocks)
        if not complete or _in_place(first, places, by_place):
            found, by = by_place, "place"
    moved = np.full(len(found), np.nan)
    there = found >= 0
    away = np.linalg.norm(places[found[there]] - first.blocks.centroids[there], axis=1)
    moved[there] = away / first.blocks.sizes[there]
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
    free = dict(enumerate(second.grounds))
    found = []
    for ground in first.grounds:
        off = {row: (other.point * factors.length - ground.point) @ ground.normal for row, other in free.items()}
        same = (
            row
            for row, other in free.items()
            if np.abs(other.normal - ground.normal).max() <= SAME_PLACE
            and abs(off[row]) <= SAME_PLACE * scale
            and _same_outline(ground, other, factors.length, SAME_PLACE * scale)
        )
        row = next(same, -1)
        free.pop(row, None)
        found.append(len(second.blocks) + row if row >= 0 else -1)
    return np.array(found, dtype=np.int64)


def _same_outline(ground: Ground, other: Ground, factor: float, near: float) -> bool:
    """Whether two grounds have no end, or the same corners; ``factor`` on lengths of the other one."""
    if ground.outline is None or other.outline is None:
        return ground.outline is other.outline
    corners = other.outline * factor
    return len(corners) == len(ground.outline) and bool(
        (np.linalg.norm(corners[:, None] - ground.outline, axis=2).min(axis=0) <= near).all()
    )


def match_interfaces(first: Contacts, second: Contacts, matching: Matching, length: float) -> IntArray:
    """Interface of B for each of A, (n_interfaces,): between the same bodies, the nearest of several; -1 for none.

    length : of B's unit in that of A
    """
    rows: dict[tuple[int, ...], list[int]] = {}
    for row, pair in enumerate(np.sort(second.bodies, axis=1).tolist()):
        rows.setdefault(tuple(pair), []).append(row)
    found = np.full(len(first), -1)
    for row, pair in enumerate(np.sort(matching.bodies[first.bodies], axis=1).tolist()):
        near = rows.get(tuple(pair))
        if near:
            away = np.linalg.norm(second.centroids[near] * length - first.centroids[row], axis=1)
            found[row] = near[int(away.argmin())]
    return found
