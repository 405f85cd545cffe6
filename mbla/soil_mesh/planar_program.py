"""The kinematic program of a planar scene as a linear cone program, and its solution.

Unknowns are the ways q of the bodies, p at ends that resist slip, and d at ends that can be crushed; half-lines alone::

    P_L(q) = 1,   s − p ≤ 0,   −s − p ≤ 0,   −j + μ p − d ≤ 0,   −d ≤ 0

(:mod:`~mbla.soil_mesh.planar_scene`). The cost is divided by its greatest entry.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import areas_of
from mbla.program.kinematic import ConeProgram
from mbla.soil_mesh.planar_scene import NOTHING, PlanarScene, cross, edge_lines
from mbla.soil_mesh.strips import strip_loads
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, IterationRecord, Status

SETTINGS = SolverSettings(tolerance=1e-8, max_iterations=200)
"""of one program"""


@dataclass(frozen=True)
class PlanarProgram:
    """Linear program of a scene; the first row is the live power, all others are half-lines with 0 on the right.

    cost, live : (n_unknowns,)
    rows       : (n_rows, n_unknowns) half-lines: rows·x ≤ 0
    slipping   : (n,) ends that have a p, as rows of (n_edges, 2)
    crushing   : (m,) ends that have a d
    """

    cost: FloatArray
    live: FloatArray
    rows: sp.csr_array
    slipping: IntArray
    crushing: IntArray


@dataclass(frozen=True)
class Mechanism:
    """Solution of the program: an upper load factor and the motions that give it a live power of 1.

    load_factor : -inf where dead loads alone have no equilibrium; then all motions are zero
    motions : (n_bodies, 3) u and ω
    slips   : (n_edges, 2) p at both ends; overlaps : (n_edges, 2) d
    """

    load_factor: float
    motions: FloatArray
    slips: FloatArray
    overlaps: FloatArray


def jump_rows(scene: PlanarScene, points: FloatArray) -> tuple[sp.csr_array, sp.csr_array]:
    """Slip s and opening j at ends of edges, rows of (n_edges, 2), from the ways; both (2 n_edges, n_ways)."""
    lines, shape = edge_lines(scene, points), (2 * len(scene.edges), 3 * len(scene.centres))
    jumps = []
    for direction in (lines.tangents, lines.normals):
        values, rows, columns = [], [], []
        for end in range(2):
            for side, sign in ((0, 1.0), (1, -1.0)):
                here = np.flatnonzero(scene.sides[:, side] != NOTHING)
                body = scene.sides[here, side]
                arm = lines.ends[here, end] - scene.centres[body]
                own = np.column_stack([direction[here], cross(arm, direction[here])])
                values.append(sign * own.ravel())
                rows.append(np.repeat(2 * here + end, 3))
                columns.append((3 * body[:, None] + np.arange(3)).ravel())
        entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
        jumps.append(sp.csr_array(sp.csr_array(entries, shape=shape) @ scene.ways))
    return jumps[0], jumps[1]


def loads_at(scene: PlanarScene, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Dead and live forces and moments about centres, (n_bodies, 3), weight of cells and strips included."""
    n = len(scene.triangles)
    areas = areas_of(scene.triangles, points)
    arms = points[scene.triangles].mean(axis=1) - scene.centres[:n]
    loads = []
    parts = (
        (scene.dead, scene.dead_density, scene.dead_strips),
        (scene.live, scene.live_density, scene.live_strips),
    )
    for own, density, strips in parts:
        load = own.copy()
        load[:n] += areas[:, None] * np.column_stack([density, cross(arms, density)])
        loads.append(load + strip_loads(scene, points, strips))
    return loads[0], loads[1]


def planar_program(scene: PlanarScene, points: FloatArray) -> PlanarProgram:
    """The program of a scene whose points, (n_points, 2), are given."""
    dead, live = loads_at(scene, points)
    slips, openings = jump_rows(scene, points)
    half = np.repeat(edge_lines(scene, points).lengths / 2.0, 2)
    friction, cohesion, tension, crush = (
        np.repeat(each, 2) for each in (scene.friction, scene.cohesion, scene.tension, scene.compressive_strength)
    )
    slipping = np.flatnonzero((friction > 0.0) | (cohesion > 0.0))
    crushing = np.flatnonzero(np.isfinite(crush))
    n, n_p, n_d = len(half), len(slipping), len(crushing)
    eye_p, eye_d = sp.eye_array(n_p), sp.eye_array(n_d)
    on_p = sp.csr_array((friction[slipping], (slipping, np.arange(n_p))), shape=(n, n_p))
    on_d = sp.csr_array((np.ones(n_d), (crushing, np.arange(n_d))), shape=(n, n_d))
    blocks: list[list[sp.sparray | None]] = [
        [slips[slipping], -eye_p, None],
        [-slips[slipping], -eye_p, None],
        [-openings, on_p, -on_d],
        [sp.csr_array((n_d, slips.shape[1])), None, -eye_d],
    ]
    cost = np.concatenate([
        openings.T @ (half * tension) - scene.ways.T @ dead.ravel(),
        (half * (cohesion - tension * friction))[slipping],
        (half * (crush + tension))[crushing],
    ])  # fmt: skip
    power = np.concatenate([scene.ways.T @ live.ravel(), np.zeros(n_p + n_d)])
    return PlanarProgram(cost, power, sp.csr_array(sp.block_array(blocks)), slipping, crushing)


def with_unit_live_load(scene: PlanarScene, points: FloatArray) -> tuple[PlanarScene, float]:
    """The scene with live loads of at most 1, and their unit, by which its load factors are too large."""
    unit = float(np.abs(loads_at(scene, points)[1]).max(initial=0.0)) or 1.0
    strips = scene.live_strips / np.array([1.0, 1.0, unit, unit])
    return replace(scene, live=scene.live / unit, live_density=scene.live_density / unit, live_strips=strips), unit


def solve_linear(
    cost: FloatArray, live: FloatArray | sp.csr_array, rows: sp.csr_array, rhs: FloatArray
) -> tuple[FloatArray, float] | None:
    """Solution x of min cost·x, live·x = 1 of each row of live, rows·x ≤ rhs, and the minimum, -inf where it has none;
    None where no x does that, or the solver finds none.
    """
    unit = float(np.abs(cost).max(initial=0.0)) or 1.0
    equal = sp.csr_array(live[None, :]) if isinstance(live, np.ndarray) else live
    matrix, ones = sp.csc_array(sp.vstack([equal, rows])), np.ones(equal.shape[0])
    program = ConeProgram(cost / unit, matrix, np.concatenate([ones, rhs]), len(rhs), 0, n_equations=len(ones))
    solution = ClarabelProgram(program, SETTINGS, _unheard).solve_once(0, 1.0)
    if solution.status is Status.NO_EQUILIBRIUM:
        return np.zeros(len(cost)), -np.inf
    return (solution.x, solution.objective * unit) if solution.status in WITH_VALUE else None


def find_mechanism(scene: PlanarScene, points: FloatArray) -> Mechanism | None:
    """The mechanism of the least load factor; None where nothing can move."""
    program = planar_program(scene, points)
    solved = solve_linear(program.cost, program.live, program.rows, np.zeros(program.rows.shape[0]))
    if solved is None:
        return None
    x, load_factor = solved
    n, n_p = scene.ways.shape[1], len(program.slipping)
    slips, overlaps = np.zeros(2 * len(scene.edges)), np.zeros(2 * len(scene.edges))
    slips[program.slipping], overlaps[program.crushing] = x[n : n + n_p], x[n + n_p :]
    motions = (scene.ways @ x[:n]).reshape(-1, 3)
    return Mechanism(load_factor, motions, slips.reshape(-1, 2), overlaps.reshape(-1, 2))


def _unheard(record: IterationRecord) -> None:
    """Iterations of these programs are told to nobody."""
