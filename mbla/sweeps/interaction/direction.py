"""The question of direction: the horizontal part of a live load is turned about the vertical.

Turned are all live accelerations (and live gravity) and all live forces of the load case, by their horizontal parts,
together. Their vertical parts, the points where forces act and the patterns by height stay as they are. Other kinds of
load have a direction of their own (a pressure that of its face), or none that could be turned, and are refused.

Where the horizontal parts all point one way, the azimuth is the direction in which they push, counted from +x towards
+y, whatever that of the deck is. Where they do not, they are turned together and the azimuth is the angle by which.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mbla.deck import Deck
from mbla.errors import UsageError
from mbla.model.loads.load_case import kind_of
from mbla.model.loads.load_kind import Entry
from mbla.results.listing.text import counted
from mbla.sweeps.interaction.angles import angles_around, unit_vector
from mbla.sweeps.interaction.entries import live_entries, section_of, written
from mbla.sweeps.interaction.question import DIRECTION, Question
from mbla.sweeps.plan import Plain

TURNED = ("gravity", "acceleration", "force")
"""kinds of loads that are turned: those that are a vector"""
ONE_WAY = 1e-9
"""sine of the angle between two horizontal parts up to which they point one way: rounding of expressions in decks"""
WHAT = "the load factor over direction"


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
        turned = self.part * complex(*unit_vector(azimuth))
        vector = [turned.real + 0.0, turned.imag + 0.0, self.vertical]
        return written(deck, self.entry, self.entry.factor, **{self.kind: vector})


def direction_question(deck: Deck, case: str, count: int) -> Question:
    """Azimuths around the circle for one load case; its name may be left out where the deck has but one.

    Raises UsageError where the load case cannot be turned.
    """
    case = _case(deck, case)
    section_of(deck, case, WHAT)
    _refuse_halves(deck)
    turnings, absolute = _turnings(deck, case)
    azimuths = angles_around(count)
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
                f"would push its image the other way; {WHAT} needs the whole structure",
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
                f"{WHAT} takes acceleration, gravity and force",
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
