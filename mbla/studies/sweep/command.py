"""``mbla sweep``: from a sweep file to its table; the table of contents of a sweep."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from mbla.errors import Notice
from mbla.studies.sweep.base import Base, read_base
from mbla.studies.sweep.design.build import design_of
from mbla.studies.sweep.design.design import Design
from mbla.studies.sweep.engine.choice import engine_for
from mbla.studies.sweep.engine.options import EngineOptions
from mbla.studies.sweep.file.read import read_sweep
from mbla.studies.sweep.file.sweep import Sweep
from mbla.studies.sweep.journal.header import JournalHeader
from mbla.studies.sweep.journal.journal import Journal
from mbla.studies.sweep.journal.shards import WHOLE, journal_name, shard_of
from mbla.studies.sweep.outcome import FAILED, Outcome
from mbla.studies.sweep.plan import Plan, Task
from mbla.studies.sweep.program import program_identity
from mbla.studies.sweep.progress import Progress
from mbla.studies.sweep.result_columns import result_columns
from mbla.studies.sweep.tables.from_outcomes import sweep_table
from mbla.studies.sweep.tables.sweep_json import SweepRun
from mbla.studies.sweep.tables.sweep_table import SweepColumn, SweepTable
from mbla.studies.sweep.tables.write_tables import TableFiles, write_tables

FAILED_POINTS = 8
"""exit status of a sweep some of whose points failed"""
MEGABYTE = 1e6

Report = Callable[[Progress, Task | None, Outcome | None], None]
"""called once before the first point, with None, and after each finished point"""


@dataclass(frozen=True)
class SweepOptions:
    """What the command line adds to a sweep file.

    folder       : of all files; the sweep's name with .out beside it if None
    overrides    : ``key.path=value`` texts for the deck, for every point
    shard        : part and number of parts, counted from 1: only these points, for job arrays
    resume       : go on with the journal that is there
    force        : begin anew and replace earlier files
    retry_failed : on resuming, solve failed points again
    """

    folder: Path | None = None
    overrides: tuple[str, ...] = ()
    engine: EngineOptions = EngineOptions()
    shard: tuple[int, int] | None = None
    resume: bool = False
    force: bool = False
    retry_failed: bool = False
    parquet: bool = False
    hdf5: bool = False

    def folder_for(self, path: Path) -> Path:
        """Where the files of a sweep go."""
        return path.with_suffix(".out") if self.folder is None else self.folder


@dataclass(frozen=True)
class Prepared:
    """A sweep that could begin.

    keys    : of each point of the design, in its order
    columns : of results
    tasks   : each different point once
    """

    sweep: Sweep
    base: Base
    design: Design
    keys: tuple[str, ...]
    columns: tuple[SweepColumn, ...]
    plan: Plan
    tasks: tuple[Task, ...]


@dataclass(frozen=True)
class Finished:
    """What a sweep ends with; ``table`` has every point, those not solved yet without values."""

    record: dict[str, Any]
    table: SweepTable
    exit_code: int


def prepare(path: Path, options: SweepOptions) -> Prepared:
    """Read the sweep file and its base deck, and make the points.

    Raises
    ------
    DeckError, FileError
        with everything that is wrong with either file
    """
    sweep = read_sweep(path, options.overrides)
    base = read_base(sweep)
    content = sweep.content
    design = design_of(content, base.vectors, base.units, base.known, sweep.fault_at)
    keys = tuple(base.key_of(point.settings) for point in design.points)
    first: dict[str, Task] = {}
    for key, point in zip(keys, design.points, strict=True):
        first.setdefault(key, Task(key, point.number, point.settings))
    limits = content.limits
    plan = Plan(
        deck=str(base.deck.path.absolute()),
        fingerprint=base.fingerprint,
        fixed=base.fixed,
        cases=base.cases,
        results=tuple(content.results),
        keep=content.output.files,
        folder=str(options.folder_for(path).absolute()),
        time_limit=limits.time,
        memory_limit=None if limits.memory is None else limits.memory * MEGABYTE,
        program=program_identity(),
    )
    columns = result_columns(content.results, base.cases, base.deck.units)
    return Prepared(sweep, base, design, keys, columns, plan, tuple(first.values()))


def run_sweep(prepared: Prepared, options: SweepOptions, report: Report | None = None) -> Finished:
    """Solve what is not solved yet, row by row into the journal, and write the table.

    Raises
    ------
    UsageError
        no engine, or a worker that does not fit
    FileError
        another run is at work, files are in the way or cannot be written; what was solved is in the journal
    """
    started = time.perf_counter()
    folder = options.folder_for(prepared.sweep.path)
    header = JournalHeader(
        program=prepared.plan.program,
        fingerprint=prepared.base.fingerprint,
        columns=tuple(column.name for column in prepared.columns),
        title=prepared.sweep.content.title,
        cases=prepared.plan.cases,
    )
    path = folder / (WHOLE if options.shard is None else journal_name(*options.shard))
    with (
        engine_for(options.engine) as engine,
        Journal(
            path, header, resume=options.resume, force=options.force, retry_failed=options.retry_failed
        ) as journal,
    ):
        tasks = [task for task in _asked(prepared.tasks, options.shard) if task.key not in journal.finished]
        _solve(engine.run(prepared.plan, tasks), tasks, journal, report)
        return _finish(prepared, options, journal, time.perf_counter() - started)


def _asked(tasks: Sequence[Task], shard: tuple[int, int] | None) -> Sequence[Task]:
    return tasks if shard is None else shard_of(tasks, *shard)


def _solve(outcomes: Iterable[Outcome], tasks: Sequence[Task], journal: Journal, report: Report | None) -> None:
    """Each outcome into the journal as it comes."""
    by_key: Mapping[str, Task] = {task.key: task for task in tasks}
    progress, started = Progress(len(tasks), len(journal.finished)), time.perf_counter()
    if report is not None:
        report(progress, None, None)
    for outcome in outcomes:
        task = by_key[outcome.key]
        journal.add(task, outcome)
        progress.add(outcome.state == FAILED, time.perf_counter() - started)
        if report is not None:
            report(progress, task, outcome)


def _finish(prepared: Prepared, options: SweepOptions, journal: Journal, seconds: float) -> Finished:
    """The table of all points, and its files; a shard writes them only where no other point is missing."""
    content, finished = prepared.sweep.content, journal.finished
    table = sweep_table(
        content.title, prepared.design, prepared.columns, finished, prepared.keys, unfinished=True
    )
    code = FAILED_POINTS if any(finished[key].state == FAILED for key in prepared.keys if key in finished) else 0
    notices = (*journal.notices, *(Notice("notice", "sweep-design", text) for text in prepared.design.remarks))
    run = SweepRun(
        sweep=prepared.sweep.path.name,
        deck=content.deck,
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        exit_code=code,
        left_out=prepared.design.left_out,
        seconds=seconds,
        notices=notices,
    )
    files = TableFiles(content.output.parquet or options.parquet, content.output.hdf5 or options.hdf5)
    record = write_tables(options.folder_for(prepared.sweep.path), True, run, table, files)
    return Finished(record, table, code)
