"""``mbla sweep``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.given_decks import refuse_unfit_name
from mbla.cli.options import add_deck_options, add_jobs, add_quiet, shard
from mbla.cli.sweep_progress import solve_and_print
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
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
    add_jobs(command)
    words = "a Dask scheduler, whose workers solve the points: tcp://HOST:PORT or tls://HOST:PORT (extra mbla[dask])"
    command.add_argument("--scheduler", metavar="ADDRESS", help=words)
    words = "the same, by the file in which the scheduler wrote its address"
    command.add_argument("--scheduler-file", type=Path, metavar="F", help=words)
    words = "only the I-th of N parts, for job arrays; the last to end writes the table"
    command.add_argument("--shard", type=shard, metavar="I/N", help=words)
    command.add_argument("--resume", action="store_true", help="continue with the journal: solve what is missing")
    command.add_argument("--retry-failed", action="store_true", help="as --resume, and solve failed points again")
    command.add_argument("--dry-run", action="store_true", help="list the points and solve nothing")
    command.add_argument("--parquet", action="store_true", help="the table as Parquet too (extra mbla[tables])")
    command.add_argument("--hdf5", action="store_true", help="the table as HDF5 too, along the axes of the design")
    add_deck_options(command, "for every point", what="sweep", default="SWEEP.out")
    add_quiet(command)


def sweep(options: argparse.Namespace) -> int:
    """Solve the points of a sweep file, or list them; the summary goes to standard output, or the JSON object alone."""
    with loading():
        from mbla.sweeps.file.read import read_sweep

    refuse_unfit_name(options.sweep, "sweep file")
    content = read_sweep(options.sweep, tuple(options.set))
    with loading():
        from mbla.results.record.json_values import json_line
        from mbla.sweeps.command import SweepOptions, dry_run_json, prepare, run_sweep
        from mbla.sweeps.design.design import design_lines
        from mbla.sweeps.engine.engine import EngineOptions
        from mbla.sweeps.words import sweep_lines

    chosen = SweepOptions(
        folder=options.output,
        engine=EngineOptions(options.jobs, options.scheduler or "", options.scheduler_file),
        shard=options.shard,
        resume=options.resume or options.retry_failed,
        force=options.force,
        retry_failed=options.retry_failed,
        further=frozenset(form for form in ("parquet", "hdf5") if getattr(options, form)),
    )
    prepared = prepare(content, chosen)
    if options.dry_run:
        text = [json_line(dry_run_json(prepared))] if options.json else design_lines(prepared.design)
        print("\n".join(text), flush=True)
        return 0
    return solve_and_print(
        options,
        lambda report: run_sweep(prepared, chosen, report),
        lambda finished: [*sweep_lines(finished.record, finished.table), *finished.lines],
    )
