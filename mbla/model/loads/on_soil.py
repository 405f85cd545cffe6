"""Loads on soil of cells: which soil carries them, and that they have a length on it.

Where cells lie is up to the mesh: what stands on no length of their plane would act on the one cell that is under it.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.errors import Finding, KeyPath
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_kind import LoadSite
from mbla.model.soil.names import soil_name
from mbla.model.soil.soil_mesh import SoilMesh

NO_LENGTH = 1e-6
"""sine of the angle up to which a line runs across the plane of cells"""
LAY = "load it with pressure, with a vehicle that has a contact, or through a block that lies on it"


def soils_under(blocks: IntArray, site: LoadSite) -> list[SoilMesh]:
    """Soils of which some of the blocks (n,) are cells."""
    return [soil for soil in site.soils if _cells_of(soil, blocks).any()]


def refuse_without_length(blocks: IntArray, sides: FloatArray, remedy: str, path: KeyPath, site: LoadSite) -> bool:
    """Whether a load that presses along sides (n, 3) on blocks stands on no length of soil; leaves a fault.

    remedy : what to give in its place
    """
    for soil in soils_under(blocks, site):
        lengths = np.linalg.norm(sides, axis=1)
        if (np.abs(sides @ soil.axes[0]) > NO_LENGTH * lengths).any():
            continue
        words = f"stands on {soil_name(soil.name)} with no length along it, and a single cell would carry it: {remedy}"
        site.refuse(Finding("load-on-cell", words, *path))
        return True
    return False


def refuse_within_soil(below: Below, blocks: IntArray, points: FloatArray, path: KeyPath, site: LoadSite) -> bool:
    """Whether a load that lands at points (n, 3) on blocks (n,) has cells of the same soil above it; leaves a fault."""
    soils = soils_under(blocks, site)
    if not soils:
        return False
    extent = float(np.linalg.norm(np.ptp(site.blocks.vertices, axis=0)))
    here, above = below.at(points), below.at(points - extent * below.down)
    for soil in soils:
        if (_cells_of(soil, here) & _cells_of(soil, above) & (above != here)).any():
            words = f"lies within {soil_name(soil.name)} and would act on cells that others cover: draw it on the top"
            site.refuse(Finding("load-on-cell", words, *path))
            return True
    return False


def refuse_on_cells(kind: str, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> bool:
    """Whether the blocks that a load of one block is given are cells of soil; leaves a fault."""
    soils = [] if blocks is None else soils_under(blocks, site)
    if soils:
        words = f"a {kind} on {soil_name(soils[0].name)} would act on one cell, which is where the mesh puts it: {LAY}"
        site.refuse(Finding("load-on-cell", words, *path))
    return bool(soils)


def _cells_of(soil: SoilMesh, blocks: IntArray) -> BoolArray:
    return np.asarray((blocks >= soil.first) & (blocks < soil.first + len(soil.triangles)))
