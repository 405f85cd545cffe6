"""Items `barrel_vault`, `cross_vault` and `pavilion_vault`: curve, thickness, courses, bond."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.items.arch import Backing, backing_width, range_of_rise, shape_keys
from mbla.deck.items.item import SpringingItem
from mbla.deck.quantities import EmbraceAngle, Integer, PositiveLength
from mbla.deck.section import ROUNDING, rule
from mbla.errors import Finding

VaultShape: TypeAlias = Literal["semicircular", "segmental", "pointed", "elliptic", "catenary"]


class VaultItem(SpringingItem):
    """Keys of every vault."""

    shape: VaultShape = Field(
        description="curve of the intrados across: semicircular; segmental with rise or embrace; or pointed, elliptic, "
        "catenary with rise"
    )
    rise: PositiveLength | None = Field(None, description="height of the intrados crown over the springings")
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    thickness: PositiveLength = Field(description="at right angles to the curve")
    courses: Annotated[int, Integer(ge=2, le=100_000)] = Field(
        description="number of courses from springing to springing, of equal lengths on the line halfway through"
    )
    unit: PositiveLength = Field(description="length of the units along their course; closing units are cut to fit")
    bond: Literal["running", "stack"] = Field("running", description="running: odd courses shifted by half a unit")


class BarrelVaultItem(VaultItem):
    """A barrel vault, its axis along +y, courses along the axis, in the bond of a wall.

    The left intrados springing is at x = 0, the right one at x = span, both at z = 0, from y = 0 to length. Labels:
    `course` from the left springing, `unit` from y = 0. With haunches the vault itself is the member `barrel`.
    """

    span: PositiveLength = Field(description="distance between the intrados springings")
    length: PositiveLength = Field(description="extent along y")
    backing: Backing | None = Field(None, description="haunches over the springings, in units along y as the vault")


class CrossVaultItem(VaultItem):
    """A cross (groin) vault: two barrels that meet in vertical planes over the diagonals, the middle of the bay at the
    origin, springings at z = 0.

    The curve spans bay[0], across the webs towards +y and -y; over an oblong bay the other section is this one
    stretched along y, so that the groins stay plane. Blocks at the groins belong to both webs. An odd number of courses
    has a keystone with a course along each ridge, an even one joints along the ridges. Members `groin`, `web`,
    `keystone`; labels: `course` from the springings up, of webs `span` (0 to 3: the webs towards +x, +y, -x, -y) and
    `unit` from the groin outwards, of groins `segment` (0 to 3: the corners at +x+y, -x+y, -x-y, +x-y).
    """

    bay: tuple[PositiveLength, PositiveLength] = Field(
        description="distance along x and y between the corners where the intrados springs"
    )
    edge: PositiveLength | None = Field(
        None,
        description="how far the webs run on beyond these corners, the width of the piers: more than the thickness; "
        "twice the thickness unless given, over an oblong bay that of its stretched section",
    )


class PavilionVaultItem(VaultItem):
    """A pavilion (cloister) vault: it rises from all four sides of a bay, whose middle is at the origin, springings at
    z = 0; courses run along the sides and meet in vertical planes over the diagonals.

    The curve spans bay[0]; over an oblong bay the other section is this one stretched along y, so that the hips stay
    plane. The number of courses is odd: a keystone closes the crown. Members `hip`, `web`, `keystone`; labels: `course`
    from the springings up, of webs `span` (0 to 3: the webs towards +x, +y, -x, -y) and `unit` counter-clockwise, of
    hips `segment` (0 to 3: the corners at +x+y, -x+y, -x-y, +x-y).
    """

    bay: tuple[PositiveLength, PositiveLength] = Field(
        description="extents along x and y between the intrados springings"
    )


LEVEL = ("semicircular", "pointed", "elliptic")
"""shapes that are upright at their springings, so that the joints there are level"""


@rule(VaultItem)
def vault_curve(vault: VaultItem) -> Iterator[Finding]:
    """A semicircle is given by its span alone, other shapes by what they need; the apex of a pointed one is a joint."""
    yield from shape_keys(vault, vault.shape, ("rise", "embrace"))
    span = vault.span if isinstance(vault, BarrelVaultItem) else vault.bay[0]  # type: ignore[attr-defined]
    if vault.rise is not None:
        yield from range_of_rise(vault.shape, span, vault.rise, None, ("rise",))
    if vault.shape == "pointed" and vault.courses % 2 and not isinstance(vault, PavilionVaultItem):
        yield Finding("out-of-bounds", "must be even for a pointed vault: its apex is a joint", "courses")


@rule(BarrelVaultItem)
def vault_backing(vault: BarrelVaultItem) -> Iterator[Finding]:
    """Haunches of a vault need a width."""
    if vault.backing is not None:
        yield from backing_width(vault.backing)


@rule(CrossVaultItem, PavilionVaultItem)
def at_most_semicircular(vault: CrossVaultItem | PavilionVaultItem) -> Iterator[Finding]:
    """Webs that lean in below their widest place would cut each other there."""
    if vault.embrace is not None and vault.embrace > 180:
        yield Finding("out-of-bounds", "must be <= 180: two barrels meet in it", "embrace")
    half = vault.bay[0] / 2
    if vault.shape == "segmental" and vault.rise is not None and vault.rise > half * (1 + ROUNDING):
        words = f"must be <= {half:g}, half the span, for a segmental vault: two barrels meet in it"
        yield Finding("out-of-bounds", words, "rise")


@rule(CrossVaultItem, PavilionVaultItem)
def level_springers(vault: VaultItem) -> Iterator[Finding]:
    """Where two webs meet at a springing, ground is one plane if it is level."""
    if vault.springers == "ground" and vault.shape not in LEVEL:
        words = f"springings on ground are level, those of a {vault.shape} vault slope in each web: write blocks"
        yield Finding("vault-shape", words, "springers")


@rule(PavilionVaultItem)
def pavilion_keystone(vault: PavilionVaultItem) -> Iterator[Finding]:
    """Four webs end in a keystone, which is flat."""
    if vault.courses % 2 == 0:
        yield Finding("out-of-bounds", "must be odd: a keystone closes the crown", "courses")
    if vault.shape == "pointed":
        words = "must not be pointed: a keystone closes the crown, and the apex would be a kink in it"
        yield Finding("vault-shape", words, "shape")
