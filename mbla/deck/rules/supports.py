"""Rules on supports."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import is_zero
from mbla.deck.section import Finding, rule


@rule(types.GroundPlane)
def ground_plane(ground: types.GroundPlane) -> Iterator[Finding]:
    """A normal goes with a point."""
    if ground.point is not None and ground.normal is None:
        yield (), "needs a normal beside its point"
    if ground.normal is not None and ground.point is None:
        yield ("normal",), "applies with point only"
    if ground.normal is not None and is_zero(ground.normal):
        yield ("normal",), "must not be the zero vector"


@rule(types.Support)
def support(item: types.Support) -> Iterator[Finding]:
    """Ground, or blocks that do not move."""
    if item.ground is None and item.blocks is None:
        yield (), "needs one of ground or blocks"
    elif item.joint is not None and item.ground is None:
        yield ("joint",), "applies with ground only: blocks that do not move have the joints of their contacts"
