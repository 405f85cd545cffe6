"""Joint laws of the model: angles of the deck as tangents."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mbla.deck.deck import Deck
from mbla.deck.joints import FRICTIONLESS
from mbla.deck.types import JointLaw
from mbla.model.model import GivenInterfaces, Ground, Joint


def build_joints(deck: Deck, grounds: Sequence[Ground], interfaces: GivenInterfaces | None) -> dict[str, Joint]:
    """Joint laws of the deck, and that without friction where it is asked for by its name."""
    laws = {name: build_joint(name, law) for name, law in deck.content.joints.items()}
    used = {deck.contacts.joint, *(override.joint for override in deck.contacts.overrides)}
    used |= {ground.joint for ground in grounds}
    if FRICTIONLESS in used.union(interfaces.joints if interfaces else ()):
        laws[FRICTIONLESS] = Joint(FRICTIONLESS, 0.0)
    return laws


def build_joint(name: str, law: JointLaw) -> Joint:
    """Joint law with tangents for angles, and an unlimited compressive strength unless given."""
    friction = law.friction
    if friction is None:
        assert law.friction_angle is not None  # a rule of the deck: one of friction and friction angle
        friction = math.tan(math.radians(law.friction_angle))
    return Joint(
        name=name,
        friction=friction,
        cohesion=law.cohesion,
        tensile_strength=law.tensile_strength,
        compressive_strength=math.inf if law.compressive_strength is None else law.compressive_strength,
        dilatancy=math.tan(math.radians(law.dilatancy)),
    )
