"""``mbla run``."""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.given_decks import each_deck, read_given_deck, run_options
from mbla.cli.options import add_analysis_options, add_deck_options, add_quiet, seconds, threads
from mbla.cli.terminal import clear_line, failed, rewrite_line, say
from mbla.errors import UsageError
from mbla.process.collector import loading
from mbla.process.run_options import RunOptions
from mbla.results.failures import StoppedRun, failure_record

if TYPE_CHECKING:
    from mbla.deck import Deck
    from mbla.results.results import Results
    from mbla.run import Progress


CELLS = 24
"""of the bar of a structure in time"""
BETWEEN = 0.1
"""seconds between two states of it"""


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser("run", help="solve every load case of decks and write the results")
    command.set_defaults(action=run)
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    add_deck_options(command)
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    add_analysis_options(command)
    words = "seconds for all load cases, instead of analysis.time_limit"
    command.add_argument("--time-limit", type=seconds, metavar="S", help=words)
    words = "threads of the linear algebra libraries, at most (default 1); factorisations are serial"
    command.add_argument("--threads", type=threads, default=1, metavar="N", help=words)
    command.add_argument("--expected", action="store_true", help="compare with the deck's expected section")
    words = "go on from what a run of the deck that was stopped has left: load cases that were done, a time history"
    command.add_argument("--resume", action="store_true", help=words)
    volume = command.add_mutually_exclusive_group()
    add_quiet(volume)
    volume.add_argument("-v", "--verbose", action="store_true", help="print the listing instead of the summary")


def run(options: argparse.Namespace) -> int:
    """Solve decks one after the other; what is found goes to standard output, with ``--json`` an object per deck."""
    chosen = run_options(options)
    progress = None if options.quiet else _progress()

    def one(deck: Path) -> int:
        content, took = read_given_deck(deck, chosen)
        with loading():
            from mbla.run import run_and_write

        try:
            results = run_and_write(content, chosen, progress, time.perf_counter() - took)
        except StoppedRun as run_stopped:
            clear_line(progress)
            failed(run_stopped.cause, {}, as_json=False)
            _tell(options, content, run_stopped.results, failure_record(run_stopped.cause, {"deck": deck}))
            return run_stopped.results.exit_code
        clear_line(progress)
        _tell(options, content, results, {}, f"  files: {chosen.folder_for(deck)}/")
        return results.exit_code

    _refuse_shared_folder(options.decks, chosen)
    return each_deck(options, one, progress)


def _tell(options: argparse.Namespace, deck: Deck, results: Results, failure: dict[str, Any], *files: str) -> None:
    """The results of a deck as they are wanted; of a stopped run with what stopped it."""
    with loading():
        from mbla.results.listing.listing import listing
        from mbla.results.listing.summary import summary_lines
        from mbla.results.record.json_record import results_json
        from mbla.results.record.json_values import json_line

    record = json_line(results_json(results) | failure) if options.json else ""
    words = ""
    if options.verbose:
        words = listing(results, every_position=deck.content.output.positions == "all")
    elif not options.quiet:
        words = "\n".join([*summary_lines(results), *files, ""])
    if options.json:
        print(record, flush=True)
    print(words, end="", file=sys.stderr if options.json else sys.stdout, flush=True)
    if options.threads > 1 and not options.quiet:
        say(f"mbla: threads: {results.settings['threads']}", 0)


def _refuse_shared_folder(decks: Sequence[Path], options: RunOptions) -> None:
    """Two decks of one name would write the same files."""
    targets = [(options.folder_for(deck).resolve(), deck.stem) for deck in decks if deck.name]
    if len(set(targets)) < len(targets):
        words = "two of the decks would write the same result files: give them different names or folders"
        raise UsageError("same-result-files", words)


def _progress() -> Progress | None:
    """A line that rewrites itself on a terminal; nothing elsewhere."""
    if not sys.stderr.isatty():
        return None
    shown, first = [0.0], dict[tuple[str, bool], Any]()

    def show(case: str, record: Any) -> None:
        if hasattr(record, "program"):
            text = f"{case}: program {record.program}, iteration {record.iteration}"
            rewrite_line(f"{text}, load factor {record.load_factor:.6g}")
            return
        begun = first.setdefault((case, record.half), record)
        if time.monotonic() - shown[0] >= BETWEEN or record.share >= 1.0:
            shown[0] = time.monotonic()
            rewrite_line(in_time(case, record, begun))

    return show


def in_time(case: str, record: Any, first: Any) -> str:
    """``quake: [########..............]  36 %, 9.1 of 25 s, 1 min 20 s to go``.

    first : step of the same, from which speed counts
    """
    done = round(CELLS * min(record.share, 1.0))
    half, to_go = ", half of the step" if record.half else "", record.to_go(first)
    words = f"{case}{half}: [{'#' * done}{'.' * (CELLS - done)}] {100.0 * record.share:3.0f} %"
    words += f", {record.time:.3g} of {record.duration:g} s"
    words += "" if math.isnan(to_go) else f", {_lasting(to_go)} to go"
    return words + (f", {record.missed} steps missed" if record.missed else "")


def _lasting(seconds: float) -> str:
    """``41 s``, ``3 min 20 s``, ``2 h 5 min``."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    return f"{whole // 60} min {whole % 60} s" if whole < 3600 else f"{whole // 3600} h {whole // 60 % 60} min"
