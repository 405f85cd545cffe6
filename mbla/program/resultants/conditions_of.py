"""A program with the conditions on interfaces of its model: crushing as stress blocks, torsion of uniform pressure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray
from mbla.program.conditions import Conditions, joined
from mbla.program.program import Program
from mbla.program.resultants.crushing_cones import crushing_conditions
from mbla.program.resultants.images import images_of
from mbla.program.resultants.interface_motions import CrushingInterfaces, crushing_of
from mbla.program.resultants.torsion_cones import torsion_conditions
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces


def with_conditions_of(
    program: Program, crushing: CrushingInterfaces | None, twisting: TwistingInterfaces | None
) -> Program:
    """A program of the model, reduced or not, with the conditions of interfaces; the same one where it has none.

    Points of interfaces that crush do not crush by themselves.
    """
    interfaces = crushing or twisting
    if interfaces is None or program.n_points == 0:
        return program
    full, forces = program.full, program.lift.forces
    owner = interfaces.interface_of_point
    n_interfaces = int(owner.max()) + 1
    first, motions = np.ones(n_interfaces, dtype=bool), sp.csr_array(sp.eye_array(6 * n_interfaces))
    if program.components == 3:
        images = images_of(forces, owner, n_interfaces)
        first, motions = images.first, images.motions
    found: list[Conditions] = []
    released: BoolArray = np.zeros(program.n_points, dtype=bool)
    if crushing is not None:
        of_first = replace(crushing, compression=np.where(first, crushing.compression, np.inf))
        crushes = crushing_of(program, of_first)
        if crushes is not None:
            found.append(crushing_conditions(crushes))
            released = crushes.points
    if twisting is not None and program.components == 3:
        twists = torsion_conditions(full, forces, twisting, first)
        found += [] if twists is None else [twists]
    conditions = joined(found)
    if conditions is None:
        return program
    by_torsion, by_crushing = (sp.csr_array(motions @ each) for each in conditions.motions)
    limits = program.limits.without_crushing(released)
    return replace(program, limits=limits, conditions=replace(conditions, motions=(by_torsion, by_crushing)))
