"""Sections `materials` and `joints`: what blocks are made of, and the laws that joints follow."""

from __future__ import annotations

import math
from collections.abc import Iterator

from pydantic import Field

from mbla.deck.quantities import (
    FrictionAngle,
    NonNegativeNumber,
    NonNegativeStress,
    PositiveDensity,
    PositiveLength,
    PositiveNumber,
    PositiveStiffness,
    PositiveStress,
    PositiveUnitWeight,
)
from mbla.deck.section import ROUNDING, Section, exactly_one_of, given, one_of, rule
from mbla.errors import Finding


@exactly_one_of("density", "unit_weight")
class Material(Section):
    """What blocks are made of; one of density and unit weight."""

    density: PositiveDensity | None = Field(None, description="mass per volume")
    unit_weight: PositiveUnitWeight | None = Field(
        None, description="weight per volume under standard gravity, 9.81 m/s^2"
    )
    tensile_strength: PositiveStress | None = Field(
        None,
        description="tensile strength of the units; changes no load factor: a warning says where units bend or split "
        "by more",
    )
    compressive_strength: PositiveStress | None = Field(
        None,
        description="compressive strength of the units; changes no load factor, which that of joints does: a warning "
        "says where joints without one press by more",
    )


FRICTIONLESS, GLUED, OPEN = "frictionless", "glued", "open"
BUILT_IN = (FRICTIONLESS, GLUED, OPEN)
"""Joint laws that every deck knows by name and none may declare."""


class StiffnessSection(Section):
    """How elastic a joint is in time histories and modes: its normal stiffness, or modulus and thickness of its mortar.

    No load factor depends on it.
    """

    normal: PositiveStiffness | None = Field(
        None, description="pressure over closing, per area of the joint; or modulus and thickness in its place"
    )
    modulus: PositiveStress | None = Field(
        None, description="modulus of elasticity of what gives way; the normal stiffness is modulus over thickness"
    )
    thickness: PositiveLength | None = Field(
        None,
        description="with modulus: of the mortar, or of the units where these give way too and modulus is that of the "
        "masonry",
    )
    ratio: PositiveNumber = Field(0.4, description="shear stiffness over normal stiffness")

    @property
    def across(self) -> float:
        """Normal stiffness, force per area and displacement."""
        if self.normal is not None:
            return self.normal
        assert self.modulus is not None  # a rule: it is there without normal
        assert self.thickness is not None  # and so is this with it
        return self.modulus / self.thickness


@rule(StiffnessSection)
def joint_stiffness(stiffness: StiffnessSection) -> Iterator[Finding]:
    """One of normal and modulus; thickness goes with modulus."""
    yield from one_of(stiffness, ("normal", "modulus"))
    if stiffness.modulus is not None and stiffness.thickness is None:
        yield Finding("missing-key", "needs thickness, over which the joint gives way by its modulus")
    if stiffness.thickness is not None and stiffness.modulus is None:
        yield Finding("key-of-another-choice", "applies with modulus only", "thickness")


@exactly_one_of("friction", "friction_angle")
class JointLaw(Section):
    """Joint law: Coulomb friction without tension unless strengths are given; one of friction and friction angle.

    Three laws are known by name wherever a law is asked for: `frictionless` (friction 0), `glued` (the blocks are one
    rigid body; with a support: they do not move) and `open` (no contact).
    """

    friction: NonNegativeNumber | None = Field(
        None, description="friction coefficient, tan of the friction angle; capped at 1e6"
    )
    friction_angle: FrictionAngle | None = Field(None, description="friction angle in degrees")
    cohesion: NonNegativeStress = Field(0.0, description="shear strength without normal stress")
    tensile_strength: NonNegativeStress = Field(0.0, description="normal stress at which the joint opens")
    compressive_strength: PositiveStress | None = Field(
        None, description="normal stress at which the joint crushes; default: unlimited"
    )
    dilatancy: FrictionAngle = Field(0.0, description="dilatancy angle in degrees, at most the friction angle")
    stiffness: StiffnessSection | None = Field(
        None, description="of time histories and modes: how elastic the joint is; default: next to rigid"
    )


@rule(JointLaw)
def joint_friction(joint: JointLaw) -> Iterator[Finding]:
    """Dilatancy at most the friction angle."""
    if len(given(joint, ("friction", "friction_angle"))) != 1:
        return
    angle = joint.friction_angle if joint.friction is None else math.degrees(math.atan(joint.friction))
    if angle is not None and joint.dilatancy > angle * (1 + ROUNDING):
        yield Finding("out-of-bounds", f"must be <= {angle:.6g} degrees, the friction angle", "dilatancy")


@rule(JointLaw)
def joint_strengths(joint: JointLaw) -> Iterator[Finding]:
    """The friction cone must be open at the tensile strength: it ends at the tension cohesion / friction."""
    if joint.friction is None and joint.friction_angle is None:
        return
    friction = math.tan(math.radians(joint.friction_angle or 0.0)) if joint.friction is None else joint.friction
    if joint.cohesion < friction * joint.tensile_strength * (1 - ROUNDING):
        words = (
            f"must be <= {joint.cohesion / friction:.6g}, cohesion / friction, where the friction cone ends: "
            f"lower it, or raise cohesion to {friction * joint.tensile_strength:.6g}"
        )
        yield Finding("out-of-bounds", words, "tensile_strength")
