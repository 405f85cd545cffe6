"""Derivatives of a planar scene by its points against central differences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.soil_mesh.derivatives import derivatives_at, jumps_at
from mbla.soil_mesh.planar_program import Mechanism, jump_rows, loads_at
from mbla.soil_mesh.planar_scene import PlanarScene, edge_lines
from tests.soil_mesh.scenes import strip

STEP = 1e-6


def cost(scene: PlanarScene, points: FloatArray, mechanism: Mechanism) -> float:
    """What the program minimises, with motions, p and d of a mechanism."""
    lines, tension = edge_lines(scene, points), scene.tension[:, None]
    openings = jumps_at(scene, lines, mechanism.motions).openings
    shear = (scene.cohesion[:, None] - tension * scene.friction[:, None]) * mechanism.slips
    crush = (scene.compressive_strength[:, None] + tension) * mechanism.overlaps
    edges = (lines.lengths[:, None] / 2 * (shear + tension * openings + crush)).sum()
    return float(edges - (loads_at(scene, points)[0] * mechanism.motions).sum())


def quantities(scene: PlanarScene, points: FloatArray, mechanism: Mechanism) -> FloatArray:
    jumps = jumps_at(scene, edge_lines(scene, points), mechanism.motions)
    live = (loads_at(scene, points)[1] * mechanism.motions).sum()
    return np.concatenate(
        [jumps.slips.ravel(), jumps.openings.ravel(), [cost(scene, points, mechanism), live]], dtype=float
    )


@pytest.mark.parametrize("crossed", [True, False])
def test_derivatives_are_those_of_differences(crossed: bool) -> None:
    case, random = strip(20.0, 0.5, 1.5, 1.0, crossed), np.random.default_rng(1)
    cells = len(case.scene.triangles)
    densities = random.normal(size=(2, cells, 2))
    scene = replace(case.scene, dead_density=densities[0], live_density=densities[1])
    scene = replace(scene, compressive_strength=np.full(len(scene.edges), 7.0))
    points = case.points + 0.02 * random.normal(size=case.points.shape)
    n = len(scene.edges)
    motions = random.normal(size=scene.dead.shape)
    mechanism = Mechanism(1.0, motions, random.random((n, 2)), random.random((n, 2)))
    slopes = derivatives_at(scene, points, mechanism)
    exact = np.vstack([slopes.slips.toarray(), slopes.openings.toarray(), slopes.cost, slopes.live_power])
    for column in range(points.size):
        moved = np.zeros(points.size)
        moved[column] = STEP
        ahead, behind = (quantities(scene, points + sign * moved.reshape(-1, 2), mechanism) for sign in (1.0, -1.0))
        assert np.allclose(exact[:, column], (ahead - behind) / (2 * STEP), rtol=1e-6, atol=1e-7)


def test_rows_of_jumps_are_those_of_motions() -> None:
    case = strip(20.0, 0.5, 1.5, 1.0)
    motions = np.random.default_rng(2).normal(size=case.scene.dead.shape)
    slips, openings = jump_rows(case.scene, case.points)
    jumps = jumps_at(case.scene, edge_lines(case.scene, case.points), motions)
    assert np.allclose(slips @ motions.ravel(), jumps.slips.ravel())
    assert np.allclose(openings @ motions.ravel(), jumps.openings.ravel())
