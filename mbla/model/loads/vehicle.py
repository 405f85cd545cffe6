"""The axles of a vehicle, and load `vehicle`: one that stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray, IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Direction, Name, Point
from mbla.deck.section import Section
from mbla.deck.sections.vehicles import DOWN, TOWARDS, Axle, Vehicle
from mbla.errors import Finding
from mbla.model.applied_load import AppliedLoad, joined_patches
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_footprint import LoadFootprint
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite
from mbla.model.loads.spreads import on_blocks
from mbla.model.loads.tread import Tread, level
from mbla.model.soil.names import carriers_in_words
from mbla.model.solids.plane import unit
from mbla.model.wording import counted, vector


class VehicleLoad(Section):
    """A vehicle that stands on the structure, or on fill."""

    name: Name = Field(description="which of section vehicles")
    at: Point = Field(description="where its first axle stands")
    along: Direction = Field(
        (1.0, 0.0, 0.0), description="the way that it looks: the other axles stand behind the first one"
    )
    towards: Direction = Field(DOWN, description=TOWARDS)


@dataclass(frozen=True)
class Axles:
    """Forces in a row.

    forces : (n, 3), the first one first
    behind : (n,) distance of each behind the first
    tread  : how each stands
    """

    forces: FloatArray
    behind: FloatArray
    tread: Tread


def axles_in_row(force: Sequence[float], others: Sequence[Axle], tread: Tread) -> Axles:
    """Axles by the force of the first one, (3,), and those behind it."""
    forces = np.array([force, *(axle.force for axle in others)])
    return Axles(forces, np.array([0.0, *(axle.behind for axle in others)]), tread)


def axles_of(vehicle: Vehicle) -> Axles:
    """Axles of a vehicle of the deck."""
    tread = Tread((vehicle.contact or 0.0, vehicle.width or 0.0))
    if vehicle.wheels is not None:
        tread = Tread(vehicle.wheels.contact or (0.0, 0.0), vehicle.wheels.gauge)
    return axles_in_row(vehicle.force, vehicle.axles, tread)


def remark_upwards(forces: FloatArray, where: str, site: LoadSite) -> None:
    """A warning of axles, (n, 3), that lift the structure, as a sign that was forgotten does."""
    up = np.flatnonzero(forces[:, 2] > 0.0)
    if len(up):
        words = f"{where}: {counted(len(up), 'axle')} {'points' if len(up) == 1 else 'point'} upwards, z is up"
        site.warn("axle-upwards", f"{words}: write a negative z if it is a weight")


def vehicle_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """All axles of a vehicle where they stand; a fault where one lies over no block, in fill where all do."""
    stands: VehicleLoad = entry.value
    name, axles = entry.load.through, axles_of(site.vehicles[stands.name])
    if name is not None and name not in site.fill:
        return None  # its blocks could not be built
    through = None if name is None else site.fill[name]
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    here = (*entry.path, "vehicle")
    remark_upwards(entry.load.factor * axles.forces, ".".join(map(str, here)), site)
    below = Below(site.blocks, np.array(stands.towards), chosen)
    footprint = LoadFootprint(below, through, here, site, stands.name)
    way = unit(stands.along)
    if not footprint.sound(axles.forces, way, axles.tread):
        return None
    places, before = np.array(stands.at) - axles.behind[:, None] * way, len(site.selection.faults)
    found = [footprint.of_axle(place, level(way), axles.tread) for place in places]
    words = f"vehicle {stands.name} at {vector(stands.at)} {site.units.length} along {vector(way)}"
    bare = [place for place, each in zip(places, found, strict=True) if each is None]
    if bare or not any(each is not None and len(each.blocks) for each in found):
        if len(site.selection.faults) == before and not site.selection.partial:
            message = "all of it goes beyond the blocks under the fill: move it"
            if bare:
                where = f"at {vector(bare[0])} {site.units.length}"
                message = f"the axle {where} lies {footprint.bare_words(bare[0], axles.tread, 'move it')}"
            site.refuse(Finding("load-beside-structure", message, *here))
        return None
    landed = [each for each in found if each is not None]
    unique, total = on_blocks(landed, axles.forces, site)
    stood = zip(places, axles.forces, landed, strict=True)
    patches = [footprint.patches_of(place, level(way), axles.tread, *each) for place, *each in stood]
    footprint.remark_beyond(words, axles.forces, landed)
    footprint.remark_met(words, axles.forces, landed)
    spread = axles.tread.words(site.units) + ("" if through is None else f" through fill {through.name}")
    words = f"{words}, {counted(len(places), 'axle')}{spread} on {carriers_in_words(unique, site.blocks)}"
    return AppliedLoad(unique, total, words, patches=joined_patches(patches))


register_load(
    LoadKind(
        name="vehicle",
        section=VehicleLoad,
        description="a vehicle that stands",
        after="pressure",
        takes=("through",),
        names={"name": "vehicle"},
        build=vehicle_load,
        mirrored=True,
    )
)
