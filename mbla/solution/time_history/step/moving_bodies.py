"""The bodies of a structure that moves in time: kinematic blocks, mass centres, inertia, and what acts on them.

Bodies move about their mass centres: momentum and angular momentum then have no common term. What the base does acts
on them as −m times the change of its velocity.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import LoadCase, Pushing
from mbla.model.motion.time_history import TimeHistory
from mbla.model.pose import Pose, turned_load
from mbla.model.solids.inertia import Inertia, inertia_of
from mbla.solution.pushover.pose.structure import PushedStructure

CENTRED = 1e-12
"""Distance of a mass centre from the centroid of its body, over the size of that, that is rounding."""


@dataclass(frozen=True)
class MovingBodies:
    """Bodies with their loads.

    structure : what moves, about mass centres
    history   : that it goes through
    masses    : (n_solids,) force per acceleration
    tensors   : (n_solids, 3, 3) of inertia about the mass centres as built, force per acceleration times length²
    """

    structure: PushedStructure
    history: TimeHistory
    masses: FloatArray
    tensors: FloatArray

    @staticmethod
    def of(assembly: Assembly, section: ContactsSection, case: LoadCase) -> MovingBodies:
        """Of a load case with a time history; what slides does not lift, whatever the flow rule of the analysis."""
        history = case.time_history
        assert history is not None  # else nothing moves in time
        n = len(assembly.model.blocks)
        none, levers = np.zeros((n, 6)), np.zeros((n, 9))
        nowhere = np.full(3, np.nan)
        following = history.dead_following
        of_loads = (history.dead_levers, levers, following, none, levers)
        push = Pushing(0.0, 0.0, 0.0, 0, np.zeros(0, np.int64), nowhere, False, *of_loads)
        posed = replace(case, pushover=push, live_load=_directions(assembly, history))
        structure = PushedStructure.of(
            with_kinematic_blocks(assembly, history.rigid), section, posed, "non_associative"
        )
        inertia = inertia_of(structure.model.blocks)
        structure, inertia = _about_mass_centres(structure.as_laws, inertia)
        unit = assembly.model.units.force_per_mass_acceleration
        return MovingBodies(structure, history, unit * inertia.masses, unit * inertia.tensors)

    @property
    def gravity(self) -> float:
        """g₀, standard gravity."""
        return self.structure.model.units.standard_gravity

    @cached_property
    def constant(self) -> FloatArray:
        """Dead loads that keep their direction, without moments, (n_solids, 3): they have a potential."""
        return self.structure.solids.loads(self.structure.case.dead_load - self.history.dead_following)[:, :3]

    @property
    def down(self) -> FloatArray:
        """Direction of the dead load, (3,); −z without any."""
        total = self.constant.sum(axis=0)
        size = float(np.linalg.norm(total))
        return np.asarray(total / size if size > 0.0 else np.array([0.0, 0.0, -1.0]))

    @cached_property
    def turns(self) -> bool:
        """Whether dead loads change with the pose: they have levers about the mass centres, or turn."""
        case, built = self.structure.case, self.structure.solids.loads(self.structure.case.dead_load)
        if self.history.dead_following.any():
            return True
        size = self.structure.solids.model.blocks.sizes * np.linalg.norm(built[:, :3], axis=1)
        own = np.einsum("ni,nj->nij", self.structure.solids.arms, case.dead_load[:, :3]).reshape(-1, 9)
        levers = np.zeros((self.structure.n_solids, 9))
        np.add.at(levers, self.structure.solids.label, own + self.history.dead_levers)
        return bool((np.abs(levers).max(axis=1) > CENTRED * np.maximum(size, 1e-300)).any())

    def dead(self, pose: Pose) -> FloatArray:
        """Dead loads at a pose, (n_solids, 6)."""
        if not self.turns:
            return np.hstack([self.constant, np.zeros((len(self.constant), 3))])
        none = np.zeros(self.structure.n_solids, dtype=np.bool_)
        return self.structure.loads_at(pose, none, 0.0)[0]

    def impulses(self, pose: Pose, begin: float, end: float) -> FloatArray:
        """Of forces over time between two instants, at a pose, (n_solids, 6)."""
        solids, total = self.structure.solids, np.zeros((self.structure.n_solids, 6))
        if not self.history.forces:
            return total
        blocks = self.structure.blocks_at(pose)
        turned = replace(solids, arms=np.einsum("nij,nj->ni", blocks.rotation, solids.arms))
        for force in self.history.forces:
            impulse = float(force.signal.integral(end) - force.signal.integral(begin))
            none = np.zeros_like(force.wrenches[:, :6])
            total += impulse * turned.loads(turned_load(force.wrenches[:, :6], force.wrenches[:, 6:], none, blocks))
        return total

    @cached_property
    def inverse_masses(self) -> FloatArray:
        """(n_solids,); 0 of what does not move."""
        moves = ~self.structure.solids.model.fixed
        return np.where(moves, 1.0 / np.where(moves, self.masses, 1.0), 0.0)

    @cached_property
    def inverse_tensors(self) -> FloatArray:
        """(n_solids, 3, 3) as built; 0 of what does not move."""
        found, moves = np.zeros_like(self.tensors), self.free
        found[moves] = np.linalg.inv(self.tensors[moves])
        return found

    def velocities(self, momenta: FloatArray, rotation: FloatArray) -> FloatArray:
        """Of momentum and angular momentum, (n_solids, 6), with inertia at a rotation; 0 of what does not move."""
        own = np.einsum("nji,nj->ni", rotation, momenta[:, 3:])
        turns = np.einsum("nij,nj->ni", rotation, np.einsum("nij,nj->ni", self.inverse_tensors, own))
        return np.hstack([momenta[:, :3] * self.inverse_masses[:, None], turns])

    def tensors_at(self, rotation: FloatArray) -> FloatArray:
        """Of inertia, for rotations (n_solids, 3, 3)."""
        return np.asarray(rotation @ self.tensors @ rotation.transpose(0, 2, 1))

    @property
    def free(self) -> IntArray:
        """Solids that may move."""
        return np.flatnonzero(~self.structure.solids.model.fixed)


def with_kinematic_blocks(assembly: Assembly, rigid: tuple[IntArray, ...]) -> Assembly:
    """The assembly in which the blocks of each kinematic block move as one body."""
    if not rigid:
        return assembly
    contacts, n = assembly.contacts, len(assembly.model.blocks)
    label = np.arange(n) if contacts.solid_of_block is None else contacts.solid_of_block.copy()
    for blocks in rigid:
        label[np.isin(label, label[blocks])] = label[blocks].min()
    label = np.unique(label, return_inverse=True)[1].ravel()
    fixed = np.zeros(int(label.max()) + 1, dtype=bool)
    fixed[label[assembly.model.fixed]] = True
    return Assembly(replace(assembly.model, fixed=fixed[label]), replace(contacts, solid_of_block=label))


def _directions(assembly: Assembly, history: TimeHistory) -> FloatArray:
    """Loads on blocks, (n_blocks, 6), that are symmetric about a plane only if all motions and forces are."""
    masses, total = assembly.model.weights, np.zeros((len(assembly.model.blocks), 6))
    for number, motion in enumerate(history.motions, 1):
        total[:, :3] += np.sqrt(number) * masses[:, None] * motion.direction
    for number, force in enumerate(history.forces, 1):
        size = float(np.abs(force.wrenches[:, :3]).sum())
        total += np.sqrt(number) / max(size, 1e-300) * float(masses.sum()) * force.wrenches[:, :6]
    return total


def _about_mass_centres(structure: PushedStructure, of_blocks: Inertia) -> tuple[PushedStructure, Inertia]:
    """The structure with its bodies about their mass centres, and their inertia."""
    solids = structure.solids
    inertia = of_blocks.joined(solids.label, solids.arms)
    off = np.where(np.abs(inertia.arms) > CENTRED * solids.model.blocks.sizes[:, None], inertia.arms, 0.0)
    if not off.any():
        return structure, inertia
    guides, blocks = solids.model.guides, solids.model.blocks
    motions = guides.motions.copy()
    motions[:, :3] += np.cross(motions[:, 3:], off[guides.blocks][:, :, None], axis=1)
    model = replace(
        solids.model,
        blocks=replace(blocks, centroids=blocks.centroids + off),
        guides=replace(guides, motions=motions),
    )
    about = RigidBodies(model, solids.contacts, solids.label, solids.arms - off[solids.label])
    return replace(structure, solids=about), inertia
