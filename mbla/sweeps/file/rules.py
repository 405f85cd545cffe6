"""Checks of a sweep file: across the keys of one section, then across its sections."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
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
from mbla.sweeps.file.parts import KINDS, PartOfDesign, design_parts, is_random

FARTHEST = 40
"""deviations: no sample lies so far from the mean in double precision"""


@rule(types.Parameter, types.DesignPart)
def one_key(item: types.Parameter | types.DesignPart) -> Iterator[Finding]:
    """One way of saying values, one kind of part."""
    yield from one_of(item, types.WAYS if isinstance(item, types.Parameter) else KINDS)


@rule(types.Parameter)
def plain_values(item: types.Parameter) -> Iterator[Finding]:
    """A value is one of the deck, not an entire section of it."""
    message = "must be a number, text, true, false or a list: give each key a parameter, in a zip"
    for index, value in enumerate(item.values or ()):
        if isinstance(value, dict):
            yield Finding("sweep-values", message, "values", index)


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
        message = f"must lie between {item.start:g} and {item.end:g}, the values of from and to"
        yield Finding("out-of-bounds", message, "mode")


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


@rule(types.SweepContent)
def keys_once(sweep: types.SweepContent) -> Iterator[Finding]:
    """No key of the deck gets two values; keys inside of one another are found with the base deck at hand."""
    owners: dict[tuple[str, ...], str] = {}
    for key in sweep.set:
        own = types.spelt(key)
        for before in owners:
            if before[: len(own)] == own:
                said = f"replaces {shorten('.'.join(before))}, which stands before it: put it first, or drop that"
                yield Finding("sweep-without-effect", said, "set", key)
        owners[own] = f"set sets {shorten(key)} too: one of them would have no effect"
    for name, parameter in sweep.parameters.items():
        for path, key in key_places(name, parameter):
            own = types.spelt(key)
            if own in owners:
                yield Finding("sweep-without-effect", f"parameter {name} sets {shorten(key)}, and {owners[own]}", *path)
            owners.setdefault(own, f"parameter {name} sets it too")


def key_places(name: str, parameter: types.Parameter) -> Iterator[tuple[KeyPath, str]]:
    """Each key path of a parameter with its place in the sweep file."""
    for index, key in enumerate(types.key_paths(name, parameter)):
        place: KeyPath = ("parameters", name)
        if parameter.key is not None:
            place = (*place, "key") if isinstance(parameter.key, str) else (*place, "key", index)
        yield place, key


# --- design -------------------------------------------------------------------------------------------------------


@rule(types.SweepContent)
def every_parameter_in_one_part(sweep: types.SweepContent) -> Iterator[Finding]:
    """None twice, none left out, no part empty."""
    parts = design_parts(sweep)
    open_parts = [part for part in parts if sweep.design and part.of is None]
    for part in open_parts[1:]:
        message = "needs `of`: only one part of the design can take all parameters that no other names"
        yield Finding("sweep-parts", message, *part.path)
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
    for name in sweep.parameters if sweep.design and not open_parts else ():
        if name not in owners:
            message = "stands in no part of the design: name it in one of its `of`, or drop it"
            yield Finding("sweep-parts", message, "parameters", name)


@rule(types.SweepContent)
def ways_fit_their_part(sweep: types.SweepContent) -> Iterator[Finding]:
    """Levels where values are combined one by one, distributions and integer ranges where they are sampled."""
    for part in design_parts(sweep):
        for name in dict.fromkeys(part.parameters):
            way, points = types.way_of(sweep.parameters[name]), types.level_count(sweep.parameters[name])
            path: KeyPath = ("parameters", name, way)
            message = ""
            if part.kind in types.SAMPLED and way in types.WITH_POINTS and points is not None:
                message = f"has no meaning in a {part.kind} design, which has its own: leave it out"
                path = (*path, "points")
            elif part.kind not in types.SAMPLED and way in types.DISTRIBUTIONS:
                message = f"is a distribution, which a {part.kind} cannot take: put {name} into {_samples()}"
            elif part.kind not in types.SAMPLED and points is None:
                message = f"needs points, how many values it has, in a {part.kind}; or put {name} into {_samples()}"
            if message:
                yield Finding("sweep-ranges", message, *path)


@rule(types.SweepContent)
def grid_values_once(sweep: types.SweepContent) -> Iterator[Finding]:
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
    return f"{listed(f'a {kind}' for kind in types.SAMPLED)} part of the design"


@rule(types.SweepContent)
def zipped_lists(sweep: types.SweepContent) -> Iterator[Finding]:
    """First with first, second with second: none may be left over."""
    for part in design_parts(sweep):
        counts = {name: types.level_count(sweep.parameters[name]) for name in part.parameters}
        if part.kind != "zip" or None in counts.values() or len(set(counts.values())) < 2:
            continue
        shown = listed((f"{name} {count}" for name, count in counts.items()), "and")
        yield Finding("sweep-ranges", f"needs as many values of each parameter; here are: {shown}", *part.path)


@rule(types.SweepContent)
def number_of_points(sweep: types.SweepContent) -> Iterator[Finding]:
    """Not more points than a readable table has."""
    parts = design_parts(sweep)
    sizes = [_size(sweep, part) for part in parts]
    known = [size for size in sizes if size is not None]
    if len(known) == len(sizes) and prod(known) > types.MAX_POINTS:
        path = ("design",) if sweep.design else ("parameters",)
        factors = " x ".join(str(size) for size in known) + " = " if len(known) > 1 else ""
        said = f"makes {factors}{prod(known)} points, at most {types.MAX_POINTS} are taken: a sample needs fewer"
        yield Finding("sweep-too-many-points", said, *path)


def _size(sweep: types.SweepContent, part: PartOfDesign) -> int | None:
    """Points of a part; None where that is at fault."""
    if part.kind in types.SAMPLED:
        return part.points
    counts = [types.level_count(sweep.parameters[name]) for name in part.parameters]
    known = [count for count in counts if count is not None]
    if len(known) < len(counts):
        return None
    return prod(known) if part.kind == "grid" else max(known, default=0)


@rule(types.SweepContent)
def constraints(sweep: types.SweepContent) -> Iterator[Finding]:
    """Comparisons that can be read; what they name is seen with the base deck."""
    for number, text in enumerate(sweep.constraints):
        try:
            read_comparison(text)
        except ExpressionError as error:
            yield Finding(error.message.identifier, error.message.words, "constraints", number)


# --- results ------------------------------------------------------------------------------------------------------


@rule(types.SweepContent)
def names_once(sweep: types.SweepContent) -> Iterator[Finding]:
    """Each load case is solved once, each result is one column."""
    for key, names in (("cases", sweep.cases or []), ("results", sweep.results)):
        for index, name in enumerate(names):
            if name in names[:index]:
                yield Finding("duplicate-key", "is given twice", key, index)


@rule(types.FragilitySection)
def limits_and_demands(asked: types.FragilitySection) -> Iterator[Finding]:
    """One of them, each value once; a curve is fitted to shares that grow, as those that pass a limit."""
    yield from one_of(asked, types.SIDES)
    if asked.over is not None and asked.limit is None:
        yield Finding("key-of-another-choice", "applies with limit only", "over")
    for key, values in (("demand", asked.demand or []), ("limit", asked.limit or [])):
        for index, value in enumerate(values):
            if value in values[:index]:
                yield Finding("duplicate-key", "is given twice", key, index)


@rule(types.SweepContent)
def fragility(sweep: types.SweepContent) -> Iterator[Finding]:
    """A probability needs points that are a random sample, or are said to be one."""
    asked = sweep.fragility
    if asked is None:
        return
    for key in ("sample", "over"):
        name = getattr(asked, key)
        if name is not None and name not in sweep.parameters:
            words = unknown("parameter", name, sweep.parameters, "the sweep has")
            yield Finding("sweep-fragility", words, "fragility", key)
            return
    parts = design_parts(sweep)
    random = [part for part in parts if is_random(part, sweep)]
    message = ""
    if asked.sample is not None:
        if random:
            message = f"is no sample beside the random part of the design, which is one: leave {asked.sample} out here"
            yield Finding("sweep-fragility", message, "fragility", "sample")
    elif not random:
        message = f"needs a random design: {_samples()} in which every parameter is {listed(types.RANDOM)}"
        yield Finding("sweep-fragility", f"{message}; or sample, a list of records", "fragility")
    elif len(random) > 1:
        message = "needs one random part of the design, not several: put their parameters into one"
        yield Finding("sweep-fragility", message, "fragility")
    if asked.over is not None and not message:
        yield from _over(asked.over, asked.sample, sweep, parts)


def _over(over: str, sample: str | None, sweep: types.SweepContent, parts: Sequence[PartOfDesign]) -> Iterator[Finding]:
    """It has numbers above 0, and other ones than the sample."""
    (own,) = (part for part in parts if over in part.parameters)
    together = own.kind in types.SAMPLED or (own.kind == "zip" and sample in own.parameters) or over == sample
    way = types.way_of(sweep.parameters[over])
    section = getattr(sweep.parameters[over], way)
    values = section if way == "values" else [] if way in types.DIRECTIONS else [section.start, section.end]
    if together:
        words = f"changes with the sample: put {over} into a grid of its own, so that each value has all of the sample"
        yield Finding("sweep-fragility", words, "fragility", "over")
    elif not values or any(isinstance(each, bool | str | list) or not each > 0 for each in values):
        yield Finding("sweep-fragility", f"{over} has values that are no numbers above 0", "fragility", "over")
