"""Soil as the model has it: its triangles, the plane that they lie in, and the blocks that they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import PlaneMesh


class StrangeCornersError(ValueError):
    """Corners of cells that are none of the soil that they are given for."""


@dataclass(frozen=True)
class SoilCorners:
    """Where the corners of the cells of a soil are.

    size   : of the cells of the mesh that they are corners of
    points : (n, 2) in its plane; None: as they are made for the size
    moved  : whether they were moved to where the soil slips
    """

    size: float
    points: FloatArray | None
    moved: bool


@dataclass(frozen=True)
class SoilMesh(PlaneMesh):
    """Soil of rigid cells, a prism each on a triangle of a plane.

    name   : group of its cells
    size   : of its cells, as they are divided
    moved  : whether its points were moved to where the soil slips
    axes   : (3, 3) unit vectors u, v of the plane, and w = v × u across it: the point p of the plane, at the distance t
             across, is p0 u + p1 v + t w
    extent : (2,) of the cells across the plane, from and to
    first  : block that the first triangle is; those of the others follow in order
    joint, wall_joint : names of the joint laws between its cells, and between these and other blocks
    """

    name: str
    size: float
    moved: bool
    axes: FloatArray
    extent: FloatArray
    first: int
    joint: str
    wall_joint: str

    @property
    def corners(self) -> SoilCorners:
        """What the mesh is built of again."""
        return SoilCorners(self.size, self.points, self.moved)

    @property
    def blocks(self) -> IntArray:
        """Block of each triangle, (m,)."""
        return self.first + np.arange(len(self.triangles))
