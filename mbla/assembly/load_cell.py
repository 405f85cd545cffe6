"""The load cell of an objective: one more body, weightless, that measures the force through a cut, or of ties.

Every contact force of an interface in the cut acts on the cell as well as on its two bodies, with the sign that it has
on the side where it counts. The cell can only slide along the direction of the objective: its equilibrium is
F = R0 − λ U (:mod:`mbla.model.objective`), and its velocity q opens the cut, which adds q d to the velocity of one side
relative to the other at all contact points of the cut.

A tie of the objective pulls at the cell as well, with its whole tension, and gets longer as the cell moves.

It is the last body that the solver sees, and in no result: where the live power is 1 its velocity is 1/U.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.model.settlement import with_reference
from mbla.model.solids.blocks import Blocks, join_labels, labels_of
from mbla.model.supports.guides import Guides, joined, slide
from mbla.questions.force import Force, Objective


@dataclass(frozen=True)
class LoadCell:
    """How a load cell moves.

    direction : (6,) unit motion: along the direction of the objective for the least value, against it for the greatest
    unit      : U, that the live load takes from the force for a load factor of 1
    """

    direction: FloatArray
    unit: float

    @staticmethod
    def of(question: Force) -> LoadCell:
        """That of a force."""
        along = slide(question.objective.direction, 1)[0]
        return LoadCell(np.asarray(question.settlement.sense * along), question.scale)

    @property
    def motion(self) -> FloatArray:
        """Its motion where the live power is 1, (6,)."""
        return self.direction / self.unit

    def loaded(self, load_case: LoadCase, body: int) -> LoadCase:
        """The load case with the settlement of its objective, and its loads, on the cell, a body of that number."""
        question = load_case.question
        assert isinstance(question, Force)  # what has a load cell
        on_cell = replace(question.settlement, blocks=np.array([body]), motions=self.direction[None])
        return with_reference(replace(load_case, question=replace(question, settlement=on_cell)), on_cell.reference)


def with_load_cell(
    model: Model, contacts: Contacts, objective: Objective, cell: LoadCell, tied_as: int
) -> tuple[Model, Contacts]:
    """Model and contacts with the load cell of an objective as the last body.

    The cut of a deck is one-sided: symmetry of the structure is not assumed of the forces.

    contacts : with the cut
    tied_as  : number of the cell among the blocks that ties pull at
    """
    n_blocks = len(model.blocks)
    weights = contacts.areas * (contacts.cut != 0)
    middle = weights @ contacts.centroids / (weights.sum() or 1.0)
    ties = model.ties
    if len(objective.ties):
        middle = ties.places[np.isin(ties.tie_of_point, objective.ties)].mean(axis=0)
        ties = ties.measured_by(objective.ties, tied_as, objective.direction)
    motions = np.zeros((1, 6, 6))
    motions[0, :, 0] = cell.direction
    guide = Guides(np.array([n_blocks]), np.zeros(1, dtype=np.int64), motions)
    bodies = np.where(contacts.bodies < n_blocks, contacts.bodies, contacts.bodies + 1)
    return (
        replace(
            model,
            blocks=_one_more(model.blocks, middle),
            fixed=np.append(model.fixed, False),
            guides=joined(model.guides, guide),
            mirrors=(),
            ties=ties,
        ),
        replace(contacts, bodies=bodies),
    )


def _one_more(blocks: Blocks, centroid: FloatArray) -> Blocks:
    """The blocks and one of mean size without faces and mass."""
    return replace(
        blocks,
        vertex_start=np.append(blocks.vertex_start, blocks.vertex_start[-1]),
        face_start=np.append(blocks.face_start, blocks.face_start[-1]),
        convex=np.append(blocks.convex, True),
        volumes=np.append(blocks.volumes, blocks.volumes.mean()),
        centroids=np.vstack([blocks.centroids, centroid]),
        densities=np.append(blocks.densities, 0.0),
        added_masses=np.append(blocks.added_masses, 0.0),
        added_mass_points=np.vstack([blocks.added_mass_points, centroid]),
        groups=(*blocks.groups, "load cell"),
        group_indices=np.append(blocks.group_indices, 0),
        labels=join_labels([blocks.labels, labels_of(1)]),
        strengths=None,
    )
