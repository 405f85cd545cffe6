"""The gauge of an objective: one more body, weightless, that feels the force through a cut, or the tension of ties.

Every contact force of an interface in the cut acts on the gauge as well as on its two bodies, with the sign that it has
on the side where it counts. The gauge can only slide along the direction of the objective: its equilibrium is
F = R0 − λ U (:mod:`mbla.model.objective`), and its velocity q opens the cut, which adds q d to the velocity of one side
relative to the other at all contact points of the cut.

A tie that is asked for pulls at it as well, by its whole tension, and gets longer as it moves.

It is the last block of the model that the solver sees, and in no result: where the live power is 1 its velocity is 1/U.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.guides import Guides, joined, slide
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import Blocks, join_labels, labels_of


def with_gauge(model: Model, contacts: Contacts, load_case: LoadCase, felt_as: int) -> tuple[Model, Contacts]:
    """Model and contacts with a gauge for the objective of a load case.

    The cut of a deck is one-sided: symmetry of the structure is not assumed of the forces.

    contacts : with the cut
    felt_as  : number of the gauge among the blocks at which ties pull
    """
    objective, n_blocks = load_case.objective, len(model.blocks)
    assert objective is not None  # that is why there is a gauge
    weights = contacts.areas * (contacts.cut != 0)
    middle = weights @ contacts.centroids / (weights.sum() or 1.0)
    ties = model.ties
    if len(objective.ties):
        middle = ties.places[np.isin(ties.tie_of_point, objective.ties)].mean(axis=0)
        ties = ties.felt_by(objective.ties, felt_as, objective.direction)
    way = gauge_way(load_case)
    motions = np.zeros((1, 6, 6))
    motions[0, :, 0] = way
    gauge = Guides(np.array([n_blocks]), np.zeros(1, dtype=np.int64), motions)
    bodies = np.where(contacts.bodies < n_blocks, contacts.bodies, contacts.bodies + 1)
    return (
        replace(
            model,
            blocks=_one_more(model.blocks, middle),
            fixed=np.append(model.fixed, False),
            guides=joined(model.guides, gauge),
            mirrors=(),
            ties=ties,
        ),
        replace(contacts, bodies=bodies),
    )


def gauge_way(load_case: LoadCase) -> FloatArray:
    """Unit motion of the gauge, (6,): along the direction for the least value, against it for the greatest."""
    assert load_case.objective is not None
    assert load_case.settlement is not None
    return np.asarray(load_case.settlement.sense * slide(load_case.objective.direction, 1)[0])


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
        groups=(*blocks.groups, "gauge"),
        group_indices=np.append(blocks.group_indices, 0),
        labels=join_labels([blocks.labels, labels_of(1)]),
    )
