"""Rules on vaults, domes and stairs."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import ROUNDING, exactly_one, given
from mbla.deck.section import Finding, rule
from mbla.errors import Message


@rule(types.DomeItem)
def dome_shape(dome: types.DomeItem) -> Iterator[Finding]:
    """A hemisphere is given by its span alone; the crown is open or closed."""
    if dome.shape == "segmental":
        yield from exactly_one(dome, ("rise", "embrace"), " for a segmental dome")
    else:
        for key in given(dome, ("rise", "embrace")):
            yield (
                (key,),
                Message(
                    "key-of-another-choice", "applies to segmental domes only: leave it out, or write shape: segmental"
                ),
            )
    if dome.oculus is not None and dome.keystone is not None:
        yield ("keystone",), Message("one-of-several", "only one of oculus or keystone may be given")


@rule(types.DomeItem)
def dome_bond(dome: types.DomeItem) -> Iterator[Finding]:
    """Half a block is a whole number of facets."""
    if dome.bond == "running" and dome.facets is not None and dome.facets % 2:
        yield (
            ("facets",),
            Message(
                "out-of-bounds", "must be even in running bond: rings are turned by half a block; or write bond: stack"
            ),
        )


@rule(types.DomeItem)
def dome_springers(dome: types.DomeItem) -> Iterator[Finding]:
    """Ground is one plane."""
    if dome.springers == "ground" and dome.shape == "segmental" and dome.drum is None:
        yield (
            ("springers",),
            Message(
                "vault-shape",
                "a springing on ground is level, that of a segmental dome is a cone: write blocks, or add a drum",
            ),
        )
    if dome.springers == "blocks" and dome.drum is not None:
        yield ("springers",), Message("key-of-another-choice", "a drum carries the dome: write ground or none")
    if dome.joint is not None and dome.springers != "ground":
        yield ("joint",), Message("key-of-another-choice", "applies with springers: ground only")


CURVED = (types.BarrelVaultItem, types.CrossVaultItem, types.PavilionVaultItem)
LEVEL = ("semicircular", "pointed", "elliptic")
"""shapes that are upright at their springings, so that the joints there are level"""


def vault_curve(vault: types.VaultItem) -> Iterator[Finding]:
    """A semicircle is given by its span alone; a segment needs its rise or its angle, other shapes their rise."""
    if vault.shape == "segmental":
        yield from exactly_one(vault, ("rise", "embrace"), " for a segmental vault")
        return
    if vault.embrace is not None:
        yield (
            ("embrace",),
            Message(
                "key-of-another-choice",
                f"applies to shape: segmental only: leave it out, or change shape ({vault.shape} given)",
            ),
        )
    if vault.shape == "semicircular" and vault.rise is not None:
        yield (
            ("rise",),
            Message("key-of-another-choice", "does not apply to shape: semicircular: leave it out, or change shape"),
        )
    if vault.shape != "semicircular" and vault.rise is None:
        yield (), Message("missing-key", f"needs rise for shape: {vault.shape}")


def vault_apex(vault: types.VaultItem) -> Iterator[Finding]:
    """A pointed vault is more than a semicircle high, with a joint at its apex."""
    span = vault.span if isinstance(vault, types.BarrelVaultItem) else vault.bay[0]  # type: ignore[attr-defined]
    if vault.shape == "pointed":
        if vault.rise is not None and vault.rise <= span / 2 * (1 + ROUNDING):
            yield ("rise",), Message("out-of-bounds", f"must be > {span / 2:g}, half the span, for a pointed vault")
        if vault.courses % 2 and not isinstance(vault, types.PavilionVaultItem):
            yield ("courses",), Message("out-of-bounds", "must be even for a pointed vault: its apex is a joint")


def vault_springers(vault: types.VaultItem) -> Iterator[Finding]:
    """The joint law of a ground needs a ground."""
    if vault.joint is not None and vault.springers != "ground":
        yield ("joint",), Message("key-of-another-choice", "applies with springers: ground only")


for _vault in CURVED:
    for _check in (vault_curve, vault_apex, vault_springers):
        rule(_vault)(_check)


def at_most_semicircular(vault: types.VaultItem) -> Iterator[Finding]:
    """Webs that lean in below their widest place would cut each other there."""
    if vault.embrace is not None and vault.embrace > 180:
        yield ("embrace",), Message("out-of-bounds", "must be <= 180: two barrels meet in it")
    bay: float = vault.bay[0]  # type: ignore[attr-defined]
    if vault.shape == "segmental" and vault.rise is not None and vault.rise > bay / 2 * (1 + ROUNDING):
        yield (
            ("rise",),
            Message(
                "out-of-bounds", f"must be <= {bay / 2:g}, half the span, for a segmental vault: two barrels meet in it"
            ),
        )


def level_springers(vault: types.VaultItem) -> Iterator[Finding]:
    """Where two webs meet at a springing, ground is one plane if it is level."""
    if vault.springers == "ground" and vault.shape not in LEVEL:
        yield (
            ("springers",),
            Message(
                "vault-shape",
                f"springings on ground are level, those of a {vault.shape} vault slope in each web: write blocks",
            ),
        )


for _vault in (types.CrossVaultItem, types.PavilionVaultItem):
    rule(_vault)(level_springers)
    rule(_vault)(at_most_semicircular)


@rule(types.PavilionVaultItem)
def pavilion_keystone(vault: types.PavilionVaultItem) -> Iterator[Finding]:
    """Four webs end in a keystone, which is flat."""
    if vault.courses % 2 == 0:
        yield ("courses",), Message("out-of-bounds", "must be odd: a keystone closes the crown")
    if vault.shape == "pointed":
        yield (
            ("shape",),
            Message(
                "vault-shape", "must not be pointed: a keystone closes the crown, and the apex would be a kink in it"
            ),
        )


@rule(types.SpiralStairItem)
def stair_extents(stair: types.SpiralStairItem) -> Iterator[Finding]:
    """Radii in order; a tread is longer than it overlaps the next, and higher than its rebate."""
    if stair.outer_radius <= stair.inner_radius:
        yield ("outer_radius",), Message("out-of-bounds", f"must be > {stair.inner_radius:g}, the inner radius")
    if stair.overlap >= stair.angle:
        yield ("overlap",), Message("out-of-bounds", f"must be < {stair.angle:g}, the angle from tread to tread")
    if stair.rebate >= stair.rise:
        yield ("rebate",), Message("out-of-bounds", f"must be < {stair.rise:g}, the rise")


@rule(types.SpiralStairItem)
def stair_supports(stair: types.SpiralStairItem) -> Iterator[Finding]:
    """A wall holds what is built into it."""
    if stair.wall != "none" and stair.built_in == 0:
        yield ("wall",), Message("missing-key", "needs built_in: the wall holds the ends of treads that reach into it")
    if stair.joint is not None and stair.foot != "ground":
        yield ("joint",), Message("key-of-another-choice", "applies with foot: ground only")
