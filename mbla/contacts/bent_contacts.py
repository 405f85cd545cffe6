"""Interfaces on faces that were split because they are bent: contacts need planes, so that such a block is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.ragged import rows_and_items
from mbla.deck.deck import Deck
from mbla.errors import Fault
from mbla.model.defects import planarity_defects
from mbla.model.item_defects import defects_in_words
from mbla.model.model import Model

_FACING = 0.99
"""Cosine of the angle between the normal of an interface and that of the triangle that it lies on."""
_APART = 2.0
"""Distance of an interface from the triangle that it lies on, in tolerances."""
_OUTSIDE = 1e-6
"""Barycentric coordinate below zero that is rounding."""


def bent_faults(deck: Deck, model: Model, contacts: Contacts) -> list[Fault]:
    """A fault for each block with bent faces in contact, at its item, as for faces that cannot be split."""
    bent, tolerance = model.bent, deck.contacts.tolerance
    rows, others = bent_contacts(model, contacts, tolerance)
    if not len(rows):
        return []
    blocks = bent.blocks[rows]
    defects = planarity_defects(blocks, bent.faces[rows], bent.deviations[rows], model.blocks.sizes, tolerance)
    touched = {int(block): model.body_name(int(other)) for block, other in zip(blocks, others, strict=True)}
    told = [
        replace(defect, message=defect.message.around(after=f", and it touches {touched[defect.block]} there"))
        for defect in defects
    ]
    item_of_block = np.full(len(model.blocks), -1)
    item_of_block[bent.blocks] = bent.items
    return defects_in_words(deck, told, item_of_block, model.blocks)


def bent_contacts(model: Model, contacts: Contacts, tolerance: float) -> tuple[IntArray, IntArray]:
    """Rows of the bent faces of a model that are in contact, ascending, and the body that each touches."""
    bent = model.bent
    triangle_start = np.searchsorted(bent.blocks[bent.row], np.arange(len(model.blocks) + 1))
    found: list[tuple[IntArray, IntArray]] = []
    for side in (0, 1) if len(bent) else ():
        body = contacts.bodies[:, side]
        own = np.flatnonzero(body < len(model.blocks))
        first = triangle_start[body[own]]
        row, triangle = rows_and_items(first, triangle_start[body[own] + 1] - first)
        interface = own[row]
        outward = (1.0 - 2.0 * side) * contacts.normals[interface]
        reach = _APART * tolerance * model.blocks.sizes[body[interface]]
        on = _lies_on(contacts.centroids[interface], outward, bent.triangles[triangle], reach)
        found.append((bent.row[triangle[on]], contacts.bodies[interface[on], 1 - side]))
    rows, others = (np.concatenate([each[k] for each in found]) if found else np.zeros(0, np.int64) for k in (0, 1))
    rows, at = np.unique(rows, return_index=True)
    return rows, others[at]


def _lies_on(points: FloatArray, normals: FloatArray, triangles: FloatArray, reach: FloatArray) -> BoolArray:
    """Whether a point (n, 3) of a surface with a normal (n, 3) lies on a triangle (n, 3, 3) that looks the same way."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    area = np.cross(b - a, c - a)
    double = np.linalg.norm(area, axis=1)
    unit = area / double[:, None]
    shares = [
        np.einsum("ki,ki->k", np.cross(head - tail, points - tail), unit) / double
        for tail, head in ((a, b), (b, c), (c, a))
    ]
    inside = np.min(shares, axis=0) >= -_OUTSIDE if len(points) else np.zeros(0, dtype=bool)
    near = np.abs(np.einsum("ki,ki->k", points - a, unit)) <= reach
    return np.asarray(inside & near & (np.einsum("ki,ki->k", normals, unit) > _FACING))
