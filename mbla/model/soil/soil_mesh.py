"""Soil as the model has it: its triangles, the plane that they lie in, and the blocks that they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import PlaneMesh


@dataclass(frozen=True)
class SoilMesh(PlaneMesh):
    """Soil of rigid cells, a prism each on a triangle of a plane.

    name   : group of its cells
    axes   : (3, 3) unit vectors u, v of the plane, and w = v × u across it: the point p of the plane, at the distance t
             across, is p0 u + p1 v + t w
    extent : (2,) of the cells across the plane, from and to
    first  : block that the first triangle is; those of the others follow in order
    joint, wall_joint : names of the joint laws between its cells, and between these and other blocks
    """

    name: str
    axes: FloatArray
    extent: FloatArray
    first: int
    joint: str
    wall_joint: str

    @property
    def blocks(self) -> IntArray:
        """Block of each triangle, (m,)."""
        return self.first + np.arange(len(self.triangles))
