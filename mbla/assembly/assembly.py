"""A model with its contacts, and what the solver sees of them under each load case."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TypeAlias

from mbla.assembly.load_cell import LoadCell, with_load_cell
from mbla.assembly.rigid_bodies import RigidBodies, rigid_bodies
from mbla.assembly.ties import with_ties
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.questions.force import Force

Variant: TypeAlias = tuple[bytes | float, ...]
"""What a load case changes of what the solver sees."""


@dataclass(frozen=True)
class Assembly:
    """A model with its contacts; what the solver sees of them is worked out when it is first asked for, and kept.

    Load cases differ by the settling supports and by the load cell of their objective. Whatever else changes of
    model or contacts makes another assembly (``dataclasses.replace``).

    model    : with the blocks fixed that glue holds to a support
    contacts : as found
    """

    model: Model
    contacts: Contacts
    _glued: dict[Variant, RigidBodies] = field(default_factory=dict, init=False, repr=False, compare=False)
    _seen: dict[Variant, RigidBodies] = field(default_factory=dict, init=False, repr=False, compare=False)

    def glued(self, load_case: LoadCase | None = None) -> RigidBodies:
        """Rigid bodies as they may move under a load case, or at rest, and the interfaces between them alone."""
        variant = () if load_case is None else _supports(load_case)
        if variant not in self._glued:
            model = self.model if load_case is None else self.model.of_case(load_case)
            self._glued[variant] = rigid_bodies(model, self.contacts)
        return self._glued[variant]

    def of(self, load_case: LoadCase) -> RigidBodies:
        """What the solver sees under a load case: with the load cell of its objective, and ties among the contacts."""
        variant = _supports(load_case) + load_case.question.measured
        if variant not in self._seen:
            self._seen[variant] = with_ties(self._with_load_cell(load_case))
        return self._seen[variant]

    def _with_load_cell(self, load_case: LoadCase) -> RigidBodies:
        bodies, question = self.glued(load_case), load_case.question
        if not isinstance(question, Force):
            return bodies
        cell = LoadCell.of(question)
        # sides are those of blocks: a body may have some on either side, and some on none
        cut = replace(bodies.contacts, cut=question.objective.crossed(self.contacts.bodies))
        model, contacts = with_load_cell(bodies.model, cut, question.objective, cell, len(bodies.label))
        return replace(bodies, model=model, contacts=contacts, body_of_block=bodies.label, load_cell=cell)

    def with_load_cases(self, load_cases: tuple[LoadCase, ...]) -> Assembly:
        """The same model with load cases as they were solved, of which nothing depends that is kept."""
        other = replace(self, model=replace(self.model, load_cases=load_cases))
        other._glued.update(self._glued)
        other._seen.update(self._seen)
        return other


def _supports(load_case: LoadCase) -> Variant:
    """Supports that give way, and how."""
    question = load_case.question
    return (question.giving_way.tobytes(), question.ways.tobytes()) if len(question.giving_way) else ()


def assembly_of(model: Model, contacts: Contacts) -> Assembly:
    """A model with its contacts, the blocks fixed that these glue to a support."""
    held = contacts.report.held
    if not model.fixed[held].all():
        fixed = model.fixed.copy()
        fixed[held] = True
        model = replace(model, fixed=fixed)
    return Assembly(model, contacts)
