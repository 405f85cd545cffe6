"""What a diagram asks of a deck: one point for each angle, each a setting of the deck.

**Direction.** All live accelerations (and live gravity) and all live forces of the load case are turned about the
vertical by their horizontal parts, together. Their vertical parts, the points where forces act and the patterns by
height stay as they are. Other kinds of load have a direction of their own (a pressure that of its face), or none that
could be turned, and are refused. Where the horizontal parts all point one way, the azimuth is the direction in which
they push, counted from +x towards +y, whatever that of the deck is. Where they do not, the azimuth is the angle by
which they are turned together.

**Two loads.** The live loads of two load cases act together, A times cosine and B times sine: at the load factor λ of
an angle φ the structure carries A times λ cos φ and B times λ sin φ, a point of the interaction curve. The two load
cases must have one dead load, which belongs to every point.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.deck import Deck
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.tree import KeyPath
from mbla.errors import UsageError
from mbla.model.loads.load_case import kind_of
from mbla.model.loads.load_kind import Entry, entries_of
from mbla.model.model import Model
from mbla.results.listing.text import counted
from mbla.sweeps.design.directions import FULL_CIRCLE, horizontal
from mbla.sweeps.plan import Plain

CLOSED = 1e-9
"""degrees by which two angles may miss a full circle and close it"""


def angles_between(start: float, end: float, count: int, ratio: float = 1.0) -> tuple[float, ...]:
    """Angles from ``start`` to ``end``, both among them; the last one left out where it is a full circle on.

    ratio : of the sine's unit to that of the cosine: the angles are at equal distances where both axes of a diagram
            are drawn in these units
    """
    if ratio == 1.0:
        return _evenly(start, end, count)
    first, last = stretched(start, 1 / ratio), stretched(end, 1 / ratio)
    between = [stretched(angle, ratio) for angle in _evenly(first, last, count)]
    ends = {0: start} if closes(start, end) else {0: start, count - 1: end}
    return tuple(ends.get(number, angle) for number, angle in enumerate(between))


def stretched(degrees: float, ratio: float) -> float:
    """Angle of the vector (cos, ratio sin) of an angle, in the same turn; multiples of 90 degrees stay."""
    cosine, sine = horizontal(degrees, 1.0)
    angle = math.degrees(math.atan2(ratio * sine, cosine))
    return angle + FULL_CIRCLE * round((degrees - angle) / FULL_CIRCLE)


def _evenly(start: float, end: float, count: int) -> tuple[float, ...]:
    if closes(start, end):
        return tuple(start + FULL_CIRCLE * number / count for number in range(count))
    return tuple(start + (end - start) * number / (count - 1) for number in range(count))


def closes(start: float, end: float) -> bool:
    """Whether a range of angles is a full circle."""
    return abs(end - start - FULL_CIRCLE) <= CLOSED


DIRECTION, TWO_LOADS = "direction", "two_loads"


@dataclass(frozen=True)
class Question:
    """The points of one diagram.

    kind     : ``direction`` or ``two_loads``
    case     : load case that is solved at each point
    axes     : what the coordinates of the diagram are, in words: load factor times cosine, times sine of the angle
    short    : the same for the names of columns
    pair     : load cases of the deck as it is solved whose live loads add up, times cosine and sine, to that of each
               point; empty where they do not
    angles   : degrees, one for each point
    settings : values by key path of the deck, one mapping for each point
    fixed    : ``key.path=value`` texts for every point, after those of the command line
    closed   : the last point is followed by the first
    absolute : azimuths count from +x, rather than from the directions that the deck gives
    words    : what is turned or added, in sentences
    """

    kind: str
    case: str
    axes: tuple[str, str]
    short: tuple[str, str]
    pair: tuple[str, str] | tuple[()]
    angles: tuple[float, ...]
    settings: tuple[Mapping[str, Plain], ...]
    fixed: tuple[str, ...]
    closed: bool
    absolute: bool
    words: tuple[str, ...]


NO_SUM = {
    "travel": "travels: a load case for each of its positions",
    "tilt": "tilts: its answer is an angle",
}
"""kinds of loads that make something else of a load case than a sum of loads, and what"""


def section_of(deck: Deck, case: str, what: str) -> LoadCaseSection:
    """A load case whose live loads are a sum of loads.

    Raises UsageError for any other, where ``what`` cannot be asked.
    """
    cases = deck.content.load_cases
    if case not in cases:
        raise UsageError("unknown-load-case", f"no load case {case} in the deck; it has {', '.join(cases)}")
    section = cases[case]
    if section.settlement is not None:
        raise UsageError(
            "interact-load", f"load case {case}: a support gives way, there is no live load; {what} needs one"
        )
    for entry in live_entries(deck, case):
        for kind, words in NO_SUM.items():
            if getattr(entry.load, kind) is not None:
                raise UsageError(
                    "interact-load", f"load case {case}: its live load {words}; {what} takes other kinds of load"
                )
    return section


def live_entries(deck: Deck, case: str) -> list[Entry]:
    """The live loads of a case, those that named loads stand for among them, with the products of their factors."""
    path: KeyPath = ("load_cases", case, "live")
    return list(entries_of(deck.content.load_cases[case].live or [], path, deck.content.loads))


def written(deck: Deck, entry: Entry, factor: float, **changes: Any) -> dict[str, Any]:
    """A load as a deck writes it, in the deck's units, expressions evaluated, with another factor and other values.

    A table is named relative to the main file of the deck, from where a setting looks for it.
    """
    text: dict[str, Any] = entry.load.model_dump(mode="json", by_alias=True, exclude_unset=True, exclude_none=True)
    if entry.load.table is not None:
        table = deck.resolve_file((*entry.path, "table"), entry.load.table)
        text["table"] = os.path.relpath(table.resolve(), deck.folder.resolve())
    return text | {"factor": factor} | changes


TURNED = ("gravity", "acceleration", "force")
"""kinds of loads that are turned: those that are a vector"""
ONE_WAY = 1e-9
"""sine of the angle between two horizontal parts up to which they point one way: rounding of expressions in decks"""
OVER_DIRECTION = "the load factor over direction"


@dataclass(frozen=True)
class Turning:
    """A live load as it is turned.

    part     : its horizontal part in the frame whose first axis points to azimuth 0, as a complex number
    vertical : its vertical part
    """

    entry: Entry
    kind: str
    part: complex
    vertical: float

    def at(self, deck: Deck, azimuth: float) -> dict[str, Any]:
        """The load as the deck writes it, at an azimuth in degrees."""
        turned = self.part * complex(*horizontal(azimuth, 1.0))
        vector = [turned.real + 0.0, turned.imag + 0.0, self.vertical]
        return written(deck, self.entry, self.entry.factor, **{self.kind: vector})


def direction_question(deck: Deck, case: str, count: int) -> Question:
    """Azimuths around the circle for one load case; its name may be left out where the deck has but one.

    Raises UsageError where the load case cannot be turned.
    """
    case = _case(deck, case)
    section_of(deck, case, OVER_DIRECTION)
    _refuse_halves(deck)
    turnings, absolute = _turnings(deck, case)
    azimuths = angles_between(0.0, FULL_CIRCLE, count)
    key = f"load_cases.{case}.live"
    settings = tuple({key: _live(deck, turnings, azimuth)} for azimuth in azimuths)
    flat = all(one.vertical == 0.0 for one in turnings)
    pair, fixed = _axis_cases(deck, case, turnings) if flat else ((), ())
    axes = ("along x", "along y") if absolute else ("as the deck directs it", "a quarter turn on")
    words = _words(case, turnings, absolute=absolute, flat=flat)
    short = ("x", "y") if absolute else ("0", "90")
    return Question(DIRECTION, case, axes, short, pair, azimuths, settings, fixed, True, absolute, words)


def _live(deck: Deck, turnings: Sequence[Turning], azimuth: float) -> list[Plain]:
    return [one.at(deck, azimuth) for one in turnings]


def _case(deck: Deck, case: str) -> str:
    if case:
        return case
    cases = list(deck.content.load_cases)
    if len(cases) > 1:
        raise UsageError(
            "load-case-not-chosen", f"the deck has several load cases: choose one with --case, of {', '.join(cases)}"
        )
    return cases[0]


def _refuse_halves(deck: Deck) -> None:
    for number, plane in enumerate(deck.content.symmetry):
        if plane.z is None:
            raise UsageError(
                "interact-load",
                f"symmetry.{number}: the deck gives half of the structure, and what pushes one half out of the plane "
                f"would push its image the other way; {OVER_DIRECTION} needs the whole structure",
            )


def _turnings(deck: Deck, case: str) -> tuple[list[Turning], bool]:
    """The loads in the frame of azimuth 0, and whether azimuths count from +x."""
    entries = live_entries(deck, case)
    horizontal, vertical = [], []
    for entry in entries:
        kind = kind_of(entry.load)
        if kind not in TURNED:
            raise UsageError(
                "interact-load",
                f"load case {case}: its live load {'.'.join(map(str, entry.path))} is a {kind}, which is not turned; "
                f"{OVER_DIRECTION} takes acceleration, gravity and force",
            )
        x, y, z = getattr(entry.load, kind)
        horizontal.append(complex(x, y))
        vertical.append(z)
    way, absolute = _way(entries, horizontal)
    if way == 0.0:
        raise UsageError("interact-load", f"load case {case}: no live load has a horizontal part that could be turned")
    parts = [_in_frame(part, way, absolute=absolute) for part in horizontal]
    kinds = [kind_of(entry.load) for entry in entries]
    found = [Turning(*one) for one in zip(entries, kinds, parts, vertical, strict=True)]
    return found, absolute


def _way(entries: list[Entry], horizontal: list[complex]) -> tuple[complex, bool]:
    """Unit vector of the first horizontal part as it pushes, 0 without any, and whether all others point that way."""
    pushes = [part if entry.factor > 0 else -part for entry, part in zip(entries, horizontal, strict=True) if part]
    if not pushes:
        return 0j, False
    ways = [push / abs(push) for push in pushes]
    turned = [one * ways[0].conjugate() for one in ways]
    return ways[0], all(one.real > 0 and abs(one.imag) <= ONE_WAY for one in turned)


def _in_frame(part: complex, way: complex, *, absolute: bool) -> complex:
    """A horizontal part where azimuth 0 is +x, or where it is the deck as it stands."""
    if not absolute or not part:
        return part
    return complex(math.copysign(abs(part), (part * way.conjugate()).real), 0.0)


def _axis_cases(deck: Deck, case: str, turnings: list[Turning]) -> tuple[tuple[str, str], tuple[str, ...]]:
    """Load cases at 0 and 90 degrees beside the deck's own, whose powers say what a mechanism bounds all around."""
    names = (free_name(deck, "interact_0"), free_name(deck, "interact_90"))
    loads = [_live(deck, turnings, azimuth) for azimuth in (0.0, 90.0)]
    texts = [f"load_cases.{name}={json.dumps({'live': live})}" for name, live in zip(names, loads, strict=True)]
    return names, tuple(texts)


def free_name(deck: Deck, name: str) -> str:
    """The name with as many strokes as make it one that no load case of the deck has."""
    while name in deck.content.load_cases:
        name += "_"
    return name


def _words(case: str, turnings: list[Turning], *, absolute: bool, flat: bool) -> tuple[str, ...]:
    kinds = [one.kind for one in turnings if one.part]
    listed = " and ".join(counted(kinds.count(kind), kind) for kind in dict.fromkeys(kinds)) if kinds else ""
    listed = listed.replace("gravitys", "gravities")
    upright = "" if flat else "; vertical parts stay as they are"
    from_where = (
        "azimuth 0 pushes along +x, 90 along +y"
        if absolute
        else "as they do not all point one way, the azimuth is the angle by which they are turned together from "
        "where the deck directs them, from +x towards +y"
    )
    return (f"load case {case}: the horizontal part of its live load ({listed}) is turned{upright}; {from_where}",)


SAME_LOAD = 1e-12
"""difference of two dead loads, relative to the larger, that is rounding of how the deck writes them"""
OF_TWO_LOADS = "an interaction of two loads"


def two_loads_question(
    deck: Deck, model: Model, names: tuple[str, str], start: float, end: float, count: int, ratio: float = 1.0
) -> Question:
    """Angles from ``start`` to ``end`` in degrees for two load cases.

    ratio : of the load factor of the second alone to that of the first; the points lie evenly on a curve that is drawn
            in units of the two

    Raises UsageError where they have no sum, or not the same dead load.
    """
    first, second = names
    if first == second:
        raise UsageError("interact-option", f"--loads {first} {second}: name two different load cases")
    section = section_of(deck, first, OF_TWO_LOADS)
    section_of(deck, second, OF_TWO_LOADS)
    _refuse_other_dead_load(model, first, second)
    name = free_name(deck, "interact")
    own: dict[str, Plain] = {}
    if section.dead is not None:
        places = (("load_cases", first, "dead", number) for number in range(len(section.dead)))
        entries = [Entry(load, place, load.factor) for load, place in zip(section.dead, places, strict=True)]
        own["dead"] = [written(deck, entry, entry.factor) for entry in entries]
    angles = angles_between(start, end, count, ratio)
    settings = tuple({f"load_cases.{name}": {**own, "live": _together(deck, names, angle)}} for angle in angles)
    words = (
        f"live loads of {first} times cos and of {second} times sin of the angle act together, with the dead load that "
        "both have; load factor times cos and sin are the factors of the two at collapse",
    )
    axes = (f"factor of {first}", f"factor of {second}")
    closed = closes(start, end)
    return Question(TWO_LOADS, name, axes, names, names, angles, settings, (), closed, True, words)


def _refuse_other_dead_load(model: Model, first: str, second: str) -> None:
    dead = {case.name: case.dead_load for case in model.load_cases}
    one, other = dead[first], dead[second]
    largest = max(float(np.abs(one).max(initial=0.0)), float(np.abs(other).max(initial=0.0)))
    if float(np.abs(one - other).max(initial=0.0)) > SAME_LOAD * largest:
        raise UsageError(
            "interact-load",
            f"load cases {first} and {second} have different dead loads: their live loads act together only on one; "
            "give both the same dead load",
        )


def _together(deck: Deck, names: tuple[str, str], angle: float) -> list[Plain]:
    """Both live loads at an angle; one whose share is zero is left out."""
    return [
        written(deck, entry, share * entry.factor)
        for name, share in zip(names, horizontal(angle, 1.0), strict=True)
        if share != 0.0
        for entry in live_entries(deck, name)
    ]
