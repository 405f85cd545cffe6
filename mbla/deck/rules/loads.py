"""Rules on loads."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from mbla.deck import types
from mbla.deck.rules.common import given, is_zero, least_below_greatest
from mbla.deck.rules.exactly_one import EXACTLY_ONE
from mbla.deck.section import Finding, rule
from mbla.deck.suggestions import listed
from mbla.errors import Message

PARALLEL = 1e-6
"""sine of the angle between a line and the direction to its blocks, up to which they are parallel"""

NEEDS_BLOCK = ("force", "moment")
"""kinds of loads that act on one block, which `on` names"""
ON_ALL_BLOCKS = {"gravity": "acts on all blocks: use acceleration", "tilt": "turns the whole structure"}
"""kinds that `on` does not apply to, and why"""
LIVE_ONLY = ("travel", "tilt")
"""kinds that make something else of a load case than a sum of loads"""


@rule(types.Load)
def load_keys(load: types.Load) -> Iterator[Finding]:
    """Where a load acts, as far as that applies."""
    kind = next(iter(given(load, EXACTLY_ONE[types.Load])), "")
    if kind in NEEDS_BLOCK and load.on is None:
        yield (), Message("one-block-only", f"a {kind} needs `on`, the block it acts on")
    if load.at is not None and kind != "force":
        yield ("at",), Message("key-of-another-choice", "applies to a force only")
    if load.on is not None and kind in ON_ALL_BLOCKS:
        yield ("on",), Message("key-of-another-choice", f"does not apply to {kind}, which {ON_ALL_BLOCKS[kind]}")
    if load.on is not None and kind == "loads":
        yield (
            ("on",),
            Message(
                "key-of-another-choice",
                "does not apply to named loads: each of them says itself on which blocks it acts",
            ),
        )
    if load.on is not None and load.table is not None:
        yield ("on",), Message("key-of-another-choice", "does not apply to a table, whose rows name their blocks")
    if load.pattern is not None and kind != "acceleration":
        yield ("pattern",), Message("key-of-another-choice", "applies to acceleration only")
    if kind == "tilt" and load.factor != 1.0:
        yield ("factor",), Message("key-of-another-choice", "does not apply to tilt: gravity turns as it is")


@rule(types.HeightPattern)
def height_pattern(pattern: types.HeightPattern) -> Iterator[Finding]:
    """From base to top, or through points with rising heights."""
    if is_zero(pattern.along):
        yield ("along",), Message("zero-vector", "must not be the zero vector")
    for key in given(pattern, ("base", "top")) if pattern.points is not None else []:
        yield (key,), Message("key-of-another-choice", "does not apply beside points")
    if pattern.base is not None and pattern.top is not None and not pattern.base < pattern.top:
        yield ("top",), Message("out-of-bounds", f"must be > {pattern.base:g}, the base")
    heights = [height for height, _ in pattern.points or []]
    for number, (below, above) in enumerate(pairwise(heights), start=1):
        if not below < above:
            yield ("points", number, 0), Message("out-of-bounds", f"must be > {below:g}, the height before it")


@rule(types.LineLoad)
def line_load(line: types.LineLoad) -> Iterator[Finding]:
    """A line has a length, and its blocks lie aside of it."""
    run = [end - begin for begin, end in zip(line.from_, line.to, strict=True)]
    if is_zero(line.towards):
        yield ("towards",), Message("zero-vector", "must not be the zero vector")
    if is_zero(run):
        yield ("to",), Message("degenerate-line", "must not be the point from: the line has no length")
    elif not is_zero(line.towards) and _parallel(run, line.towards):
        yield (
            ("towards",),
            Message("degenerate-line", "must not run along the line: give the direction in which its blocks lie"),
        )


def _parallel(a: list[float], b: tuple[float, ...]) -> bool:
    """Whether two vectors have one direction, or opposite ones; free of overflow."""
    u, v = ([each / max(map(abs, vector)) for each in vector] for vector in (a, b))
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(each**2 for each in cross) <= PARALLEL**2 * sum(each**2 for each in u) * sum(each**2 for each in v)


@rule(types.PressureLoad)
def pressure_load(pressure: types.PressureLoad) -> Iterator[Finding]:
    """A depth needs a level, an angle a normal."""
    if pressure.per_depth is not None and pressure.level is None:
        yield ("per_depth",), Message("missing-key", "needs a level from which depth is measured")
    if pressure.normal is not None and is_zero(pressure.normal):
        yield ("normal",), Message("zero-vector", "must not be the zero vector")
    if "within" in pressure.model_fields_set and pressure.normal is None:
        yield ("within",), Message("key-of-another-choice", "applies with normal only")
    if not {"value", "per_depth"} & pressure.model_fields_set:
        yield (), Message("missing-key", "needs a value, or a level and per_depth")
    if pressure.box is not None:
        for (key, axis), message in least_below_greatest(*pressure.box, "box", "xyz"):
            yield (key, 1, axis), message


@rule(types.Travel)
def travel(load: types.Travel) -> Iterator[Finding]:
    """A path goes on."""
    if is_zero(load.towards):
        yield ("towards",), Message("zero-vector", "must not be the zero vector")
    for number, (before, here) in enumerate(pairwise(load.path), start=1):
        if before == here:
            yield ("path", number), Message("degenerate-line", "must not be the corner before it")


@rule(types.Tilt)
def tilt(load: types.Tilt) -> Iterator[Finding]:
    """An axis has a direction."""
    if is_zero(load.axis):
        yield ("axis",), Message("zero-vector", "must not be the zero vector")


@rule(types.LoadCaseSection)
def load_case(case: types.LoadCaseSection) -> Iterator[Finding]:
    """A live load must do something; what tilts or travels is live, and there is one of it."""
    for number, load in enumerate(case.live or []):
        for below in _without_effect(load):
            yield ("live", number, *below), Message("live-load-without-effect", "is a live load with no effect")
    for number, load in enumerate(case.dead or []):
        for kind in given(load, LIVE_ONLY):
            yield ("dead", number, kind), Message("load-misplaced", "must be a live load")
    special = [(number, kind) for number, load in enumerate(case.live or []) for kind in given(load, LIVE_ONLY)]
    for number, kind in special[1:]:
        yield (
            ("live", number, kind),
            Message("one-of-several", f"only one of {listed(LIVE_ONLY, 'and')} in a load case: make another load case"),
        )
    if len(special) == 1 and special[0][1] == "tilt" and len(case.live or []) > 1:
        other = next(number for number in range(len(case.live or [])) if number != special[0][0])
        yield (
            ("live", other),
            Message("load-misplaced", "must not stand beside tilt, whose answer is an angle: make it a dead load"),
        )


def _without_effect(load: types.Load) -> Iterator[tuple[str | int, ...]]:
    """Keys below a load that make it nothing."""
    if load.factor == 0.0:
        yield ("factor",)
    for key in ("gravity", "acceleration", "force", "moment"):
        value = getattr(load, key)
        if value == "none" or (value is not None and is_zero(value)):
            yield (key,)
    if load.line is not None and is_zero(load.line.force_per_length):
        yield ("line", "force_per_length")
    if load.travel is not None and is_zero(load.travel.force):
        yield ("travel", "force")
    for number, axle in enumerate((load.travel.axles or []) if load.travel is not None else []):
        if is_zero(axle.force):
            yield ("travel", "axles", number, "force")
    if load.pressure is not None and not load.pressure.value and not load.pressure.per_depth:
        yield ("pressure",)


@rule(types.DeckContent)
def named_loads(deck: types.DeckContent) -> Iterator[Finding]:
    """Named loads can be added up: none travels or tilts, and none comes back to itself."""
    for name, loads in deck.loads.items():
        for number, load in enumerate(loads):
            for kind in given(load, LIVE_ONLY):
                yield (
                    ("loads", name, number, kind),
                    Message("load-misplaced", "must stand in the live loads of a load case itself"),
                )
    for name in deck.loads:
        chain = _way_back(name, deck.loads)
        if chain is not None and name == min(chain):  # a cycle is told once, at its first name
            yield ("loads", name), Message("load-misplaced", f"contains itself: {' > '.join([*chain, name])}")


def _way_back(name: str, loads: dict[str, list[types.Load]]) -> list[str] | None:
    """The shortest chain of named loads that leads from one back to itself; None if there is none."""
    chains, seen = [[name]], {name}
    for chain in chains:
        for below in dict.fromkeys(load.loads for load in loads.get(chain[-1], []) if load.loads is not None):
            if below == name:
                return chain
            if below not in seen:
                seen.add(below)
                chains.append([*chain, below])
    return None


@rule(types.SettlementSection)
def settlement_direction(settlement: types.SettlementSection) -> Iterator[Finding]:
    """A settlement goes somewhere."""
    if settlement.direction is not None and is_zero(settlement.direction):
        yield ("direction",), Message("zero-vector", "must not be the zero vector")
