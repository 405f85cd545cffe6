"""All soil of cells of a deck: items `soil`, then fills with cells, each beside the blocks before it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.content import soils_of
from mbla.deck.deck import Deck
from mbla.deck.sections.fill import Fill
from mbla.deck.sections.selectors import Selector
from mbla.deck.sections.soil import SOIL
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.generated import ItemRefused
from mbla.model.blocks.soil import SoilItem
from mbla.model.items import density_of
from mbla.model.model import Ground, Joint
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.soil.cells import build_soil, mesh_of, refuse_larger
from mbla.model.soil.fill_region import fill_region
from mbla.model.soil.item_region import item_region
from mbla.model.soil.plane_mesh import PlaneMesh
from mbla.model.soil.region import Region
from mbla.model.soil.soil_mesh import SoilCorners, SoilMesh, StrangeCornersError
from mbla.model.solids.append import append_blocks
from mbla.model.solids.blocks import Blocks
from mbla.model.supports.supports import plane_of


@dataclass(frozen=True)
class Soils:
    """What soil of cells adds to a structure.

    blocks  : those before it, and all cells behind them
    partial : names of soils that could not be built
    """

    blocks: Blocks
    meshes: tuple[SoilMesh, ...] = ()
    joints: tuple[Joint, ...] = ()
    grounds: tuple[Ground, ...] = ()
    partial: frozenset[str] = frozenset()


def build_soils(deck: Deck, before: BlockSelection, corners: Mapping[str, SoilCorners]) -> Soils:
    """All soil of cells of a deck beside and on the blocks of its other items; faults go to the selection.

    corners : by name of the soil, those of its cells in the place of those that are made for its size

    Raises StrangeCornersError for corners that are none of a soil.
    """
    given = list(_sections(deck))
    strange = corners.keys() - {name for name, _, _ in given}
    if strange:
        raise StrangeCornersError(f"no soil of cells has the name {', '.join(sorted(strange))}")
    if before.partial:  # what it lies on may be missing
        return Soils(before.blocks, partial=frozenset(name for name, _, _ in given))
    soils = Soils(before.blocks)
    for name, section, path in given:
        try:
            soils = _with_soil(soils, deck, before, name, section, path, corners.get(name))
        except ItemRefused as refused:
            for finding in refused.findings:
                before.refuse(finding.below(*path))
            soils = replace(soils, partial=soils.partial | {name})
    return soils


def _with_soil(
    soils: Soils,
    deck: Deck,
    before: BlockSelection,
    name: str,
    section: Fill | SoilItem,
    path: KeyPath,
    corners: SoilCorners | None,
) -> Soils:
    region = _region(soils, deck, before, section, path)
    if region is None:
        return replace(soils, partial=soils.partial | {name})
    assert section.cells is not None
    corners = SoilCorners(section.cells.size, None, moved=False) if corners is None else corners
    refuse_larger(region, section.cells)
    mesh = mesh_of(region, section.cells, corners.size)
    if corners.points is not None:
        mesh = _with_corners(mesh, corners.points, name, corners.size)
    density = density_of(deck.content.materials[section.material], deck.units)
    soil = build_soil(section, name, region, mesh, corners, density, len(soils.blocks), deck.contacts.tolerance)
    return replace(
        soils,
        blocks=append_blocks(soils.blocks, soil.cells),
        meshes=(*soils.meshes, soil.mesh),
        joints=(*soils.joints, *soil.joints),
        grounds=(*soils.grounds, *soil.grounds),
    )


ASIDE = 1e-9
"""distance over the size of cells by which corners that are moved may lie off the outline of the soil"""


def _with_corners(mesh: PlaneMesh, points: FloatArray, name: str, size: float) -> PlaneMesh:
    """The mesh with its corners elsewhere; StrangeCornersError where they change its outline or turn cells over."""
    if points.shape != mesh.points.shape:
        raise StrangeCornersError(f"soil {name} has {len(mesh.points)} corners of cells, not {len(points)}")
    off = points - mesh.points
    off = off - (off * mesh.along).sum(axis=1, keepdims=True) * mesh.along
    if np.abs(off[~mesh.inside]).max(initial=0.0) > ASIDE * size:
        raise StrangeCornersError(f"corners of cells of soil {name} are off its outline")
    if (mesh.areas(points) <= 0.0).any():
        raise StrangeCornersError(f"corners of cells of soil {name} turn cells over")
    return replace(mesh, points=points)


def _region(soils: Soils, deck: Deck, before: BlockSelection, section: Fill | SoilItem, path: KeyPath) -> Region | None:
    """What a section describes; None where a fault says which blocks it lies on."""
    tolerance = deck.contacts.tolerance
    if isinstance(section, SoilItem):
        return item_region(section, soils.blocks, tolerance)
    own = {name for name, _, _ in _sections(deck)}
    if own & set(_groups(section.on)):
        raise ItemRefused(Finding("soil-region", "is soil of cells: name blocks of other items", "on"))
    chosen = select_blocks(section.on, (*path, "on"), before)
    if chosen is None:
        return None
    return fill_region(section, soils.blocks, chosen, _levels(deck), tolerance)


def _groups(selector: Selector) -> Iterator[str]:
    """Groups that a selector names."""
    for term in selector if isinstance(selector, list) else [selector]:
        name = term if isinstance(term, str) else term.group
        if name is not None:
            yield name


def _sections(deck: Deck) -> Iterator[tuple[str, Fill | SoilItem, KeyPath]]:
    """Soils of the deck by name, with their key paths."""
    for path, soil in soils_of(deck.content):
        yield str(path[-1]) if isinstance(soil, Fill) else soil.group or SOIL, soil, path


def _levels(deck: Deck) -> FloatArray:
    """Heights of level ground under all blocks, (n,)."""
    planes = [plane_of(each.ground) for each in deck.content.supports if each.ground and each.blocks is None]
    return np.array([point[2] for point, normal, _ in planes if normal[2] >= 1.0 - 1e-12])
