"""A force that travels: its positions along a path, each landing on the block under it.

Positions lie at equal distances along the path, both ends among them. The load case NAME becomes NAME@01, NAME@02, ...:
a name of the deck cannot have an @, files and HDF5 groups can.

Axles follow the first force at distances along the path. The positions then go from the first at the beginning of the
path to the last at its end; of each position those forces act that are on the path, ends included.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.types import Load, Travel
from mbla.errors import Message
from mbla.model.loads.blocks_under import block_under
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, sum_on_blocks, wrenches_of
from mbla.model.loads.named_loads import Entry
from mbla.model.model import TravelPosition
from mbla.model.selectors import select_blocks
from mbla.model.wording import vector

ON_PATH = 1e-9
"""share of the length of a path within which a force at its end is on it: distances are sums with rounding"""


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
    axles = axles_on_path(travel)
    empty = [number for number, (_, _, row) in enumerate(axles, start=1) if not len(row)]
    if empty:
        words = (
            f"at position {empty[0]} of {len(axles)} no force is on the path: make it longer than the gaps between them"
        )
        site.refuse((*entry.path, "travel", "axles"), Message("load-beside-structure", words))
        return None
    towards = np.array(travel.towards)
    found = [[block_under(point, towards, chosen, site.blocks)[0] for point in points] for points, _, _ in axles]
    bare = [(number, axles[number - 1][0][row.index(-1)]) for number, row in enumerate(found, start=1) if -1 in row]
    if bare:
        if not site.roster.partial:
            site.refuse(
                (*entry.path, "travel"), Message("load-beside-structure", _bare_in_words(bare, len(axles), site))
            )
        return None
    forces = entry.factor * np.array([travel.force, *(axle.force for axle in travel.axles or [])])
    loads = []
    for number, ((points, distances, row), under) in enumerate(zip(axles, found, strict=True), start=1):
        position = TravelPosition(name, number, len(axles), points[0], float(distances[0]), under[0])
        applied = _applied(forces[row], points, np.array(under), site)
        words = f"{applied.words}, position {number} of {len(axles)}"
        loads.append(PositionLoad(position, AppliedLoad(applied.blocks, applied.wrenches, words)))
    return loads


def _applied(forces: FloatArray, points: FloatArray, under: IntArray, site: LoadSite) -> AppliedLoad:
    """Forces (n, 3) at points (n, 3) on the blocks under them (n,), which may be the same for some."""
    blocks, wrenches = sum_on_blocks(under, wrenches_of(forces, points, site.blocks.centroids[under]))
    units = site.units
    each = [
        f"force {vector(force)} {units.force} at {vector(point)} {units.length} on {site.blocks.name(int(block))}"
        for force, point, block in zip(forces, points, under, strict=True)
    ]
    return AppliedLoad(blocks, wrenches, " and ".join(each))


def case_name(position: TravelPosition) -> str:
    """Name of the load case at a position: ``train@07``."""
    return f"{position.series}@{position.number:0{len(str(position.count))}d}"


def axles_on_path(travel: Travel) -> list[tuple[FloatArray, FloatArray, IntArray]]:
    """For each position the points of the forces on the path (k, 3), their distances from its beginning (k,), and
    which of the forces they are (k,), the foremost first.
    """
    corners = np.array(travel.path)
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1)))
    behind = np.array([0.0, *(axle.behind for axle in travel.axles or [])])
    order = np.argsort(behind, kind="stable")
    found = []
    for first in np.linspace(0.0, along[-1] + behind.max(), travel.positions):
        distances = first - behind[order]
        near = ON_PATH * along[-1]
        there = (distances >= -near) & (distances <= along[-1] + near)
        distances = np.clip(distances[there], 0.0, along[-1])
        points = np.stack([np.interp(distances, along, corners[:, axis]) for axis in range(3)], axis=1)
        found.append((points, distances, order[there]))
    return found


def _bare_in_words(bare: list[tuple[int, FloatArray]], count: int, site: LoadSite) -> str:
    first, point = bare[0]
    others = f" and {len(bare) - 1} more" if len(bare) > 1 else ""
    where = f"position {first} of {count}, at {vector(point)} {site.units.length},{others}"
    verb = "lies" if len(bare) == 1 else "lie"
    return f"{where} {verb} over no block; change the path, or look for blocks in another direction with towards"
