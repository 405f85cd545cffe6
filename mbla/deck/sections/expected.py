"""Section `expected`: what load cases should give, as `mbla run --expected` compares it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal

from pydantic import Field

from mbla.deck.quantities import Count, Line, Number, PositiveNumber
from mbla.deck.section import Section, given, rule
from mbla.deck.sections.time_history import given_in_time
from mbla.errors import Finding


class Expectation(Section):
    """What a load case should give, with its source."""

    load_factor: Number | None = Field(None, description="load factor by the deck's own flow rule")
    angle: Number | None = Field(None, description="tilt: angle of collapse in degrees")
    position: Count | None = Field(None, description="travel: number of the worst position, from 1")
    associative_load_factor: Number | None = Field(None, description="load factor by the associative flow rule")
    reaction: Number | None = Field(None, description="reaction of the settling support")
    least: Number | None = Field(None, description="objective: least value of the force")
    greatest: Number | None = Field(None, description="objective: greatest value of the force")
    least_load_factor: Number | None = Field(
        None,
        description="flow other than associative: least load factor of the states of rigid joints that a search found",
    )
    peak: Number | None = Field(None, description="time_history: greatest displacement of the centre of a block")
    peak_time: Number | None = Field(None, description="time_history: when that is, s")
    residual: Number | None = Field(
        None, description="time_history: greatest displacement at the end, its difference relative to the peak"
    )
    falls: Line | None = Field(
        None, description="time_history: block that falls first, `wall[3]`; none: no block falls"
    )
    end: Literal["duration", "collapse", "displaced", "at_rest"] | None = Field(
        None,
        description="time_history: how it ends: duration over, a block has fallen by half of its height, displacement "
        "of `stop` reached, at rest",
    )
    period: Number | None = Field(None, description="modes: the longest period, s")
    period_after: Number | None = Field(None, description="modes and time_history: the longest period after it, s")
    status: Literal["solved", "approximate", "not_verified", "no_equilibrium", "unbounded"] | None = Field(
        None, description="status of the case"
    )
    tolerance: PositiveNumber = Field(1e-5, description="relative difference that is allowed")
    source: Line = Field(min_length=1, description="where the figure is from")


FIGURES = (
    "load_factor",
    "angle",
    "position",
    "associative_load_factor",
    "reaction",
    "least",
    "greatest",
    "least_load_factor",
    "peak",
    "peak_time",
    "residual",
    "falls",
    "end",
    "period",
    "period_after",
    "status",
)


@rule(Expectation)
def expectation(item: Expectation) -> Iterator[Finding]:
    """Something must be expected."""
    if not given(item, FIGURES):
        yield Finding("missing-key", f"needs at least one of {', '.join(FIGURES[:-1])} or {FIGURES[-1]}")


OF_HISTORIES = ("peak", "peak_time", "residual", "falls", "end", "period_after")
OF_MODES = ("period", "period_after")
OF_LOAD_FACTORS = (
    *("load_factor", "associative_load_factor", "least_load_factor", "angle", "position"),
    *("reaction", "least", "greatest"),
)
"""figures of load cases with a time history, with modes, and with a load factor or what it stands for"""


def expectations_of_kinds(deck: Any) -> Iterator[Finding]:
    """An angle belongs to a tilt, a worst position to a load that travels, a peak to a time history."""
    for name, item in deck.expected.items():
        case = deck.load_cases.get(name)
        if case is None:
            continue  # said of the name
        for key, kind in (("angle", "tilt"), ("position", "travel")):
            live = [] if getattr(item, key) is None else (case.live or [])
            if live and not any(load.kind == kind for load in live):
                yield _applies_to(kind, name, key)
        for key in given(item, OF_HISTORIES) if case.time_history is None else ():
            yield _applies_to("time_history", name, key)
        for key in given(item, OF_MODES) if case.modes is None else ():
            yield _applies_to("modes", name, key)
        for key in given(item, OF_LOAD_FACTORS) if given_in_time(case) else ():
            words = f"does not apply to a load case with {given_in_time(case)[0]}, which has no load factor"
            yield Finding("key-of-another-choice", words, "expected", name, key)


def _applies_to(kind: str, name: str, key: str) -> Finding:
    return Finding("key-of-another-choice", f"applies to load cases with {kind} only", "expected", name, key)
