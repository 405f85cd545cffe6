"""``mbla sweep``: from a sweep file to its table; the table of contents of a sweep."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from mbla import __version__
from mbla.deck import Deck
from mbla.errors import Notice, UsageError
from mbla.results.listing.text import counted
from mbla.sweeps.base import check_points, read_base
from mbla.sweeps.design.build import design_of
from mbla.sweeps.design.design import Design, design_json
from mbla.sweeps.engine.engine import EngineOptions, check_options, outcomes_of
from mbla.sweeps.file.content import FragilitySection
from mbla.sweeps.file.read import Sweep
from mbla.sweeps.fragility import asked_of, fragility_csv, fragility_lines, fragility_of
from mbla.sweeps.fragility_curve import curve_lines, fragility_curves
from mbla.sweeps.identity import PointKeys, library_versions
from mbla.sweeps.journal import SINGLE, JournalHeader, journal_name, journals_in, merged, open_journal
from mbla.sweeps.plan import FAILED, MEGABYTE, Plan, PointOutcome, Task, as_named
from mbla.sweeps.results import result_columns
from mbla.sweeps.tables.sweep_json import counts, sweep_json
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable, sweep_table, with_columns
from mbla.sweeps.tables.write_tables import FRAGILITY, FURTHER, StudyResult, refuse_tables, write_tables
from mbla.sweeps.words import SweepProgress

FAILED_POINTS = 8
"""exit status of a sweep some of whose points failed"""
RESUME = "--resume continues"
"""words on finished points in a journal"""

Report = Callable[[SweepProgress, Task | None, PointOutcome | None], None]
"""called once before the first point, with None, and after each finished point"""


@dataclass(frozen=True)
class SweepOptions:
    """What the command line adds to a sweep file.

    folder       : of all files; SWEEP_NAME.out next to the sweep file if None
    shard        : part and number of parts, counted from 1: only these points, for job arrays
    resume       : continue with the journal that is there
    force        : start over and replace earlier files
    retry_failed : on resuming, solve failed points again
    further      : files of ``FURTHER`` that are written in addition to those of the sweep file
    goes_on      : how a sweep that was broken off is continued, in words
    """

    folder: Path | None = None
    engine: EngineOptions = field(default_factory=EngineOptions)
    shard: tuple[int, int] | None = None
    resume: bool = False
    force: bool = False
    retry_failed: bool = False
    further: frozenset[str] = frozenset()
    goes_on: str = RESUME

    def folder_for(self, path: Path) -> Path:
        """Where the files of a sweep go."""
        return path.with_suffix(".out") if self.folder is None else self.folder


@dataclass(frozen=True)
class Prepared:
    """A sweep that could begin.

    name     : of the sweep file, or of the command that makes the sweep by itself
    base     : the base deck; ``deck`` is its name as the user gives it
    study_of : what follows from the table of all points
    further  : files of ``FURTHER`` that are written next to sweep.csv and sweep.json
    """

    name: str
    deck: str
    title: str
    base: Deck
    design: Design
    plan: Plan
    study_of: Callable[[SweepTable], StudyResult]
    further: frozenset[str] = frozenset()

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """Key of each point of the design, in its order."""
        keys = PointKeys(self.plan.fingerprint, self.base)
        return tuple(keys.of(point.settings) for point in self.design.points)

    @property
    def columns(self) -> tuple[SweepColumn, ...]:
        """Columns of results."""
        return result_columns(self.plan.results, self.plan.cases, self.base.units)

    @property
    def tasks(self) -> tuple[Task, ...]:
        """Each different point once."""
        first: dict[str, Task] = {}
        for key, point in zip(self.keys, self.design.points, strict=True):
            first.setdefault(key, Task(key, point.number, point.settings))
        return tuple(first.values())


@dataclass(frozen=True)
class Finished:
    """Outcome of a sweep; ``table`` has every point, those not solved yet without values."""

    record: dict[str, Any]
    table: SweepTable
    folder: Path
    lines: Sequence[str] = ()
    remark: str = ""

    @property
    def exit_code(self) -> int:
        """Exit status of the command."""
        return int(self.record["exit_code"])


def prepare(sweep: Sweep, options: SweepOptions) -> Prepared:
    """Read the base deck of a sweep file, and make the points.

    Raises DeckError and FileError with everything that is wrong with either file.
    """
    base, content = read_base(sweep), sweep.content
    design, memory = design_of(base.sources), content.limits.memory
    check_points(base, design.points)
    plan = Plan(
        deck=str(base.deck.path.absolute()),
        fingerprint=base.fingerprint,
        fixed=base.fixed,
        cases=base.cases,
        results=tuple(content.results),
        keep=content.output.files,
        folder=str(options.folder_for(sweep.path).absolute()),
        time_limit=content.limits.time,
        memory_limit=None if memory is None else memory * MEGABYTE,
    )
    further = options.further | {name for name in FURTHER if getattr(content.output, name)}
    study_of = partial(_fragility, content.fragility)
    name = sweep.path.name
    return Prepared(name, content.deck, content.title or name, base.deck, design, plan, study_of, further)


def _fragility(asked: FragilitySection | None, table: SweepTable) -> StudyResult:
    """Probabilities of a sweep that asks for them."""
    if asked is None:
        return StudyResult()
    what = asked_of(asked, table)
    found, curves = fragility_of(table, what), fragility_curves(table, what)
    texts, record = {FRAGILITY: fragility_csv(found, table)}, {"fragility": found, "fragility_curves": curves}
    lines = [*fragility_lines(found, table), *curve_lines(curves, table)]
    return StudyResult(record=record, texts=texts, lines=lines)


def run_sweep(prepared: Prepared, options: SweepOptions, report: Report | None = None) -> Finished:
    """Solve what is not solved yet, row by row into the journal, and write the table.

    Raises UsageError: no engine, or a worker that does not fit. Raises FileError: another run is at work, files are in
    the way or cannot be written; what was solved is in the journal.
    """
    started = time.perf_counter()
    plan, folder = prepared.plan, Path(prepared.plan.folder)
    deck = {"base deck": plan.fingerprint[:16], "load cases": " ".join(plan.cases)}
    columns = {column.name: column.kind for column in prepared.columns}
    header = JournalHeader({**deck, "mbla": plan.program, **library_versions()}, columns)
    part, parts = options.shard or (1, 1)
    asked = prepared.tasks[part - 1 :: parts]  # neighbours take about equal times, and so do shards then
    path = folder / (SINGLE if options.shard is None else journal_name(part, parts))
    check_options(options.engine)
    refuse_tables(folder, prepared.further, replace=options.force or options.resume)
    how = {"resume": options.resume, "force": options.force, "retry_failed": options.retry_failed}
    with open_journal(path, header, **how) as journal:
        tasks = {task.key: task for task in asked if task.key not in journal.finished}
        progress = SweepProgress(len(tasks), len(journal.finished))
        if report is not None:
            report(progress, None, None)
        try:
            with closing(outcomes_of(options.engine, plan, tuple(tasks.values()))) as outcomes:
                for outcome in outcomes:
                    task = tasks[outcome.key]
                    journal.add(task, as_named(plan, prepared.deck, outcome))
                    progress.add(outcome.state == FAILED)
                    if report is not None:
                        report(progress, task, journal.finished[outcome.key])
        except BaseException as error:  # says how much of the sweep is kept, where its own words do not
            if not isinstance(error, UsageError) and RESUME not in str(error):
                kept = counted(len(journal.finished), "finished point")
                error.add_note(f"{kept} in the journal, {options.goes_on}")
            raise
        of_shards = merged(() if options.shard is None else journals_in(folder), header)
        return _finish(prepared, journal.finished | of_shards, journal.notices, time.perf_counter() - started)


def _finish(
    prepared: Prepared, finished: Mapping[str, PointOutcome], notices: Sequence[Notice], seconds: float
) -> Finished:
    """The table of all points, and its files once none is missing, which may be so in a shard."""
    design, keys = prepared.design, prepared.keys
    table = sweep_table(prepared.title, design, prepared.columns, finished, keys)
    failed = any(finished[key].state == FAILED for key in keys if key in finished)
    study = prepared.study_of(table)
    table = with_columns(table, study.columns)
    record = sweep_json(
        table,
        sweep=prepared.name,
        deck=prepared.deck,
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        exit_code=study.exit_code if study.exit_code is not None else FAILED_POINTS if failed else 0,
        left_out=design.left_out,
        seconds=seconds,
        notices=(*notices, *(Notice("notice", "sweep-design", text) for text in design.remarks)),
    )
    record |= study.record
    remark, folder = "", Path(prepared.plan.folder)
    if not counts(table)["unfinished"]:
        record, remark = write_tables(folder, record, table, prepared.further, study)
    return Finished(record, table, folder, study.lines, remark)


def dry_run_json(prepared: Prepared) -> dict[str, Any]:
    """The points of a sweep that is only listed, with their keys and the columns of its table."""
    return {
        "mbla": __version__,
        "sweep": prepared.name,
        "deck": prepared.deck,
        "cases": list(prepared.plan.cases),
        "design": design_json(prepared.design),
        "keys": list(prepared.keys),
        "different": len(prepared.tasks),
        "results": [column.name for column in prepared.columns],
    }
