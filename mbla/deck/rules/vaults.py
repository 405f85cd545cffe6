"""Rules on vaults, domes and stairs."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import exactly_one, given
from mbla.deck.section import Finding, rule


@rule(types.DomeItem)
def dome_shape(dome: types.DomeItem) -> Iterator[Finding]:
    """A hemisphere is given by its span alone; the crown is open or closed."""
    if dome.shape == "segmental":
        yield from exactly_one(dome, ("rise", "embrace"), " for a segmental dome")
    else:
        for key in given(dome, ("rise", "embrace")):
            yield (key,), "applies to segmental domes only: leave it out, or write shape: segmental"
    if dome.oculus is not None and dome.keystone is not None:
        yield ("keystone",), "only one of oculus or keystone may be given"


@rule(types.DomeItem)
def dome_bond(dome: types.DomeItem) -> Iterator[Finding]:
    """Half a block is a whole number of facets."""
    if dome.bond == "running" and dome.facets is not None and dome.facets % 2:
        yield ("facets",), "must be even in running bond: rings are turned by half a block; or write bond: stack"


@rule(types.DomeItem)
def dome_springers(dome: types.DomeItem) -> Iterator[Finding]:
    """Ground is one plane."""
    if dome.springers == "ground" and dome.shape == "segmental" and dome.drum is None:
        yield (
            ("springers",),
            "a springing on ground is level, that of a segmental dome is a cone: write blocks, or add a drum",
        )
    if dome.springers == "blocks" and dome.drum is not None:
        yield ("springers",), "a drum carries the dome: write ground or none"
    if dome.joint is not None and dome.springers != "ground":
        yield ("joint",), "applies with springers: ground only"
