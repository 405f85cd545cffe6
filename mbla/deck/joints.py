"""Section `joints`: the laws that joints follow."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import FrictionAngle, NonNegativeNumber, NonNegativeStress, PositiveStress
from mbla.deck.section import Section

FRICTIONLESS, GLUED, OPEN = "frictionless", "glued", "open"
BUILT_IN = (FRICTIONLESS, GLUED, OPEN)
"""Joint laws that every deck knows by name and none may declare."""


class JointLaw(Section):
    """Joint law: Coulomb friction without tension unless strengths are given; one of friction and friction angle.

    Three laws are known by name wherever a law is asked for: `frictionless` (friction 0), `glued` (the blocks are one
    rigid body; with a support: they do not move) and `open` (no contact).
    """

    friction: NonNegativeNumber | None = Field(None, description="friction coefficient, tan of the friction angle")
    friction_angle: FrictionAngle | None = Field(None, description="friction angle in degrees")
    cohesion: NonNegativeStress = Field(0.0, description="shear strength without normal stress")
    tensile_strength: NonNegativeStress = Field(0.0, description="normal stress at which the joint opens")
    compressive_strength: PositiveStress | None = Field(
        None, description="normal stress at which it crushes; unlimited unless given"
    )
    dilatancy: FrictionAngle = Field(0.0, description="dilatancy angle in degrees, at most the friction angle")
