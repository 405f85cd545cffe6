"""What ``mbla find`` looks for: by the section of the deck, with options of the command in its place."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from mbla.deck import Deck
from mbla.deck.parameter_keys import number_at, path_of_key, unit_of
from mbla.deck.sections.find import IN_TIME, MOST_STEPS, SWITCHES, TOLERANCE
from mbla.deck.text.overrides import RefusedError
from mbla.deck.text.tree import key_text
from mbla.errors import KeyPath, UsageError

TARGETS = {
    "load_factor": "load factor",
    "least_load_factor": "least load factor",
    "stands": "pressure in all joints",
    "falls": "peak displacement",
    "peak": "peak displacement",
}
"""kinds of targets, and what is compared in words"""
TIMED = ("falls", "peak")
"""kinds of structures in time"""


@dataclass(frozen=True)
class FindQuestion:
    """The value of a parameter between two bounds at which a result is a target.

    parameter : key path as ``--set`` takes it
    path      : the same in the deck
    unit      : of its values; empty for plain numbers
    kind      : of ``TARGETS``
    target    : of the load factor, or the peak; 0 for ``stands`` and ``falls``
    scan      : equal steps between the bounds at which the result is looked at
    first     : whether they end with the first one, upwards, that has a value
    tolerance : of the value, relative to the larger of the bounds
    load_case : name
    """

    parameter: str
    path: KeyPath
    unit: str
    kind: str
    target: float
    bounds: tuple[float, float]
    scan: int
    tolerance: float
    load_case: str
    first: bool = False

    @property
    def in_time(self) -> bool:
        """Whether the structure is followed in time."""
        return self.kind in TIMED

    @property
    def absolute_tolerance(self) -> float:
        """Of the value, in its unit."""
        return self.tolerance * max(map(abs, self.bounds))


def question_of(deck: Deck, options: Any) -> FindQuestion:
    """The question that deck and options ask; raises UsageError where they leave it open or contradict themselves.

    options : ``parameter``, ``target``, ``bounds``, ``case``, ``scan``, ``first``, ``tolerance``; each None for that of
              the deck
    """
    section = deck.content.find
    given = {name: getattr(options, name) for name in ("parameter", "target", "bounds")}
    kind, target = ("", 0.0) if given["target"] is None else given["target"]
    if section is not None:
        if not kind:
            kind = next(name for name in TARGETS if getattr(section.target, name) is not None)
            target = getattr(section.target, kind)
        given["parameter"] = given["parameter"] or section.parameter
        given["bounds"] = given["bounds"] or section.bounds
    missing = [name for name in ("parameter", "bounds") if given[name] is None] + (["target"] if not kind else [])
    if missing:
        names = " and ".join(f"--{name}" for name in missing)
        raise UsageError("find-option", f"{deck.path}: find needs {names}, or a section find in the deck")
    least, greatest = given["bounds"]
    steps = (1 if section is None else section.scan) if options.scan is None else options.scan
    path, load_case, faults = _parameter(deck, given["parameter"]), _load_case(deck, options), list[str]()
    faults += [path] if isinstance(path, str) else []
    if not -math.inf < least < greatest < math.inf:
        faults.append(f"--bounds {least:g} {greatest:g}: two numbers, the second the greater")
    if not 1 <= steps <= MOST_STEPS:
        faults.append(f"--scan {steps}: 1 to {MOST_STEPS} steps are allowed")
    faults += [] if load_case else [f"--case is needed: the deck has {', '.join(deck.content.load_cases)}"]
    if faults or isinstance(path, str):
        raise UsageError("find-option", "\n".join(faults))
    return FindQuestion(
        parameter=".".join(map(str, path)),
        path=path,
        unit=unit_of([path], deck.units),
        kind=kind,
        target=0.0 if kind in SWITCHES else float(target),
        bounds=(float(least), float(greatest)),
        scan=steps,
        tolerance=options.tolerance or (section and section.tolerance) or (IN_TIME if kind in TIMED else TOLERANCE),
        load_case=load_case,
        first=bool(options.first or (section and section.first)),
    )


def _parameter(deck: Deck, key: str) -> KeyPath | str:
    """Its path, or what is wrong with it where it is no real number of the structure or its loads."""
    try:
        path = path_of_key(deck.data, key)
    except RefusedError as refusal:
        return f"--parameter {key}: {refusal.message.words}"
    if number_at(deck.content, path) is None:
        return f"--parameter {key}: {key_text(path)} is no real number that the deck gives"
    return path


def _load_case(deck: Deck, options: Any) -> str:
    """Name of the load case; empty where it is not said and there are several."""
    names, section = list(deck.content.load_cases), deck.content.find
    return options.case or (section and section.load_case) or (names[0] if len(names) == 1 else "")
