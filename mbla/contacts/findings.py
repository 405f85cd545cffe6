"""Faults of the deck that only its contacts show: bent faces that touch, and what glue takes from loads and supports.

Contacts need planes, so that a block is refused if it touches another with a face that was split because it is bent,
unless the other has the same face, split alike.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts, ContactsRefused
from mbla.contacts.glue import Solids, guides_at_odds, held_model, solids_of
from mbla.contacts.notices import overlap_messages
from mbla.contacts.search import find_contacts
from mbla.deck.deck import Deck
from mbla.deck.text.tree import KeyPath
from mbla.errors import DeckError, Fault, Message, first_faults
from mbla.model.items import defects_in_words
from mbla.model.model import LoadCase, Model
from mbla.model.objective import ENDS
from mbla.model.solids.defects import planarity_defects
from mbla.model.solids.ragged import rows_and_items
from mbla.model.ties.ties import OUTSIDE
from mbla.model.wording import named

CANCELLED = 1e-12
"""sum of live loads on a solid, relative to the loads themselves, at which they cancel"""


def glue_findings(model: Model, contacts: Contacts) -> list[tuple[KeyPath, Message]]:
    """Key path and words of each: nothing is left to move, loads that move nothing, supports that glue would hold."""
    if not len(contacts.report.glued):
        return []
    held = held_model(model, contacts)
    if held.fixed.all():
        return [(("contacts",), Message("nothing-can-move", "every block is glued to a support: nothing can move"))]
    found = [*_held_otherwise(model, contacts), *_glued_settlements(model, contacts)]
    if found:
        return found
    solids = solids_of(held, contacts)
    return [
        (
            ("load_cases", case.name, "live"),
            Message(
                "live-load-without-effect",
                "the live loads have no effect: they act on blocks glued to a support, or cancel on glued blocks",
            ),
        )
        for case in model.load_cases
        if case.settlement is None and _without_effect(solids, case)
    ]


def objective_findings(model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """Forces through cuts without a joint, and through glue, whose force nothing determines; each once."""
    for case in model.load_cases:
        objective, path = case.objective, ("load_cases", case.deck_name, "objective", "force")
        if objective is None or objective.end != next(iter(ENDS)):
            continue
        if len(objective.ties):
            yield from _loose_ties(model, contacts, objective.ties, (*path[:-1], "tie"))
            continue
        glued = contacts.report.glued[objective.crossed(contacts.report.glued) != 0]
        if len(glued):
            first, second = (model.body_name(int(body)) for body in glued[0])
            words = f"{first} and {second} are glued: the force through glue is not determined; put both on one side"
            yield path, Message("objective-not-possible", words)
        elif not objective.crossed(contacts.bodies).any():
            words = "no joint lies between the two sides, so that there is no force: see what `mbla check` says touches"
            yield path, Message("objective-without-effect", words)


def _loose_ties(model: Model, contacts: Contacts, rows: IntArray, path: KeyPath) -> Iterator[tuple[KeyPath, Message]]:
    """Ties, (n,), all of whose points are on blocks that are glued to one."""
    label = np.arange(len(model.blocks)) if contacts.solid_of_block is None else contacts.solid_of_block
    body = np.append(np.where(held_model(model, contacts).fixed, OUTSIDE, label), OUTSIDE)
    ties = model.ties.with_bodies(body[model.ties.bodies])
    for row in rows.tolist():
        if len(np.unique(ties.bodies[ties.start[row] : ties.start[row + 1]])) == 1:
            words = f"{ties.names[row]} is between blocks that are glued to one: its force is not determined"
            yield path, Message("objective-not-possible", words)


def settlement_findings(model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """Supports that give way and hold nothing: no joint and no tie lies between them and a block that can move."""
    still = np.append(held_model(model, contacts).fixed, np.ones(len(model.grounds) + 1, dtype=bool))
    ties, glued = model.ties, contacts.report.glued
    for case in model.load_cases:
        if case.settlement is None or case.objective is not None:
            continue
        if (np.isin(glued, case.settlement.blocks).sum(axis=1) == 1).any():
            continue  # refused for that
        on_it = np.isin(contacts.bodies, case.settlement.blocks).any(axis=1)
        tied = np.unique(ties.tie_of_point[np.isin(ties.bodies, case.settlement.blocks)])
        beside = [contacts.bodies[on_it].ravel(), ties.bodies[np.isin(ties.tie_of_point, tied)]]
        if still[np.concatenate(beside)].all():  # the last entry stands for what is outside of the model
            words = "nothing that can move touches the support that gives way: no reaction is lost; see `mbla check`"
            yield ("load_cases", case.deck_name, "settlement", "on"), Message("settlement-without-effect", words)


def _held_otherwise(model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """Guided blocks that glue holds to a support, or to a block that may move in another way."""
    stuck = np.intersect1d(model.guides.blocks, contacts.report.held)
    label, blocks = contacts.solid_of_block, model.blocks
    if len(stuck):
        words = f"{named(stuck, blocks.name)} may move in some way, but glue holds it to a support"
        yield ("supports",), Message("support-held-twice", words)
    elif label is not None and len(model.guides):
        volumes = np.bincount(label, blocks.volumes)
        moments = [np.bincount(label, blocks.volumes * axis) / volumes for axis in blocks.centroids.T]
        pair = guides_at_odds(model.guides, label, blocks.centroids - np.stack(moments, axis=1)[label])
        if pair is not None:
            first, second = map(blocks.name, pair)
            words = f"{first} and {second} are glued to one rigid body, but may move in different ways: guide one"
            yield ("supports",), Message("support-held-twice", words)


def _glued_settlements(model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """A support that gives way does not take along what is glued to it."""
    bodies = contacts.report.glued
    for case in model.load_cases:
        if case.settlement is None:
            continue
        on_it = bodies[np.isin(bodies, case.settlement.blocks).any(axis=1)]
        others = np.setdiff1d(on_it, case.settlement.blocks)
        if len(others):
            names = ", ".join(model.body_name(int(body)) for body in others[:3])
            message = f"{names} held by glue on a support that gives way: fix that too, so that it settles along"
            yield ("load_cases", case.name, "settlement", "on"), Message("support-held-twice", message)


def _without_effect(solids: Solids, case: LoadCase) -> bool:
    """Whether the live loads on solids that move cancel, relative to the sizes of these and of their moments."""
    net = np.abs(solids.loads(case.live_load)[~solids.model.fixed]).max(axis=0)
    sizes = np.abs(case.live_load)
    sizes[:, 3:] += (
        np.linalg.norm(solids.arms, axis=1)[:, None] * np.linalg.norm(case.live_load[:, :3], axis=1)[:, None]
    )
    return bool((net <= CANCELLED * sizes.max(axis=0)).all())


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


def _overlap_findings(deck: Deck, model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """Blocks that overlap; at the tolerance that would accept them, were one of them not swallowed."""
    report, key = contacts.report, "tolerance" if deck.contacts.overlap_tolerance is None else "overlap_tolerance"
    within = report.overlap_swallows & (report.overlap_depths <= deck.contacts.depth_allowed)
    for words in overlap_messages(model, report):
        yield ("blocks",), Message("blocks-overlap", words)
    if within.any():
        first, second = map(model.blocks.name, report.overlaps[within][0].tolist())
        words = f"so great that it would swallow a block: {first} and {second} reach through half of one another"
        yield ("contacts", key), Message("block-swallowed", words)


def contacts_of(deck: Deck, model: Model) -> Contacts:
    """Contacts of a model.

    Raises
    ------
    DeckError
        for blocks that overlap, bent faces in contact, glue that leaves nothing to move, and what no search can handle
    """
    try:
        contacts = find_contacts(model, deck.contacts)
    except ContactsRefused as refused:
        raise DeckError([deck.fault_at(refused.path, refused.message)]) from refused
    faults = [deck.fault_at(path, message) for path, message in _overlap_findings(deck, model, contacts)]
    faults += bent_faults(deck, model, contacts)
    faults += [deck.fault_at(path, message) for path, message in glue_findings(model, contacts)]
    faults += [deck.fault_at(path, message) for path, message in objective_findings(model, contacts)]
    faults += [deck.fault_at(path, message) for path, message in settlement_findings(model, contacts)]
    if faults:
        raise DeckError(first_faults(faults))
    return contacts
