"""The commands that solve a deck many times: call what does the work, print, return the exit status; nothing else.

They print as ``cli`` does, which calls them and says what went wrong; sweeps are in ``sweep_commands``.
Everything of a command is imported when it is called, so that the program starts at once.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.decks import read_given_deck, refuse_unfit_name, run_options
from mbla.cli.options import (
    add_analysis_options,
    add_deck_options,
    degrees,
    points,
    relative_above_zero,
    seconds,
    threads,
    workers,
)
from mbla.cli.terminal import clear_line, rewrite_line, say
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.process.run_options import RunOptions


def add_interact(commands: Any) -> None:
    """``mbla interact``."""
    command = commands.add_parser(
        "interact",
        help="load factor over horizontal direction, or over two live loads: table and diagram",
        description="Turn the live load of a load case around the horizon, or let the live loads of two load cases act "
        "together in all proportions: table, STEM_interact.csv (of two loads STEM_interact_A_B.csv), .json, and a "
        "diagram (extra mbla[pictures]). Turned are the horizontal parts of live accelerations and forces, all "
        "together; azimuth 0 pushes along +x, 90 along +y. Two loads A and B act as A cos + B sin of an angle, with "
        "the one dead load that both must have.",
        epilog="Exit status 0 where every point is answered and verified (also that the load never brings collapse "
        "there); else that of the gravest point: 4 not solved or not verified, 7 time or memory limit; 4 also where "
        "bounds of points contradict each other; 5 where no point has a load factor; 130 where it was interrupted: "
        "points solved until then are written, unless there are earlier files.",
    )
    command.set_defaults(action=interact, about={"deck": "deck"})
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--case", metavar="NAME", help="the load case that is turned; needed if there are several")
    command.add_argument("--loads", nargs=2, metavar=("A", "B"), help="two load cases whose live loads act together")
    command.add_argument(
        "--directions", type=points, metavar="N", help="points around the horizon (default 72), or of two loads (31)"
    )
    command.add_argument("--from", dest="start", type=degrees, metavar="DEG", help="first angle of two loads (0)")
    command.add_argument(
        "--to", dest="end", type=degrees, metavar="DEG", help="last angle (90 on; 360: both loads with both signs)"
    )
    command.add_argument(
        "-j", "--jobs", type=workers, default=1, metavar="N", help="processes of this machine (1; more: mbla[dask])"
    )
    add_deck_options(command, "for every point")
    command.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for each point, instead of analysis.time_limit"
    )
    add_analysis_options(command)
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def interact(options: argparse.Namespace) -> int:
    """Solve the points of a diagram; the table goes to standard output, with ``--json`` the object alone."""

    def study() -> tuple[Any, Any]:
        from mbla.sweeps.interaction.study import interact
        from mbla.sweeps.interaction.words import study_lines

        return interact, study_lines

    return _run_study(options, run_options(options), "points", study)


def add_tradeoff(commands: Any) -> None:
    """``mbla tradeoff``."""
    command = commands.add_parser(
        "tradeoff",
        help="speed against accuracy on a deck: table, CSV and plot",
        description="Run a deck under a ladder of settings, one after the other, and hold time and "
        "error against each other: table, STEM_tradeoff.csv, .json, and a picture of each load case (extra "
        "mbla[pictures]). Without --knob and --setting the ladder has everything that applies to the deck.",
        epilog="Exit status 0; 4 where no setting is verified that the others could be held against; 7 where the time "
        "limit came before the reference.",
    )
    command.set_defaults(action=tradeoff, about={"deck": "deck"})
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    add_deck_options(command, "for every setting")
    command.add_argument(
        "--knob",
        action="append",
        default=[],
        metavar="KEY.PATH=V,V,...",
        help="instead of the ladder: a setting for each value; of several, every combination (repeatable)",
    )
    command.add_argument(
        "--setting",
        action="append",
        default=[],
        metavar="'NAME: KEY.PATH=V ...'",
        help="instead of the ladder: one setting under a name of its own (repeatable)",
    )
    command.add_argument(
        "--wanted-error",
        type=relative_above_zero,
        default=1e-4,
        metavar="E",
        help="relative error for which a setting is advised (default 1e-4)",
    )
    command.add_argument("--time-limit", type=seconds, metavar="S", help="seconds for all settings together")
    command.add_argument("--run-limit", type=seconds, metavar="S", help="seconds for each setting")
    command.add_argument("--threads", type=threads, default=1, metavar="N", help="as of mbla run (default 1)")
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def tradeoff(options: argparse.Namespace) -> int:
    """Measure a deck under many settings; the table goes to standard output, with ``--json`` the object alone."""

    def study() -> tuple[Any, Any]:
        from mbla.sweeps.tradeoff.study import tradeoff
        from mbla.sweeps.tradeoff.words import study_lines

        return tradeoff, study_lines

    return _run_study(options, run_options(options, override=False), "settings", study)


def _run_study(options: argparse.Namespace, run: RunOptions, what: str, study: Callable[[], tuple[Any, Any]]) -> int:
    """Read the deck, solve what is asked of it and tell what came out; the exit status.

    what  : what is solved, as the line of progress counts it
    study : imports what solves it, and what says it in words
    """
    refuse_unfit_name(options.deck)
    content, _ = read_given_deck(options.deck, run)
    with loading():
        solve, lines = study()
    report = None if options.quiet else _progress(what)
    try:
        solved, record, remarks = solve(content, run, options, report)
    finally:
        clear_line(report)  # what is said of an interruption has a line of its own
    _tell(options, run, lines(solved), record, remarks)
    return int(solved.exit_code)


def _tell(
    options: argparse.Namespace,
    run: RunOptions,
    lines: Sequence[str],
    record: Mapping[str, Any],
    remarks: Sequence[str],
) -> None:
    """Remarks, the JSON object where it is asked for, what the study found in words, and its files."""
    with loading():
        from mbla.results.listing.text import sentence
        from mbla.results.record.json_values import json_line

    for remark in remarks:
        say(f"mbla: {remark}", 0)
    if options.json:
        print(json_line(dict(record)), flush=True)
    if not options.quiet:
        named = f"files: {', '.join(record['files'])} in {run.folder_for(options.deck)}/"
        text = [*lines, *(sentence(named) if record["files"] else [])]
        print("\n".join(text), file=sys.stderr if options.json else sys.stdout, flush=True)


def _progress(what: str) -> Callable[[int, int], None] | None:
    """A line that rewrites itself on a terminal, ``12 of 72 points``; nothing elsewhere."""
    if not sys.stderr.isatty():
        return None

    def show(done: int, count: int) -> None:
        rewrite_line(f"{done} of {count} {what}")

    return show
