"""A force that travels: its positions along a path, each landing on the block under it.

Positions lie at equal distances along the path, both ends among them. The load case NAME becomes NAME@01, NAME@02, ...:
a name of the deck cannot have an @, files and HDF5 groups can.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.types import Load, Travel
from mbla.model.loads.blocks_under import block_under
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, wrenches_of
from mbla.model.loads.named_loads import Entry
from mbla.model.model import TravelPosition
from mbla.model.selectors import select_blocks
from mbla.model.wording import vector


@dataclass(frozen=True)
class PositionLoad:
    """The load at one position."""

    position: TravelPosition
    applied: AppliedLoad


def travel_of(loads: list[Load]) -> int | None:
    """Which of the live loads travels; a rule of the deck: at most one does."""
    return next((number for number, load in enumerate(loads) if load.travel is not None), None)


def travel_loads(name: str, entry: Entry, site: LoadSite) -> list[PositionLoad] | None:
    """The load at every position; None where a fault was left, as for positions over no block."""
    travel = entry.load.travel
    assert travel is not None  # what makes it this kind
    chosen: IntArray | None = np.arange(len(site.blocks))
    if entry.load.on is not None:
        chosen = select_blocks(entry.load.on, (*entry.path, "on"), site.roster, site.faults)
    if chosen is None:
        return None
    points, distances = positions_on(travel)
    found = [block_under(point, np.array(travel.towards), chosen, site.blocks) for point in points]
    bare = [number for number, (block, _) in enumerate(found, start=1) if block < 0]
    if bare:
        if not site.roster.partial:
            site.refuse((*entry.path, "travel"), _bare_in_words(bare, points, site))
        return None
    force = entry.factor * np.array(travel.force)
    loads = []
    for number, (point, distance, (block, _)) in enumerate(zip(points, distances, found, strict=True), start=1):
        position = TravelPosition(name, number, len(points), point, float(distance), block)
        wrench = wrenches_of(force[None], point[None], site.blocks.centroids[[block]])
        words = (
            f"force {vector(force)} {site.units.force} at {vector(point)} {site.units.length} on "
            f"{site.blocks.name(block)}, position {number} of {len(points)}"
        )
        loads.append(PositionLoad(position, AppliedLoad(np.array([block]), wrench, words)))
    return loads


def case_name(position: TravelPosition) -> str:
    """Name of the load case at a position: ``train@07``."""
    return f"{position.series}@{position.number:0{len(str(position.count))}d}"


def positions_on(travel: Travel) -> tuple[FloatArray, FloatArray]:
    """Points at equal distances along the path, (n, 3), and their distances from its beginning, (n,)."""
    corners = np.array(travel.path)
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1)))
    distances = np.linspace(0.0, along[-1], travel.positions)
    return np.stack([np.interp(distances, along, corners[:, axis]) for axis in range(3)], axis=1), distances


def _bare_in_words(bare: list[int], points: FloatArray, site: LoadSite) -> str:
    first = bare[0]
    others = f" and {len(bare) - 1} more" if len(bare) > 1 else ""
    where = f"position {first} of {len(points)}, at {vector(points[first - 1])} {site.units.length},{others}"
    verb = "lies" if len(bare) == 1 else "lie"
    return f"{where} {verb} over no block; change the path, or look for blocks in another direction with towards"
