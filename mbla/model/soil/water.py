"""Ground water in soil of cells: what it lifts, what it presses on, and how much heavier it makes the soil.

The pore pressure u = γ_w (level - z) below the level acts on both sides of every joint of the soil, which carries
effective stress besides. On the closed surface of a cell it sums to the weight of the water in the place of its part
below the level, upwards at the centroid of that part; on a block to -∫ u n dA over its faces that touch cells.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.content import soils_of
from mbla.deck.deck import Deck
from mbla.deck.sections.soil import SoilWater
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.applied_load import AppliedLoad, sum_on_blocks, wrenches_of
from mbla.model.items import density_of
from mbla.model.loads.face_parts import parts_against
from mbla.model.loads.pressure import PressureLoad, pressure_wrenches
from mbla.model.selectors import BlockSelection
from mbla.model.soil.build import Soils
from mbla.model.soil.plane import SQUARE
from mbla.model.soil.soil_mesh import SoilMesh
from mbla.model.solids.blocks import NO_MASSES, PointMasses, joined_masses
from mbla.model.solids.plane import cut
from mbla.model.wording import counted

WATER = "9.81 kN/m^3"
"""its unit weight"""
NEARLY_FLOATS = 1.2
"""weight of soil over that of the water in its place, up to which it may be that without the water, by mistake"""


@dataclass(frozen=True)
class GroundWater:
    """What ground water adds to a model.

    loads  : one of each soil that it stands in
    masses : of the water in pores, beside the density of the soil above it
    """

    loads: tuple[AppliedLoad, ...] = ()
    masses: PointMasses = NO_MASSES


@dataclass(frozen=True)
class _WetSoil:
    """Soil with water: keys and their path, density of the soil and more of it below the level, weight of the water."""

    mesh: SoilMesh
    water: SoilWater
    path: KeyPath
    density: float
    more: float
    unit_weight: float

    @cached_property
    def below(self) -> tuple[FloatArray, FloatArray]:
        """Volume of the part of each cell below the level, (n,), and its centroid, (n, 3), zero where there is none."""
        mesh = self.mesh
        corners = mesh.points[mesh.triangles]
        parts = cut(corners, self.water.level - corners @ mesh.axes[:2, 2])
        to = parts - parts[:, :1]  # a fan of triangles over each
        one, other = to[:, 1:-1], to[:, 2:]
        areas = (one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]) / 2
        whole = areas.sum(axis=1)
        moments = (areas[..., None] * (one + other) / 3).sum(axis=1)
        middles = parts[:, 0] + moments / np.where(whole > 0.0, whole, 1.0)[:, None]
        width, across = np.ptp(mesh.extent), mesh.extent.mean()
        return whole * width, middles @ mesh.axes[:2] + across * mesh.axes[2]

    @property
    def words(self) -> str:
        """``soil``, or ``soil backfill``."""
        return "soil" if self.mesh.name == "soil" else f"soil {self.mesh.name}"


def ground_water(deck: Deck, soils: Soils, selection: BlockSelection) -> GroundWater:
    """The water in all soil of cells of a deck; faults and remarks go to the selection."""
    if selection.partial or soils.partial:
        return GroundWater()
    wet = list(_wet_soils(deck, soils, selection))
    is_wet = np.zeros(len(selection.blocks), dtype=bool)
    for soil in wet:
        is_wet[soil.mesh.blocks] = True
    _refuse_other_levels(deck, wet, selection)
    return GroundWater(
        tuple(_load(deck, soil, ~is_wet, selection) for soil in wet),
        joined_masses(_in_pores(soil) for soil in wet if soil.more),
    )


def _wet_soils(deck: Deck, soils: Soils, selection: BlockSelection) -> Iterator[_WetSoil]:
    """Those with water, but for those of which a fault is left."""
    materials, units = deck.content.materials, deck.units
    for mesh, (path, section) in zip(soils.meshes, soils_of(deck.content), strict=True):
        water: SoilWater | None = section.water
        if water is None:
            continue
        path = (*path, "water")
        if abs(mesh.axes[2, 2]) > SQUARE:
            words = "needs soil whose width is level"
            selection.refuse(Finding("soil-not-prismatic", words, *path))
            continue
        density = density_of(materials[section.material], units)
        saturated = density_of(materials[water.saturated or section.material], units)
        if saturated < density:
            words = f"weighs less than {section.material}, the soil above the water: give its weight with the water"
            selection.refuse(Finding("out-of-bounds", words, *path, "saturated"))
            continue
        of_water = units.convert(WATER, "unit_weight") if water.unit_weight is None else water.unit_weight
        wet = _WetSoil(mesh, water, path, density, saturated - density, of_water)
        _warn_floating(deck, wet, selection)
        yield wet


def _warn_floating(deck: Deck, soil: _WetSoil, selection: BlockSelection) -> None:
    """A weight below water that may be the one without it."""
    units = deck.units
    weight = (soil.density + soil.more) * units.standard_gravity * units.force_per_mass_acceleration
    if weight <= NEARLY_FLOATS * soil.unit_weight and soil.below[0].any():
        unit = f"{units.force}/{units.length}3"
        words = (
            f"{soil.words} below the water weighs {weight:.4g} {unit} and is lifted by {soil.unit_weight:.4g} {unit} "
            "of it: give with saturated what it weighs with the water in its pores"
        )
        selection.remark(Notice("warning", "soil-nearly-floats", words))


def _refuse_other_levels(deck: Deck, wet: list[_WetSoil], selection: BlockSelection) -> None:
    """Soils that touch have one water."""
    for number, soil in enumerate(wet):
        for other in wet[:number]:
            same = soil.water.level == other.water.level and soil.unit_weight == other.unit_weight
            if same or not _wetted(deck, soil, _of(other, selection), selection)[1].any():
                continue
            words = f"touches {other.words} with water at z = {other.water.level:.6g}, of another weight or level: "
            words += "water at rest is the same in both; put a block between them"
            selection.refuse(Finding("out-of-bounds", words, *soil.path, "level"))


def _of(soil: _WetSoil, selection: BlockSelection) -> BoolArray:
    chosen = np.zeros(len(selection.blocks), dtype=bool)
    chosen[soil.mesh.blocks] = True
    return chosen


def _load(deck: Deck, soil: _WetSoil, pressed: BoolArray, selection: BlockSelection) -> AppliedLoad:
    """What the water in a soil does to its cells and to blocks (n_blocks,) that may touch it."""
    blocks, cells = selection.blocks, soil.mesh.blocks
    volumes, centroids = soil.below
    up = np.zeros((len(cells), 3))
    up[:, 2] = soil.unit_weight * volumes
    lifted = volumes > 0.0
    lift = wrenches_of(up[lifted], centroids[lifted], blocks.centroids[cells[lifted]])
    owner, areas, wrenches = _wetted(deck, soil, pressed, selection)
    units = deck.units
    does = [f"lifts {counted(int(lifted.sum()), 'cell')}"] if lifted.any() else ["does nothing: the soil lies above"]
    if len(areas):
        does.append(f"presses on {counted(len(areas), 'face')} ({float(areas.sum()):.6g} {units.length}2)")
    words = (
        f"water in {soil.words} below z = {soil.water.level:.6g} {units.length}, {soil.unit_weight:.6g} "
        f"{units.force}/{units.length}3: {', '.join(does)}"
    )
    acted_on, total = sum_on_blocks(np.append(cells[lifted], owner), np.vstack([lift, wrenches]))
    return AppliedLoad(acted_on, total, words, of_water=True)


def _wetted(
    deck: Deck, soil: _WetSoil, pressed: BoolArray, selection: BlockSelection
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Faces of blocks (n_blocks,) that touch the soil below its level: block, area in the water, and wrench of each."""
    blocks, contacts = selection.blocks, deck.contacts
    faces = np.flatnonzero(pressed[blocks.block_of_face])
    by = _of(soil, selection)
    parts = parts_against(faces, by, blocks, contacts.tolerance, contacts.depth_allowed)
    pressure = PressureLoad.model_construct(level=soil.water.level, per_depth=soil.unit_weight)
    wrenches, areas = pressure_wrenches(parts, pressure, faces, blocks)
    wet = areas > 0.0
    return blocks.block_of_face[faces[wet]], areas[wet], wrenches[wet]


def _in_pores(soil: _WetSoil) -> PointMasses:
    """Water in the pores of each cell below the level, beside what the density of the soil has of it."""
    volumes, centroids = soil.below
    lifted = volumes > 0.0
    return PointMasses(soil.mesh.blocks[lifted], soil.more * volumes[lifted], centroids[lifted])
