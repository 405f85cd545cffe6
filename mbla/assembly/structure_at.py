"""A structure as it stands before its joints give under the dead load: as built, or where a time history left it.

Where it was left the blocks are moved, contacts are those that are found there, and the dead load acts there. Joints
that have come open gap, and joints that press overlap by what they had given: both are gaps from which the joints go
on, so that what is in balance there is at rest without any motion. Friction begins anew.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.moved import MovedSearch
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.model.pose import Pose, moved_model, turned_load

OPEN = 10.0
"""Gap over the sag from which joints are open by a motion: under the dead load alone they open by some sags at most."""


@dataclass(frozen=True)
class StructureAt:
    """Blocks, contacts and dead load somewhere.

    built     : as built, by which joints are as stiff as they are
    assembly  : there
    load_case : with the dead load there
    gaps      : (n_points,) m of contact points without ties, negative where bodies overlap; 0 as built
    turned    : (n_interfaces,) of the surfaces, which are open by a motion of their bodies: further than joints give
    """

    built: Assembly
    assembly: Assembly
    load_case: LoadCase
    gaps: FloatArray
    turned: BoolArray

    @staticmethod
    def as_built(assembly: Assembly, load_case: LoadCase) -> StructureAt:
        """Where joints just touch."""
        contacts = assembly.contacts
        gaps, turned = np.zeros(len(contacts.points)), np.zeros(len(contacts), dtype=np.bool_)
        return StructureAt(assembly, assembly, load_case, gaps, turned)

    @staticmethod
    def moved(
        assembly: Assembly,
        section: ContactsSection,
        load_case: LoadCase,
        history: TimeHistory,
        moved: FloatArray,
        sag: float,
    ) -> StructureAt:
        """Where a time history has left it, without ties.

        moved : (n_blocks, 6) m, rad, displacements and rotation vectors of the blocks from as built
        sag   : m, by which joints give under the dead load as built
        """
        pose = Pose.of(moved)
        found = MovedSearch(assembly.model, assembly.contacts, section).at(pose)
        there = Assembly(moved_model(assembly.model, pose), found.contacts)
        dead = turned_load(load_case.dead_load, history.dead_levers, history.dead_following, pose)
        widest = np.zeros(len(found.contacts))
        np.maximum.at(widest, found.contacts.interface_of_point, found.gaps)
        return StructureAt(assembly, there, replace(load_case, dead_load=dead), found.gaps, widest > OPEN * sag)

    @property
    def gaps_with_ties(self) -> FloatArray:
        """(n_points,) of what the solver sees; 0 of ties, which come last."""
        points = self.assembly.of(self.load_case.dead_alone).contacts.points
        return np.append(self.gaps, np.zeros(len(points) - len(self.gaps)))
