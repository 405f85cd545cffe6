"""Checks of a sweep file that need its base deck: keys inside of one another, directions, values, columns."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from itertools import combinations
from typing import TYPE_CHECKING, Any

from pydantic import TypeAdapter, ValidationError

from mbla.deck.content import DeckContent
from mbla.deck.deck import check_regular, read_deck
from mbla.deck.expressions import Parameters, is_expression
from mbla.deck.fields import annotations_at
from mbla.deck.parameter_keys import path_of_key, unit_of, value_at, vector_at
from mbla.deck.references import side_files
from mbla.deck.suggestions import listed, unknown
from mbla.deck.text.include import confined
from mbla.deck.text.overrides import LABEL, RefusedError
from mbla.deck.text.tree import key_text, shorten
from mbla.errors import DeckError, Fault, FileError, Finding, KeyPath, Message, Place
from mbla.sweeps.file.content import DIRECTIONS, FALLS, Parameter, way_of
from mbla.sweeps.file.rules import key_places
from mbla.sweeps.plan import override_texts
from mbla.sweeps.results import (
    FACTORS,
    FALLEN,
    IN_TIME,
    OWN_COLUMNS,
    STATUS,
    result_columns,
    result_fault,
    result_places,
)

if TYPE_CHECKING:
    from mbla.sweeps.base import Base

UNUSED = re.compile(r" (\w+)\.(\S+) is not used$")
"""end of the notices on names that nothing uses"""


def base_faults(base: Base) -> list[Fault]:
    """Everything wrong with what a sweep does to its base deck, where each of its keys is known to exist."""
    checks = (_nested_keys, _without_effect, _directions, _units, _results, _columns, _fragility, _files)
    findings = [finding for check in checks for finding in check(base)]
    faults = [*_replaced(base), *(base.sweep.fault_at(*finding) for finding in findings)]
    return faults or list(_values(base))


def _places(base: Base) -> Iterator[tuple[str, KeyPath, str, KeyPath]]:
    """Of each key of a parameter: the parameter, place in the sweep file, the key, path in the deck."""
    for name, parameter in base.sweep.content.parameters.items():
        for (place, key), path in zip(key_places(name, parameter), base.paths[name], strict=True):
            yield name, place, key, path


def _nested_keys(base: Base) -> Iterator[Finding]:
    """No parameter sets what another one sets as a part of its own value."""
    for (name, _, key, path), (other, place, other_key, other_path) in combinations(_places(base), 2):
        short, long = sorted((path, other_path), key=len)
        if long[: len(short)] == short:
            both = f"parameter {other} sets {shorten(other_key)}, parameter {name} {shorten(key)}"
            yield Finding("sweep-without-effect", f"{both}: one of them holds the other", *place)


def _replaced(base: Base) -> Iterator[Fault]:
    """No value of `set` or of the command line that a parameter replaces in every point."""
    own = [(key, partial(base.sweep.fault_at, ("set", key))) for key in base.sweep.content.set]
    for number, text in enumerate(base.sweep.overrides, start=1):
        key = text.partition("=")[0].strip()
        own.append((key, partial(Fault, Place(LABEL, number, 1), key)))
    for key, fault in own:
        with suppress(RefusedError):  # an entire section, which holds more than parameters replace
            fixed = path_of_key(base.tree.data, key.strip())
            for name, _, _, path in _places(base):
                if fixed[: len(path)] == path:
                    said = f"has no effect: parameter {name} of the sweep sets it in every point"
                    yield fault(Message("sweep-without-effect", said))


def _without_effect(base: Base) -> Iterator[Finding]:
    """No parameter changes what nothing in the deck uses: every point would be the same."""
    # without its expectations: what only they use does not change a point
    deck = read_deck(base.path, base.fixed, expected=False) if base.deck.content.expected else base.deck
    ends = (UNUSED.search(notice.message) for notice in deck.notices if notice.identifier.endswith("-unused"))
    unused = {(match[1], match[2]) for match in ends if match}
    parameters = base.sweep.content.parameters.values()
    texts = [value for each in parameters for value in each.values or () if isinstance(value, str)]
    for _, place, _, path in _places(base):
        section, thing = (*map(str, path[:2]), "")[:2]
        if section == "load_cases" and thing and thing not in base.cases:
            message = f"has no effect: load case {shorten(thing)} is not among the cases to solve"
            yield Finding("sweep-without-effect", message, *place)
        named = any(thing in text for text in texts)  # another parameter may bring it into use
        if (section, thing) in unused and not named:
            message = f"has no effect: the deck does not use {section}.{shorten(thing)}"
            yield Finding("sweep-without-effect", message, *place)


def _directions(base: Base) -> Iterator[Finding]:
    """Directions turn vectors that have one."""
    for name, parameter in base.sweep.content.parameters.items():
        way = way_of(parameter)
        if way not in DIRECTIONS:
            continue
        vectors = {path: vector_at(base.deck.content, path) for path in base.paths[name]}
        for path in (path for path, vector in vectors.items() if vector is None):
            found = "nothing" if value_at(base.deck.content, path) is None else "something else"
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
        own = unit_of(base.paths[name], base.deck.units)
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
                message = f"column {column} of the table would be there twice, it is {owners[column]}"
                remedy = "choose another name, and give the key path with key"
                yield Finding("sweep-columns", f"{message}: {remedy}", "parameters", name)
            owners.setdefault(column, f"that of parameter {name}")


def _fragility(base: Base) -> Iterator[Finding]:
    """The result is a column of numbers, or one in each load case, and what has no load factor can be distinguished."""
    results, asked = base.sweep.content.results, base.sweep.content.fragility
    if asked is None or any(result_fault(path, base.cases) for path in results):
        return
    columns = result_columns(results, base.cases, base.deck.units)
    chosen = [column for column in columns if asked.result in (column.name, column.path)]
    if not chosen:
        message = unknown("column", asked.result, [column.name for column in columns], "the columns are")
        yield Finding("sweep-fragility", message, "fragility", "result")
    elif any(column.kind not in ("float", "int") for column in chosen):
        yield Finding("sweep-fragility", f"{asked.result} is no number", "fragility", "result")
    elif any(column.path in FACTORS for column in chosen) and STATUS not in results:
        message = (
            f"must have {STATUS} too: for the probability of {shorten(asked.result)} it distinguishes what does not "
            "stand from what no load brings down"
        )
        yield Finding("sweep-fragility", message, "results")
    elif asked.limit is not None and all(column.path.startswith(IN_TIME) for column in chosen):
        if missing := [path for path in (STATUS, FALLEN) if path not in results]:
            message = (
                f"must have {listed(missing, 'and')} too: what falls, or does not stand at rest, passes every limit"
            )
            yield Finding("sweep-fragility", message, "results")
    elif asked.limit is not None and FALLS in asked.limit:
        message = f"{shorten(asked.result)} is none of a structure in time, which falls: take a number"
        yield Finding("sweep-fragility", message, "fragility", "limit", asked.limit.index(FALLS))


def _files(base: Base) -> Iterator[Finding]:
    """Files that values name are there, records among them; whether they can be read is seen at their points."""
    for name, place, _, path in _places(base):
        values = base.sweep.content.parameters[name].values or ()
        named = [(index, file) for index, value in enumerate(values) for _, file in side_files(value, path)]
        for index, file in named:
            try:
                check_regular(confined(base.deck.path.resolve().parent, file))
            except FileError as error:
                yield Finding(error.message.identifier, error.message.words, *place[:2], "values", index)


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


def _given(name: str, parameter: Parameter) -> Iterator[tuple[KeyPath, Any]]:
    """Values of a parameter that the sweep file has literally, each with its place in the file."""
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
