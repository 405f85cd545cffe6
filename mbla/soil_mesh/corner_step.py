r"""Where corners have to move for the load factor to become smaller: the program linearised about a mechanism.

Displacements δ of the points are unknowns of the same program beside the motions, within a bound r and so that no cell
shrinks by more than a share a of its area A,

.. math:: s + (∂s/∂x) δ, \quad j + (∂j/∂x) δ, \quad |δ| ≤ r, \quad −(∂A/∂x) δ ≤ a A,

and costs and powers grow by their derivatives times δ (Hambleton and Sloan 2013, doi:10.1016/j.compgeo.2012.07.012).
Several scenes of one mesh share δ; what is minimised is the sum of their load factors, each over its size now.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.model.soil.plane_mesh import areas_of
from mbla.soil_mesh.derivatives import area_derivatives, derivatives_at
from mbla.soil_mesh.planar_program import Mechanism, planar_program, solve_linear
from mbla.soil_mesh.planar_scene import PlanarScene

LEAST = 1e-3
"""share of the greatest load factor as which smaller ones count among several"""


def corner_step(
    scenes: Sequence[PlanarScene],
    points: FloatArray,
    mechanisms: Sequence[Mechanism],
    ways: sp.csr_array,
    bound: FloatArray,
    spare: FloatArray,
) -> FloatArray | None:
    """Displacements of the points, (n_points, 2); None where the solver finds none.

    scenes : of one mesh
    ways  : (2 n_points, n_ways) displacements that unknowns stand for
    bound : (n_ways,) greatest size of each unknown
    spare : (n_cells,) share of its area by which each may shrink
    """
    ways = sp.csr_array(ways @ sp.diags_array(bound))  # unknowns from −1 to 1
    triangles, n = scenes[0].triangles, ways.shape[1]
    if not n:
        return None
    areas = sp.diags_array(1.0 / areas_of(triangles, points)) @ area_derivatives(triangles, points)
    eye = sp.eye_array(n)
    parts = [_linearised(*each, points, ways) for each in zip(scenes, mechanisms, strict=True)]
    by_step = sp.vstack([part.by_step for part in parts] + [eye, -eye, -areas @ ways])
    own = sp.block_diag([part.rows for part in parts])
    own = sp.vstack([own, sp.csr_array((by_step.shape[0] - own.shape[0], own.shape[1]))])
    live = sp.hstack([
        sp.block_diag([sp.csr_array(part.live[None, :]) for part in parts]),
        sp.csr_array(np.stack([part.live_by_step for part in parts])),
    ])  # fmt: skip
    sizes = np.abs([each.load_factor for each in mechanisms])
    weights = sizes.max() / np.maximum(sizes, LEAST * sizes.max())
    cost = [weight * part.cost for weight, part in zip(weights, parts, strict=True)]
    cost_by_step = sum(weight * part.cost_by_step for weight, part in zip(weights, parts, strict=True))
    solved = solve_linear(
        np.concatenate([*cost, cost_by_step]),
        sp.csr_array(live),
        sp.csr_array(sp.hstack([own, by_step])),
        np.concatenate([np.zeros(by_step.shape[0] - 2 * n - len(spare)), np.ones(2 * n), spare]),
    )
    return None if solved is None else (ways @ solved[0][-n:]).reshape(-1, 2)


@dataclass(frozen=True)
class _Linearised:
    """The program of a scene, and what of it grows with the step, (…, n_ways)."""

    cost: FloatArray
    live: FloatArray
    rows: sp.csr_array
    cost_by_step: FloatArray
    live_by_step: FloatArray
    by_step: sp.csr_array


def _linearised(scene: PlanarScene, mechanism: Mechanism, points: FloatArray, ways: sp.csr_array) -> _Linearised:
    program, slopes = planar_program(scene, points), derivatives_at(scene, points, mechanism)
    slips, openings = slopes.slips @ ways, slopes.openings @ ways
    none = sp.csr_array((len(program.crushing), ways.shape[1]))
    by_step = sp.vstack([slips[program.slipping], -slips[program.slipping], -openings, none])
    cost, live = ways.T @ slopes.cost, ways.T @ slopes.live_power
    return _Linearised(program.cost, program.live, program.rows, cost, live, sp.csr_array(by_step))
