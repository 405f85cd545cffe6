"""Rules on joint laws."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import ROUNDING, given
from mbla.deck.section import Finding, rule
from mbla.errors import Message


@rule(types.JointLaw)
def joint_friction(joint: types.JointLaw) -> Iterator[Finding]:
    """Dilatancy at most the friction angle."""
    if len(given(joint, ("friction", "friction_angle"))) != 1:
        return
    angle = joint.friction_angle if joint.friction is None else math.degrees(math.atan(joint.friction))
    if angle is not None and joint.dilatancy > angle * (1 + ROUNDING):
        yield ("dilatancy",), Message("out-of-bounds", f"must be <= {angle:.6g} degrees, the friction angle")


@rule(types.JointLaw)
def joint_strengths(joint: types.JointLaw) -> Iterator[Finding]:
    """The friction cone must be open at the tensile strength: it ends at the tension cohesion / friction."""
    if joint.friction is None and joint.friction_angle is None:
        return
    friction = math.tan(math.radians(joint.friction_angle or 0.0)) if joint.friction is None else joint.friction
    if joint.cohesion < friction * joint.tensile_strength * (1 - ROUNDING):
        yield (
            ("tensile_strength",),
            Message(
                "out-of-bounds",
                f"must be <= {joint.cohesion / friction:.6g}, cohesion / friction, where the friction cone ends: "
                f"lower it, or raise cohesion to {friction * joint.tensile_strength:.6g}",
            ),
        )
