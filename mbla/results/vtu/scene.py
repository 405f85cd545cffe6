"""What the files of one load case show, each derived once: motion as drawn, forces, thrust, modes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import InterfaceMotion, interface_motion
from mbla.results.collapse.motion import contact_displacements, drawn_motion, vertex_displacements
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.collapse.thrust import Thrust, thrust_lines, thrust_of
from mbla.results.collapse.torsion_use import torsion_use
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult, Results
from mbla.results.vtu.cells import BlockCells, block_cells
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class Scene:
    """A model and one of its load cases, or the model alone.

    model : as it may move under the load case (``Model.of_case``)
    case  : None for the model alone
    """

    model: Model
    contacts: Contacts
    case: CaseResult | None

    @cached_property
    def cells(self) -> BlockCells:
        """Blocks as cells of a mesh file."""
        return block_cells(self.model.blocks)

    @cached_property
    def motion(self) -> FloatArray:
        """Displacement and rotation of each block as drawn, (n_blocks, 6) m and rad."""
        return drawn_motion(self.model, self.case)

    @cached_property
    def displacements(self) -> FloatArray:
        """Linearised, of every vertex, (n_vertices, 3) m."""
        return vertex_displacements(self.model.blocks, self.motion)

    @cached_property
    def contact_displacements(self) -> FloatArray:
        """Mean of both bodies at every contact point, (n_points, 3) m."""
        return contact_displacements(self.model, self.contacts, self.motion)

    @cached_property
    def parts(self) -> IntArray:
        """Part of each block, 0 at rest."""
        return rigid_parts(self.model, self.contacts, self.motion)

    @property
    def mechanics(self) -> Mechanics | None:
        """Forces and velocities at the load factor or of the best iterate."""
        return None if self.case is None else self.case.solution.mechanics

    @property
    def is_result(self) -> bool:
        """Whether these are a result; else the best that was reached."""
        return self.case is not None and result_of(self.case) is not None

    @property
    def moves(self) -> bool:
        """Whether there is a mechanism, or a motion that shows the lack of equilibrium."""
        return self.case is not None and (self.mechanics is not None or self.case.solution.certificate is not None)

    @property
    def forces(self) -> FloatArray | None:
        """Contact forces at the load factor; without one those that lock the structure."""
        if self.case is None:
            return None
        return self.case.solution.lock if self.mechanics is None else self.mechanics.contact_forces

    @cached_property
    def thrust(self) -> Thrust | None:
        """Of every interface under these forces."""
        return None if self.forces is None else thrust_of(self.model, self.contacts, self.forces)

    @cached_property
    def torsion_use(self) -> FloatArray | None:
        """Shear force and torsion over what each interface carries of both, (n_interfaces,)."""
        if self.forces is None or self.case is None:
            return None
        return torsion_use(self.model, self.contacts, self.forces, self.case.solution.contact_model)

    @cached_property
    def lines(self) -> tuple[IntArray, ...]:
        """Thrust lines, interfaces in their order."""
        return () if self.thrust is None else thrust_lines(self.model, self.contacts, self.thrust)

    @cached_property
    def interfaces(self) -> InterfaceMotion | None:
        """What interfaces do in the mechanism."""
        return None if self.mechanics is None else interface_motion(self.model, self.contacts, self.mechanics)


def scene_of(results: Results, case: CaseResult) -> Scene:
    """The scene of a load case of a run."""
    return Scene(results.model.of_case(case.load_case), results.contacts, case)
