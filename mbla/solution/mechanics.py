"""From the variables of a program to forces, velocities, mechanism and modes of the whole model."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.solution.solution import ContactMode, Mechanics


def mechanics_of(program: Program, load_factor: float, forces: FloatArray, velocities: FloatArray) -> Mechanics:
    """Mechanics of the model from the program's load factor, forces (3 n_points,) and block velocities (6 n_free,)."""
    scaling = program.scaling
    velocities = velocities / (program.live_load @ velocities)
    physical = scaling.velocities(velocities).ravel()
    matrix = program.equilibrium_matrix
    # the rows of the matrix carry the program's units; undo them to get velocities in the deck's units
    contact_velocities = (matrix.T @ (physical / (scaling.row * scaling.force))).reshape(-1, 3)
    contact_forces = scaling.forces(forces)
    return Mechanics(
        load_factor=scaling.load_factor(load_factor),
        contact_forces=contact_forces,
        contact_velocities=contact_velocities,
        mechanism=program.mechanism(velocities),
        modes=contact_modes(contact_forces, contact_velocities),
    )


def contact_modes(contact_forces: FloatArray, contact_velocities: FloatArray) -> IntArray:
    """Mode of every contact point, (n_points,).

    Complementarity leaves one of two small: a point is open where its opening velocity over the largest contact speed
    exceeds its normal force over the largest one, else it slides where its sliding speed is not negligible. Ratios, not
    a threshold on velocities, so that the verdict does not depend on how far the solver went.
    """
    normal_force, normal_velocity = contact_forces[:, 0], contact_velocities[:, 0]
    sliding = np.hypot(contact_velocities[:, 1], contact_velocities[:, 2])
    speed = np.linalg.norm(contact_velocities, axis=1).max(initial=0.0)
    force = np.abs(normal_force).max(initial=0.0)
    modes = np.full(len(normal_force), ContactMode.STICK, dtype=np.int64)
    if speed == 0.0 or force == 0.0:
        return modes
    modes[sliding > 1e-5 * speed] = ContactMode.SLIDE
    opens = (normal_velocity / speed > np.maximum(normal_force / force, 0.0)) & (normal_velocity > 1e-5 * speed)
    modes[opens] = ContactMode.OPEN
    return modes
