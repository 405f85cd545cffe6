"""Which values of a run become columns of the table, and where they are in its JSON.

A travelling load is one load case of the deck and many of the record. Its values are those of the worst position, and
those of the series itself (``worst.distance``, ``positions.3.load_factor``). Where the worst is not known there are
none, and the status is that of the first position that leaves it unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mbla.deck.suggestions import listed
from mbla.sweeps.plan import Plain

OF_RUN = ("model", "settings", "time")
"""first keys of paths that lead into the record of the run rather than into that of a load case"""
OWN_COLUMNS = ("point", "state", "exit_code", "reason", "tries", "seconds")
"""columns that every table of a sweep has beside those of parameters and results"""
STATUS = "status"
FACTORS = (
    "load_factor",
    "least_load_factor",
    "greatest_load_factor",
    "static_bound",
    "kinematic_bound",
    "associative_load_factor",
)
"""results that are load factors: they have a place on their axis for a structure that does not stand, and for one that
no load brings down, which their status tells"""
UNBOUNDED = "unbounded"
"""status of a position that nothing brings down: others may still be the worst"""


@dataclass(frozen=True)
class ResultPlace:
    """Where the value of one column is.

    name : of the column: the path, with ``CASE.`` before it where several load cases are solved
    case : load case; empty for values of the whole run
    path : keys, and numbers of items of lists, from the object of the case or of the run
    """

    name: str
    case: str
    path: tuple[str, ...]


def result_places(results: Sequence[str], cases: Sequence[str]) -> tuple[ResultPlace, ...]:
    """The columns of a sweep: case by case, then those of the whole run."""
    of_cases = [path for path in results if path.partition(".")[0] not in OF_RUN]
    of_run = [path for path in results if path.partition(".")[0] in OF_RUN]
    prefixes = {case: f"{case}." if len(cases) > 1 else "" for case in cases}
    places = [ResultPlace(prefixes[case] + path, case, tuple(path.split("."))) for case in cases for path in of_cases]
    return (*places, *(ResultPlace(path, "", tuple(path.split("."))) for path in of_run))


def values_of(record: Mapping[str, Any], places: Sequence[ResultPlace]) -> dict[str, Plain]:
    """Value of each column in the JSON record of a run; None where the run has none."""
    cases = {case["name"]: case for case in record["cases"]}
    cases |= {series["name"]: _of_series(series, cases) for series in record["series"]}
    return {place.name: _at(cases.get(place.case) if place.case else record, place.path) for place in places}


def reason_of(record: Mapping[str, Any]) -> str:
    """Why a run failed: blocks that touch nothing, then why load cases have no load factor.

    Each reason once, with the names of its cases where several were solved.
    """
    apart = [notice["message"] for notice in record["notices"] if _is_fault(notice)]
    names: dict[str, list[str]] = {}
    for case in record["cases"]:
        if case["reason"]:
            names.setdefault(case["reason"], []).append(case["name"])
    if len(record["cases"]) == 1:
        return "; ".join([*apart, *names])
    return "; ".join([*apart, *(f"{listed(cases, 'and')}: {reason}" for reason, cases in names.items())])


def _is_fault(notice: Mapping[str, Any]) -> bool:
    return bool(notice["identifier"] == "isolated-blocks" and notice["severity"] == "warning")


def _of_series(series: Mapping[str, Any], cases: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """The keys of a travelling load, and those of the case that is its worst position."""
    if series["worst"] is not None:
        return {**cases[series["worst"]["case"]], **series}
    statuses = [position["status"] for position in series["positions"]]
    unknown = [
        position["status"]
        for position in series["positions"]
        if position["load_factor"] is None and position["status"] != UNBOUNDED
    ]
    return {"status": (unknown or statuses or [None])[0], **series}


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
