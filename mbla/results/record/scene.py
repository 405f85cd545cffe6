"""A model under one of its load cases, and what follows from forces and mechanism, each worked out once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, Failure, collapse_of, failure_of
from mbla.results.collapse.interface_modes import InterfaceMotion
from mbla.results.collapse.mechanics import interface_resultants
from mbla.results.collapse.motion import drawn_motion, mean_displacements, vertex_displacements
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.collapse.thrust import Thrust, thrust_lines, thrust_of
from mbla.results.collapse.torsion_use import torsion_use
from mbla.results.demand.demand import Demand, demand_of
from mbla.results.outcome import associative_of, best_iterate, result_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status

FIGURES = ("", "result", "best_iterate", "lock")
"""what forces and velocities are, by number: none, a result, the best iterate, or forces that balance the live
load alone"""


@dataclass(frozen=True)
class Scene:
    """A model and one of its load cases, or the model alone.

    case : None for the model alone
    """

    assembly: Assembly
    case: CaseResult | None

    @cached_property
    def model(self) -> Model:
        """As it may move under the load case."""
        return self.assembly.model if self.case is None else self.assembly.model.of_case(self.case.load_case)

    @property
    def solved(self) -> CaseResult:
        """The load case, of scenes that have one."""
        assert self.case is not None
        return self.case

    @property
    def load_case(self) -> LoadCase | None:
        """As it was solved."""
        return None if self.case is None else self.case.load_case

    @property
    def contacts(self) -> Contacts:
        """As found."""
        return self.assembly.contacts

    @property
    def bodies(self) -> RigidBodies:
        """That glue makes of the blocks."""
        return self.assembly.glued(None if self.case is None else self.case.load_case)

    @property
    def result(self) -> Mechanics | None:
        """Forces and velocities that are a result."""
        return None if self.case is None else result_of(self.case)

    @property
    def best(self) -> Mechanics | None:
        """The best iterate where there is no result."""
        return None if self.case is None else best_iterate(self.case)

    @property
    def associative(self) -> Mechanics | None:
        """Those of associative flow, where they are a result."""
        return None if self.case is None else associative_of(self.case)

    @property
    def mechanics(self) -> Mechanics | None:
        """Forces and velocities: the result, else the best iterate; None where there are none."""
        return self.result or self.best

    @property
    def figures(self) -> str:
        """What the forces are, one of ``FIGURES``."""
        if self.result is not None:
            return "result"
        if self.mechanics is not None:
            return "best_iterate"
        return "" if self.forces is None else "lock"

    @property
    def forces(self) -> FloatArray | None:
        """Contact forces, (n_points, 3) N; without a load factor those that lock the structure."""
        if self.mechanics is not None:
            return self.mechanics.contact_forces
        locked = self.case is not None and self.case.status is Status.UNBOUNDED
        lock = self.case.solution.lock if locked and self.case is not None else None
        return None if lock is None else lock[: len(self.contacts.points)]

    @property
    def certificate(self) -> FloatArray | None:
        """The motion that proves the lack of equilibrium, (n_blocks, 6)."""
        fallen = self.case is not None and self.case.status is Status.NO_EQUILIBRIUM
        return self.case.solution.certificate if fallen and self.case is not None else None

    @property
    def moves(self) -> bool:
        """Whether there is a mechanism, or a motion that shows the lack of equilibrium."""
        return self.case is not None and (self.mechanics is not None or self.case.solution.certificate is not None)

    @cached_property
    def collapse(self) -> Collapse | None:
        """What follows from the mechanism."""
        if self.case is None or self.mechanics is None:
            return None
        return collapse_of(self.assembly, self.case.load_case, self.mechanics)

    @cached_property
    def failure(self) -> Failure | None:
        """How the mechanism is listed."""
        if self.collapse is None or self.mechanics is None:
            return None
        return failure_of(self.model, self.contacts, self.collapse, self.mechanics)

    @property
    def interfaces(self) -> InterfaceMotion | None:
        """What interfaces do in the mechanism."""
        return None if self.collapse is None else self.collapse.interfaces

    @cached_property
    def thrust(self) -> Thrust | None:
        """Of every interface under the forces."""
        return None if self.forces is None else thrust_of(self.model, self.contacts, self.forces)

    @cached_property
    def lines(self) -> tuple[IntArray, ...]:
        """Thrust lines, interfaces in their order, (n,) each."""
        return () if self.thrust is None else thrust_lines(self.bodies, self.thrust)

    @cached_property
    def torsion_use(self) -> FloatArray | None:
        """Shear force and torsion over what each interface carries of both, (n_interfaces,)."""
        if self.forces is None or self.case is None:
            return None
        return torsion_use(self.model, self.contacts, self.forces, self.case.solution.contact_model)

    @cached_property
    def demand(self) -> Demand | None:
        """What the forces of the result ask of the units."""
        if self.case is None or self.result is None:
            return None
        return demand_of(self.assembly, self.case.load_case, self.result)

    @cached_property
    def moments(self) -> FloatArray | None:
        """Moment of the forces of each interface about its centroid, (n_interfaces, 3) N m."""
        return None if self.forces is None else interface_resultants(self.contacts, self.forces)[:, 3:]

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
        contacts = self.contacts
        bodies = contacts.bodies[contacts.interface_of_point]
        return mean_displacements(self.model.blocks, self.motion, bodies, contacts.points)

    @cached_property
    def parts(self) -> IntArray:
        """Part of each block in the motion as drawn, (n_blocks,), 0 at rest."""
        return rigid_parts(self.model, self.bodies, self.motion) if self.collapse is None else self.collapse.parts


@dataclass(frozen=True)
class AskedScene(Scene):
    """A load case as it is asked for, solved or not."""

    asked: LoadCase

    @property
    def load_case(self) -> LoadCase:
        """The one that is asked for."""
        return self.asked


def scene_of(results: Results, case: CaseResult) -> Scene:
    """The scene of a load case of a run."""
    return Scene(results.assembly, case)


Values: TypeAlias = "np.typing.NDArray[Any]"


def as_text(values: Sequence[str]) -> Values:
    """Text as an array of objects."""
    array = np.empty(len(values), dtype=object)
    array[:] = list(values)
    return array
