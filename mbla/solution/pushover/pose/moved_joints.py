"""Elastic joints of a structure at any pose: one pattern from one search for contacts to the next.

A and the loads are those of the pose; the ways of the reductions stay.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.assembly.ties import with_ties
from mbla.contacts.carried import Placed, Touching
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.pose import Pose
from mbla.model.ties.ties import Ties
from mbla.program.assemble import assemble
from mbla.program.program import Program
from mbla.program.reductions.reduce import reduced_whole
from mbla.program.reductions.scene import scene_of
from mbla.program.reductions.steps import ReductionSwitches
from mbla.program.stiffness_shares import stiffness_through
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.pushover.pose.masses_at_pose import MassesAtPose
from mbla.solution.pushover.pose.matrix_at_pose import MatrixAtPose
from mbla.solution.pushover.pose.nearness import Nearness
from mbla.solution.pushover.pose.structure import PushedStructure
from mbla.solution.pushover.pose.ties_at_pose import TiesAtPose


@dataclass(frozen=True)
class JointsAt:
    """Joints at a pose.

    placed  : contact points of the surfaces
    joints  : with A and loads of the pose, those that change with the load factor in another way than in proportion
              to first order at the one given
    offsets : (components, n_points) displacements of the program: gap, positive where open, and slip
    ties    : there
    loads   : dead and live, (n_solids, 6) each, about the centroids
    """

    pose: Pose
    placed: Placed
    joints: ElasticJoints
    offsets: FloatArray
    ties: Ties
    loads: tuple[FloatArray, FloatArray]


@dataclass(frozen=True)
class History:
    """What joints remember, (components, n_points) in forces of the program.

    values : normal force that a joint would have at offset 0, shear after the last step
    slips  : (components − 1, n_points) offsets along the joint after the last step
    """

    values: FloatArray
    slips: FloatArray


@dataclass(frozen=True)
class MovedJoints:
    """Joints of what touches at a pose, wherever it moves from there.

    structure : what is pushed
    fallen    : (n_solids,) debris
    touching  : contacts of the surfaces
    model     : of the solids there, debris fixed
    contacts  : with ties
    ties      : rows of the ties of the model that are left, (n_ties,)
    full      : the program of all points
    reduced   : that of what is solved
    shares    : (n_points,) of the stiffness, mean 1
    found_at  : pose where the contacts were found
    length    : h, with which h k_N is the stiffness in units of the program
    ratio     : k_T over k_N
    """

    structure: PushedStructure
    fallen: BoolArray
    touching: Touching
    model: Model
    contacts: Contacts
    ties: IntArray
    full: Program
    reduced: Program
    areas: FloatArray
    shares: FloatArray
    length: float
    ratio: float
    found_at: Pose

    @staticmethod
    def at_pose(
        structure: PushedStructure,
        pose: Pose,
        fallen: BoolArray,
        broken: BoolArray,
        ratio: float,
        before: tuple[MovedJoints, History] | None = None,
    ) -> MovedJoints:
        """Contacts found there.

        broken : (n_ties,) ties of the model that carry nothing any more
        before : whose points stay where nothing has slid
        """
        old = None if before is None else before[0]
        opened = 0.0
        if before is not None and before[0]._joints.dilates:
            opened = float((before[0].opened(before[1]) / before[0].touching.sizes).max(initial=0.0))
        touching = structure.touching(pose, fallen, None if old is None else old.touching, opened)
        areas = structure.areas_of(touching)
        if old is not None:
            kept = touching.before >= 0
            areas[kept] = old.areas[touching.before[kept]]
        return MovedJoints.on_points(structure, pose, fallen, broken, ratio, touching, areas)

    @staticmethod
    def on_points(
        structure: PushedStructure,
        pose: Pose,
        fallen: BoolArray,
        broken: BoolArray,
        ratio: float,
        touching: Touching,
        areas: FloatArray,
    ) -> MovedJoints:
        """On contacts that were found there, with the areas that their points are as stiff as, (n_points,)."""
        rows = np.flatnonzero(~broken)
        solids = _tied(structure, pose, touching, fallen, rows)
        dead, live, _ = structure.loads_at(pose, fallen, 0.0)
        loads = replace(structure.case, dead_load=dead, live_load=live)
        full = assemble(solids.model, solids.contacts, loads, own=False).full  # guides come last
        own = rows[:0] if solids.contacts.ties is None else rows[solids.contacts.ties.rows]
        mean = float(areas.mean()) if len(areas) else float(structure.areas.mean())
        full = replace(full, facts=replace(full.facts, areas=np.append(areas, np.full(len(own), mean))))
        reduced = reduced_whole(scene_of(solids.model, solids.contacts, full), SWITCHES, solids.model.mirrors)
        stiffness = structure.stiffness * (float(full.facts.areas.mean()) if len(full.facts.areas) else mean)
        scaled = stiffness * stiffness_through(reduced) * full.scaling.live / full.scaling.force**2
        length = float(scaled.mean()) if len(scaled) else stiffness * full.scaling.live / full.scaling.force**2
        return MovedJoints(
            structure, fallen, touching, solids.model, solids.contacts, own, full, reduced, areas, scaled / length,
            length, ratio, pose
        )  # fmt: skip

    @cached_property
    def nearness(self) -> Nearness:
        """Which solids are near each other, and near the ground."""
        return Nearness(self.model.blocks, self.structure.model.grounds)

    @cached_property
    def _of_ties(self) -> TiesAtPose:
        return TiesAtPose.of(self.structure, self.contacts, self.ties, self.row_of_solid)

    @cached_property
    def _matrix(self) -> MatrixAtPose:
        return MatrixAtPose(self.touching.points.bodies, self.row_of_solid, self._of_ties, self.full, self.reduced)

    @cached_property
    def masses(self) -> MassesAtPose:
        """Where masses of the solids go among the entries of the program."""
        return MassesAtPose(self.reduced)

    @cached_property
    def mass_places(self) -> IntArray:
        """Of the entries of masses among those of the stiffness, (nnz,)."""
        return self.masses.pattern.places(self._joints.matrix)

    @cached_property
    def normal_scale(self) -> tuple[FloatArray, FloatArray]:
        """Offsets across the points of the program over those in the deck's unit, and sizes of their smaller blocks.

        (n_points,) each; ties have the mean size.
        """
        weights, scaling = abs(self.reduced.lift.normal_forces).T, self.full.scaling
        total = np.asarray(weights @ np.ones(weights.shape[1]))
        mean = float(self.structure.solids.model.blocks.sizes.mean())
        sizes = np.append(self.touching.sizes, np.full(len(self.ties), mean))
        return total * (scaling.force / scaling.live), np.asarray(weights @ sizes) / np.maximum(total, 1e-300)

    @cached_property
    def along(self) -> FloatArray:
        """Shear stiffness of the points of the program over that of joints without one of their own, (n_points,)."""
        own = np.append(self.structure.along(self.touching), np.ones(len(self.ties)))
        if (own == 1.0).all():
            return np.ones(self.n_points)
        weights = abs(self.reduced.lift.normal_forces).T
        return np.asarray((weights @ own) / (weights @ np.ones(len(own))))

    @cached_property
    def is_tie(self) -> BoolArray:
        """Which points of the program are ties, (n_points,)."""
        own = np.repeat(self.contacts.tie_points.astype(np.float64), 3)
        found = abs(self.ways[1]).T @ own
        return np.asarray(found.reshape(-1, self.components)[:, 0] > 0.0)

    @property
    def shear_stiffness(self) -> FloatArray:
        """k_T of the points of the program, (n_points,)."""
        return np.asarray(self.ratio * self.along * self.length * self.shares)

    @property
    def components(self) -> int:
        """Of a force at a contact point."""
        return self.reduced.components

    @property
    def n_points(self) -> int:
        """Of the program that is solved."""
        return self.reduced.n_points

    def there(self, pose: Pose, factor: float) -> JointsAt:
        """The joints at a pose, with loads for a load factor of the program."""
        found = self.unloaded(pose)
        row, scaling = self.full.scaling.row, self.full.scaling
        load_factor = scaling.load_factor(factor)
        dead, live, change = self.structure.loads_at(pose, self.fallen, load_factor)
        every = dead + found.loads[0], live
        linear = every[0] + load_factor * (live - change), change
        loads = [each[self.full.facts.free].ravel() for each in linear]
        ways = self.ways[0].T
        program = replace(
            found.joints.program,
            dead_load=np.asarray(ways @ (row * loads[0])),
            live_load=np.asarray(ways @ (row * loads[1] * scaling.live)),
        )
        joints = replace(found.joints, program=program, matrix=replace(found.joints.matrix, program=program))
        return replace(found, joints=joints, loads=every)

    def unloaded(self, pose: Pose) -> JointsAt:
        """The joints at a pose without loads but those of prestress, which are not in their program."""
        placed, ties = self.touching.points.at(pose), self._of_ties.at(pose)
        centres = self.structure.solids.model.blocks.centroids + pose.shift
        matrix = self._stiffness(self._matrix.entries(placed, ties, centres))
        nothing = np.zeros_like(self.reduced.dead_load)
        equilibrium = sp.csr_array(matrix.compatibility.T)
        program = replace(self.reduced, equilibrium_matrix=equilibrium, dead_load=nothing, live_load=nothing)
        joints = replace(self._joints, program=program, matrix=replace(matrix, program=program))
        offsets = np.vstack([placed.offsets, self._of_ties.offsets(ties)])
        moved = self.ways[1].T @ (offsets.ravel() * (self.full.scaling.force / self.full.scaling.live))
        always = self._of_ties.prestress_load(ties, centres)
        moved = moved.reshape(-1, self.components).T
        return JointsAt(pose, placed, joints, moved, ties, (always, np.zeros_like(always)))

    def after(self, pose: Pose, u: FloatArray) -> Pose:
        """The pose after displacements of the program, (n_rows,)."""
        return pose.after(self.twists(u))

    def twists(self, u: FloatArray) -> FloatArray:
        """Of all solids, (n_solids, 6), from displacements of the program."""
        return self.reduced.mechanism(u)

    def displacements(self, twists: FloatArray) -> FloatArray:
        """The way back, (n_rows,)."""
        return self.reduced.velocities(twists)

    def forces(self, values: FloatArray) -> FloatArray:
        """Of all points, (n_points of the full program, 3) N, from those of the program, (components, n_points)."""
        return (self.ways[1] @ values.T.ravel()).reshape(-1, 3) * self.full.scaling.force

    def opened(self, history: History) -> FloatArray:
        """How far joints that touch have opened by their slip, (n_points of the surfaces,) m."""
        free = self.forces(history.values)[: len(self.areas), 0]
        return np.asarray(free / (self.structure.stiffness * self.areas))

    @cached_property
    def prestress(self) -> FloatArray:
        """Normal force of the points of the program at no gap, as built, (n_points,): the prestress of ties."""
        forces = np.zeros((len(self.contacts.points), 3))
        if self.contacts.ties is not None:
            forces[len(self.areas) :, 0] = self.contacts.ties.senses * self.structure.model.ties.prestress[self.ties]
        return np.asarray(self.values(forces)[0])

    def values(self, forces: FloatArray) -> FloatArray:
        """The way back, (components, n_points)."""
        scaled = forces.ravel() / self.full.scaling.force
        ways = self.ways[1]
        values = (ways.T @ scaled) / np.maximum(np.asarray(ways.power(2).sum(axis=0)).ravel(), 1e-300)
        return np.asarray(values.reshape(-1, self.components).T)

    @cached_property
    def ways(self) -> tuple[sp.csr_array, sp.csr_array]:
        """U = S q and x = P y through all reductions."""
        lift = self.reduced.lift
        return lift.velocities, lift.forces

    @cached_property
    def row_of_solid(self) -> IntArray:
        """Number among the free solids, (n_solids + grounds + 1,); −1 of the others."""
        number = np.full(len(self.model.blocks) + len(self.model.grounds) + 1, -1)
        number[self.full.facts.free] = np.arange(len(self.full.facts.free))
        return number

    @cached_property
    def _joints(self) -> ElasticJoints:
        """Joints of the numbered pattern."""
        program = replace(self.reduced, equilibrium_matrix=sp.csr_array(self._matrix.numbered.T))
        dilatancy = program.limits.dilatancy_by(self.structure.flow_rule)
        ratio = self.ratio * self.along
        return ElasticJoints.of(program, self.shares, ratio, dilatancy, coupled=self.masses.coupled)

    def _stiffness(self, data: FloatArray) -> Stiffness:
        """Pattern of K with A of a pose: its entries where those of the numbered pattern are."""
        pattern = self._joints.matrix
        values = np.concatenate([[0.0], data])
        groups = tuple(
            replace(group, block=values[numbers]) for group, numbers in zip(pattern.groups, self._numbers, strict=True)
        )
        compatibility = sp.csr_array(
            (data, pattern.compatibility.indices, pattern.compatibility.indptr), shape=pattern.compatibility.shape
        )
        return replace(pattern, groups=groups, compatibility=compatibility, size=self.size)

    @cached_property
    def _numbers(self) -> list[IntArray]:
        return [group.block.astype(np.int64) for group in self._joints.matrix.groups]

    @cached_property
    def size(self) -> FloatArray:
        """(n_rows,) diagonal of A Aᵀ at the pose where contacts were found."""
        matrix = self.reduced.equilibrium_matrix
        return np.asarray(matrix.multiply(matrix).sum(axis=1))


def _tied(structure: PushedStructure, pose: Pose, touching: Touching, fallen: BoolArray, rows: IntArray) -> RigidBodies:
    """Solids at a pose, debris fixed, with some of the ties of the model, without prestress."""
    solids, ties = structure.solids_at(pose, touching.contacts), structure.ties_at(pose)
    left = replace(ties, prestress=np.zeros(len(ties))).take(rows)
    model = replace(solids.model, fixed=solids.model.fixed | fallen, ties=left, load_cases=())
    return with_ties(replace(solids, model=model))


SWITCHES = ReductionSwitches(on=True, mirror=True, points=False)
"""Planes, and halves about planes that the deck gives."""
