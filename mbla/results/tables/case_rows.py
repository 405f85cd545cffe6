"""What the rows of one load case are read from: model, contacts, forces and velocities, and what follows from them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.collapse import Collapse, collapse_of
from mbla.results.collapse.interface_modes import relative_motion
from mbla.results.collapse.mechanics import interface_resultants
from mbla.results.collapse.thrust import Thrust, thrust_of
from mbla.results.collapse.torsion_use import torsion_use
from mbla.results.outcome import best_iterate, result_of
from mbla.results.results import CaseResult, Results
from mbla.results.tables.column import Values, as_text
from mbla.solution.solution import Mechanics, Status

RESULT, BEST_ITERATE, NONE = "result", "best_iterate", ""
"""what the forces and velocities in a row are"""


@dataclass(frozen=True)
class CaseRows:
    """One load case of a result; everything that follows from its forces is worked out once, when asked for."""

    results: Results
    case: CaseResult

    @cached_property
    def model(self) -> Model:
        """As it may move under this case."""
        return self.results.model.of_case(self.case.load_case)

    @property
    def contacts(self) -> Contacts:
        """The same for all cases."""
        return self.results.contacts

    @property
    def mechanics(self) -> Mechanics | None:
        """Forces and velocities: the result, else the best that was reached; None where there are none."""
        return result_of(self.case) or best_iterate(self.case)

    @property
    def figures(self) -> str:
        """What they are: ``result``, ``best_iterate`` or nothing."""
        if result_of(self.case) is not None:
            return RESULT
        return NONE if self.mechanics is None else BEST_ITERATE

    @property
    def certificate(self) -> FloatArray | None:
        """The motion that proves the lack of equilibrium, (n_blocks, 6)."""
        return self.case.solution.certificate if self.case.status is Status.NO_EQUILIBRIUM else None

    @property
    def lock(self) -> FloatArray | None:
        """Forces that balance the live load alone, (n_points, 3) N, where that proves that nothing comes down."""
        return self.case.solution.lock if self.case.status is Status.UNBOUNDED else None

    @cached_property
    def collapse(self) -> Collapse | None:
        """What follows from the mechanism."""
        if self.mechanics is None:
            return None
        return collapse_of(self.model, self.contacts, self.case.load_case, self.mechanics)

    @cached_property
    def thrust(self) -> Thrust | None:
        """What follows from the contact forces."""
        return None if self.mechanics is None else thrust_of(self.model, self.contacts, self.mechanics.contact_forces)

    @cached_property
    def torsion_use(self) -> FloatArray:
        """Shear force and torsion over what each interface carries of both, (n_interfaces,); nan without forces."""
        if self.mechanics is None:
            return self.missing(len(self.contacts))
        forces, contact_model = self.mechanics.contact_forces, self.case.solution.contact_model
        return torsion_use(self.model, self.contacts, forces, contact_model)

    @cached_property
    def moments(self) -> FloatArray:
        """Moment of the forces of each interface about its centroid, (n_interfaces, 3) N m; nan without forces."""
        if self.mechanics is None:
            return self.missing(len(self.contacts), 3)
        return interface_resultants(self.contacts, self.mechanics.contact_forces)[:, 3:]

    @cached_property
    def certificate_motion(self) -> tuple[FloatArray, FloatArray] | None:
        """Velocity and rotation of b relative to a in that motion, (n_interfaces, 3) each."""
        if self.certificate is None:
            return None
        return relative_motion(self.model, self.contacts, self.certificate)

    def same(self, count: int, text: str) -> Values:
        """One text in every row."""
        return as_text([text] * count)

    def missing(self, *shape: int) -> FloatArray:
        """Values that do not exist."""
        return np.full(shape, np.nan)

    def given(self, values: FloatArray | None, *shape: int) -> FloatArray:
        """Values, or nan of that shape where there are none."""
        return self.missing(*shape) if values is None else values


def case_rows(results: Results, cases: tuple[CaseResult, ...]) -> list[CaseRows]:
    """Sources of tables that have rows for every load case."""
    return [CaseRows(results, case) for case in cases]
