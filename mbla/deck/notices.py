"""What a valid deck should make its author look twice at.

Keys without effect are no faults: ``--flow-rule`` and ``--set`` leave keys unused that the deck has for another run.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from mbla.deck.content import DeckContent
from mbla.deck.expressions import Parameters
from mbla.deck.references import unused_names
from mbla.deck.sections.analysis import APPLIES
from mbla.deck.sections.loads import Load
from mbla.deck.text.tree import KeyPath, Tree, key_text
from mbla.deck.units import METRES, STANDARD_GRAVITY, Units
from mbla.errors import Message, Notice

GRAVITY_TOLERANCE = 0.02
"""Covers 9.8, 9.80665 and the variation over the earth."""


def notices_of(tree: Tree, content: DeckContent, units: Units, parameters: Parameters) -> tuple[Notice, ...]:
    """Warnings about unusual gravity and keys without effect, and remarks on names that nothing uses."""
    return (*_gravity(tree, content, units), *unused_keys(tree, content), *_unused(tree, content, parameters))


def _gravity(tree: Tree, content: DeckContent, units: Units) -> Iterator[Notice]:
    """Gravity far from 9.81 m/s2: mostly a deck in mm whose gravity is still in m."""
    for path, load in _loads(content):
        if load.gravity is None or load.gravity == "none" or not any(load.gravity):
            continue
        size = math.hypot(*load.gravity) * METRES[units.length]
        if abs(size - STANDARD_GRAVITY) > GRAVITY_TOLERANCE * STANDARD_GRAVITY:
            fault = tree.fault((*path, "gravity"), Message("gravity-unusual", f"is {size:.4g} m/s^2, not 9.81"))
            words = f"{fault}: its numbers are in {units.unit('acceleration')}"
            yield Notice("warning", "gravity-unusual", words)


def _loads(content: DeckContent) -> Iterator[tuple[KeyPath, Load]]:
    for name, named in content.loads.items():
        yield from ((("loads", name, number), load) for number, load in enumerate(named))
    for name, case in content.load_cases.items():
        for key, loads in (("dead", case.dead or []), ("live", case.live or [])):
            for number, load in enumerate(loads):
                yield ("load_cases", name, key, number), load


def _unused(tree: Tree, content: DeckContent, parameters: Parameters) -> Iterator[Notice]:
    for name in content.parameters:
        if name not in parameters.used:
            path = ("parameters", name)
            yield Notice("notice", "parameter-unused", f"{tree.place_at(path)} {key_text(path)} is not used")
    for section, name in unused_names(tree.data):
        path = (section, name)
        identifier = f"{section.removesuffix('s')}-unused"
        yield Notice("notice", identifier, f"{tree.place_at(path)} {key_text(path)} is not used")


def unused_keys(tree: Tree, content: DeckContent) -> Iterator[Notice]:
    """A warning for each key that is given without effect."""
    analysis = content.analysis
    given = tree.data.get("analysis") or {}
    for key, (applies, where) in APPLIES.items():
        if key in given and not applies(analysis):
            yield _notice(tree, ("analysis", key), where)
    for name, joint in content.joints.items():
        if joint.dilatancy > 0.0 and analysis.flow_rule != "dilatancy":
            yield _notice(tree, ("joints", name, "dilatancy"), "flow_rule: dilatancy")


def _notice(tree: Tree, path: KeyPath, where: str) -> Notice:
    return Notice(
        "warning", "key-idle", str(tree.fault(path, Message("key-idle", f"has no effect: it applies to {where}")))
    )
