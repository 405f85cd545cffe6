"""Joint laws of the model: angles of the deck as tangents."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mbla.deck.deck import Deck
from mbla.deck.joints import FRICTIONLESS
from mbla.deck.types import JointLaw
from mbla.errors import Notice
from mbla.model.model import Ground, Joint, PrescribedInterfaces

UNLIMITED = 1e6
"""Greatest friction coefficient and tangent of the dilatancy angle, 0.2 seconds of arc from a right angle: what is
steeper is taken for this. A load factor changes by a millionth between here and no limit; the power of sliding, which
is rounding times friction, would be the whole answer at 1e15."""


def build_joints(deck: Deck, grounds: Sequence[Ground], interfaces: PrescribedInterfaces | None) -> dict[str, Joint]:
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
        friction=min(friction, UNLIMITED),
        cohesion=law.cohesion,
        tensile_strength=law.tensile_strength,
        compressive_strength=math.inf if law.compressive_strength is None else law.compressive_strength,
        dilatancy=min(math.tan(math.radians(law.dilatancy)), UNLIMITED),
    )


def joint_notices(deck: Deck) -> list[Notice]:
    """Laws whose friction is taken for less than the deck gives."""
    steepest = math.degrees(math.atan(UNLIMITED))
    return [
        Notice("notice", "friction-limited", f"joint law {name}: its friction is taken for {UNLIMITED:g}")
        for name, law in deck.content.joints.items()
        if (law.friction or 0.0) > UNLIMITED or (law.friction_angle or 0.0) > steepest
    ]
