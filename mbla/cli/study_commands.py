"""The commands that solve a deck many times: call what does the work, print, return the exit status; nothing else.

They print as ``cli`` does, which calls them and says what went wrong; sweeps are in ``sweep_commands``.
Everything of a command is imported when it is called, so that the program starts at once.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from mbla.cli.given_deck import read_given_deck, refuse_unfit_name, run_options
from mbla.cli.terminal import clear_line, rewrite_line, say
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.run_options import RunOptions


def interact(options: argparse.Namespace) -> int:
    """Solve the points of a diagram; the table goes to standard output, with ``--json`` the object alone."""
    refuse_unfit_name(options.deck)
    run = run_options(options)
    content, _ = read_given_deck(options.deck, run)
    with loading():
        from mbla.sweeps.interaction.command import interact
        from mbla.sweeps.interaction.words import study_lines

    report = None if options.quiet else _point_progress()
    try:
        study, record, remarks = interact(content, run, options, report)
    finally:
        clear_line(report)
    _tell(options, run, study_lines(study), record, remarks)
    return study.exit_code


def tradeoff(options: argparse.Namespace) -> int:
    """Measure a deck under many settings; the table goes to standard output, with ``--json`` the object alone."""
    refuse_unfit_name(options.deck)
    run = run_options(options, override=False)
    content, _ = read_given_deck(options.deck, run)
    with loading():
        from mbla.sweeps.tradeoff.command import tradeoff
        from mbla.sweeps.tradeoff.words import study_lines

    report = None if options.quiet else _rung_progress()
    try:
        study, record, remarks = tradeoff(content, run, options, report)
    finally:
        clear_line(report)  # what is said of an interruption has a line of its own
    _tell(options, run, study_lines(study), record, remarks)
    return study.exit_code


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
        from mbla.results.records.json_record import json_line

    for remark in remarks:
        say(f"mbla: {remark}", 0)
    if options.json:
        print(json_line(dict(record)), flush=True)
    if not options.quiet:
        named = f"files: {', '.join(record['files'])} in {run.folder_for(options.deck)}/"
        text = [*lines, *(sentence(named) if record["files"] else [])]
        print("\n".join(text), file=sys.stderr if options.json else sys.stdout, flush=True)


def _point_progress() -> Callable[[int, int], None] | None:
    """A line that rewrites itself on a terminal, for the points of a diagram; nothing elsewhere."""
    if not sys.stderr.isatty():
        return None

    def show(done: int, count: int) -> None:
        rewrite_line(f"{done} of {count} points")

    return show


def _rung_progress() -> Callable[[int, int, str, str], None] | None:
    """A line that rewrites itself on a terminal, for the settings of a study."""
    if not sys.stderr.isatty():
        return None

    def show(number: int, count: int, name: str, case: str) -> None:
        text = f"setting {number} of {count}: {name}" + (f", {case} done" if case else "")
        rewrite_line(text)

    return show
