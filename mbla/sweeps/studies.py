"""Sweeps of a deck that a command makes by itself, without a sweep file and a journal: points, table, files.

``mbla interact`` turns a load, ``mbla tradeoff`` changes the analysis; both take the engines, outcomes and tables of
sweeps, and add a picture and sentences of their own.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np

from mbla.deck import Deck
from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.failures import SIGNALS, words_of
from mbla.results.files import OutputFolder
from mbla.results.listing.text import INDENT
from mbla.results.pictures.page import matplotlib_parts
from mbla.results.provenance import collect_provenance
from mbla.results.record.scene import Values
from mbla.results.results import now
from mbla.sweeps.design.design import Design, Dimension, Point
from mbla.sweeps.engine.engine import Engine
from mbla.sweeps.identity import fingerprint_of, key_hash, program_identity
from mbla.sweeps.plan import Outcome, Plain, Plan, Task, shown_folders
from mbla.sweeps.results import result_columns
from mbla.sweeps.tables.sweep_json import record_text
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable, sweep_table
from mbla.sweeps.tables.write_tables import sweep_csv

PICTURES = ("png", "svg")
INTERRUPTION = "interrupted: here is what was found until then"
LEFT = "the files of the earlier study are left as they are"
"""of a study that was interrupted"""
NOT_SOLVED = "not solved: interrupted before"
"""reason of points that were not reached"""


@dataclass(frozen=True)
class About:
    """What every study says of its deck.

    overrides : of the command line, for every point
    """

    deck: str
    title: str
    overrides: tuple[str, ...]
    units: Units
    flow_rule: str
    provenance: Mapping[str, str] = field(default_factory=collect_provenance)
    created: str = field(default_factory=now)

    @property
    def heading(self) -> str:
        """Deck and title; the deck alone where it has no title."""
        return self.deck if self.title == self.deck else f"{self.deck}: {self.title}"


def about(deck: Deck, overrides: Sequence[str]) -> About:
    """What is said of a deck that was read with these overrides."""
    return About(deck.path.name, deck.title, tuple(overrides), deck.units, deck.analysis.flow_rule)


@dataclass(frozen=True)
class Study(ABC):
    """What every study ends with.

    stop    : exit status of the signal that ended it, 0 without one
    seconds : by the clock
    """

    about: About
    table: SweepTable
    stop: int
    seconds: float

    @property
    @abstractmethod
    def exit_code(self) -> int:
        """Of the command."""

    @property
    def heading_lines(self) -> list[str]:
        """How its words begin."""
        return [self.about.heading, f"{INDENT}flow rule {self.about.flow_rule}"]


StudyOfAKind = TypeVar("StudyOfAKind", bound=Study)


def plan_of(deck: Deck, fixed: Sequence[str], cases: Sequence[str], results: Sequence[str]) -> Plan:
    """The plan of points of a deck without limits and files."""
    path = deck.path.resolve()
    return Plan(
        deck=str(path),
        fingerprint=fingerprint_of(deck.path, fixed),
        fixed=tuple(fixed),
        cases=tuple(cases),
        results=tuple(results),
        keep="none",
        folder=str(path.parent),
        time_limit=None,
        memory_limit=None,
        program=program_identity(),
    )


def tasks_of(plan: Plan, settings: Sequence[Mapping[str, Plain]]) -> list[Task]:
    """One task for each point; no two points are one."""
    return [Task(key_hash(plan.fingerprint, own, [str(n)]), n, own) for n, own in enumerate(settings, 1)]


def solved(
    engine: Engine, plan: Plan, tasks: Sequence[Task], deck: Deck, report: Callable[[int], None] | None = None
) -> tuple[dict[int, Outcome], int]:
    """Outcomes by the number of their point, and the exit status of the signal that ended it, 0 without one.

    An interruption before the first outcome is raised; other errors as the engine does.

    report : called with how many points are done
    """
    numbers = {task.key: task.number for task in tasks}
    shown = shown_folders(plan, deck.path.name)
    found: dict[int, Outcome] = {}
    with closing(engine.run(plan, tasks)) as outcomes:
        try:
            for outcome in map(shown, outcomes):
                found[numbers[outcome.key]] = outcome
                if report is not None:
                    report(len(found))
        except tuple(SIGNALS) as error:
            if not found:
                raise
            return found, words_of(error)[0]
    return found, 0


def study_table(
    of: About, parameter: SweepColumn, values: Sequence[Plain], plan: Plan, outcomes: Mapping[int, Outcome]
) -> SweepTable:
    """The table of a study, a row for each value of its one parameter; rows not solved have no values."""
    points = tuple(Point(n, (n - 1,), (value,), {}) for n, value in enumerate(values, 1))
    design = Design((parameter,), (Dimension(parameter.dimension, len(points)),), points, (tuple(values),))
    found = {str(number): outcome for number, outcome in outcomes.items()}
    columns = result_columns(plan.results, plan.cases, of.units)
    return sweep_table(of.title, design, columns, found, [str(point.number) for point in points], unfinished=True)


def with_columns(table: SweepTable, columns: Sequence[tuple[SweepColumn, Values]]) -> SweepTable:
    """The table with more columns at its end."""
    return replace(
        table,
        columns=(*table.columns, *(column for column, _ in columns)),
        values=(*table.values, *(values for _, values in columns)),
    )


def without_empty(table: SweepTable) -> SweepTable:
    """The table without results that no point has."""
    empty = [column.role == "result" and not any(_plain(values)) for column, values in _pairs(table)]
    kept = [pair for pair, none in zip(_pairs(table), empty, strict=True) if not none]
    return replace(table, columns=tuple(c for c, _ in kept), values=tuple(v for _, v in kept))


def _pairs(table: SweepTable) -> list[tuple[SweepColumn, Values]]:
    return list(zip(table.columns, table.values, strict=True))


def _plain(values: Values) -> Iterator[bool]:
    """Of each value whether there is one."""
    return (value is not None and value == value for value in np.ma.asarray(values).tolist())


def rows_json(table: SweepTable) -> list[dict[str, Plain]]:
    """An object for each point, its values by the names of the columns; None where there is none."""
    columns = [
        [None if value is None or value != value else value for value in np.ma.asarray(values).tolist()]
        for values in table.values
    ]
    names = [column.name for column in table.columns]
    return [dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True)]


def study_record(study: Study, own: Mapping[str, Any], files: Sequence[str]) -> dict[str, Any]:
    """The record of a study: how every one begins and ends, and its own keys between."""
    of = study.about
    return {
        "mbla": of.provenance["mbla"],
        "deck": of.deck,
        "title": of.title,
        "created": of.created,
        "exit_code": study.exit_code,
        "set": list(of.overrides),
        "flow_rule": of.flow_rule,
        "units": {"length": of.units.length, "force": of.units.force, "mass": of.units.mass},
        "provenance": dict(of.provenance),
        **own,
        "time": study.seconds,
        "files": list(files),
    }


def written_study(
    out: OutputFolder,
    solve: Callable[[], StudyOfAKind],
    draw: Callable[[OutputFolder, str, StudyOfAKind], None],
    record: Callable[[StudyOfAKind, tuple[str, ...]], dict[str, Any]],
) -> tuple[StudyOfAKind, dict[str, Any], list[str]]:
    """Solve a study and write table, pictures and record; the study, its record, and what is to be said of it.

    An interrupted study is written as far as it came, but never over an earlier one.

    draw   : called with the folder, the ending of the pictures to make, and the study
    record : of the study and the names of all files

    Raises
    ------
    FileError
        Files are in the way or cannot be written.
    """
    table, json = f"{out.stem}.csv", f"{out.stem}.json"
    out.refuse(table, json)
    with out:
        study = solve()
        remarks = [INTERRUPTION] if study.stop else []
        if study.stop and any((out.folder / name).exists() for name in (table, json)):
            return study, record(study, out.names), [*remarks, LEFT]
        out.write_text(table, sweep_csv(study.table))
        remark = _without_pictures()
        for ending in () if remark else PICTURES:
            draw(out, ending, study)
        out.write_text(json, record_text(record(study, tuple(sorted((*out.names, json))))))
    return study, record(study, out.names), [*remarks, *([remark] if remark else [])]


def _without_pictures() -> str:
    """Why there can be no pictures; empty where there can."""
    try:
        matplotlib_parts()
    except UsageError as error:
        return f"no pictures: {error}"
    return ""
