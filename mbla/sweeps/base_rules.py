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
from mbla.deck.overrides import LABEL, RefusedError
from mbla.deck.suggestions import listed
from mbla.deck.tree import KeyPath, key_text, shorten
from mbla.errors import DeckError, Fault, Message, Notice, Place
from mbla.sweeps.base_keys import path_of_key, unit_at, value_at, vector_at
from mbla.sweeps.file.content import Parameter
from mbla.sweeps.file.parts import DIRECTIONS, way_of
from mbla.sweeps.file.rules import key_places, parameter_columns
from mbla.sweeps.plan import override_texts
from mbla.sweeps.results import result_faults, result_places

if TYPE_CHECKING:
    from mbla.sweeps.base import Base

UNUSED = re.compile(r" (\w+)\.(\S+) is not used$")
"""end of the notices on names that nothing uses"""

Given = tuple[KeyPath, Any]
"""Place of a value in the sweep file, and the value"""


def base_faults(base: Base) -> list[Fault]:
    """Everything wrong with what a sweep does to its base deck, where each of its keys is known to exist."""
    checks = (_nested_keys, _idle_values, _without_effect, _directions, _units, _results, _columns, _fragility)
    faults = [fault for check in checks for fault in check(base)]
    return faults or list(_values(base))


def _nested_keys(base: Base) -> Iterator[Fault]:
    """No parameter sets what another one sets as a part of its own value."""
    seen: list[tuple[str, str, KeyPath]] = []
    for name, parameter in base.sweep.content.parameters.items():
        for (place, key), path in zip(key_places(name, parameter), base.paths[name], strict=True):
            for other, other_key, outer in seen:
                short, long = sorted((outer, path), key=len)
                if long[: len(short)] == short:
                    both = f"parameter {name} sets {shorten(key)}, parameter {other} {shorten(other_key)}"
                    message = f"{both}: one of them holds the other"
                    yield base.sweep.fault_at(place, Message("sweep-without-effect", message))
            seen.append((name, key, path))


def _idle_values(base: Base) -> Iterator[Fault]:
    """No fixed value that a parameter replaces in every point."""
    owners = [(name, path) for name, paths in base.paths.items() for path in paths]
    keys = [text.partition("=")[0].strip() for text in base.fixed]
    for number, key in enumerate(keys):
        try:
            fixed = path_of_key(base.tree.data, key)
        except RefusedError:  # a whole section, which holds more than parameters replace
            continue
        for name, path in owners:
            if fixed[: len(path)] == path:
                message = f"has no effect: parameter {name} of the sweep sets it in every point"
                index = number - len(base.sweep.content.set)
                if index < 0:
                    yield base.sweep.fault_at(
                        ("set", list(base.sweep.content.set)[number]), Message("sweep-without-effect", message)
                    )
                else:
                    yield Fault(Place(LABEL, index + 1, 1), key, Message("sweep-without-effect", message))


def _without_effect(base: Base) -> Iterator[Fault]:
    """No parameter changes what nothing in the deck uses: every point would be the same."""
    content = base.sweep.content
    idle = unused(_notices(base))
    texts = [value for each in content.parameters.values() for value in each.values or () if isinstance(value, str)]
    for name, parameter in content.parameters.items():
        for (place, _), path in zip(key_places(name, parameter), base.paths[name], strict=True):
            if len(path) < 2:
                continue
            section, thing = str(path[0]), str(path[1])
            if section == "load_cases" and thing not in base.cases:
                yield base.sweep.fault_at(
                    place,
                    Message(
                        "sweep-without-effect",
                        f"has no effect: load case {shorten(thing)} is not among the cases to solve",
                    ),
                )
            named = any(thing in text for text in texts)  # another parameter may bring it into use
            if (section, thing) in idle and not named:
                yield base.sweep.fault_at(
                    place,
                    Message("sweep-without-effect", f"has no effect: the deck does not use {section}.{shorten(thing)}"),
                )


def _notices(base: Base) -> tuple[Notice, ...]:
    """Those of the deck without its expectations: what only they use does not change a point."""
    if not base.deck.content.expected:
        return base.deck.notices
    return read_deck(base.path, base.fixed, expected=False).notices


def unused(notices: Iterable[Notice]) -> set[tuple[str, str]]:
    """Section and name of what a deck gives and does not use, by its notices."""
    found = (UNUSED.search(notice.message) for notice in notices if notice.identifier.endswith("-unused"))
    return {(match[1], match[2]) for match in found if match}


def _directions(base: Base) -> Iterator[Fault]:
    """Directions turn vectors that have one."""
    for name, parameter in base.sweep.content.parameters.items():
        way = way_of(parameter)
        if way not in DIRECTIONS:
            continue
        vectors = [vector_at(base.deck, path) for path in base.paths[name]]
        place = ("parameters", name, way)
        for path, vector in zip(base.paths[name], vectors, strict=True):
            if vector is None:
                found = "nothing" if value_at(base.deck, path) is None else "something else"
                message = f"turns a vector of three numbers; the deck has {found} at {key_text(path)}"
                yield base.sweep.fault_at(place, Message("sweep-directions", message))
        if None in vectors:
            continue
        if len(set(vectors)) > 1:
            yield base.sweep.fault_at(
                place,
                Message("sweep-directions", "turns vectors that differ in the deck: give each a parameter, in a zip"),
            )
            continue
        x, y, z = vectors[0] or (0.0, 0.0, 0.0)
        if getattr(parameter, way).size is None and not (x or y or (z and way == "sphere")):
            part = "length" if way == "sphere" else "horizontal part"
            yield base.sweep.fault_at(
                place,
                Message("sweep-directions", f"needs size: the vector in the deck has no {part} that it could keep"),
            )


def _units(base: Base) -> Iterator[Fault]:
    """A unit in the sweep file names a column; it does not convert."""
    for name, parameter in base.sweep.content.parameters.items():
        if not parameter.unit or any(isinstance(value, str) for value in parameter.values or ()):
            continue
        units = {unit_at(path, base.deck.units) for path in base.paths[name]}
        own = units.pop() if len(units) == 1 else ""
        if own and own != parameter.unit:
            message = f"the deck takes this in {own}, and values here are not converted: write them in {own}"
            yield base.sweep.fault_at(("parameters", name, "unit"), Message("sweep-unit", message))


def _results(base: Base) -> Iterator[Fault]:
    """Every result is one that a run has."""
    for index, message in result_faults(base.sweep.content.results, base.cases):
        yield base.sweep.fault_at(("results", index), Message("sweep-result", message))


def _columns(base: Base) -> Iterator[Fault]:
    """No parameter is named as the result of a load case."""
    content = base.sweep.content
    results = {place.name for place in result_places(content.results, base.cases)} - set(content.results)
    for name, parameter in content.parameters.items():
        for column in parameter_columns(name, parameter):
            if column in results:
                message = (
                    f"column {column} of the table is a result: choose another name, and give the key path with key"
                )
                yield base.sweep.fault_at(("parameters", name), Message("sweep-columns", message))


def _fragility(base: Base) -> Iterator[Fault]:
    """The result is a column, or one in each load case."""
    content = base.sweep.content
    if content.fragility is None:
        return
    wanted = content.fragility.result
    columns = [place.name for place in result_places(content.results, base.cases)]
    if wanted not in columns and wanted not in content.results:
        message = f"there is no column {shorten(wanted)}: the columns are {listed(columns, 'and')}"
        yield base.sweep.fault_at(("fragility", "result"), Message("sweep-fragility", message))


# --- values -------------------------------------------------------------------------------------------------------


def _values(base: Base) -> Iterator[Fault]:
    """Values, and the ends of ranges, that the deck does not take there, in the words of ``--set``."""
    numbers = Parameters(base.known)

    def convert(text: str, dimension: str) -> float:
        return numbers.evaluate(text) if is_expression(text) else base.deck.units.convert(text, dimension)

    for name, parameter in base.sweep.content.parameters.items():
        given = list(_given(name, parameter))
        for (_, key), path in zip(key_places(name, parameter), base.paths[name], strict=True):
            annotation: Any = annotations_at(DeckContent, path)
            adapters = [TypeAdapter[Any](each) for each in annotation]
            for place, value in given:
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
