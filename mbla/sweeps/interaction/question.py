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

import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.assembly import build_assembly
from mbla.deck import Deck
from mbla.deck.section import given
from mbla.errors import UsageError
from mbla.model import build_model
from mbla.model.loads.load_kind import Entry, entries_of, load_kind
from mbla.model.model import Model
from mbla.sweeps.design.directions import FULL_CIRCLE, horizontal
from mbla.sweeps.plan import Plain, override_texts

DIRECTION, TWO_LOADS = "direction", "two_loads"
DIRECTIONS, ANGLES = 72, 31
"""points unless their number is given: every 5 degrees around, every 3 degrees of a quarter"""
MOST_POINTS = 3600
QUARTER = 90.0
ONE_WAY = 1e-9
"""sine of the angle between two horizontal parts up to which they point one way: rounding of expressions in decks"""
SAME_LOAD = 1e-12
"""difference of two dead loads, relative to the larger, that is rounding of how the deck writes them"""


@dataclass(frozen=True)
class InteractionQuestion:
    """The points of one diagram.

    kind     : ``direction`` or ``two_loads``
    case     : load case that is solved at each point
    axes     : what the coordinates of the diagram are, in words: load factor times cosine, times sine of the angle
    pair     : load cases of the deck as it is solved whose live loads add up, times cosine and sine, to that of each
               point; empty where they do not
    settings : of each point by its angle in degrees, values by key path of the deck
    fixed    : ``key.path=value`` texts for every point, after those of the command line
    closed   : the last point is followed by the first
    words    : what is turned or added, in a sentence
    """

    kind: str
    case: str
    axes: tuple[str, str]
    pair: tuple[str, ...]
    settings: Mapping[float, Mapping[str, Plain]]
    fixed: tuple[str, ...]
    closed: bool
    words: str

    @property
    def angles(self) -> tuple[float, ...]:
        """Degrees, one for each point."""
        return tuple(self.settings)

    @property
    def names(self) -> list[str]:
        """What the axes are, for columns: the last word of each."""
        return [axis.split()[-1] for axis in self.axes]


def question_of(deck: Deck, options: Any, ratio: Callable[[], float] = lambda: 1.0) -> InteractionQuestion:
    """What is asked of a deck; building the model here finds whatever is wrong with it before a point is solved.

    options : ``case`` or ``loads`` (two names), ``directions``, ``start`` and ``end`` in degrees, by default None
    ratio   : of the load factor of the second of two loads alone to that of the first

    Raises DeckError: for what is wrong with the deck. Raises UsageError: for options that do not go together, and for
    load cases of which it cannot be asked.
    """
    model = build_model(deck)
    build_assembly(deck, model)
    if options.loads is None:
        if options.start is not None or options.end is not None:
            raise UsageError("interact-option", "--from and --to apply with --loads; directions go all around")
        cases = list(deck.content.load_cases)
        if not options.case and len(cases) > 1:
            words = f"the deck has several load cases: choose one with --case, of {', '.join(cases)}"
            raise UsageError("load-case-not-chosen", words)
        return _direction(deck, options.case or cases[0], _count(options.directions, DIRECTIONS, 1))
    if options.case:
        raise UsageError("interact-option", "--case and --loads: one or the other; --loads names the two load cases")
    start = 0.0 if options.start is None else options.start
    end = start + QUARTER if options.end is None else options.end
    if not start < end <= start + FULL_CIRCLE:
        words = f"--from {start:g} --to {end:g}: the end must lie above, by 360 degrees at most"
        raise UsageError("interact-option", words)
    count, pair = _count(options.directions, ANGLES, 2), tuple(options.loads)
    shares = _two_loads(deck, model, pair)
    return InteractionQuestion(
        kind=TWO_LOADS,
        case=_free_name(deck, "interact"),
        axes=(f"factor of {pair[0]}", f"factor of {pair[1]}"),
        pair=pair,
        settings={angle: shares(angle) for angle in angles_between(start, end, count, ratio())},
        fixed=(),
        closed=closes(start, end),
        words=f"live loads of {pair[0]} times cos and of {pair[1]} times sin of the angle act together, with the dead "
        "load that both have; load factor times cos and sin are the factors of the two at collapse",
    )


def _count(given: int | None, usual: int, least: int) -> int:
    count = usual if given is None else given
    if not least <= count <= MOST_POINTS:
        raise UsageError("interact-option", f"--directions {count}: {least} to {MOST_POINTS} points")
    return count


def angles_between(start: float, end: float, count: int, ratio: float = 1.0) -> list[float]:
    """Angles from ``start`` to ``end``, both among them; the last one left out where it is a full circle on.

    ratio : of the sine's unit to that of the cosine: the angles are at equal distances where both axes of a diagram
            are drawn in these units
    """
    first, last = stretched(start, 1 / ratio), stretched(end, 1 / ratio)
    between = np.linspace(first, last, count, endpoint=not closes(start, end)).tolist()
    return [round(stretched(angle, ratio), 12) for angle in between]


def closes(start: float, end: float) -> bool:
    """Whether a range of angles is a full circle."""
    return math.isclose(end - start, FULL_CIRCLE)


def stretched(degrees: float, ratio: float) -> float:
    """Angle of the vector (cos, ratio sin) of an angle, in the same turn; multiples of 90 degrees stay."""
    if ratio == 1.0:
        return degrees
    cosine, sine = horizontal(degrees, 1.0)
    angle = math.degrees(math.atan2(ratio * sine, cosine))
    return angle + FULL_CIRCLE * round((degrees - angle) / FULL_CIRCLE)


# --- loads ------------------------------------------------------------------------------------------------------------


NO_LIVE_LOAD = {
    "objective": "a force is sought, no load factor",
    "settlement": "a support gives way, there is no live load",
    "time_history": "it moves in time, there is no live load",
    "modes": "it vibrates, there is no live load",
}
"""Keys of load cases without a live load for a diagram, and what they ask instead"""


def _live_loads(deck: Deck, case: str) -> list[Entry]:
    """The live loads of a case, those that named loads stand for among them, with the products of their factors.

    Raises UsageError where there is no such case, and where its live loads are no sum of loads.
    """
    cases = deck.content.load_cases
    if case not in cases:
        raise UsageError("unknown-load-case", f"no load case {case} in the deck; it has {', '.join(cases)}")
    for key in given(cases[case], tuple(NO_LIVE_LOAD)):
        raise UsageError("interact-load", f"load case {case}: {NO_LIVE_LOAD[key]}")
    entries = list(entries_of(cases[case].live or [], ("load_cases", case, "live"), deck.content.loads))
    if not all(entry.adds_up for entry in entries):
        words = f"load case {case}: its live load travels or tilts; a diagram takes other kinds of load"
        raise UsageError("interact-load", words)
    return entries


def _written(deck: Deck, entry: Entry, factor: float, **changes: Any) -> dict[str, Any]:
    """A load as a deck writes it, in the deck's units, expressions evaluated, with another factor and other values.

    A table is named relative to the main file of the deck, from where a setting looks for it.
    """
    text: dict[str, Any] = entry.load.model_dump(mode="json", by_alias=True, exclude_unset=True, exclude_none=True)
    if entry.load.facts.is_file:
        file = deck.resolve_file((*entry.path, entry.kind), entry.value)
        text[entry.kind] = os.path.relpath(file.resolve(), deck.folder.resolve())
    return text | {"factor": factor} | changes


def _free_name(deck: Deck, name: str) -> str:
    """The name with as many strokes as make it one that no load case of the deck has."""
    while name in deck.content.load_cases:
        name += "_"
    return name


def _direction(deck: Deck, case: str, count: int) -> InteractionQuestion:
    """Azimuths around the circle for one load case; raises UsageError where nothing can be turned."""
    entries = _live_loads(deck, case)
    if deck.content.symmetry:
        raise UsageError(
            "interact-load",
            "symmetry: the deck gives half of the structure, and what pushes one half out of the plane would push its "
            "image the other way; the load factor over direction needs the whole structure",
        )
    vectors = [_vector(case, entry) for entry in entries]
    parts = [complex(x, y) for x, y, _ in vectors]
    pushes = [part * entry.factor for entry, part in zip(entries, parts, strict=True) if part]
    if not pushes:
        raise UsageError("interact-load", f"load case {case}: no live load has a horizontal part that could be turned")
    turned = [push / pushes[0] for push in pushes]
    absolute = all(one.real > 0 and abs(one.imag) <= ONE_WAY * abs(one) for one in turned)
    if absolute:  # from +x on, whatever the direction in the deck
        parts = [complex(math.copysign(abs(part), each.factor)) for each, part in zip(entries, parts, strict=True)]
    loads = [(entry, part, z) for entry, part, (_, _, z) in zip(entries, parts, vectors, strict=True)]
    pair: tuple[str, ...] = ()
    if not any(z for _, _, z in vectors):  # powers of both say what a mechanism bounds all around
        pair = _free_name(deck, "interact_0"), _free_name(deck, "interact_90")
    both = zip(pair, (0.0, QUARTER), strict=False)
    fixed: dict[str, Plain] = {f"load_cases.{name}": {"live": _turned(deck, loads, angle)} for name, angle in both}
    azimuths = angles_between(0.0, FULL_CIRCLE, count)
    begins = "azimuth 0 pushes along +x, 90 along +y" if absolute else "azimuth 0 is as the deck directs its loads"
    return InteractionQuestion(
        kind=DIRECTION,
        case=case,
        axes=("factor along x", "factor along y") if absolute else ("factor at azimuth 0", "factor at azimuth 90"),
        pair=pair,
        settings={azimuth: {f"load_cases.{case}.live": _turned(deck, loads, azimuth)} for azimuth in azimuths},
        fixed=override_texts(fixed),
        closed=True,
        words=f"load case {case}: the horizontal part of its live load is turned; {begins}",
    )


def _turned(deck: Deck, loads: Sequence[tuple[Entry, complex, float]], azimuth: float) -> list[Plain]:
    """Loads as a deck writes them, each by its horizontal part, which is turned, and its vertical part."""
    turn, found = complex(*horizontal(azimuth, 1.0)), list[Plain]()
    for entry, part, vertical in loads:
        to = part * turn
        found.append(_written(deck, entry, entry.factor, **{entry.kind: [to.real + 0.0, to.imag + 0.0, vertical]}))
    return found


def _vector(case: str, entry: Entry) -> tuple[float, float, float]:
    """The vector of a load; raises UsageError for one that has none."""
    vector = load_kind(entry).vector
    if vector is None:
        raise UsageError(
            "interact-load",
            f"load case {case}: its live load {'.'.join(map(str, entry.path))} is a {entry.kind}, which is not turned; "
            "the load factor over direction takes acceleration, gravity and force",
        )
    x, y, z = vector(entry.value)
    return float(x), float(y), float(z)


def _two_loads(deck: Deck, model: Model, pair: tuple[str, ...]) -> Callable[[float], Mapping[str, Plain]]:
    """What an angle sets; raises UsageError where two load cases have no sum, or not the same dead load."""
    first, second = pair
    if first == second:
        raise UsageError("interact-option", f"--loads {first} {second}: name two different load cases")
    entries = {name: _live_loads(deck, name) for name in pair}
    one, other = ({case.name: case.dead_load for case in model.load_cases}[name] for name in pair)
    if not np.abs(one - other).max(initial=0.0) <= SAME_LOAD * np.abs([one, other]).max(initial=0.0):
        raise UsageError(
            "interact-load",
            f"load cases {first} and {second} have different dead loads: their live loads act together only on one; "
            "give both the same dead load",
        )
    own: dict[str, Plain] = {}
    if (dead := deck.content.load_cases[first].dead) is not None:
        places = [Entry.of(load, ("load_cases", first, "dead", number)) for number, load in enumerate(dead)]
        own["dead"] = [_written(deck, entry, entry.factor) for entry in places]
    case = f"load_cases.{_free_name(deck, 'interact')}"

    def setting(angle: float) -> Mapping[str, Plain]:
        """Both live loads; one whose share is zero is left out."""
        shares = zip(pair, horizontal(angle, 1.0), strict=True)
        acting = ((share, entry) for name, share in shares if share for entry in entries[name])
        return {case: {**own, "live": [_written(deck, entry, share * entry.factor) for share, entry in acting]}}

    return setting
