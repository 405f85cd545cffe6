"""Rules on supports."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import given, is_zero
from mbla.deck.section import Finding, rule
from mbla.errors import Message


@rule(types.GroundPlane)
def ground_plane(ground: types.GroundPlane) -> Iterator[Finding]:
    """A normal goes with a point."""
    yield from _plane_normal(ground)


@rule(types.SymmetryPlane)
def symmetry_plane(plane: types.SymmetryPlane) -> Iterator[Finding]:
    """A normal goes with a point."""
    yield from _plane_normal(plane)


def _plane_normal(ground: types.GroundPlane | types.SymmetryPlane) -> Iterator[Finding]:
    if ground.point is not None and ground.normal is None:
        yield (), Message("missing-key", "needs a normal beside its point")
    if ground.normal is not None and ground.point is None:
        yield ("normal",), Message("key-of-another-choice", "applies with point only")
    if ground.normal is not None and is_zero(ground.normal):
        yield ("normal",), Message("zero-vector", "must not be the zero vector")


@rule(types.Support)
def support(item: types.Support) -> Iterator[Finding]:
    """Ground, or blocks that do not move, or not as they like."""
    if item.ground is None and item.blocks is None:
        yield (), Message("missing-key", "needs one of ground or blocks")
    elif item.joint is not None and item.ground is None:
        yield (
            ("joint",),
            Message(
                "key-of-another-choice",
                "applies with ground only: blocks that do not move have the joints of their contacts",
            ),
        )
    ways = given(item, ("fixed", "slide", "turn"))
    if item.ground is not None:
        for key in (*ways, *given(item, ("together",))):
            yield (
                (key,),
                Message(
                    "key-of-another-choice",
                    "does not apply to ground, which does not move: say it of blocks in an item of their own",
                ),
            )
        return
    if item.fixed is not None and len(ways) > 1:
        yield (
            (ways[1],),
            Message(
                "one-of-several",
                "only one of fixed, and slide or turn, may be given: what may slide or turn is held otherwise",
            ),
        )
    if item.together and not ways:
        yield (
            ("together",),
            Message(
                "key-of-another-choice",
                "applies with fixed, slide or turn only: blocks that do not move do so together anyway",
            ),
        )


@rule(types.Support)
def guide(item: types.Support) -> Iterator[Finding]:
    """Ways to move that are ways."""
    fixed = item.fixed or []
    for number, component in enumerate(fixed):
        if component in fixed[:number]:
            yield ("fixed", number), Message("duplicate-key", f"{component} is listed already")
    if item.slide is not None and is_zero(item.slide):
        yield ("slide",), Message("zero-vector", "must not be the zero vector")


@rule(types.Turn)
def turn_axis(turn: types.Turn) -> Iterator[Finding]:
    """A line has a direction."""
    if is_zero(turn.axis):
        yield ("axis",), Message("zero-vector", "must not be the zero vector")
