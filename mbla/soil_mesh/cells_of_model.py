"""All soil of cells of a model as cells of one plane, and the way back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray
from mbla.model.applied_load import AppliedLoad
from mbla.model.model import LoadCase, Model
from mbla.model.soil.soil_mesh import SoilCorners, SoilMesh
from mbla.soil_mesh.scene_of_assembly import SAME, Cells

ALIKE = 1e-9
"""difference of unit vectors up to which planes of soils are one"""


def cells_of(model: Model) -> Cells | None:
    """Cells of all soils, one after the other; None where there are none, or their planes differ."""
    soils = model.soils
    if not soils or any(np.abs(soil.axes - soils[0].axes).max() > ALIKE for soil in soils):
        return None
    first = np.cumsum([0, *(len(soil.points) for soil in soils)])
    return Cells(
        points=np.concatenate([soil.points for soil in soils]),
        triangles=np.concatenate([soil.triangles + start for soil, start in zip(soils, first, strict=False)]),
        blocks=np.concatenate([soil.blocks for soil in soils]),
        axes=soils[0].axes,
        held=np.concatenate([soil.fixed | _at_others(soil, soils) for soil in soils]),
    )


def _at_others(soil: SoilMesh, soils: tuple[SoilMesh, ...]) -> BoolArray:
    """Corners of a soil that lie on another one."""
    points, at = shapely.points(soil.points), np.zeros(len(soil.points), dtype=bool)
    for other in soils:
        if other is not soil:
            region = shapely.union_all(shapely.polygons(other.points[other.triangles]))
            at |= shapely.dwithin(points, region, SAME * min(soil.size, other.size))
    return at


def corners_of(model: Model, cells: Cells, points: FloatArray) -> dict[str, SoilCorners]:
    """By name of the soil its corners, which were moved from those of the cells to other points (n_points, 2)."""
    found, first = {}, 0
    for soil in model.soils:
        rows = slice(first, first + len(soil.points))
        off = points[rows] - cells.points[rows]
        off = np.where(soil.inside[:, None], off, (off * soil.along).sum(axis=1, keepdims=True) * soil.along)
        found[soil.name] = SoilCorners(soil.size, soil.points + off, moved=True)
        first += len(soil.points)
    return found


def with_loaded_held(cells: Cells, model: Model, load_cases: Sequence[LoadCase]) -> Cells:
    """The cells with the corners on the outline held of those that carry loads of these load cases on their faces.

    What of such loads each cell carries hangs on where its corners are; of axles the planar scene knows how.
    """
    loads = [load for case in load_cases for load in (*case.dead, *case.live) if not _moves_along(load)]
    loaded = np.isin(cells.blocks, np.concatenate([np.empty(0, np.int64), *(load.blocks for load in loads)]))
    corners = np.zeros(len(cells.points), dtype=bool)
    corners[cells.triangles[loaded]] = True
    inside = np.concatenate([soil.inside for soil in model.soils])
    return replace(cells, held=cells.held | (corners & ~inside))


def _moves_along(load: AppliedLoad) -> bool:
    """Whether a planar scene says what of a load cells carry, wherever their corners are."""
    axles = len(load.patches.forces) and not load.patches.spreads
    return load.on_masses or load.of_water or bool(axles or len(load.on_cells.forces))
