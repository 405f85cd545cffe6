"""The command line: parse arguments, print, return the exit status; nothing else.

Commands on decks stand here, those on results in :mod:`mbla.cli.result_commands`, those that solve a deck many times in
``study_commands`` and ``sweep_commands``; beside these and ``terminal`` no module prints.
"""

from __future__ import annotations

import argparse
import json
import os
import shlex
import sys
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli import result_commands, study_commands, sweep_commands
from mbla.cli.arguments import build_parser, wants_json
from mbla.cli.given_deck import read_given_deck, refuse_unfit_name, run_options
from mbla.cli.streams import drop_output, prepare_streams
from mbla.cli.terminal import clear_line, rewrite_line, say
from mbla.errors import DeckError, FileError, MblaError, UsageError
from mbla.process.collector import loading
from mbla.process.memory_limit import refuse_too_low_limits
from mbla.process.threads import limit_threads
from mbla.results.failures import ENDINGS, StoppedRun, failure_record, lines_of, words_of
from mbla.run_options import RunOptions

if TYPE_CHECKING:
    from mbla.deck import Deck
    from mbla.results.results import Results
    from mbla.run import Progress

WORST_FIRST = (1, 6, 7, 3, 4, 5)
FIRST_OF_SIGNALS = 128
ABOUT = {
    "show": {"result": "result"},
    "verify": {"result": "result"},
    "diff": {"first": "first", "second": "second"},
    "sweep": {"sweep": "sweep"},
    "interact": {"deck": "deck"},
    "tradeoff": {"deck": "deck"},
}
"""commands with one JSON object for the whole: by its keys the arguments with the files that it is about"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the exit status is the return value (argparse exits by itself on --help and --version)."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    as_json, options = wants_json(given), argparse.Namespace()
    try:
        prepare_streams(json_lines=as_json)
        options = build_parser().parse_args(given)
        limit_threads(getattr(options, "threads", 1))
        _refuse_vanished_folder()
        refuse_too_low_limits()
        status = COMMANDS[options.command](options)
        sys.stdout.flush()
        return status
    except BrokenPipeError:  # the reader of our output went away: not our error, but the output is not whole
        drop_output()
        return FileError.exit_status
    except ENDINGS as error:
        if isinstance(error, OSError) and error.filename is None:
            drop_output()
        about = ABOUT.get(getattr(options, "command", ""), {})
        return failed(error, {key: getattr(options, name) for key, name in about.items()}, as_json)


# --- commands on decks --------------------------------------------------------------------------------------------


def _run(options: argparse.Namespace) -> int:
    run = run_options(options)
    progress = None if options.quiet else _progress()

    def one(deck: Path) -> int:
        content, seconds = read_given_deck(deck, run)
        with loading():
            from mbla.run import run_and_write

        try:
            results = run_and_write(content, run, progress, time.perf_counter() - seconds)
        except StoppedRun as run_stopped:
            clear_line(progress)
            failed(run_stopped.cause, {}, as_json=False)
            _tell(options, content, run_stopped.results, failure_record(run_stopped.cause, {"deck": deck}))
            return run_stopped.results.exit_code
        clear_line(progress)
        _tell(options, content, results, {}, f"  files: {run.folder_for(deck)}/")
        return results.exit_code

    _refuse_shared_folder(options.decks, run)
    return _each_deck(options, one, progress)


def _tell(options: argparse.Namespace, deck: Deck, results: Results, failure: dict[str, Any], *files: str) -> None:
    """The results of a deck as they are wanted; of a stopped run with what stopped it."""
    with loading():
        from mbla.results.listing.listing import listing
        from mbla.results.listing.summary import summary_lines
        from mbla.results.records.json_record import json_line, results_json

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


def _check(options: argparse.Namespace) -> int:
    run = run_options(options)

    def one(deck: Path) -> int:
        content, seconds = read_given_deck(deck, run)
        with loading():
            from mbla.cli.check import check
            from mbla.results.listing.listing import check_listing
            from mbla.results.records.json_record import check_json, json_line

        results, needs = check(content, run, options.vtu, time.perf_counter() - seconds)
        text = json_line(check_json(results, needs)) + "\n" if options.json else check_listing(results, needs)
        print(text, end="", flush=True)
        if options.vtu:
            files = run.folder_for(deck) / f"{deck.stem}_check_*.vtu"
            print(f"  files: {files}", file=sys.stderr if options.json else sys.stdout, flush=True)
        return 0

    return _each_deck(options, one, None)


def _schema(options: argparse.Namespace) -> int:
    with loading():
        if options.kind == "sweep":
            from mbla.sweeps.file.schema import sweep_schema as schema
        else:
            from mbla.deck.schema import deck_schema as schema

    print(json.dumps(schema(), indent=2))
    return 0


def _new(options: argparse.Namespace) -> int:
    with loading():
        from mbla.cli.starter import write_starter

    path = write_starter(options.name, replace=options.force)
    print(f"{path} written; run it with: mbla run {shlex.quote(str(path))}")
    return 0


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "run": _run,
    "check": _check,
    "show": result_commands.show,
    "verify": result_commands.verify,
    "plot": result_commands.plot,
    "report": result_commands.report,
    "export": result_commands.export,
    "diff": result_commands.diff,
    "explain": result_commands.explain,
    "sweep": sweep_commands.sweep,
    "interact": study_commands.interact,
    "tradeoff": study_commands.tradeoff,
    "sweep-plot": result_commands.sweep_plot,
    "schema": _schema,
    "new": _new,
}


# --- what the commands share --------------------------------------------------------------------------------------


def _refuse_shared_folder(decks: Sequence[Path], options: RunOptions) -> None:
    """Two decks of one name would write the same files."""
    targets = [(options.folder_for(deck).resolve(), deck.stem) for deck in decks if deck.name]
    if len(set(targets)) < len(targets):
        raise UsageError(
            "same-result-files",
            "two of the decks would write the same result files: give them different names or folders",
        )


def _each_deck(options: argparse.Namespace, one: Callable[[Path], int], progress: Progress | None) -> int:
    """Run one deck after the other; a deck that fails does not stop the next, a signal does."""
    codes = []
    for deck in options.decks:
        try:
            refuse_unfit_name(deck)
            codes.append(one(deck))
        except BrokenPipeError:
            raise
        except ENDINGS as error:
            clear_line(progress)
            codes.append(failed(error, {"deck": deck}, options.json))
        if codes[-1] >= FIRST_OF_SIGNALS:
            return codes[-1]
    return next((code for code in WORST_FIRST if code in codes), codes[0] if len(set(codes)) == 1 else max(codes))


def failed(error: BaseException, about: Mapping[str, Path], as_json: bool) -> int:
    """Say what went wrong in one line per fault, and as a JSON object where that is wanted; the exit status."""
    status, _ = words_of(error)
    text = "\n".join(lines_of(error))
    if status == MblaError.exit_status and os.environ.get("MBLA_TRACEBACK"):
        traceback.print_exception(error)
    if as_json:
        print(json.dumps(failure_record(error, about)), flush=True)
    return say(text if isinstance(error, DeckError) else f"mbla: {text}", status)


def _refuse_vanished_folder() -> None:
    try:
        Path.cwd()
    except OSError:
        raise FileError("current-folder-gone", "the current folder does not exist any more") from None


def _progress() -> Progress | None:
    """A line that rewrites itself on a terminal; nothing elsewhere."""
    if not sys.stderr.isatty():
        return None

    def show(case: str, record: Any) -> None:
        text = f"{case}: program {record.program}, iteration {record.iteration}, load factor {record.load_factor:.6g}"
        rewrite_line(text)

    return show
