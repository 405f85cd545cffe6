"""Which values of a run become columns of the table, and where they are in its JSON.

A travelling load is one load case of the deck and many of the record. Its values are those of the worst position, and
those of the series itself (``worst.distance``, ``positions.3.load_factor``). Where the worst is not known there are
none, and the status is that of the first position that leaves it unknown. An objective is two: ``least.value``,
``greatest.value``, and the graver status of both.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from mbla.deck.suggestions import did_you_mean, listed
from mbla.deck.units import Units
from mbla.results.quantities.quantity import unit_text
from mbla.results.record.json_record import RUN
from mbla.results.record.objects import Key, keys_of
from mbla.sweeps.plan import Plain
from mbla.sweeps.tables.sweep_table import AFTER, POINT, STATE, SweepColumn

OF_RUN = ("model", "settings", "time")
"""first keys of paths that lead into the record of the run rather than into that of a load case"""
TIME_OF_CASE = ("time.total", "time.solver")
OWN_COLUMNS = tuple(column.name for column in (POINT, STATE, *AFTER))
"""columns that every table of a sweep has in addition to those of parameters and results"""
STATUS = "status"
FACTORS = (
    *("load_factor", "least_load_factor", "torsion_load_factor", "associative_load_factor"),
    *("static_bound", "kinematic_bound"),
)
"""results that are load factors: they have a place on their axis for a structure that does not stand, and for one that
no load brings down, which their status says"""
IN_TIME, FALLEN, MOVES = "time_history.", "time_history.fallen", "time_history.still_moves"
"""how paths of structures in time begin; how many of its blocks fall: with one it passes every limit; whether it ends
while it still moves: then it may pass those that it has not reached"""
UNBOUNDED = "unbounded"
"""status of a position that nothing brings down: others may still be the worst"""


def is_of_run(path: str) -> bool:
    """Whether a path leads into the record of the run; what a load case took by itself is in its own."""
    return path.partition(".")[0] in OF_RUN and path not in TIME_OF_CASE


def result_places(results: Sequence[str], cases: Sequence[str]) -> list[tuple[str, str, str]]:
    """Name, load case and key path of each column: case by case, then those of the entire run, which have no case.

    The name is the path, with ``CASE.`` before it where several load cases are solved.
    """
    of_run = [path for path in results if is_of_run(path)]
    prefixes = {case: f"{case}." if len(cases) > 1 else "" for case in cases}
    places = [(prefixes[case] + path, case, path) for case in cases for path in results if path not in of_run]
    return [*places, *((path, "", path) for path in of_run)]


def values_of(record: Mapping[str, Any], places: Sequence[tuple[str, str, str]]) -> dict[str, Plain]:
    """Value of each column in the JSON record of a run; None where the run has none."""
    cases = {case["name"]: case for case in record["cases"]}
    cases |= {series["name"]: _of_series(series, cases) for series in record["series"]}
    cases |= {each["name"]: _of_objective(each, cases) for each in record["objectives"]}
    return {name: _at(cases.get(case) if case else record, path.split(".")) for name, case, path in places}


def reason_of(record: Mapping[str, Any]) -> str:
    """Why a run failed: blocks that touch nothing, then why load cases have no load factor.

    Each reason once, with the names of its cases where several were solved.
    """
    warnings = (notice for notice in record["notices"] if notice["severity"] == "warning")
    apart = [notice["message"] for notice in warnings if notice["identifier"] == "isolated-blocks"]
    names: dict[str, list[str]] = {}
    for case in record["cases"]:
        if case["reason"]:
            names.setdefault(case["reason"], []).append(case["name"])
    if len(record["cases"]) == 1:
        return "; ".join([*apart, *names])
    return "; ".join([*apart, *(f"{listed(cases, 'and')}: {reason}" for reason, cases in names.items())])


def _of_series(series: Mapping[str, Any], cases: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """The keys of a travelling load, and those of the case that is its worst position."""
    if series["worst"] is not None:
        own = [cases[position["case"]]["time"] for position in series["positions"]]
        time = {key: sum(each[key] or 0.0 for each in own) for key in ("total", "solver")}
        return {**cases[series["worst"]["case"]], **series, "time": time}
    statuses = [position["status"] for position in series["positions"]]
    without = [position["status"] for position in series["positions"] if position["load_factor"] is None]
    unknown = [status for status in without if status != UNBOUNDED]
    return {"status": (unknown or statuses or [None])[0], **series}


def _of_objective(objective: Mapping[str, Any], cases: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """The keys of a force, and those of the case that is its least value, with the time of both ends."""
    ends = [cases[end["case"]] for end in (objective["least"], objective["greatest"]) if end is not None]
    time = {key: sum(each["time"][key] or 0.0 for each in ends) for key in ("total", "solver")}
    return {**ends[0], **objective, "time": time}


def _at(record: Any, path: Sequence[str]) -> Plain:
    """The value at a path; keys of an object may have full stops in them, as ``ground z = 0.5`` does."""
    if not path:
        value: Plain = None if isinstance(record, Mapping | list) else record
        return value
    if isinstance(record, Mapping):
        for count in range(1, len(path) + 1):
            if (key := ".".join(path[:count])) in record:
                return _at(record[key], path[count:])
    if isinstance(record, list) and path[0].isdecimal() and int(path[0]) < len(record):
        return _at(record[int(path[0])], path[1:])
    return None


KINDS = {"integer": "int", "number": "float", "string": "text", "boolean": "bool"}
"""types of JSON that fill a column, and what the column is called"""
OWNERS = ("cases[].", "series[].", "objectives[].")
"""what stands before the paths of load cases in the description; a travelling load has both"""


def result_columns(results: Sequence[str], cases: Sequence[str], units: Units) -> tuple[SweepColumn, ...]:
    """The columns of results in their order, as ``result_places`` names them, in a deck's units.

    The paths must have passed ``result_fault``.
    """
    columns = []
    for name, case, path in result_places(results, cases):
        key = _key_at(path)
        assert key is not None, f"{path} was not checked"
        unit = "" if key.unit == "1" else unit_text(key.unit, units)
        words = key.words.replace("null", "empty")
        columns.append(SweepColumn(name, unit, words, KINDS[_kind(key)], "result", case=case, path=path))
    return tuple(columns)


def result_fault(path: str, cases: Sequence[str] = ()) -> str:
    """What is wrong with a path that cannot be a column, empty where it can; cases: names of the load cases."""
    if not path.strip():
        return "must not be empty: write a key path such as load_factor"
    key, (first, _, rest) = _key_at(path), path.partition(".")
    if key is not None and _kind(key) in KINDS:
        return ""
    names = [name for name, _, own in _described() if _kind(own) in KINDS]
    if key is None:
        if first in cases and _key_at(rest) is not None:
            return f"stands without its load case, as {rest}: each load case gets a column of it"
        hint = did_you_mean(path, names)
        return f"is no result{hint or '; results are the keys of `cases[]` in schemas/results.md'}"
    inside = [name for name in names if name.startswith(f"{path}.")]
    inside = [name for name in inside if name.count(".") == path.count(".") + 1] or inside
    return f"is {'an object' if _kind(key) == 'object' else 'a list'}, no single value; take {listed(inside)}"


def _kind(key: Key) -> str:
    return key.kind.rstrip("?")


def _key_at(path: str) -> Key | None:
    """The description of what is at a path; a single value before an object where names with full stops allow both."""
    found = [key for _, pattern, key in _described() if pattern.fullmatch(path)]
    return next((key for key in found if _kind(key) in KINDS), found[0] if found else None)


@cache
def _described() -> tuple[tuple[str, re.Pattern[str], Key], ...]:
    """Paths from the object of a load case, or of the run: as a sweep file may have them, and what all others match.

    Item 0 of lists, NAME where the deck names keys, which may have full stops in them.
    """
    found = []
    for key in keys_of(RUN):
        owner = next((owner for owner in OWNERS if key.path.startswith(owner)), "")
        path = key.path.removeprefix(owner)
        if owner or path.partition(".")[0] in OF_RUN:
            pattern = re.escape(path).replace(r"\[\]", r"\.[0-9]+").replace(r"\*", r".+")
            found.append((path.replace("[]", ".0").replace("*", "NAME"), re.compile(pattern), key))
    return tuple(found)
