"""The question of two loads: the live loads of two load cases act together, A times cosine and B times sine.

At the load factor λ of an angle φ the structure carries A times λ cos φ and B times λ sin φ: a point of the
interaction curve. The two load cases must have one dead load, which belongs to every point.
"""

from __future__ import annotations

import numpy as np

from mbla.deck import Deck
from mbla.errors import UsageError
from mbla.model.loads.load_kind import Entry
from mbla.model.model import Model
from mbla.sweeps.interaction.angles import angles_between, closes, unit_vector
from mbla.sweeps.interaction.direction import free_name
from mbla.sweeps.interaction.entries import live_entries, section_of, written
from mbla.sweeps.interaction.question import TWO_LOADS, Question
from mbla.sweeps.plan import Plain

SAME = 1e-12
"""difference of two dead loads, relative to the larger, that is rounding of how the deck writes them"""
WHAT = "an interaction of two loads"


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
    section = section_of(deck, first, WHAT)
    section_of(deck, second, WHAT)
    _refuse_other_dead_load(model, first, second)
    name = free_name(deck, "interact")
    dead = section.dead
    own: dict[str, Plain] = {}
    if dead is not None:
        own["dead"] = [_dead(deck, first, number) for number in range(len(dead))]
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
    if float(np.abs(one - other).max(initial=0.0)) > SAME * largest:
        raise UsageError(
            "interact-load",
            f"load cases {first} and {second} have different dead loads: their live loads act together only on one; "
            "give both the same dead load",
        )


def _dead(deck: Deck, case: str, number: int) -> Plain:
    """A dead load as the deck writes it; what it names is looked for from the main file."""
    load = (deck.content.load_cases[case].dead or [])[number]
    return written(deck, Entry(load, ("load_cases", case, "dead", number), load.factor), load.factor)


def _together(deck: Deck, names: tuple[str, str], angle: float) -> list[Plain]:
    """Both live loads at an angle; one whose share is zero is left out."""
    return [
        written(deck, entry, share * entry.factor)
        for name, share in zip(names, unit_vector(angle), strict=True)
        if share != 0.0
        for entry in live_entries(deck, name)
    ]
