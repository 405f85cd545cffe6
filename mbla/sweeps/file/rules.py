"""Checks across the keys of one section of a sweep file; those across sections are in ``design_rules``."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from mbla.deck.section import Section, one_of, rule
from mbla.errors import Finding
from mbla.sweeps.design.directions import FULL_CIRCLE
from mbla.sweeps.file import content as types
from mbla.sweeps.file.parts import KINDS, WAYS

EXACTLY_ONE: dict[type[Section], tuple[str, ...]] = {types.Parameter: WAYS, types.DesignPart: KINDS}
"""Keys of which a section has exactly one; the schema says so too."""

FARTHEST = 40
"""deviations: no sample lies so far from the mean in double precision"""


def _register_exactly_one(section: type[Section], keys: tuple[str, ...]) -> None:
    @rule(section)
    def one_key(item: Section) -> Iterator[Finding]:
        yield from one_of(item, keys)


for _section, _keys in EXACTLY_ONE.items():
    _register_exactly_one(_section, _keys)


@rule(types.Parameter)
def plain_values(item: types.Parameter) -> Iterator[Finding]:
    """A value is one of the deck, not a whole section of it."""
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
    if isinstance(item.key, str):
        keys: list[tuple[tuple[str | int, ...], str]] = [(("key",), item.key)]
    else:
        keys = [(("key", index), key) for index, key in enumerate(item.key or ())]
    for path, key in keys:
        if not key.strip():
            yield Finding("sweep-key", "must not be empty: write a key path such as joints.dry.friction", *path)


@rule(types.LinearRange)
def linear_range(item: types.LinearRange) -> Iterator[Finding]:
    """Upwards or downwards."""
    if item.start == item.end:
        yield Finding("out-of-bounds", "must differ from the value of from", "to")


def _upwards(section: type[Section]) -> None:
    @rule(section)
    def upwards(item: Any) -> Iterator[Finding]:
        if not item.start < item.end:
            yield Finding("out-of-bounds", f"must be > {item.start:g}, the value of from", "to")


for _section in (types.LogRange, types.WholeRange, types.Uniform, types.Triangular, types.Horizon, types.Sphere):
    _upwards(_section)


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


def _cut_around_the_mean(section: type[Section]) -> None:
    @rule(section)
    def cut(item: Any) -> Iterator[Finding]:
        if not math.isfinite(abs(item.mean) + FARTHEST * item.deviation):
            yield Finding("out-of-bounds", f"must be so small that {FARTHEST} of them are a number", "deviation")
        if item.least is not None and not item.least < item.mean:
            yield Finding("out-of-bounds", f"must be < {item.mean:g}, the mean", "min")
        if item.greatest is not None and not item.greatest > item.mean:
            yield Finding("out-of-bounds", f"must be > {item.mean:g}, the mean", "max")


_cut_around_the_mean(types.Normal)
_cut_around_the_mean(types.Lognormal)
