"""Faults of the deck that only its contacts show: blocks that overlap, and bent faces that touch.

Contacts need planes. A bent face, which was split into triangles, may touch only the same face of another block, split
alike; else its block is refused.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.notices import overlap_messages
from mbla.deck.deck import Deck
from mbla.errors import Fault, KeyPath, Message
from mbla.model.items import defects_in_words
from mbla.model.model import Model
from mbla.model.solids.defects import planarity_defects
from mbla.model.solids.ragged import rows_and_items

_FACING = 0.99
"""Cosine of the angle between the normal of an interface and that of the triangle that it lies on."""
_APART = 2.0
"""Distance of an interface from the triangle that it lies on, in tolerances."""
_OUTSIDE = 1e-6
"""Barycentric coordinate below zero that is rounding."""


def bent_faults(deck: Deck, model: Model, contacts: Contacts) -> list[Fault]:
    """A fault for each block with bent faces in contact, at its item, as for faces that cannot be split."""
    bent, tolerance = model.bent, deck.contacts.tolerance
    rows, others = bent_contacts(model, contacts, max(tolerance, deck.contacts.depth_allowed))
    if not len(rows):
        return []
    blocks = bent.blocks[rows]
    defects = planarity_defects(blocks, bent.faces[rows], bent.deviations[rows], model.blocks.sizes, tolerance)
    touched = {int(block): model.body_name(int(other)) for block, other in zip(blocks, others, strict=True)}
    extended = [
        replace(defect, message=defect.message.around(after=f", and it touches {touched[defect.block]} there"))
        for defect in defects
    ]
    item_of_block = np.full(len(model.blocks), -1)
    item_of_block[bent.blocks] = bent.items
    return defects_in_words(deck, extended, item_of_block, model.blocks)


def bent_contacts(model: Model, contacts: Contacts, tolerance: float) -> tuple[IntArray, IntArray]:
    """Rows of the bent faces of a model that are in contact, (n,) ascending, and the body that each touches."""
    bent, n = model.bent, len(contacts)
    triangle_start = np.searchsorted(bent.blocks[bent.row], np.arange(len(model.blocks) + 1))
    # every interface from body a, then every one from body b
    body, other = contacts.bodies.T.ravel(), contacts.bodies[:, ::-1].T.ravel()
    own = np.flatnonzero(body < len(model.blocks))
    first = triangle_start[body[own]]
    row, triangle = rows_and_items(first, triangle_start[body[own] + 1] - first)
    side = own[row]
    outward = np.where(side < n, 1.0, -1.0)[:, None] * contacts.normals[side % n]
    reach = _APART * tolerance * model.blocks.sizes[body[side]]
    on = _lies_on(contacts.centroids[side % n], outward, bent.triangles[triangle], reach)
    on &= other[side] != bent.twins[bent.row[triangle]]  # split alike
    rows, at = np.unique(bent.row[triangle[on]], return_index=True)
    return rows, other[side[on]][at]


def _lies_on(points: FloatArray, normals: FloatArray, triangles: FloatArray, reach: FloatArray) -> BoolArray:
    """Whether a point (n, 3) of a surface with a normal (n, 3) lies on a triangle (n, 3, 3) that faces the same way."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    area = np.cross(b - a, c - a)
    double = np.linalg.norm(area, axis=1)
    unit = area / double[:, None]
    shares = [
        np.einsum("ki,ki->k", np.cross(head - tail, points - tail), unit) / double
        for tail, head in ((a, b), (b, c), (c, a))
    ]
    inside = np.min(shares, axis=0) >= -_OUTSIDE
    near = np.abs(np.einsum("ki,ki->k", points - a, unit)) <= reach
    return np.asarray(inside & near & (np.einsum("ki,ki->k", normals, unit) > _FACING))


def overlap_findings(deck: Deck, model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """Blocks that overlap; at the tolerance that would accept them, were one of them not swallowed."""
    report, key = contacts.report, "tolerance" if deck.contacts.overlap_tolerance is None else "overlap_tolerance"
    within = report.overlap_swallows & (report.overlap_depths <= deck.contacts.depth_allowed)
    for words in overlap_messages(model, report):
        yield ("blocks",), Message("blocks-overlap", words)
    if within.any():
        first, second = map(model.blocks.name, report.overlaps[within][0].tolist())
        words = f"so great that it would swallow a block: {first} and {second} reach through half of one another"
        yield ("contacts", key), Message("block-swallowed", words)
