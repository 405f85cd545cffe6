"""Forces and motions of the convex contact model repaired so that they prove bounds of the associative load factor.

As in :mod:`mbla.solution.associative.repair`, with the conditions on interfaces.
*Static:* the dual variables z of the kinematic form are contact forces and the slacks of all conditions; any z in the
cones with Mᵀz = −cost is in equilibrium and within all conditions. They are rebuilt from the contact forces, moved
strictly inside and corrected in the metric of the barrier (``least_step``): by normal equations, and
where these stall by the augmented system.
*Kinematic:* blocks and, all together, interfaces move towards points strictly inside their cones.
What the repaired forces and motions prove is evaluated by ``verify_convex`` with its own statics.

The helping unknowns of the conditions are chosen well inside their ranges, where these have an inside.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.ragged import next_item
from mbla.process.stopwatch import stage
from mbla.program.kinematic import KinematicForm
from mbla.program.program import Program
from mbla.program.resultants import ConvexProgram, convex_form
from mbla.program.resultants.conditions import ConeRows
from mbla.program.resultants.crushing import CrushingLimits, corner_values, crushing_cones
from mbla.program.resultants.torsion import TorsionLimits
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.associative.repair import repaired_mechanisms
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.resultants.convex_units import in_units, unit_at_collapse, units_of_unknowns
from mbla.solution.resultants.least_step import Equilibrium, StepOf, augmented_step, normal_step

ROUNDS = 6
PROGRESS = 0.5
"""Share of the residual that a whole step must do away with at least to be followed by another."""

EQUILIBRIUM_TOLERANCE, GOOD_EQUILIBRIUM = 1e-11, 3e-10
"""Residual of Mᵀz = −cost, in mean block loads or in what a light block carries, at which corrections stop, and at
which no other start is tried: the proof is taken with some 1e-9 of these, whatever the largest load is."""

LARGEST_UNIT = 1e5
"""Unit of force, in mean block loads, beyond which these are no more than its rounding."""

INSIDES = (1e-10, 1e-8, 1e-7)
"""Distances from the borders of the cones, relative to the size of a vector, from which corrections start: where a
whole plane slides all its forces are on their cones, and rounding keeps corrections from succeeding too close to
them. Where none of them will do, vectors of crushing are moved by as much of the unit of force: where all of an
interface is nearly crushed they are small differences of its strength and its force, which the solver knows no better
than the rest."""

THRESHOLDS = (0.0, 1e-6, np.inf)
"""Share of the largest contact speed below which the motion of an interface is taken for rounding and left out."""


@stage("repair")
def repaired_convex_forces(
    convex: ConvexProgram, forces: FloatArray, load_factor: float
) -> tuple[FloatArray, float] | None:
    """Forces near the given ones in equilibrium and within all conditions, and the load factor that they carry.

    forces : (n_points, 3), non-dimensional like the load factor. None where no repair is found.
    """
    unit = unit_at_collapse(convex, load_factor)
    convex, forces, load_factor = convex.in_unit_of_force(unit), forces / unit, load_factor / unit
    form = convex_form(convex)
    cones = ConeVectors.of(form.cone_program)
    units = units_of_unknowns(form, convex, forces)
    cone_program = in_units(form.cone_program, units)
    rows = sp.csr_array(cone_program.matrix)
    equilibrium = Equilibrium(rows[1:], rows[[0]].toarray().ravel(), cone_program.cost)
    slacks, sizes = slacks_of(convex, form, forces), _sizes(cones, sp.csr_array(form.cone_program.matrix)[1:], units)
    tolerance, good = (share / min(unit, LARGEST_UNIT) for share in (EQUILIBRIUM_TOLERANCE, GOOD_EQUILIBRIUM))
    best, least = None, np.inf
    of_crushing = np.arange(len(sizes)) >= len(sizes) - len(convex.conditions[1].cone_sizes)
    for apart, inside, step_of in product((0.0, 1.0), INSIDES, (normal_step, augmented_step)):
        distance = np.where(of_crushing, apart * inside * np.minimum(sizes, 1.0), 0.0)
        z = np.concatenate([[-load_factor], cones.pulled_inside(slacks, inside, sizes, distance)])
        z, residual = _corrected(equilibrium, cones, z, step_of, tolerance)
        if residual < least:
            best, least = z, residual
        if least <= good:
            break
    if best is None:
        return None
    return form.contact_forces(best) * unit, -float(best[0]) * unit


@stage("repair")
def repaired_convex_motions(
    convex: ConvexProgram, velocities: FloatArray, motions: FloatArray
) -> list[tuple[FloatArray, FloatArray]]:
    """Versions of the velocities of the blocks, (n_block_rows,), moved towards compatibility, with motions.

    motions : (n_interfaces, 2, 6) of the interfaces, in the program's units. They are taken as they are, without those
              that are rounding, and left out; all of them count as one more velocity, whose value is 1 at first
    """
    program, found = convex.points, [(velocities, motions)]
    speed = float(np.abs(program.equilibrium_matrix.T @ velocities).max(initial=0.0))
    size = np.abs(motions).max(axis=2, keepdims=True)
    for threshold in THRESHOLDS:
        kept = np.where(size > threshold * speed, motions, 0.0)
        together = sp.csr_array((convex.resultants.T @ kept.sum(axis=1).ravel())[None, :])
        moved = list(repaired_mechanisms(_with_motions(program, together), np.append(velocities, 1.0)))
        found += [(u[:-1], float(u[-1]) * kept) for u in moved]
    return found


def _with_motions(program: Program, motions: sp.csr_array) -> Program:
    """The program with motions of interfaces behind the velocities of the blocks: v = Aᵀu − motionsᵀ w.

    motions : (n_motions, 3 n_points)
    """
    none = np.zeros(motions.shape[0])
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(sp.vstack([program.equilibrium_matrix, -motions])),
        dead_load=np.concatenate([program.dead_load, none]),
        live_load=np.concatenate([program.live_load, none]),
    )


def _sizes(cones: ConeVectors, matrix: sp.csr_array, units: FloatArray) -> FloatArray:
    """What the vector of each cone is large beside: the least that the equations it stands in carry, (n_cones,)."""
    entries = matrix.tocoo()
    least = np.full(len(cones.sizes), np.inf)
    np.minimum.at(least, cones.cone_of_row[entries.row], units[entries.col] / np.maximum(np.abs(entries.data), 1e-300))
    return least


def _corrected(
    equilibrium: Equilibrium, cones: ConeVectors, z: FloatArray, step_of: StepOf, tolerance: float
) -> tuple[FloatArray, float]:
    """The best of the corrections of z that keep it inside the cones, and its residual."""
    best, least = z, np.inf
    for _ in range(ROUNDS):
        step = step_of(equilibrium, cones, z)
        if step is None:
            break
        longest = 0.999 * cones.step_to_boundary(z[1:], step[1:])
        z = z + min(1.0, longest) * step
        residual = float(np.abs(equilibrium.unbalanced(z)).max(initial=0.0))
        stalled = longest >= 1.0 and residual > PROGRESS * least
        if residual < least:
            best, least = z, residual
        if stalled or least <= tolerance:
            break
    return best, least


INSIDE = 1e-10
"""Share of its range by which a helping unknown keeps off the end of it."""


def slacks_of(convex: ConvexProgram, form: KinematicForm, forces: FloatArray) -> FloatArray:
    """All cone rows of z that belong to contact forces, with helping unknowns well inside their ranges."""
    limits, rows = convex.points.limits, form.rows
    x = _points_inside(limits, forces)
    strength = limits.cohesion + limits.friction * x[:, 0]
    shear = np.column_stack([strength, x[:, 1:]])
    resultants = convex.resultants_of(x)
    return np.concatenate(
        [
            x[rows.cut_off, 0] + limits.tension[rows.cut_off],
            limits.compression[rows.crushing] - x[rows.crushing, 0],
            shear[rows.dry].ravel(),
            shear[rows.frictional].ravel(),
            _torsion_slacks(convex.torsion, resultants),
            _crushing_slacks(convex.crushing, resultants),
        ]
    )


def _points_inside(limits: YieldLimits, forces: FloatArray) -> FloatArray:
    x = forces.copy()
    x[:, 0] = np.minimum(np.maximum(x[:, 0], -limits.tension), limits.compression)
    return x


def _torsion_slacks(limits: TorsionLimits, resultants: FloatArray) -> FloatArray:
    """K ± M_n/ρ;  y with Σ y = V − R, Σ y q = μ m;  (R − θk/2, T − T', (1 − θ/2) k);  (V − R, T')."""
    r = resultants[limits.interfaces]
    total = limits.friction * r[:, 0] + limits.cohesion
    moment = limits.friction[:, None] * np.column_stack([-r[:, 5], r[:, 4]])
    at_corners, least = _at_corners(limits, moment)
    share = np.maximum(total - least, 0.0) * (1.0 - INSIDE)
    evenly = _even_weights(limits)
    y = at_corners + evenly * np.maximum(total - share - least, 0.0)[_owner(limits)]
    size = np.hypot(r[:, 1], r[:, 2])
    alone = np.minimum(1.0, np.maximum(total - share, 0.0) * (1.0 - INSIDE) / np.maximum(size, 1e-300))
    apart = alone[:, None] * r[:, 1:3]
    twist, theta = r[:, 3] / limits.radii, limits.thetas
    most = _largest_twist(share, np.hypot(*(r[:, 1:3] - apart).T), theta)
    k = np.abs(twist) + 0.5 * np.maximum(most - np.abs(twist), 0.0)
    curve = np.column_stack([share - 0.5 * theta * k, r[:, 1:3] - apart, (1.0 - 0.5 * theta) * k])
    rest = np.column_stack([total - share, apart])
    both = np.column_stack([k + twist, k - twist])
    return np.concatenate([both.ravel(), y, curve.ravel(), rest.ravel()])


def _owner(limits: TorsionLimits) -> IntArray:
    """Row of the limits to which each corner belongs."""
    return np.repeat(np.arange(len(limits.interfaces)), np.diff(limits.start))


def _at_corners(limits: TorsionLimits, moment: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least forces y ≥ 0 at the corners q with Σ y q = moment, at the ends of one edge, and their sums."""
    owner, q = _owner(limits), limits.corners
    after = next_item(limits.start) if len(q) else np.zeros(0, dtype=np.int64)
    m, q_after = moment[owner], q[after]
    det = q[:, 0] * q_after[:, 1] - q[:, 1] * q_after[:, 0]
    first = (m[:, 0] * q_after[:, 1] - m[:, 1] * q_after[:, 0]) / det
    second = (q[:, 0] * m[:, 1] - q[:, 1] * m[:, 0]) / det
    inside = np.minimum(first, second)
    best = np.full(len(limits.interfaces), -np.inf)
    np.maximum.at(best, owner, inside)
    edge = np.flatnonzero(inside >= best[owner])
    edge = edge[np.unique(owner[edge], return_index=True)[1]]
    y = np.zeros(len(q))
    np.add.at(y, edge, np.maximum(first[edge], 0.0))
    np.add.at(y, after[edge], np.maximum(second[edge], 0.0))
    return y, np.asarray(np.bincount(owner, y, len(limits.interfaces)), dtype=np.float64)


def _even_weights(limits: TorsionLimits) -> FloatArray:
    """Positive weights of the corners, sum 1, whose mean is the centroid (mean value coordinates, Floater 2003)."""
    q = limits.corners
    if len(q) == 0:
        return np.zeros(0)
    after = q[next_item(limits.start)]
    cross = q[:, 0] * after[:, 1] - q[:, 1] * after[:, 0]
    half = np.tan(0.5 * np.arctan2(cross, (q * after).sum(axis=1)))
    before = np.empty_like(half)
    before[next_item(limits.start)] = half
    weight = (half + before) / np.hypot(q[:, 0], q[:, 1])
    owner = _owner(limits)
    return np.asarray(weight / np.bincount(owner, weight)[owner])


def _largest_twist(share: FloatArray, shear: FloatArray, theta: FloatArray) -> FloatArray:
    """M of the safe curve of size R at shear t."""
    room = np.maximum(share**2 - shear**2, 0.0)
    return np.asarray(
        2.0 * room / np.maximum(theta * share + np.sqrt((theta * share) ** 2 + 4 * (1 - theta) * room), 1e-300)
    )


def _crushing_slacks(limits: CrushingLimits, resultants: FloatArray) -> FloatArray:
    """The vectors of all conditions at resultants, (n_interfaces, 6)."""
    corners, rows = limits.corners, ConeRows()
    crushing_cones(limits, rows)
    lead, q = corner_values(corners, resultants)
    lead, q = np.maximum(lead, 0.0), np.maximum(q, 0.0) * (1.0 - INSIDE)
    h = np.sqrt(q[:, 0] * q[:, 1]) * (1.0 - INSIDE)
    helpers = np.concatenate([_between(lead, corners.strength, h), h, q.ravel()])
    given = rows.resultants(len(resultants)) @ resultants.ravel()
    return np.asarray(given + rows.helpers @ helpers + rows.constants)


def _between(normal: FloatArray, strength: FloatArray, h: FloatArray) -> FloatArray:
    """The unknown g between its bounds N²/(√F h) and √N."""
    least = normal**2 / np.maximum(np.sqrt(strength) * h, 1e-300)
    return np.asarray(np.sqrt(np.minimum(least, np.sqrt(normal)) * np.sqrt(normal)))
