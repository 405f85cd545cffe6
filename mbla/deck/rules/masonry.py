"""Rules on walls: bond, openings, gables, buttresses."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.items.masonry import Buttress, Gable, Opening, OpeningArch
from mbla.deck.rules.common import ROUNDING
from mbla.deck.section import Finding, rule
from mbla.errors import Message

BONDED = ("english", "flemish", "header")
"""bonds with headers of their own"""


def check_bond(wall: types.Masonry) -> Iterator[Finding]:
    """Headers go through a wall of several leaves; random units are those of a running bond."""
    length, thickness, _ = wall.unit
    if wall.bond in BONDED:
        across = wall.leaves * thickness
        if wall.leaves == 1:
            yield (
                ("leaves",),
                Message("out-of-bounds", f"must be >= 2 in {wall.bond} bond, whose headers lie across the leaves"),
            )
        elif abs(length - across) > ROUNDING * across:
            yield (
                ("unit", 0),
                Message(
                    "out-of-bounds",
                    f"must be {across:g} in {wall.bond} bond: a unit laid across goes through all leaves",
                ),
            )
        if wall.headers is not None:
            yield (
                ("headers",),
                Message(
                    "key-of-another-choice",
                    f"applies to running and stack bond: {wall.bond} bond has headers of its own",
                ),
            )
    elif wall.headers is not None and wall.leaves == 1:
        yield ("headers",), Message("missing-key", "needs leaves >= 2 that they tie")
    if wall.irregular is not None:
        if wall.bond not in ("running", "stretcher"):
            yield ("irregular",), Message("key-of-another-choice", f"applies to running bond only, here is {wall.bond}")
        if wall.start != "full":
            yield ("start",), Message("key-of-another-choice", "has no meaning with random units: leave it out")


def check_openings(wall: types.WallItem | types.WallsItem, number: int, length: float) -> Iterator[Finding]:
    """An opening has an extent and lies within the wall, as does what spans it."""
    opening, height = wall.openings[number], wall.unit[2]
    limits = (length, wall.courses * height)
    for axis, (limit, what) in enumerate(zip(limits, ("length", "height"), strict=True)):
        low, high = opening.from_[axis], opening.to[axis]
        if not low < high:
            yield ("openings", number, "to", axis), Message("out-of-bounds", f"must be > {low:g}, that of from")
        if low < -ROUNDING * limit:
            yield (
                ("openings", number, "from", axis),
                Message("out-of-bounds", "must be >= 0: the opening must lie within the wall"),
            )
        if high > limit * (1 + ROUNDING):
            yield (
                ("openings", number, "to", axis),
                Message("out-of-bounds", f"must be <= {limit:g}, the {what} of the wall"),
            )
    if opening.arch is not None and opening.arch.rise > 0:
        path = ("openings", number, "arch", "rise")
        room, half = opening.arch.courses * height, (opening.to[0] - opening.from_[0]) / 2
        if opening.arch.rise >= min(room, half):
            yield (
                path,
                Message(
                    "out-of-bounds",
                    f"must be < {min(room, half):g}: half the opening, and the height of the arch in courses",
                ),
            )
        elif not opening.arch.rise / half:
            yield path, Message("out-of-bounds", f"is lost beside half the opening, {half:g}: make it larger")


def check_gable(gable: Gable, length: float) -> Iterator[Finding]:
    """The apex is above the wall; key paths below the gable."""
    if gable.apex is not None and not -ROUNDING * length <= gable.apex <= length * (1 + ROUNDING):
        yield ("apex",), Message("out-of-bounds", f"must be between 0 and {length:g}, the length of the wall")


def check_buttress(wall: types.Masonry, buttress: Buttress, length: float) -> Iterator[Finding]:
    """A buttress is as long as the wall at most, and as high; key paths below it."""
    if buttress.at < -ROUNDING * length:
        yield ("at",), Message("out-of-bounds", "must be >= 0: the buttress must lie within the wall")
    elif buttress.at + buttress.width > length * (1 + ROUNDING):
        yield (
            ("width",),
            Message("out-of-bounds", f"must be <= {length - buttress.at:g}, so that the buttress ends within the wall"),
        )
    sloped = buttress.slope / wall.unit[2]
    if not math.isfinite(sloped) or abs(sloped - round(sloped)) > ROUNDING * max(sloped, 1.0):
        yield ("slope",), Message("out-of-bounds", f"must be a whole number of courses of {wall.unit[2]:g}")
    elif buttress.courses is None and round(sloped) >= wall.courses:
        yield ("slope",), Message("wall-shape", "must leave a level part: it is as high as the wall")
    elif buttress.courses is not None and buttress.courses + round(sloped) > wall.courses:
        yield (
            ("courses",),
            Message(
                "out-of-bounds",
                f"must be <= {wall.courses - round(sloped)}: with its slope it ends at the top of the wall",
            ),
        )


@rule(types.Opening)
def one_span(opening: Opening) -> Iterator[Finding]:
    """A lintel or an arch."""
    if opening.lintel is not None and opening.arch is not None:
        yield ("arch",), Message("one-of-several", "only one of lintel and arch may be given")


@rule(OpeningArch)
def arch_of_opening(arch: OpeningArch) -> Iterator[Finding]:
    """The embrace of a segment of a circle follows from its rise."""
    if arch.embrace is None:
        return
    if arch.rise > 0:
        yield (
            ("embrace",),
            Message(
                "key-of-another-choice", "applies to flat arches: that of a segment of a circle follows from its rise"
            ),
        )
    elif arch.embrace >= 180:
        yield ("embrace",), Message("out-of-bounds", "must be < 180: the end joints of a flat arch meet below it")


@rule(types.WallItem)
def wall(item: types.WallItem) -> Iterator[Finding]:
    """All that a straight wall has."""
    yield from check_bond(item)
    for number in range(len(item.openings)):
        yield from check_openings(item, number, item.length)
    if item.gable is not None:
        yield from ((("gable", *path), message) for path, message in check_gable(item.gable, item.length))
    for number, buttress in enumerate(item.buttresses):
        found = check_buttress(item, buttress, item.length)
        yield from ((("buttresses", number, *path), message) for path, message in found)
