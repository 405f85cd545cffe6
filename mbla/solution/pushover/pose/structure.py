"""The structure that is pushed: its solids as built and at a pose, what acts on them there, and where they touch."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.carried import Touching
from mbla.contacts.contacts import Contacts
from mbla.contacts.moved import MovedSearch
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import SHEAR_RATIO, LoadCase, Model
from mbla.model.pose import Pose, moved_case, moved_model
from mbla.model.ties.moved import moved_ties
from mbla.model.ties.ties import Ties
from mbla.program.reductions.scene import refined
from mbla.solution.law.stiffness_of_joints import areas_of_pairs, default_stiffness, mean_size, pair_numbers


@dataclass(frozen=True)
class PushedStructure:
    """A model that moves under a load case; solids are its blocks, those that glue joins one.

    model     : as it may move, blocks as built
    case      : on the blocks
    solids    : as built; ties are none of their contacts
    search    : of contacts wherever the blocks are
    areas     : (n_pairs,) m² of the solids that touch as built, by ``pairs``, (n_pairs,) numbers of their bodies
    stiffness : of joints, force per volume
    flow_rule : of the analysis
    of_laws   : (n_laws, 2) stiffness of joints with a law of the model over ``stiffness``, and their ratio of shear
                over normal stiffness over that of others
    """

    model: Model
    case: LoadCase
    solids: RigidBodies
    search: MovedSearch
    pairs: IntArray
    areas: FloatArray
    stiffness: float
    flow_rule: str
    of_laws: FloatArray

    @staticmethod
    def of(assembly: Assembly, section: ContactsSection, case: LoadCase, flow_rule: str) -> PushedStructure:
        """From contacts as built."""
        model, solids = assembly.model.of_case(case), assembly.glued(case)
        case = replace(case, live_load=case.question.pushed(case.live_load))
        pairs, areas = areas_of_pairs(solids)
        return PushedStructure(
            model=model,
            case=case,
            solids=solids,
            search=MovedSearch(model, assembly.contacts, section),
            pairs=pairs,
            areas=areas,
            stiffness=default_stiffness(model, case, solids),
            flow_rule=flow_rule,
            of_laws=np.ones((len(model.joints), 2)),
        )

    @property
    def as_laws(self) -> PushedStructure:
        """The same with the stiffness that joint laws of the deck have, where they have one."""
        laws = list(self.model.joints.values())
        own = np.array([[law.normal_stiffness / self.stiffness, law.shear_ratio / SHEAR_RATIO] for law in laws])
        return replace(self, of_laws=np.where(np.isfinite(own), own, 1.0).reshape(-1, 2))

    @property
    def size(self) -> float:
        """Mean of the bodies that may move, m."""
        return mean_size(self.solids)

    @property
    def n_solids(self) -> int:
        """Number of bodies that may move, and of fixed blocks."""
        return len(self.solids.model.blocks)

    def blocks_at(self, pose: Pose) -> Pose:
        """Poses of the blocks from those of the solids."""
        if self.solids.body_of_block is None:
            return pose
        turn = pose.rotation[self.solids.label]
        arms = self.solids.arms
        return Pose(pose.shift[self.solids.label] + np.einsum("nij,nj->ni", turn, arms) - arms, turn)

    def solids_at(self, pose: Pose, contacts: Contacts) -> RigidBodies:
        """The solids there with contacts between them, without ties."""
        arms = np.einsum("nij,nj->ni", pose.rotation[self.solids.label], self.solids.arms)
        return replace(self.solids, model=moved_model(self.solids.model, pose), contacts=contacts, arms=arms)

    def loads_at(self, pose: Pose, fallen: BoolArray, load_factor: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Dead and live load on the solids there, (n_solids, 6) each, and the change of all loads with the load factor.

        Without those of debris, (n_solids,). The change is the live load, but for a tilting table.
        """
        case = moved_case(self.case, self.blocks_at(pose))
        arms = np.einsum("nij,nj->ni", pose.rotation[self.solids.label], self.solids.arms)
        solids = replace(self.solids, arms=arms)
        parts = case.question.loads_at(case.dead_load, case.live_load, load_factor)
        dead, live, change = (solids.loads(each) for each in parts)
        dead[fallen], live[fallen], change[fallen] = 0.0, 0.0, 0.0
        return dead, live, change

    def ties_at(self, pose: Pose) -> Ties:
        """Ties there."""
        return moved_ties(self.model.ties, self.model.blocks, self.blocks_at(pose))

    def touching(self, pose: Pose, fallen: BoolArray, before: Touching | None, opened: float = 0.0) -> Touching:
        """Contacts of the solids there; points of interfaces that have not slid are those before.

        opened : gap over the size of blocks, that joints which dilate have at most and touch all the same
        """
        blocks = self.blocks_at(pose)
        found = self.search.at(blocks, fallen[self.solids.label], opened)
        body = np.concatenate([self.solids.label, self.n_solids + np.arange(len(self.model.grounds))])
        contacts = replace(found.contacts, bodies=body[found.contacts.bodies], solid_of_block=None)
        corners = self.search.to_corners(found, blocks)
        there = self.solids.model.blocks
        new = Touching.found(there.centroids, there.sizes, corners, replace(found, contacts=contacts), pose)
        return new if before is None else before.renewed(new, pose)

    def areas_of(self, touching: Touching) -> FloatArray:
        """Area that each contact point is as stiff as, (n_points,) m²: what two solids share as built, by their points,
        times the stiffness of its joint law over that of others.

        Two solids that meet only later are as stiff as others in the mean. Corners share it equally, points of a grid
        by their areas.
        """
        contacts = touching.contacts
        numbers = pair_numbers(contacts.bodies, self.solids.model)
        row = np.minimum(np.searchsorted(self.pairs, numbers), len(self.pairs) - 1)
        of_pair = np.where(self.pairs[row] == numbers, self.areas[row], self.areas.mean())
        pair, place = np.unique(numbers, return_inverse=True)
        interface = contacts.interface_of_point
        of_point = place.ravel()[interface]
        shares = (1.0 / np.maximum(np.bincount(of_point, minlength=len(pair)), FEWEST))[of_point]
        grid = refined(interface, contacts.points, contacts.frames[:, 0])
        if grid.any():
            equal = (contacts.areas / np.maximum(np.diff(contacts.point_start), 1))[interface]
            own = np.where(grid, contacts.point_areas, equal)
            of_grid = np.bincount(of_point, grid, len(pair))[of_point] > 0.0
            whole = np.bincount(of_point, own, len(pair))[of_point]
            shares = np.where(of_grid & (whole > 0.0), own / np.maximum(whole, 1e-300), shares)
        return np.asarray(of_pair[interface] * shares * self.of_laws[self.laws_of(contacts)[interface], 0])

    def along(self, touching: Touching) -> FloatArray:
        """Shear over normal stiffness of each contact point over that of joints without a ratio, (n_points,)."""
        contacts = touching.contacts
        return np.asarray(self.of_laws[self.laws_of(contacts)[contacts.interface_of_point], 1])

    def laws_of(self, contacts: Contacts) -> IntArray:
        """Rows of the joint laws of the model that interfaces have, (n_interfaces,)."""
        laws = list(self.model.joints)
        return np.array([laws.index(name) for name in contacts.joint_names], dtype=np.int64)[contacts.joints]


FEWEST = 4
"""Points over which the stiffness of two solids is spread at least: an edge is no stiffer than half a face."""
