"""A force that travels: its positions along a path, each landing on the block under it.

Positions lie at equal distances along the path, both ends among them. The load case NAME becomes NAME@01, NAME@02, ...:
a name of the deck cannot have an @, files and HDF5 groups can.

Axles follow the first force at distances along the path. The positions then go from the first at the beginning of the
path to the last at its end; of each position those forces act that are on the path, ends included.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.loads import Travel
from mbla.errors import Finding
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_kind import AppliedLoad, Entry, LoadSite, sum_on_blocks, wrenches_of
from mbla.model.model import TravelPosition
from mbla.model.selectors import select_blocks
from mbla.model.wording import vector

ON_PATH = 1e-9
"""share of the length of a path within which a force at its end is on it: distances are sums with rounding"""


def travel_loads(name: str, entry: Entry, site: LoadSite) -> list[tuple[TravelPosition, AppliedLoad]] | None:
    """The load at every position; None where a fault was left, as for positions over no block."""
    travel = entry.load.travel
    assert travel is not None  # what makes it this kind
    chosen: IntArray | None = np.arange(len(site.blocks))
    if entry.load.on is not None:
        chosen = select_blocks(entry.load.on, (*entry.path, "on"), site.roster)
    if chosen is None:
        return None
    vehicle = vehicle_on_path(travel)
    empty = [number for number, (_, _, acting) in enumerate(vehicle, start=1) if not acting.any()]
    if empty:
        words = (
            f"at position {empty[0]} of {len(vehicle)} no force is on the path: make it longer than the gaps between "
            "them"
        )
        site.refuse(Finding("load-beside-structure", words, *entry.path, "travel", "axles"))
        return None
    below = Below(site.blocks, np.array(travel.towards), chosen)
    forces = entry.factor * np.array([travel.force, *(axle.force for axle in travel.axles or [])])
    positions, bare = [], []
    for number, (points, distances, acting) in enumerate(vehicle, start=1):
        under = np.full(len(points), -1)
        under[acting] = below.at(points[acting])
        positions.append(TravelPosition(name, number, len(vehicle), points, distances, forces, under))
        bare += [(number, points[axle]) for axle in np.flatnonzero(acting & (under < 0))[:1]]
    if bare and not site.roster.partial:
        (first, point), more = bare[0], len(bare) - 1
        words = (
            f"position {first} of {len(vehicle)}, at {vector(point)} {site.units.length},"
            f"{f' and {more} more lie' if more else ' lies'} over no block; change the path, or look for blocks in "
            "another direction with towards"
        )
        site.refuse(Finding("load-beside-structure", words, *entry.path, "travel"))
    if bare:
        return None
    return [(position, _applied(position, site)) for position in positions]


def _applied(position: TravelPosition, site: LoadSite) -> AppliedLoad:
    """The forces on the path, on the blocks under them, which may be the same for some."""
    acting, units = position.acting, site.units
    forces, points, under = position.forces[acting], position.points[acting], position.blocks[acting]
    blocks, wrenches = sum_on_blocks(under, wrenches_of(forces, points, site.blocks.centroids[under]))
    each = [
        f"force {vector(force)} {units.force} at {vector(point)} {units.length} on {site.blocks.name(int(block))}"
        for force, point, block in zip(forces, points, under, strict=True)
    ]
    words = f"position {position.number} of {position.count}"
    if len(acting) > 1:
        words += f", first axle {position.distance:.6g} {units.length} along the path"
    off = int(np.sum(~acting))
    words += f", {off} of {len(acting)} axles off the path" if off else ""
    return AppliedLoad(blocks, wrenches, f"{' and '.join(each)}, {words}")


def case_name(position: TravelPosition) -> str:
    """Name of the load case at a position: ``train@07``."""
    return f"{position.series}@{position.number:0{len(str(position.count))}d}"


def vehicle_on_path(travel: Travel) -> list[tuple[FloatArray, FloatArray, BoolArray]]:
    """For each position of all axles: their points (n, 3), distances from the beginning of the path (n,), and which of
    them are on it (n,), ends included; the others stand straight on from its ends.
    """
    corners = np.array(travel.path)
    steps = np.diff(corners, axis=0)
    along = np.append(0.0, np.cumsum(np.linalg.norm(steps, axis=1)))
    ways = steps[[0, -1]] / np.linalg.norm(steps[[0, -1]], axis=1, keepdims=True)
    behind = np.array([0.0, *(axle.behind for axle in travel.axles or [])])
    found = []
    for first in np.linspace(0.0, along[-1] + behind.max(), travel.positions):
        distances = first - behind
        near = ON_PATH * along[-1]
        acting = (distances >= -near) & (distances <= along[-1] + near)
        distances = np.where(acting, np.clip(distances, 0.0, along[-1]), distances)
        points = np.stack([np.interp(distances, along, corners[:, axis]) for axis in range(3)], axis=1)
        points += (
            np.minimum(distances, 0.0)[:, None] * ways[0] + np.maximum(distances - along[-1], 0)[:, None] * ways[1]
        )
        found.append((points, distances, acting))
    return found
