"""Soil as blocks: a prism on each triangle of a region, their joint laws, and the ground that holds them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import FloatArray
from mbla.deck.section import ROUNDING
from mbla.deck.sections.fill import Fill
from mbla.deck.sections.soil import SHARE_OF_WALL, SoilCells, laws_of_soil
from mbla.errors import Finding
from mbla.model.blocks.generated import ItemRefused
from mbla.model.blocks.soil import CELL, SoilItem
from mbla.model.model import Ground, Joint
from mbla.model.soil.mesh import ALONG, AREA, CellSize, NotConformingError, triangulate
from mbla.model.soil.plane_mesh import PlaneMesh
from mbla.model.soil.region import HeldEdge, Region, tops_of
from mbla.model.soil.soil_mesh import SoilCorners, SoilMesh
from mbla.model.solids.blocks import Blocks, labels_of
from mbla.model.solids.build import Labels, build_blocks
from mbla.model.solids.polyhedra import Polyhedra, chains, in_space

MOST = 100_000
"""cells of one soil that can be handled"""


@dataclass(frozen=True)
class Soil:
    """One soil: its mesh, its cells as blocks, its joint laws, and ground that it brings along."""

    mesh: SoilMesh
    cells: Blocks
    joints: tuple[Joint, Joint]
    grounds: tuple[Ground, ...]


def refuse_larger(region: Region, cells: SoilCells) -> None:
    """Refuse cells of a size that is larger than the region, or than those along its top."""
    size = cells.size
    if cells.top is not None and cells.top > size:
        raise ItemRefused(Finding("out-of-bounds", f"must be <= {size:.6g}, the size below", "cells", "top"))
    left, low, right, high = shapely.total_bounds(region.polygons)
    long = max(right - left, high - low)
    if size > long * (1 + ROUNDING):
        words = f"must be <= {long:.6g}, the greatest extent of the soil: cells are a small part of it"
        raise ItemRefused(Finding("out-of-bounds", words, "cells", "size"))


def mesh_of(region: Region, cells: SoilCells, size: float) -> PlaneMesh:
    """Triangles in a region, which are about a size where those of the deck are of theirs; raises ItemRefused where
    these are too many, or none fit.
    """
    about = region.area / (AREA * size**2)
    if about > MOST:
        makes = f"makes {_rounded_up(about):,.0f} cells" if about < 1e12 else "makes more than 1,000,000,000,000 cells"
        least = _rounded_up(math.sqrt(region.area / (AREA * MOST)))
        words = f"{makes}, about; at most {MOST:,} can be handled: must be >= {least:.2g}"
        raise ItemRefused(Finding("too-many-units", words, "cells", "size"))
    try:
        return triangulate(region.polygons, _sizes(region, cells, size))
    except NotConformingError:
        words = "cannot be divided into cells: two edges of its outline meet at nearly no angle"
        raise ItemRefused(Finding("soil-region", words)) from None


def _sizes(region: Region, cells: SoilCells, size: float) -> CellSize:
    """Sizes of cells: near what bears on part of a side of the region, and along its top, they may be smaller."""
    lengths = np.linalg.norm(region.bearings[:, 1] - region.bearings[:, 0], axis=1)
    sides, sizes = region.bearings, lengths / ALONG
    if cells.top is not None:
        tops = tops_of(region)
        sides = np.concatenate([sides, tops])
        sizes = np.append(sizes, np.full(len(tops), cells.top * size / cells.size))
    return CellSize(size, sides, sizes)


def _rounded_up(value: float) -> float:
    """To two digits."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / unit) * unit


def build_soil(
    section: Fill | SoilItem,
    name: str,
    region: Region,
    mesh: PlaneMesh,
    corners: SoilCorners,
    density: float,
    first: int,
    tolerance: float,
) -> Soil:
    """The soil of a section of the deck.

    mesh    : of the region, with its points where they are to be
    corners : these, and whether they were moved
    first : number of the first cell among the blocks
    """
    joint, wall = joints_of(section, name)
    soil = SoilMesh(
        points=mesh.points,
        triangles=mesh.triangles,
        along=mesh.along,
        inside=mesh.inside,
        name=name,
        size=corners.size,
        moved=corners.moved,
        axes=region.axes,
        extent=region.extent,
        first=first,
        joint=joint.name,
        wall_joint=wall.name,
    )
    count = len(mesh.triangles)
    labels = labels_of(count, positions={CELL.name: np.arange(count)})
    built = build_blocks(prisms_of(soil), Labels((name,) * count, np.full(count, density), labels), tolerance)
    if built.defects:
        defect = built.defects[0]
        words = f"makes cells that are no blocks: {built.blocks.name(defect.block)} {defect.message}"
        raise ItemRefused(Finding("soil-region", words))
    grounds = tuple(_ground(edge, soil) for edge in region.held)
    return Soil(soil, built.blocks, (joint, wall), grounds)


def prisms_of(soil: SoilMesh) -> Polyhedra:
    """Its cells, faces outwards."""
    sections = soil.points[soil.triangles]
    near, far = (in_space(sections, distance) for distance in soil.extent)
    level, up, across = soil.axes
    return chains(np.stack([far, near], axis=1) @ np.stack([level, across, up]))


def joints_of(section: Fill | SoilItem, name: str) -> tuple[Joint, Joint]:
    """The law between its cells, and that between these and other blocks."""
    own, wall = laws_of_soil(name)
    assert section.friction_angle is not None  # a rule of the deck: it is given with cells
    angle = section.wall.friction_angle
    angle = SHARE_OF_WALL * section.friction_angle if angle is None else angle
    law = Joint(
        name=own,
        friction=_tangent(section.friction_angle),
        cohesion=section.cohesion,
        tensile_strength=section.tensile_strength,
        dilatancy=_tangent(section.dilatancy),
    )
    return law, Joint(wall, _tangent(angle), section.wall.cohesion)


def _tangent(degrees: float) -> float:
    return math.tan(math.radians(degrees))


def _ground(edge: HeldEdge, soil: SoilMesh) -> Ground:
    """Ground along an edge, through the width, that carries cells only, with the law of the soil."""
    normal = edge.normal @ soil.axes[:2]
    corners: FloatArray = np.concatenate(
        [in_space(edge.ends, soil.extent[0]), in_space(edge.ends[::-1], soil.extent[1])]
    )
    corners = corners @ soil.axes[[0, 2, 1]]
    if np.cross(corners[1] - corners[0], corners[2] - corners[1]) @ normal < 0.0:
        corners = corners[::-1]
    return Ground(corners[0], normal, soil.joint, soil.blocks, f"ground {edge.label} {soil.name}", corners)
