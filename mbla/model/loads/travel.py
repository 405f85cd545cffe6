"""A force that travels: its positions along a path, each footprint on the block under it, or through fill on several.

Positions lie at equal distances along the path, both ends among them. The load case NAME becomes NAME@01, NAME@02, ...:
a name of the deck cannot have an @, files and HDF5 groups can.

Axles follow the first force at distances along the path. The positions then go from the first at the beginning of the
path to the last at its end; of each position those forces act that are on the path, ends included.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from pydantic import Field

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Direction, Force, Name, Point, Positions, PositiveLength
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.deck.sections.vehicles import CONTACT, DOWN, TOWARDS, WIDTH, Axle
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.applied_load import AppliedLoad, joined_patches
from mbla.model.fill.dispersal import Spread
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_footprint import LoadFootprint
from mbla.model.loads.load_kind import CaseKind, Entry, LoadSite, Variant
from mbla.model.loads.spreads import most_laden, on_blocks, share_of
from mbla.model.loads.tread import Tread, level
from mbla.model.loads.vehicle import Axles, axles_in_row, axles_of, remark_upwards
from mbla.model.selectors import select_blocks
from mbla.model.soil.names import carriers_in_words
from mbla.model.wording import vector
from mbla.questions.travel import Travel as TravelQuestion
from mbla.questions.travel_position import TravelPosition

ON_PATH = 1e-9
"""share of the length of a path within which a force at its end is on it: distances are sums with rounding"""
AXLES = (
    "forces that follow the first one, as the axles of a lorry; none acts before it is on the path and beyond its end"
)


@exactly_one_of("force", "vehicle")
class Travel(Section):
    """A force, or several in a row, along a path: a load case for each position, and the worst of them."""

    force: tuple[Force, Force, Force] | None = Field(
        None, description="the force; it acts where the path is drawn, with its moment"
    )
    vehicle: Name | None = Field(None, description="or a vehicle of section vehicles")
    path: list[Point] = Field(min_length=2, description="corners of the path")
    positions: Positions = Field(
        description="positions at equal distances along the path, its ends among them; with axles from the first force "
        "at the beginning of the path to the last axle at its end"
    )
    axles: list[Axle] | None = Field(None, min_length=1, max_length=100, description=AXLES)
    width: PositiveLength | None = Field(None, description=WIDTH)
    contact: PositiveLength | None = Field(None, description=CONTACT)
    towards: Direction = Field(DOWN, description=TOWARDS)


@rule(Travel)
def sound_path(load: Travel) -> Iterator[Finding]:
    """A path goes on; a vehicle has axles of its own."""
    for number, (before, here) in enumerate(pairwise(load.path), start=1):
        if before == here:
            yield Finding("degenerate-line", "must not be the corner before it", "path", number)
    if load.vehicle is not None:
        for key in given(load, ("axles", "width", "contact")):
            yield Finding("key-of-another-choice", f"belongs to vehicles.{load.vehicle}: give it there", key)


def travel_variants(
    name: str, entry: Entry, dead: Sequence[Entry], dead_load: FloatArray, site: LoadSite
) -> list[Variant]:
    """The load at every position; none where a fault was left, as for positions over no block."""
    travel: Travel = entry.value
    through, on = entry.load.through, entry.load.on
    chosen: IntArray | None = np.arange(len(site.blocks))
    if on is not None:
        chosen = select_blocks(on, (*entry.path, "on"), site.selection)
    if chosen is None or (through is not None and through not in site.fill):
        return []
    axles, path = _axles(travel, site), (*entry.path, "travel")
    vehicle = vehicle_on_path(travel, axles.behind)
    empty = [number for number, (_, _, acting) in enumerate(vehicle, start=1) if not acting.any()]
    if empty:
        words = (
            f"at position {empty[0]} of {len(vehicle)} no force is on the path: make it longer than the gaps between "
            "them"
        )
        site.refuse(Finding("load-beside-structure", words, *path, "axles" if travel.vehicle is None else "vehicle"))
        return []
    _remark_off_path(entry.factor * axles.forces, [acting for _, _, acting in vehicle], path, site)
    below, fill = Below(site.blocks, np.array(travel.towards), chosen), site.fill[through] if through else None
    footprint = LoadFootprint(below, fill, path, site, travel.vehicle or "")
    steps = np.diff(np.array(travel.path), axis=0)
    if not all(footprint.sound(axles.forces, step, axles.tread) for step in steps):
        return []
    before = len(site.selection.faults)
    found = [_landed(footprint, travel, axles.tread, *each) for each in vehicle]
    bare = [(number, place) for number, (_, place) in enumerate(found, start=1) if place is not None]
    if bare and len(site.selection.faults) == before and not site.selection.partial:
        _refuse_bare(bare, len(vehicle), footprint, axles.tread)
    if bare:
        return []
    positions, forces = [], entry.factor * axles.forces
    for number, ((points, distances, _), (landed, _)) in enumerate(zip(vehicle, found, strict=True), start=1):
        if footprint.through is not None:
            points[:, 2] = footprint.through.tops(points)
        under = np.array([most_laden(each) for each in landed])
        spread = footprint.through is not None or axles.tread != Tread()
        position = TravelPosition(name, number, len(vehicle), points, distances, forces, under, spread)
        applied = replace(_applied(position, landed, footprint, axles.tread, travel), follows=entry.load.follows)
        positions.append(Variant(applied, TravelQuestion(position)))
    _remark_parts(name, axles.forces, [landed for landed, _ in found], footprint)
    return positions


def _axles(travel: Travel, site: LoadSite) -> Axles:
    """Its own, or those of the vehicle that it names."""
    if travel.vehicle is not None:
        return axles_of(site.vehicles[travel.vehicle])
    assert travel.force is not None  # a rule of the deck: a force, or a vehicle
    return axles_in_row(travel.force, travel.axles or [], Tread((travel.contact or 0.0, travel.width or 0.0)))


Landed: TypeAlias = Sequence[Spread | None]
"""where each axle lands; None off the path"""


def _landed(
    footprint: LoadFootprint, travel: Travel, tread: Tread, points: FloatArray, distances: FloatArray, acting: BoolArray
) -> tuple[Landed, FloatArray | None]:
    """Where the axles land, and the first place, (3,), where one lies over no block; on fill, where all of them do."""
    found: list[Spread | None] = [None] * len(points)
    bare = []
    for axle in np.flatnonzero(acting).tolist():
        found[axle] = footprint.of_axle(points[axle], _level_way(travel, float(distances[axle])), tread)
        if found[axle] is None:
            bare.append(points[axle])
    if not bare and not any(each is not None and len(each.blocks) for each in found):
        bare.append(points[acting][0])
    return found, bare[0] if bare else None


def _level_way(travel: Travel, distance: float) -> FloatArray:
    """The level direction of the path at a distance from its beginning, (3,) unit."""
    steps = np.diff(np.array(travel.path), axis=0)
    ends = np.cumsum(np.linalg.norm(steps, axis=1))
    return level(steps[min(int(np.searchsorted(ends, distance)), len(steps) - 1)])


def _remark_off_path(forces: FloatArray, acting: Sequence[BoolArray], path: KeyPath, site: LoadSite) -> None:
    """A notice of axles that are beyond the ends of the path, where they do not act; one of those that point upwards.

    forces : (n_axles, 3); acting : of each position, (n_axles,)
    """
    where = ".".join(map(str, path))
    off = [number for number, there in enumerate(acting, start=1) if not there.all()]
    if off:
        sizes = np.linalg.norm(forces, axis=1)
        shares = [float(sizes[~acting[number - 1]].sum() / sizes.sum()) for number in off]
        most = int(np.argmax(shares))
        words = (
            f"{where}: at {len(off)} of {len(acting)} positions axles are beyond the ends of the path and do not act, "
            f"at position {off[most]} {100 * shares[most]:.3g} % of the whole force: the path is where axles stand"
        )
        site.selection.remark(Notice("notice", "axles-beyond-path", words))
    remark_upwards(forces, where, site)


def _refuse_bare(bare: list[tuple[int, FloatArray]], count: int, footprint: LoadFootprint, tread: Tread) -> None:
    (first, point), more = bare[0], len(bare) - 1
    over = footprint.bare_words(point, tread, "change the path")
    words = (
        f"position {first} of {count}, at {vector(point)} {footprint.site.units.length},"
        f"{f' and {more} more lie' if more else ' lies'} {over}"
    )
    footprint.site.refuse(Finding("load-beside-structure", words, *footprint.path))


def _applied(
    position: TravelPosition, landed: Landed, footprint: LoadFootprint, tread: Tread, travel: Travel
) -> AppliedLoad:
    """The forces on the path, on the blocks they land on, which may be the same for some."""
    site, units = footprint.site, footprint.site.units
    there = [(axle, each) for axle, each in enumerate(landed) if each is not None and len(each.blocks)]
    blocks, wrenches = on_blocks([each for _, each in there], position.forces[[axle for axle, _ in there]], site)
    through = tread.words(units)
    through += f" through fill {footprint.through.name}" if footprint.through is not None else ""
    each_on = [
        f"force {vector(position.forces[axle])} {units.force} at {vector(position.points[axle])} {units.length}"
        f"{through} on {carriers_in_words(each.blocks, site.blocks)}"
        for axle, each in there
    ]
    words = f"position {position.number} of {position.count}"
    if len(landed) > 1:
        words += f", first axle {position.distance:.6g} {units.length} along the path"
    off = sum(each is None for each in landed)
    words += f", {off} of {len(landed)} axles off the path" if off else ""
    apart = not position.spread and len(blocks) == sum(len(each.blocks) for _, each in there)
    ways = [_level_way(travel, float(distance)) for distance in position.distances]
    patches = [
        footprint.patches_of(position.points[axle], ways[axle], tread, position.forces[axle], each)
        for axle, each in there
    ]
    return AppliedLoad(
        blocks, wrenches, f"{' and '.join(each_on)}, {words}", at_point=apart, patches=joined_patches(patches)
    )


def _remark_parts(name: str, forces: FloatArray, positions: Sequence[Landed], footprint: LoadFootprint) -> None:
    """The positions at which most of the load goes beyond the ends of the blocks, and meets others, if some does."""
    acting = [[axle for axle, each in enumerate(landed) if each is not None] for landed in positions]
    there = [[each for each in landed if each is not None] for landed in positions]
    for remark, part in ((footprint.remark_beyond, "beyond"), (footprint.remark_met, "met")):
        shares = [
            share_of(forces[axles], [getattr(each, part) for each in own])
            for axles, own in zip(acting, there, strict=True)
        ]
        worst = int(np.argmax(shares))
        words = f"{name}: at position {worst + 1} of {len(shares)}, where it is most"
        remark(words, forces[acting[worst]], there[worst])


def vehicle_on_path(travel: Travel, behind: FloatArray) -> list[tuple[FloatArray, FloatArray, BoolArray]]:
    """For each position of all axles: their points (n, 3), distances from the beginning of the path (n,), and which of
    them are on it (n,), ends included; the others stand straight on from its ends.

    behind : (n,) distance of each axle behind the first
    """
    corners = np.array(travel.path)
    steps = np.diff(corners, axis=0)
    along = np.append(0.0, np.cumsum(np.linalg.norm(steps, axis=1)))
    ways = steps[[0, -1]] / np.linalg.norm(steps[[0, -1]], axis=1, keepdims=True)
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


register_load(
    CaseKind(
        name="travel",
        section=Travel,
        description="force at one position after the other",
        after="loads",
        takes=("through", "follows"),
        names={"vehicle": "vehicle"},
        variants=travel_variants,
    )
)
