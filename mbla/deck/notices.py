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

USUAL: tuple[tuple[str, str, float | str, float | str, str], ...] = (
    ("joints", "friction", 0.0, 5.0, "is more than masonry has; an angle is given as friction_angle, in degrees"),
    ("joints", "friction_angle", 1.0, 90.0, "is less than masonry has; a coefficient is given as friction"),
    ("materials", "density", "200 kg/m^3", "20000 kg/m^3", "is not that of masonry, 1500 to 3000 kg/m^3"),
    ("materials", "unit_weight", "2 kN/m^3", "200 kN/m^3", "is not that of masonry, 15 to 30 kN/m^3"),
)
"""What values of a section's keys are taken for another unit outside of, and in words what then."""


def notices_of(tree: Tree, content: DeckContent, units: Units, parameters: Parameters) -> tuple[Notice, ...]:
    """Warnings about unusual values and keys without effect, and remarks on names that nothing uses."""
    odd = (*_gravity(tree, content, units), *_unusual(tree, content, units))
    return (*odd, *unused_keys(tree, content), *_unused(tree, content, parameters))


def _unusual(tree: Tree, content: DeckContent, units: Units) -> Iterator[Notice]:
    """Values far from those of masonry: mostly of another unit, or an angle for a coefficient."""
    odd: list[tuple[KeyPath, str]] = []
    for section, key, least, most, words in USUAL:
        low, high = (units.convert(end, key) if isinstance(end, str) else end for end in (least, most))
        values = {name: getattr(item, key) for name, item in getattr(content, section).items()}
        odd += [((section, name, key), words) for name, value in values.items() if value and not low <= value <= high]
    multiples = ((path, load.acceleration) for path, load in _loads(content) if load.acceleration is not None)
    odd += [((*path, "acceleration"), "is in units of g = 9.81 m/s^2") for path, a in multiples if math.hypot(*a) > 5.0]
    for path, words in odd:
        yield Notice("warning", "value-unusual", str(tree.fault(path, Message("value-unusual", words))))


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
    unused = [("parameters", name) for name in content.parameters if name not in parameters.used]
    for section, name in (*unused, *unused_names(tree.data)):
        identifier = f"{section.removesuffix('s')}-unused"
        path = (section, name)
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
    fault = tree.fault(path, Message("key-idle", f"has no effect: it applies to {where}"))
    return Notice("warning", "key-idle", str(fault))
