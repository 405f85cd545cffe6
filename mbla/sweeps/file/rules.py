"""Checks of a sweep file: across the keys of one section, then across its sections."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from math import prod
from typing import Any

from mbla.deck.expressions import ExpressionError
from mbla.deck.section import one_of, rule
from mbla.deck.suggestions import listed, unknown
from mbla.deck.text.tree import shorten
from mbla.errors import Finding, KeyPath
from mbla.sweeps.design.directions import FULL_CIRCLE
from mbla.sweeps.file import content as types
from mbla.sweeps.file.comparisons import read_comparison
from mbla.sweeps.file.content import (
    DISTRIBUTIONS,
    KINDS,
    MAX_POINTS,
    RANDOM,
    SAMPLED,
    WAYS,
    WITH_POINTS,
    Parameter,
    PartOfDesign,
    SweepContent,
    design_parts,
    is_random,
    key_paths,
    level_count,
    spelt,
    way_of,
)

FARTHEST = 40
"""deviations: no sample lies so far from the mean in double precision"""


@rule(types.Parameter, types.DesignPart)
def one_key(item: types.Parameter | types.DesignPart) -> Iterator[Finding]:
    """One way of saying values, one kind of part."""
    yield from one_of(item, WAYS if isinstance(item, types.Parameter) else KINDS)


@rule(types.Parameter)
def plain_values(item: types.Parameter) -> Iterator[Finding]:
    """A value is one of the deck, not an entire section of it."""
    for index, value in enumerate(item.values or ()):
        if isinstance(value, dict):
            yield Finding(
                "sweep-values",
                "must be a number, text, true, false or a list: give each key a parameter, in a zip",
                "values",
                index,
            )


@rule(types.Parameter)
def key_paths_of_text(item: types.Parameter) -> Iterator[Finding]:
    """A key path has something in it."""
    for (_, _, *path), key in key_places("", item) if item.key is not None else ():
        if not key.strip():
            yield Finding("sweep-key", "must not be empty: write a key path such as joints.dry.friction", *path)


@rule(types.LinearRange)
def linear_range(item: types.LinearRange) -> Iterator[Finding]:
    """Upwards or downwards."""
    if item.start == item.end:
        yield Finding("out-of-bounds", "must differ from the value of from", "to")


@rule(types.LogRange, types.IntegerRange, types.Uniform, types.Triangular, types.Horizon, types.Sphere)
def upwards(item: Any) -> Iterator[Finding]:
    """From the least to the greatest."""
    if not item.start < item.end:
        yield Finding("out-of-bounds", f"must be > {item.start:g}, the value of from", "to")


@rule(types.Horizon)
def horizon(item: types.Horizon) -> Iterator[Finding]:
    """No direction twice."""
    if item.end - item.start > FULL_CIRCLE:
        yield Finding("out-of-bounds", f"must be at most {item.start + FULL_CIRCLE:g}, a full circle beyond from", "to")


@rule(types.Triangular)
def triangular(item: types.Triangular) -> Iterator[Finding]:
    """The most likely value is one of them."""
    if item.start < item.end and not item.start <= item.mode <= item.end:
        yield Finding(
            "out-of-bounds", f"must lie between {item.start:g} and {item.end:g}, the values of from and to", "mode"
        )


@rule(types.Normal, types.Lognormal)
def cut_around_the_mean(item: Any) -> Iterator[Finding]:
    """What is cut off leaves the mean."""
    if not math.isfinite(abs(item.mean) + FARTHEST * item.deviation):
        yield Finding("out-of-bounds", f"must be so small that {FARTHEST} of them are a number", "deviation")
    if item.least is not None and not item.least < item.mean:
        yield Finding("out-of-bounds", f"must be < {item.mean:g}, the mean", "min")
    if item.greatest is not None and not item.greatest > item.mean:
        yield Finding("out-of-bounds", f"must be > {item.mean:g}, the mean", "max")


# --- parameters ---------------------------------------------------------------------------------------------------


@rule(SweepContent)
def keys_once(sweep: SweepContent) -> Iterator[Finding]:
    """No key of the deck gets two values; keys inside of one another are found with the base deck at hand."""
    owners: dict[tuple[str, ...], str] = {}
    for key in sweep.set:
        for before in owners:
            if before[: len(spelt(key))] == spelt(key):
                yield Finding(
                    "sweep-without-effect",
                    f"replaces {shorten('.'.join(before))}, which stands before it: put it first, or drop that",
                    "set",
                    key,
                )
        owners[spelt(key)] = f"set sets {shorten(key)} too: one of them would have no effect"
    for name, parameter in sweep.parameters.items():
        for path, key in key_places(name, parameter):
            if spelt(key) in owners:
                yield Finding(
                    "sweep-without-effect", f"parameter {name} sets {shorten(key)}, and {owners[spelt(key)]}", *path
                )
            owners.setdefault(spelt(key), f"parameter {name} sets it too")


def key_places(name: str, parameter: Parameter) -> Iterator[tuple[KeyPath, str]]:
    """Each key path of a parameter with its place in the sweep file."""
    for index, key in enumerate(key_paths(name, parameter)):
        place: KeyPath = ("parameters", name)
        if parameter.key is not None:
            place = (*place, "key") if isinstance(parameter.key, str) else (*place, "key", index)
        yield place, key


# --- design -------------------------------------------------------------------------------------------------------


@rule(SweepContent)
def every_parameter_in_one_part(sweep: SweepContent) -> Iterator[Finding]:
    """None twice, none left out, no part empty."""
    parts = design_parts(sweep)
    open_parts = [part for part in parts if sweep.design and part.of is None]
    for part in open_parts[1:]:
        yield Finding(
            "sweep-parts",
            "needs `of`: only one part of the design can take all parameters that no other names",
            *part.path,
        )
    for part in open_parts[:1]:
        if not part.parameters:
            yield Finding("sweep-parts", "has no parameters: the other parts name them all", *part.path)
    owners: dict[str, int] = {}
    for number, part in enumerate(parts):
        for index, name in enumerate(part.of or ()):
            if name not in sweep.parameters:
                words = unknown("parameter", name, sweep.parameters, "known")
                yield Finding("unknown-name", words, *part.path, "of", index)
            elif name in owners:
                where = "this part" if owners[name] == number else f"part {owners[name] + 1} of the design"
                yield Finding("sweep-parts", f"{name} stands in {where} already", *part.path, "of", index)
            owners.setdefault(name, number)
    if sweep.design and not open_parts:
        for name in sweep.parameters:
            if name not in owners:
                yield Finding(
                    "sweep-parts",
                    "stands in no part of the design: name it in one of its `of`, or drop it",
                    "parameters",
                    name,
                )


@rule(SweepContent)
def ways_fit_their_part(sweep: SweepContent) -> Iterator[Finding]:
    """Levels where values are combined one by one, distributions and integer ranges where they are sampled."""
    for part in design_parts(sweep):
        for name in dict.fromkeys(part.parameters):
            way, points = way_of(sweep.parameters[name]), level_count(sweep.parameters[name])
            path: KeyPath = ("parameters", name, way)
            message = ""
            if part.kind in SAMPLED and way in WITH_POINTS and points is not None:
                message = f"has no meaning in a {part.kind} design, which has its own: leave it out"
                path = (*path, "points")
            elif part.kind not in SAMPLED and way in DISTRIBUTIONS:
                message = f"is a distribution, which a {part.kind} cannot take: put {name} into {_samples()}"
            elif part.kind not in SAMPLED and points is None:
                message = f"needs points, how many values it has, in a {part.kind}; or put {name} into {_samples()}"
            if message:
                yield Finding("sweep-ranges", message, *path)


@rule(SweepContent)
def grid_values_once(sweep: SweepContent) -> Iterator[Finding]:
    """No point of a grid twice; in a zip a value may come again with others, and in a sample it has more weight."""
    for part in design_parts(sweep):
        for name in part.parameters if part.kind == "grid" else ():
            values = sweep.parameters[name].values or []
            written = [json.dumps(value) if isinstance(value, bool | str | list) else value for value in values]
            for index, value in enumerate(written):
                if value in written[:index]:
                    message = "is given twice: the points of a grid differ in each value"
                    yield Finding("duplicate-key", message, "parameters", name, "values", index)


def _samples() -> str:
    return f"{listed(f'a {kind}' for kind in SAMPLED)} part of the design"


@rule(SweepContent)
def zipped_lists(sweep: SweepContent) -> Iterator[Finding]:
    """First with first, second with second: none may be left over."""
    for part in design_parts(sweep):
        counts = {name: level_count(sweep.parameters[name]) for name in part.parameters}
        if part.kind != "zip" or None in counts.values() or len(set(counts.values())) < 2:
            continue
        shown = listed((f"{name} {count}" for name, count in counts.items()), "and")
        yield Finding("sweep-ranges", f"needs as many values of each parameter; here are: {shown}", *part.path)


@rule(SweepContent)
def number_of_points(sweep: SweepContent) -> Iterator[Finding]:
    """Not more points than a readable table has."""
    parts = design_parts(sweep)
    sizes = [_size(sweep, part) for part in parts]
    known = [size for size in sizes if size is not None]
    if len(known) == len(sizes) and prod(known) > MAX_POINTS:
        path = ("design",) if sweep.design else ("parameters",)
        factors = " x ".join(str(size) for size in known) + " = " if len(known) > 1 else ""
        yield Finding(
            "sweep-too-many-points",
            f"makes {factors}{prod(known)} points, at most {MAX_POINTS} are taken: a sample needs fewer",
            *path,
        )


def _size(sweep: SweepContent, part: PartOfDesign) -> int | None:
    """Points of a part; None where that is at fault."""
    if part.kind in SAMPLED:
        return part.points
    counts = [level_count(sweep.parameters[name]) for name in part.parameters]
    known = [count for count in counts if count is not None]
    if len(known) < len(counts):
        return None
    return prod(known) if part.kind == "grid" else max(known, default=0)


@rule(SweepContent)
def constraints(sweep: SweepContent) -> Iterator[Finding]:
    """Comparisons that can be read; what they name is seen with the base deck."""
    for number, text in enumerate(sweep.constraints):
        try:
            read_comparison(text)
        except ExpressionError as error:
            yield Finding(error.message.identifier, error.message.words, "constraints", number)


# --- results ------------------------------------------------------------------------------------------------------


@rule(SweepContent)
def names_once(sweep: SweepContent) -> Iterator[Finding]:
    """Each load case is solved once, each result is one column."""
    for key, names in (("cases", sweep.cases or []), ("results", sweep.results)):
        for index, name in enumerate(names):
            if name in names[:index]:
                yield Finding("duplicate-key", "is given twice", key, index)


@rule(SweepContent)
def fragility(sweep: SweepContent) -> Iterator[Finding]:
    """A probability needs points that are a random sample."""
    if sweep.fragility is None:
        return
    random = [part for part in design_parts(sweep) if is_random(part, sweep)]
    message = ""
    if not random:
        message = f"needs a random design: {_samples()} in which every parameter is {listed(RANDOM)}"
    elif len(random) > 1:
        message = "needs one random part of the design, not several: put their parameters into one"
    if message:
        yield Finding("sweep-fragility", message, "fragility")
