"""Forces and motions of the convex contact model repaired so that they prove bounds of the associative load factor.

As in ``force_repair`` and ``mechanism_repair``, with the conditions on interfaces.
*Static:* the dual variables z of the kinematic form are contact forces and the slacks of all conditions; any z in the
cones with Mᵀz = −cost is in equilibrium and within all conditions. They are rebuilt from the contact forces, moved
strictly inside and corrected in the metric of the barrier (``least_step``): by normal equations, and
where these stall by the augmented system.
*Kinematic:* blocks and, all together, interfaces move towards points strictly inside their cones.
What the repaired forces and motions prove is evaluated by ``verify_convex`` with its own statics.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.process.stopwatch import timed
from mbla.program.resultants import ConvexProgram, convex_form
from mbla.program.resultants.assemble import in_unit_of_force
from mbla.solution.associative.least_step import Equilibrium, StepOf, augmented_step, normal_step
from mbla.solution.associative.mechanism_repair import repaired_mechanisms
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.resultants.convex_slacks import slacks_of
from mbla.solution.resultants.convex_units import in_units, unit_at_collapse, units_of_unknowns

ROUNDS = 6
PROGRESS = 0.5
"""Share of the residual that a whole step must do away with at least to be followed by another."""

EQUILIBRIUM_TOLERANCE, GOOD_EQUILIBRIUM = 1e-11, 3e-10
"""Residual of Mᵀz = −cost, in mean block loads or in what a light block carries, at which corrections stop, and at
which no other start is tried; of the largest load where that is more, by a large load factor."""

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


@timed("repair")
def repaired_convex_forces(
    convex: ConvexProgram, forces: FloatArray, load_factor: float, *, sharp: bool = False
) -> tuple[FloatArray, float] | None:
    """Forces near the given ones in equilibrium and within all conditions, and the load factor that they carry.

    forces : (n_points, 3), non-dimensional like the load factor. None where no repair is found.
    sharp  : None too where they are not as near to equilibrium as ``GOOD_EQUILIBRIUM``
    """
    unit = unit_at_collapse(convex, load_factor)
    convex, forces, load_factor = in_unit_of_force(convex, unit), forces / unit, load_factor / unit
    form = convex_form(convex)
    cones = ConeVectors.of(form.cone_program)
    units = units_of_unknowns(form, convex, forces)
    cone_program = in_units(form.cone_program, units)
    rows = sp.csr_array(cone_program.matrix)
    equilibrium = Equilibrium(rows[1:], rows[[0]].toarray().ravel(), cone_program.cost)
    slacks, sizes = slacks_of(convex, form, forces), _sizes(cones, sp.csr_array(form.cone_program.matrix)[1:], units)
    loads = np.abs(equilibrium.cost) + np.abs(load_factor * equilibrium.live)
    tolerance, good = (share / min(unit, LARGEST_UNIT) for share in (EQUILIBRIUM_TOLERANCE, GOOD_EQUILIBRIUM))
    good *= max(1.0, float(loads.max(initial=0.0)))
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
    if best is None or (sharp and not least <= good):
        return None
    return form.contact_forces(best) * unit, -float(best[0]) * unit


@timed("repair")
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
        by_interface = convex.resultants.T @ kept.sum(axis=1).ravel()
        with_motions = replace(
            program,
            equilibrium_matrix=sp.csr_array(sp.vstack([program.equilibrium_matrix, -by_interface[None, :]])),
            dead_load=np.append(program.dead_load, 0.0),
            live_load=np.append(program.live_load, 0.0),
        )
        moved = list(repaired_mechanisms(with_motions, np.append(velocities, 1.0)))
        found += [(u[:-1], float(u[-1]) * kept) for u in moved]
    return found


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
