"""Checks of a sweep file that need its base deck: keys inside of one another, directions, values, columns."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from pydantic import TypeAdapter, ValidationError

from mbla.deck.content import DeckContent
from mbla.deck.deck import read_deck
from mbla.deck.expressions import Parameters, is_expression
from mbla.deck.fields import annotations_at
from mbla.deck.suggestions import did_you_mean, listed
from mbla.deck.text.overrides import LABEL, RefusedError
from mbla.deck.text.tree import KeyPath, key_text, shorten
from mbla.errors import DeckError, Fault, Finding, Message, Notice, Place
from mbla.sweeps.base_keys import path_of_key, unit_at, value_at, vector_at
from mbla.sweeps.file.content import DIRECTIONS, Parameter, way_of
from mbla.sweeps.file.rules import key_places
from mbla.sweeps.plan import override_texts
from mbla.sweeps.results import FACTORS, OWN_COLUMNS, STATUS, result_columns, result_fault, result_places

if TYPE_CHECKING:
    from mbla.sweeps.base import Base

UNUSED = re.compile(r" (\w+)\.(\S+) is not used$")
"""end of the notices on names that nothing uses"""

Given = tuple[KeyPath, Any]
"""Place of a value in the sweep file, and the value"""


def base_faults(base: Base) -> list[Fault]:
    """Everything wrong with what a sweep does to its base deck, where each of its keys is known to exist."""
    checks = (_nested_keys, _idle_values, _without_effect, _directions, _units, _results, _columns, _fragility)
    findings = [finding for check in checks for finding in check(base)]
    faults = [*_idle_overrides(base), *(base.sweep.fault_at(*finding) for finding in findings)]
    return faults or list(_values(base))


def _nested_keys(base: Base) -> Iterator[Finding]:
    """No parameter sets what another one sets as a part of its own value."""
    seen: list[tuple[str, str, KeyPath]] = []
    for name, place, key, path in _places(base):
        for other, other_key, outer in seen:
            short, long = sorted((outer, path), key=len)
            if long[: len(short)] == short:
                both = f"parameter {name} sets {shorten(key)}, parameter {other} {shorten(other_key)}"
                yield Finding("sweep-without-effect", f"{both}: one of them holds the other", *place)
        seen.append((name, key, path))


def _places(base: Base) -> Iterator[tuple[str, KeyPath, str, KeyPath]]:
    """Of each key of a parameter: the parameter, place in the sweep file, the key, path in the deck."""
    for name, parameter in base.sweep.content.parameters.items():
        for (place, key), path in zip(key_places(name, parameter), base.paths[name], strict=True):
            yield name, place, key, path


def _idle_values(base: Base) -> Iterator[Finding]:
    """No value of `set` that a parameter replaces in every point."""
    for key in base.sweep.content.set:
        for name in _replacing(base, key):
            yield Finding("sweep-without-effect", NO_EFFECT.format(name), "set", key)


def _idle_overrides(base: Base) -> Iterator[Fault]:
    """No value of the command line either."""
    for number, text in enumerate(base.sweep.overrides, start=1):
        key = text.partition("=")[0].strip()
        for name in _replacing(base, key):
            yield Fault(Place(LABEL, number, 1), key, Message("sweep-without-effect", NO_EFFECT.format(name)))


NO_EFFECT = "has no effect: parameter {} of the sweep sets it in every point"


def _replacing(base: Base, key: str) -> list[str]:
    """Parameters that set a key of the deck, or what holds it, for each of their own keys."""
    try:
        fixed = path_of_key(base.tree.data, key.strip())
    except RefusedError:  # a whole section, which holds more than parameters replace
        return []
    return [name for name, _, _, path in _places(base) if fixed[: len(path)] == path]


def _without_effect(base: Base) -> Iterator[Finding]:
    """No parameter changes what nothing in the deck uses: every point would be the same."""
    idle = unused(_notices(base))
    parameters = base.sweep.content.parameters.values()
    texts = [value for each in parameters for value in each.values or () if isinstance(value, str)]
    for _, place, _, path in _places(base):
        if len(path) < 2:
            continue
        section, thing = str(path[0]), str(path[1])
        if section == "load_cases" and thing not in base.cases:
            message = f"has no effect: load case {shorten(thing)} is not among the cases to solve"
            yield Finding("sweep-without-effect", message, *place)
        named = any(thing in text for text in texts)  # another parameter may bring it into use
        if (section, thing) in idle and not named:
            message = f"has no effect: the deck does not use {section}.{shorten(thing)}"
            yield Finding("sweep-without-effect", message, *place)


def _notices(base: Base) -> tuple[Notice, ...]:
    """Those of the deck without its expectations: what only they use does not change a point."""
    if not base.deck.content.expected:
        return base.deck.notices
    return read_deck(base.path, base.fixed, expected=False).notices


def unused(notices: Iterable[Notice]) -> set[tuple[str, str]]:
    """Section and name of what a deck gives and does not use, by its notices."""
    found = (UNUSED.search(notice.message) for notice in notices if notice.identifier.endswith("-unused"))
    return {(match[1], match[2]) for match in found if match}


def _directions(base: Base) -> Iterator[Finding]:
    """Directions turn vectors that have one."""
    for name, parameter in base.sweep.content.parameters.items():
        way = way_of(parameter)
        if way not in DIRECTIONS:
            continue
        vectors = {path: vector_at(base.deck, path) for path in base.paths[name]}
        for path in (path for path, vector in vectors.items() if vector is None):
            found = "nothing" if value_at(base.deck, path) is None else "something else"
            message = f"turns a vector of three numbers; the deck has {found} at {key_text(path)}"
            yield Finding("sweep-directions", message, "parameters", name, way)
        if None in vectors.values():
            continue
        x, y, z = vectors[base.paths[name][0]] or (0.0, 0.0, 0.0)
        if len(set(vectors.values())) > 1:
            message = "turns vectors that differ in the deck: give each a parameter, in a zip"
            yield Finding("sweep-directions", message, "parameters", name, way)
        elif getattr(parameter, way).size is None and not (x or y or (z and way == "sphere")):
            part = "length" if way == "sphere" else "horizontal part"
            message = f"needs size: the vector in the deck has no {part} that it could keep"
            yield Finding("sweep-directions", message, "parameters", name, way)


def _units(base: Base) -> Iterator[Finding]:
    """A unit in the sweep file names a column; it does not convert."""
    for name, parameter in base.sweep.content.parameters.items():
        if not parameter.unit or any(isinstance(value, str) for value in parameter.values or ()):
            continue
        units = {unit_at(path, base.deck.units) for path in base.paths[name]}
        own = units.pop() if len(units) == 1 else ""
        if own and own != parameter.unit:
            message = f"the deck takes this in {own}, and values here are not converted: write them in {own}"
            yield Finding("sweep-unit", message, "parameters", name, "unit")


def _results(base: Base) -> Iterator[Finding]:
    """Every result is one that a run has."""
    for index, path in enumerate(base.sweep.content.results):
        if message := result_fault(path, base.cases):
            yield Finding("sweep-result", message, "results", index)


def _columns(base: Base) -> Iterator[Finding]:
    """Every column of the table has a name of its own."""
    content = base.sweep.content
    owners = dict.fromkeys(OWN_COLUMNS, "a column of every sweep")
    places = result_places(content.results, base.cases)
    owners |= dict.fromkeys([*content.results, *(name for name, _, _ in places)], "a result")
    for name, parameter in content.parameters.items():
        for column in (f"{name}_azimuth", f"{name}_elevation") if parameter.sphere is not None else (name,):
            if column in owners:
                message = (
                    f"column {column} of the table would be there twice, it is {owners[column]}: "
                    "choose another name, and give the key path with key"
                )
                yield Finding("sweep-columns", message, "parameters", name)
            owners.setdefault(column, f"that of parameter {name}")


def _fragility(base: Base) -> Iterator[Finding]:
    """The result is a column of numbers, or one in each load case, and what has no load factor can be told apart."""
    results, asked = base.sweep.content.results, base.sweep.content.fragility
    if asked is None or any(result_fault(path, base.cases) for path in results):
        return
    columns = result_columns(results, base.cases, base.deck.units)
    chosen = [column for column in columns if asked.result in (column.name, column.path)]
    if not chosen:
        hint = did_you_mean(asked.result, [*(column.name for column in columns), *results]) or ":"
        cases = f" of {listed(base.cases, 'and')}" if len(base.cases) > 1 else ""
        message = f"there is no column {shorten(asked.result)}{hint} the results are {listed(results, 'and')}{cases}"
        yield Finding("sweep-fragility", message, "fragility", "result")
    elif any(column.kind not in ("float", "int") for column in chosen):
        yield Finding("sweep-fragility", f"{asked.result} is no number", "fragility", "result")
    elif any(column.path in FACTORS for column in chosen) and STATUS not in results:
        message = (
            f"must have {STATUS} too: for the probability of {shorten(asked.result)} it tells what does not stand from "
            "what no load brings down"
        )
        yield Finding("sweep-fragility", message, "results")


# --- values -------------------------------------------------------------------------------------------------------


def _values(base: Base) -> Iterator[Fault]:
    """Values, and the ends of ranges, that the deck does not take there, in the words of ``--set``."""
    numbers = Parameters(base.sources.known)

    def convert(text: str, dimension: str) -> float:
        return numbers.evaluate(text) if is_expression(text) else base.deck.units.convert(text, dimension)

    for name, _, key, path in _places(base):
        adapters = [TypeAdapter[Any](each) for each in annotations_at(DeckContent, path)]
        for place, value in _given(name, base.sweep.content.parameters[name]):
            if not any(_fits(adapter, value, convert) for adapter in adapters):
                yield from _in_words(base, place, key, value)


def _given(name: str, parameter: Parameter) -> Iterator[Given]:
    """Values of a parameter that the sweep file has literally."""
    place: KeyPath = ("parameters", name, way_of(parameter))
    for index, value in enumerate(parameter.values or ()):
        yield (*place, index), value
    section = getattr(parameter, way_of(parameter))
    if parameter.values is None and way_of(parameter) not in DIRECTIONS:
        for key, field in type(section).model_fields.items():
            value = getattr(section, key)
            if key in ("start", "end", "mode", "mean", "least", "greatest") and value is not None:
                yield (*place, field.alias or key), value


def _fits(adapter: TypeAdapter[Any], value: Any, convert: Any) -> bool:
    try:
        adapter.validate_python(value, context={"convert": convert})
    except ValidationError:
        return False
    return True


def _in_words(base: Base, place: KeyPath, key: str, value: Any) -> Iterator[Fault]:
    """Faults of the deck with a value that its types refuse, at the place of the value."""
    text = override_texts({key: value})
    try:
        read_deck(base.path, (*base.fixed, *text), expected=False)
    except DeckError as error:
        for fault in error.faults:
            if fault.place.file == LABEL and fault.place.line == len(base.fixed) + 1:
                yield base.sweep.fault_at(place, fault.message.around(before=f"as {shorten(key)} of the deck: "))
