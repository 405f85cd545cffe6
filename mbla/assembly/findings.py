"""Faults of the deck that glue and loads show: what glue takes from loads and supports, forces that no joint has."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from mbla.arrays import IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies, guides_at_odds
from mbla.errors import KeyPath, Message
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.model.objective import ENDS
from mbla.model.ties.ties import OUTSIDE
from mbla.model.wording import named
from mbla.questions.force import Objective

CANCELLED = 1e-12
"""sum of live loads on a body, relative to the loads themselves, at which they cancel"""


def glue_findings(assembly: Assembly) -> list[tuple[KeyPath, Message]]:
    """Key path and words of each: nothing is left to move, loads that move nothing, supports that glue would hold."""
    model = assembly.model
    if not len(assembly.contacts.report.glued):
        return []
    if model.fixed.all():
        return [(("contacts",), Message("nothing-can-move", "every block is glued to a support: nothing can move"))]
    found = [*_held_otherwise(assembly), *_glued_settlements(assembly)]
    if found:
        return found
    return [
        (
            ("load_cases", case.name, "live"),
            Message(
                "live-load-without-effect",
                "the live loads have no effect: they act on blocks glued to a support, or cancel on glued blocks",
            ),
        )
        for case in model.load_cases
        if case.question.multiplies and _without_effect(assembly.glued(case), case)
    ]


def objective_findings(assembly: Assembly) -> Iterator[tuple[KeyPath, Message]]:
    """Forces through cuts without a joint, and through glue, whose force nothing determines; each once."""
    model, contacts = assembly.model, assembly.contacts
    for case in model.load_cases:
        objective, path = case.question.record(Objective), ("load_cases", case.deck_name, "objective", "force")
        if objective is None or objective.end != next(iter(ENDS)):
            continue
        if len(objective.ties):
            yield from _loose_ties(assembly, objective.ties, (*path[:-1], "tie"))
            continue
        glued = contacts.report.glued[objective.crossed(contacts.report.glued) != 0]
        if len(glued):
            first, second = (model.body_name(int(body)) for body in glued[0])
            words = f"{first} and {second} are glued: the force through glue is not determined; put both on one side"
            yield path, Message("objective-not-possible", words)
        elif not objective.crossed(contacts.bodies).any():
            words = "no joint lies between the two sides, so that there is no force: see what `mbla check` says touches"
            yield path, Message("objective-without-effect", words)


def dilatancy_findings(assembly: Assembly, laws: Collection[str]) -> Iterator[tuple[KeyPath, Message]]:
    """Joint laws among those in use that lift as they slide, which none does in a time history.

    laws : in use where blocks have no joint yet
    """
    model = assembly.model
    name = next((case.deck_name for case in model.load_cases if case.time_history is not None), None)
    if name is None:
        return
    for law in dict.fromkeys((*assembly.contacts.joint_names, *laws)):
        if law in model.joints and model.joints[law].dilatancy > 0.0:
            words = f"must be 0: load case {name} has a time_history, in which joints slide without dilatancy"
            yield ("joints", law, "dilatancy"), Message("time-history-not-possible", words)


def time_history_findings(assembly: Assembly) -> Iterator[tuple[KeyPath, Message]]:
    """Recorded interfaces without a joint, or within what moves as one; kinematic blocks that glue or guides hold."""
    for case in assembly.model.load_cases:
        if case.time_history is not None:
            path = ("load_cases", case.deck_name, "time_history")
            yield from _rigid_held(assembly, case.time_history, path)
            yield from _without_interface(assembly, case.time_history, path)


def _rigid_held(assembly: Assembly, history: TimeHistory, path: KeyPath) -> Iterator[tuple[KeyPath, Message]]:
    held, name = assembly.contacts.report.held, assembly.model.blocks.name
    for blocks in history.rigid:
        if len(stuck := np.intersect1d(blocks, held)):
            words = f"{named(stuck, name)} is glued to a support: what moves as one has no block that does not move"
            yield (*path, "rigid"), Message("rigid-blocks", words)
        elif len(guided := np.intersect1d(blocks, assembly.model.guides.blocks)) > 1:
            words = f"{named(guided, name)} are guided each by itself: guide one of what moves as one"
            yield (*path, "rigid"), Message("rigid-blocks", words)


def _without_interface(assembly: Assembly, history: TimeHistory, path: KeyPath) -> Iterator[tuple[KeyPath, Message]]:
    """Of pairs with one name, as of a block and each ground, one at least has a joint."""
    model = assembly.model
    joints = {tuple(pair) for pair in np.sort(assembly.contacts.bodies, axis=1).tolist()}
    pairs: dict[str, list[tuple[int, ...]]] = {}
    for each in history.interfaces:
        pairs.setdefault(each.name.partition("[")[0], []).append(tuple(each.bodies.tolist()))
    for name, found in pairs.items():
        place: KeyPath = (*path, "record", "interfaces", name, "between")
        first, second = (model.body_name(body) for body in found[0])
        if joints.isdisjoint(tuple(sorted(pair)) for pair in found):
            words = f"no joint lies between {first} and {second}: see what `mbla check` says touches"
            yield place, Message("recorded-interface-missing", words)
        elif any(np.isin(pair, blocks).all() for pair in found for blocks in history.rigid):
            words = f"{first} and {second} move as one, by `rigid`: nothing happens between them"
            yield place, Message("recorded-interface-missing", words)


def _loose_ties(assembly: Assembly, rows: IntArray, path: KeyPath) -> Iterator[tuple[KeyPath, Message]]:
    """Ties, (n,), all of whose points are on blocks that are glued to one."""
    model = assembly.model
    body = np.append(np.where(model.fixed, OUTSIDE, assembly.glued().label), OUTSIDE)
    ties = model.ties.with_bodies(body[model.ties.bodies])
    for row in rows.tolist():
        if len(np.unique(ties.bodies[ties.start[row] : ties.start[row + 1]])) == 1:
            words = f"{ties.names[row]} is between blocks that are glued to one: its force is not determined"
            yield path, Message("objective-not-possible", words)


def settlement_findings(assembly: Assembly) -> Iterator[tuple[KeyPath, Message]]:
    """Settling supports that hold nothing: no joint and no tie lies between them and a block that can move."""
    model, contacts = assembly.model, assembly.contacts
    still = np.append(model.fixed, np.ones(len(model.grounds) + 1, dtype=bool))
    ties, glued = model.ties, contacts.report.glued
    for case in model.load_cases:
        blocks = case.question.giving_way
        if not len(blocks):
            continue
        if (np.isin(glued, blocks).sum(axis=1) == 1).any():
            continue  # refused for that
        on_it = np.isin(contacts.bodies, blocks).any(axis=1)
        tied = np.unique(ties.tie_of_point[np.isin(ties.bodies, blocks)])
        beside = [contacts.bodies[on_it].ravel(), ties.bodies[np.isin(ties.tie_of_point, tied)]]
        if still[np.concatenate(beside)].all():  # the last entry stands for what is outside of the model
            words = "nothing that can move touches the settling support: no reaction is lost; see `mbla check`"
            yield ("load_cases", case.deck_name, "settlement", "on"), Message("settlement-without-effect", words)


def _held_otherwise(assembly: Assembly) -> Iterator[tuple[KeyPath, Message]]:
    """Guided blocks that glue holds to a support, or to a block that may move in another way."""
    guides, bodies = assembly.model.guides, assembly.glued()
    stuck, name = np.intersect1d(guides.blocks, assembly.contacts.report.held), assembly.model.blocks.name
    if len(stuck):
        words = f"{named(stuck, name)} may move in some way, but glue holds it to a support"
        yield ("supports",), Message("support-held-twice", words)
    elif (pair := guides_at_odds(guides, bodies.label, bodies.arms)) is not None:
        first, second = map(name, pair)
        words = f"{first} and {second} are glued to one rigid body, but may move in different ways: guide one"
        yield ("supports",), Message("support-held-twice", words)


def _glued_settlements(assembly: Assembly) -> Iterator[tuple[KeyPath, Message]]:
    """A settling support does not take along what is glued to it."""
    model, bodies = assembly.model, assembly.contacts.report.glued
    for case in model.load_cases:
        blocks = case.question.giving_way
        on_it = bodies[np.isin(bodies, blocks).any(axis=1)]
        others = np.setdiff1d(on_it, blocks)
        if len(others):
            names = ", ".join(model.body_name(int(body)) for body in others[:3])
            message = f"{names} held by glue on a settling support: fix that too, so that it settles along"
            yield ("load_cases", case.name, "settlement", "on"), Message("support-held-twice", message)


def _without_effect(bodies: RigidBodies, case: LoadCase) -> bool:
    """Whether the live loads on bodies that move cancel, relative to the sizes of these and of their moments."""
    net = np.abs(bodies.loads(case.live_load)[~bodies.model.fixed]).max(axis=0)
    sizes = np.abs(case.live_load)
    sizes[:, 3:] += (
        np.linalg.norm(bodies.arms, axis=1)[:, None] * np.linalg.norm(case.live_load[:, :3], axis=1)[:, None]
    )
    return bool((net <= CANCELLED * sizes.max(axis=0)).all())
