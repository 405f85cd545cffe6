"""What glue makes a fault of the deck: found with the contacts, after the model stage has judged loads and guides."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids, held_model, solids_of
from mbla.contacts.glued_guides import guides_at_odds
from mbla.deck.tree import KeyPath
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.wording import named

CANCELLED = 1e-12
"""sum of live loads on a solid, relative to the loads themselves, at which nothing is left of them"""


def glue_findings(model: Model, contacts: Contacts) -> list[tuple[KeyPath, Message]]:
    """Key path and words of each: nothing is left to move, loads that move nothing, supports that glue would hold."""
    if not len(contacts.report.glued):
        return []
    held = held_model(model, contacts)
    if held.fixed.all():
        return [(("contacts",), Message("nothing-can-move", "every block is glued to a support: nothing can move"))]
    found = [*_held_guides(model, contacts), *_guides_at_odds(held, contacts), *_glued_settlements(model, contacts)]
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


def _held_guides(model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    stuck = np.intersect1d(model.guides.blocks, contacts.report.held)
    if len(stuck):
        yield (
            ("supports",),
            Message(
                "support-held-twice",
                f"{named(stuck, model.blocks.name)} may move in some way, but glue holds it to a support",
            ),
        )


def _guides_at_odds(model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    label = contacts.solid_of_block
    if label is None or not len(model.guides):
        return
    volumes = np.bincount(label, model.blocks.volumes)
    moments = [np.bincount(label, model.blocks.volumes * axis) / volumes for axis in model.blocks.centroids.T]
    arms = model.blocks.centroids - np.stack(moments, axis=1)[label]
    pair = guides_at_odds(model.guides, label, arms)
    if pair is not None:
        first, second = (model.blocks.name(block) for block in pair)
        message = f"{first} and {second} are glued to one rigid body, but may move in different ways: guide one of them"
        yield ("supports",), Message("support-held-twice", message)


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
    free = ~solids.model.fixed
    net, gross = np.abs(solids.loads(case.live_load)[free]), _gross(solids, case.live_load)[free]
    return bool((net.max(axis=0) <= CANCELLED * gross.max(axis=0)).all())


def _gross(solids: Solids, loads: FloatArray) -> FloatArray:
    """Sum of the sizes of forces, and of moments about the solid's centroid, on each solid, (n_solids, 6)."""
    sizes = np.abs(loads)
    arms = np.linalg.norm(solids.arms, axis=1) * np.linalg.norm(loads[:, :3], axis=1)
    sizes[:, 3:] += arms[:, None]
    total = np.zeros((len(solids.model.blocks), 6))
    label = np.arange(len(loads)) if solids.solid_of_block is None else solids.solid_of_block
    np.add.at(total, label, sizes)
    return total
