r"""Where corners have to move for the load factor to become smaller: the program linearised about a mechanism.

Displacements δ of the points are unknowns of the same program beside the motions, within a bound r and so that no cell
shrinks by more than a share a of its area A,

.. math:: s + (∂s/∂x) δ, \quad j + (∂j/∂x) δ, \quad |δ| ≤ r, \quad −(∂A/∂x) δ ≤ a A,

and costs and powers grow by their derivatives times δ (Hambleton and Sloan 2013, doi:10.1016/j.compgeo.2012.07.012).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.soil_mesh.derivatives import area_derivatives, derivatives_at
from mbla.soil_mesh.planar_program import Mechanism, planar_program, solve_linear
from mbla.soil_mesh.planar_scene import PlanarScene, areas_of


def corner_step(
    scene: PlanarScene,
    points: FloatArray,
    mechanism: Mechanism,
    ways: sp.csr_array,
    bound: FloatArray,
    spare: FloatArray,
) -> FloatArray | None:
    """Displacements of the points, (n_points, 2); None where the solver finds none.

    ways  : (2 n_points, n_ways) displacements that unknowns stand for
    bound : (n_ways,) greatest size of each unknown
    spare : (n_cells,) share of its area by which each may shrink
    """
    program, slopes = planar_program(scene, points), derivatives_at(scene, points, mechanism)
    ways = sp.csr_array(ways @ sp.diags_array(bound))  # unknowns from −1 to 1
    slips, openings = slopes.slips @ ways, slopes.openings @ ways
    n, n_x = ways.shape[1], len(program.cost)
    none = sp.csr_array((len(program.crushing), n))
    areas = sp.diags_array(1.0 / areas_of(scene.triangles, points)) @ area_derivatives(scene.triangles, points)
    by_point = sp.vstack([slips[program.slipping], -slips[program.slipping], -openings, none])
    eye = sp.eye_array(n)
    blocks: list[list[sp.sparray | None]] = [
        [program.rows, by_point],
        [None, eye],
        [None, -eye],
        [None, -areas @ ways],
    ]
    solved = solve_linear(
        np.concatenate([program.cost, ways.T @ slopes.cost]),
        np.concatenate([program.live, ways.T @ slopes.live_power]),
        sp.csr_array(sp.block_array(blocks)),
        np.concatenate([np.zeros(program.rows.shape[0]), np.ones(2 * n), spare]),
    )
    return None if solved is None else (ways @ solved[0][n_x:]).reshape(-1, 2)
