"""The commands on parameter sweeps: call what does the work, print, return the exit status; nothing else.

They print as :mod:`mbla.cli` does, which calls them and says what went wrong. Everything of a command is imported when
it is called, so that the program starts at once.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.decks import refuse_unfit_name
from mbla.cli.options import add_deck_options, shard, workers
from mbla.cli.terminal import clear_line, rewrite_line, say
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.sweeps.command import Finished, SweepOptions
    from mbla.sweeps.plan import PointOutcome, Task
    from mbla.sweeps.words import Progress

NAMED_FAILURES = 20
"""failed points that have a line of their own while the sweep continues; the journal has the reasons of all"""
BETWEEN_LINES = 10.0
"""seconds between lines of progress where there is no terminal"""


def add_sweep(commands: Any) -> None:
    """``mbla sweep``."""
    command = commands.add_parser(
        "sweep",
        help="run a deck over a design of experiments: a table of all points",
        description="Solve a base deck at every point of a design of experiments. Each finished point is a row of "
        "journal.csv at once; --resume continues after an interruption. When none is missing, sweep.csv and sweep.json "
        "hold all points in the order of the design, and mbla sweep-plot draws them. mbla schema sweep says what a "
        "sweep file may have.",
        epilog="Exit status 0 where every point has a verified answer, also that there is no load factor; 8 with "
        "failed points, whose rows say why.",
    )
    command.set_defaults(action=sweep, about={"sweep": "sweep"})
    command.add_argument("sweep", type=Path, metavar="SWEEP", help="sweep file (YAML)")
    command.add_argument(
        "-j",
        "--jobs",
        type=workers,
        default=1,
        metavar="N",
        help="processes of this machine (default 1)",
    )
    command.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="a Dask scheduler, whose workers solve the points: tcp://HOST:PORT or tls://HOST:PORT (extra mbla[dask])",
    )
    command.add_argument(
        "--scheduler-file",
        type=Path,
        metavar="F",
        help="the same, by the file in which the scheduler wrote its address",
    )
    command.add_argument(
        "--shard",
        type=shard,
        metavar="I/N",
        help="only the I-th of N parts, for job arrays; the last to end writes the table",
    )
    command.add_argument("--resume", action="store_true", help="continue with the journal: solve what is missing")
    command.add_argument("--retry-failed", action="store_true", help="as --resume, and solve failed points again")
    command.add_argument("--dry-run", action="store_true", help="list the points and solve nothing")
    command.add_argument("--parquet", action="store_true", help="the table as Parquet too (extra mbla[tables])")
    command.add_argument("--hdf5", action="store_true", help="the table as HDF5 too, along the axes of the design")
    add_deck_options(command, "for every point", what="sweep", default="SWEEP.out")
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def sweep(options: argparse.Namespace) -> int:
    """Solve the points of a sweep file, or list them; the summary goes to standard output, or the JSON object alone."""
    with loading():
        from mbla.sweeps.file.read import read_sweep

    refuse_unfit_name(options.sweep, "sweep file")
    content = read_sweep(options.sweep, tuple(options.set))
    with loading():
        from mbla.results.record.json_values import json_line
        from mbla.sweeps.command import dry_run_json, prepare, run_sweep
        from mbla.sweeps.design.design import design_lines
        from mbla.sweeps.words import sweep_lines

    chosen = _sweep_options(options)
    prepared = prepare(content, chosen)
    if options.dry_run:
        text = [json_line(dry_run_json(prepared))] if options.json else design_lines(prepared.design)
        print("\n".join(text), flush=True)
        return 0
    finished = solved(options, lambda report: run_sweep(prepared, chosen, report))
    print_finished(options, finished, [*sweep_lines(finished.record, finished.table), *finished.lines])
    return finished.exit_code


def solved(options: argparse.Namespace, solve: Callable[[Any], Finished]) -> Finished:
    """What a sweep ends with, its progress reported meanwhile."""
    report = None if options.quiet else _Reporter()
    try:
        return solve(report)
    finally:
        if report is not None:
            report.end()


def print_finished(options: argparse.Namespace, finished: Finished, lines: Sequence[str]) -> None:
    """The JSON object where it is asked for, what was found in words, and where the files are."""
    with loading():
        from mbla.results.record.json_values import json_line

    if finished.remark:
        say(f"mbla: {finished.remark}", 0)
    if options.json:
        print(json_line(finished.record), flush=True)
    if not options.quiet:
        folder, here = finished.folder, Path.cwd()
        shown = folder.relative_to(here) if folder.is_relative_to(here) else folder
        text = "\n".join([*lines, f"  files: {shown}/"])
        print(text, file=sys.stderr if options.json else sys.stdout, flush=True)


def _sweep_options(options: argparse.Namespace) -> SweepOptions:
    with loading():
        from mbla.sweeps.command import SweepOptions
        from mbla.sweeps.engine.engine import EngineOptions

    return SweepOptions(
        folder=options.output,
        engine=EngineOptions(
            workers=options.jobs,
            scheduler=options.scheduler or "",
            scheduler_file=options.scheduler_file,
        ),
        shard=options.shard,
        resume=options.resume or options.retry_failed,
        force=options.force,
        retry_failed=options.retry_failed,
        parquet=options.parquet,
        hdf5=options.hdf5,
    )


class _Reporter:
    """Progress on standard error: a line that rewrites itself on a terminal, a line now and then elsewhere."""

    def __init__(self) -> None:
        self._terminal = sys.stderr.isatty()
        self._last = time.monotonic()

    def __call__(self, progress: Progress, task: Task | None, outcome: PointOutcome | None) -> None:
        failed = outcome is not None and outcome.state == "failed"
        if task is not None and outcome is not None and failed and progress.failed <= NAMED_FAILURES:
            self.end()
            say(f"mbla: point {task.number} failed: {outcome.reason}", 0)
        if self._terminal:
            rewrite_line(progress.words())
        elif outcome is None:
            known = f", {progress.earlier} are in the journal" if progress.earlier else ""
            say(f"mbla: {progress.total} points to solve{known}", 0)
        elif time.monotonic() - self._last >= BETWEEN_LINES:
            self._last = time.monotonic()
            say(f"mbla: {progress.words()}", 0)

    def end(self) -> None:
        """What is said next has a line of its own."""
        clear_line(self._terminal or None)
