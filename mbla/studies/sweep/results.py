"""Which values of a run become columns of the table, and where they are in its JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mbla.studies.sweep.plan import Plain

OF_RUN = ("model", "settings", "time")
"""first keys of paths that lead into the record of the run rather than into that of a load case"""


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
    cases = {case["name"]: case for case in (*record["cases"], *record["series"])}
    return {place.name: _at(cases.get(place.case) if place.case else record, place.path) for place in places}


def _at(record: Any, path: Sequence[str]) -> Plain:
    for key in path:
        if isinstance(record, Mapping):
            record = record.get(key)
        elif isinstance(record, list) and key.isdecimal() and int(key) < len(record):
            record = record[int(key)]
        else:
            return None
    value: Plain = record
    return value
