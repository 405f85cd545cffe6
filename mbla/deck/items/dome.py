"""Item `dome`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.items.item import SpringingItem
from mbla.deck.quantities import Count, EmbraceAngle, Integer, PositiveLength
from mbla.deck.section import Section, given, one_of, rule
from mbla.errors import Finding


class DomeDrum(Section):
    """Cylindrical wall under a dome, in the same bond and with as many blocks around."""

    height: PositiveLength = Field(description="height up to the intrados springing")
    courses: Count = Field(description="number of courses")
    thickness: PositiveLength | None = Field(
        None, description="radial thickness, inside flush with the dome; that of the dome unless given"
    )


class DomeItem(SpringingItem):
    """A spherical dome of rings of blocks about the z axis, bed joints conical about the centre of the sphere.

    The middle of the springing is at the origin, or at z = height of the drum, which then stands at z = 0. Circles are
    polygons with their corners on the circle. Labels: `ring` (the keystone is the last) and `segment`, in the drum
    `course` and `segment`; members `ring`, `keystone`, `drum`.
    """

    shape: Literal["hemispherical", "segmental"] = Field(
        "hemispherical", description="hemispherical, or segmental with rise or embrace"
    )
    span: PositiveLength = Field(description="diameter of the intrados at the springing")
    thickness: PositiveLength = Field(description="radial thickness")
    rings: Count = Field(description="number of rings, without the keystone")
    segments: Annotated[int, Integer(ge=3, le=10_000)] = Field(description="blocks of each ring")
    rise: PositiveLength | None = Field(None, description="segmental: height of the intrados crown over the springing")
    embrace: EmbraceAngle | None = Field(
        None, description="segmental: angle between the springing joints in a section through the axis, degrees"
    )
    oculus: PositiveLength | None = Field(
        None,
        description="diameter of an opening in the intrados at the crown; the rim is cut along the cone and has no "
        "level seat for a lantern",
    )
    keystone: PositiveLength | None = Field(
        None,
        description="diameter, in the intrados, of the block that closes the crown; without it and without an oculus "
        "the keystone is as wide as a ring",
    )
    bond: Literal["running", "stack"] = Field(
        "running", description="running: odd rings are turned by half a block; stack: joints run up the meridians"
    )
    facets: Annotated[int, Integer(ge=1, le=1000)] | None = Field(
        None,
        description="plane pieces around of each block's faces, even for running bond; 2 unless given, in stack bond 1",
    )
    drum: DomeDrum | None = Field(None, description="cylindrical wall that the dome stands on")


@rule(DomeItem)
def dome_shape(dome: DomeItem) -> Iterator[Finding]:
    """A hemisphere is given by its span alone; the crown is open or closed."""
    if dome.shape == "segmental":
        yield from one_of(dome, ("rise", "embrace"), " for a segmental dome")
    else:
        for key in given(dome, ("rise", "embrace")):
            yield Finding(
                "key-of-another-choice", "applies to segmental domes only: leave it out, or write shape: segmental", key
            )
    if dome.oculus is not None and dome.keystone is not None:
        yield Finding("one-of-several", "only one of oculus or keystone may be given", "keystone")


@rule(DomeItem)
def dome_bond(dome: DomeItem) -> Iterator[Finding]:
    """Half a block is an integer number of facets."""
    if dome.bond == "running" and dome.facets is not None and dome.facets % 2:
        words = "must be even in running bond: rings are turned by half a block; or write bond: stack"
        yield Finding("out-of-bounds", words, "facets")


@rule(DomeItem)
def dome_springers(dome: DomeItem) -> Iterator[Finding]:
    """Ground is one plane."""
    if dome.springers == "ground" and dome.shape == "segmental" and dome.drum is None:
        words = "a springing on ground is level, that of a segmental dome is a cone: write blocks, or add a drum"
        yield Finding("vault-shape", words, "springers")
    if dome.springers == "blocks" and dome.drum is not None:
        yield Finding("key-of-another-choice", "a drum carries the dome: write ground or none", "springers")
