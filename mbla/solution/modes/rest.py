"""The structure at rest under its dead load on joints with the stiffness of the deck, from which modes are sought.

It is the step of :mod:`mbla.solution.flow.gravity_step`, with which a structure is judged to stand, without live load
and with supports that settle later held. No symmetry is presumed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.assembly.structure_at import StructureAt
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase
from mbla.program.assemble import assemble
from mbla.program.stiffness_shares import stiffness_areas
from mbla.solution.flow.gravity_step import gravity_step
from mbla.solution.law.elastic_joints import ElasticJoints, Memory
from mbla.solution.law.stiffness_of_joints import default_stiffness, joint_stiffness

FALLS = "the structure does not stand under its dead load on elastic joints"
NOT_SOLVED = "the step of its elastic joints under the dead load was not solved"
NOTHING_TOUCHES = "nothing touches it"
NO_DEAD_LOAD = "there is no dead load that presses its joints together"


@dataclass(frozen=True)
class Rest:
    """A structure at rest.

    bodies     : what moves, with ties among the contacts; supports that settle later are fixed
    case       : dead load on the bodies, with the prestress of ties
    default    : normal stiffness of joints for which the deck gives none, force per volume
    stiffness  : (n_interfaces, 2) of interfaces across and along, force per volume; nan of ties
    points     : (n_points, 2) of contact points in the step, force per length
    settlement : (n_bodies, 6) displacements and rotations, m, rad
    gaps       : (n_points,) m of contact points before it, of ties 0
    turned     : (n_surfaces,) interfaces that are open by a motion before it
    """

    bodies: RigidBodies
    case: LoadCase
    default: float
    stiffness: FloatArray
    points: FloatArray
    settlement: FloatArray
    gaps: FloatArray
    turned: BoolArray

    @property
    def sag(self) -> float:
        """Greatest displacement of a centroid, m."""
        return float(np.linalg.norm(self.settlement[:, :3], axis=1).max(initial=0.0))


def at_rest(there: StructureAt) -> Rest | str:
    """A structure under its dead load, or why it does not rest there, in words."""
    alone, built = there.load_case.dead_alone, there.built
    bodies = there.assembly.of(alone)
    model, contacts, case = bodies.model, bodies.contacts, bodies.load_case(alone)
    if not len(contacts.points):
        return NOTHING_TOUCHES
    if not np.any(case.dead_load[model.free]):
        return NO_DEAD_LOAD
    default = default_stiffness(built.model, alone, built.glued(alone))
    stiffness = joint_stiffness(model, contacts, default)
    points = point_stiffness(contacts, stiffness)
    whole = assemble(model, contacts, replace(case, live_load=case.dead_load), own=False)  # units need a live load
    program, unit = whole.without_live_load(), float(points[:, 0].mean())
    joints = replace(ElasticJoints.of(program, points[:, 0] / unit, 1.0), shear=points[:, 1] / unit)
    gaps = there.gaps_with_ties
    before = -points[:, 0] * gaps / program.full.scaling.force
    gravity = gravity_step(joints, memory=replace(Memory.stress_free(joints), normal=before))
    if not gravity.carried:
        return FALLS if gravity.settled else NOT_SOLVED
    settlement = program.mechanism(gravity.state.u) * (program.full.scaling.force**2 / unit)
    return Rest(bodies, case, default, stiffness, points, settlement, gaps, there.turned)


def point_stiffness(contacts: Contacts, stiffness: FloatArray) -> FloatArray:
    """Of contact points across and along, (n_points, 2) force per length: by their share of the interface.

    Ties are as stiff as the mean of the points.
    """
    points = stiffness[contacts.interface_of_point] * stiffness_areas(contacts)[:, None]
    surfaces = ~contacts.tie_points
    points[~surfaces] = points[surfaces].mean(axis=0) if surfaces.any() else 1.0
    return points
