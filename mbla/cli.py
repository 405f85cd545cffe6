"""The command line: parse arguments, print, return the exit status; nothing else.

Commands on decks stand here, those on results in :mod:`mbla.result_commands`; no other module prints.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shlex
import signal
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any, NoReturn

from mbla import result_commands, sweep_commands
from mbla.arguments import build_parser
from mbla.collector import loading, no_collection
from mbla.errors import DeckError, FileError, MblaError, UsageError
from mbla.failures import failure_record, words_of
from mbla.run_options import RunOptions
from mbla.streams import drop_output, prepare_streams
from mbla.threads import limit_threads

if TYPE_CHECKING:
    from mbla.deck import Deck
    from mbla.run_deck import Progress

WORST_FIRST = (1, 6, 7, 3, 4, 5)


class Terminated(BaseException):
    """SIGTERM arrived."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the exit status is the return value (argparse exits by itself on --help and wrong usage)."""
    options = build_parser().parse_args(arguments)
    limit_threads(getattr(options, "threads", 1))
    if signal.getsignal(signal.SIGTERM) is not signal.SIG_IGN:
        signal.signal(signal.SIGTERM, _terminate)
    try:
        prepare_streams(json_lines=getattr(options, "json", False))
        _refuse_vanished_folder()
        status = COMMANDS[options.command](options)
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return _say("interrupted", 130)
    except Terminated:
        return _say("terminated", 143)
    except BrokenPipeError:  # the reader of our output went away: not our error, but the output is not whole
        drop_output()
        return FileError.exit_status
    except Exception as error:
        if isinstance(error, OSError) and error.filename is None:
            drop_output()
        return _failed(error)


# --- commands on decks --------------------------------------------------------------------------------------------


def _run(options: argparse.Namespace) -> int:
    run_options = _run_options(options)
    progress = None if options.quiet else _progress()

    def one(deck: Path) -> int:
        content, seconds = _read(deck, run_options)
        with loading():
            from mbla.results.records.json_record import json_line, results_json
            from mbla.results.words.listing import listing
            from mbla.results.words.summary import summary_lines
            from mbla.run_deck import run_and_write

        results = run_and_write(content, run_options, progress, time.perf_counter() - seconds)
        _clear_progress(progress)
        if options.json:
            print(json_line(results_json(results)), flush=True)
        words = sys.stderr if options.json else sys.stdout
        if options.verbose:
            print(listing(results), end="", file=words, flush=True)
        elif not options.quiet:
            lines = [*summary_lines(results), f"  files: {run_options.folder_for(deck)}/"]
            print("\n".join(lines), file=words, flush=True)
        return results.exit_code

    _refuse_shared_folder(options.decks, run_options)
    return _each_deck(options, one, progress)


def _check(options: argparse.Namespace) -> int:
    run_options = _run_options(options)

    def one(deck: Path) -> int:
        content, seconds = _read(deck, run_options)
        from mbla.check import check
        from mbla.results.records.json_record import check_json, json_line
        from mbla.results.words.listing import check_listing

        results, needs = check(content, run_options, options.vtu, time.perf_counter() - seconds)
        text = json_line(check_json(results, needs)) + "\n" if options.json else check_listing(results, needs)
        print(text, end="", flush=True)
        if options.vtu:
            files = run_options.folder_for(deck) / f"{deck.stem}_check_*.vtu"
            print(f"  files: {files}", file=sys.stderr if options.json else sys.stdout, flush=True)
        return 0

    return _each_deck(options, one, None)


def _interact(options: argparse.Namespace) -> int:
    """Solve the points of a diagram; the table goes to standard output, with ``--json`` the object alone."""
    _refuse_unfit_name(options.deck)
    run_options = _run_options(options)
    content, _ = _read(options.deck, run_options)
    from mbla.results.records.json_record import json_line
    from mbla.results.words.text import sentence
    from mbla.studies.interact.command import interact
    from mbla.studies.interact.words import study_lines

    report = None if options.quiet else _point_progress()
    try:
        study, record, remarks = interact(content, run_options, options, report)
    finally:
        _clear_progress(report)
    for remark in remarks:
        _say(f"mbla: {remark}", 0)
    if options.json:
        print(json_line(record), flush=True)
    if not options.quiet:
        lines = study_lines(study)
        if record["files"]:
            lines += sentence(f"files: {', '.join(record['files'])} in {run_options.folder_for(options.deck)}/")
        print("\n".join(lines), file=sys.stderr if options.json else sys.stdout, flush=True)
    return study.exit_code


def _tradeoff(options: argparse.Namespace) -> int:
    """Measure a deck under many settings; the table goes to standard output, with ``--json`` the object alone."""
    _refuse_unfit_name(options.deck)
    run_options = _run_options(options, override=False)
    content, _ = _read(options.deck, run_options)
    from mbla.results.records.json_record import json_line
    from mbla.results.words.text import sentence
    from mbla.studies.tradeoff.command import tradeoff
    from mbla.studies.tradeoff.words import study_lines

    report = None if options.quiet else _rung_progress()
    try:
        study, record, remarks = tradeoff(content, run_options, options, report)
    finally:
        _clear_progress(report)  # what is said of an interruption has a line of its own
    for remark in remarks:
        _say(f"mbla: {remark}", 0)
    if options.json:
        print(json_line(record), flush=True)
    if not options.quiet:
        lines = study_lines(study)
        if record["files"]:
            lines += sentence(f"files: {', '.join(record['files'])} in {run_options.folder_for(options.deck)}/")
        print("\n".join(lines), file=sys.stderr if options.json else sys.stdout, flush=True)
    return study.exit_code


def _schema(options: argparse.Namespace) -> int:
    if options.kind == "sweep":
        from mbla.studies.sweep.file.schema import sweep_schema as schema
    else:
        from mbla.deck.schema import deck_schema as schema

    print(json.dumps(schema(), indent=2))
    return 0


def _new(options: argparse.Namespace) -> int:
    from mbla.starter import write_starter

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
    "interact": _interact,
    "tradeoff": _tradeoff,
    "sweep-plot": result_commands.sweep_plot,
    "schema": _schema,
    "new": _new,
}


# --- what the commands share --------------------------------------------------------------------------------------


def _read(path: Path, options: RunOptions) -> tuple[Deck, float]:
    """The deck, and the seconds it took; a faulty one is told before anything heavy is imported."""
    with no_collection():
        from mbla.deck import read_deck

    started = time.perf_counter()
    return read_deck(path, options.overrides), time.perf_counter() - started


def _run_options(options: argparse.Namespace, *, override: bool = True) -> RunOptions:
    """Options of a run; those that stand for values of the deck become overrides unless the command means others."""
    overrides = list(options.set)
    for name in ("accuracy", "flow_rule", "time_limit") if override else ():
        value = getattr(options, name, None)
        if value is not None:
            overrides.append(f"analysis.{name}={value}")
    return RunOptions(
        folder=options.output,
        overrides=tuple(overrides),
        cases=_cases(options),
        force=options.force,
        threads=getattr(options, "threads", 1),
        expected=getattr(options, "expected", False),
    )


def _cases(options: argparse.Namespace) -> tuple[str, ...]:
    """Names of ``--case``, which some commands take once."""
    given = getattr(options, "case", None) or ()
    return (given,) if isinstance(given, str) else tuple(given)


def _refuse_shared_folder(decks: Sequence[Path], options: RunOptions) -> None:
    """Two decks of one name would write the same files."""
    targets = [(options.folder_for(deck).resolve(), deck.stem) for deck in decks if deck.name]
    if len(set(targets)) < len(targets):
        raise UsageError("two of the decks would write the same result files: give them different names or folders")


def _refuse_unfit_name(deck: Path) -> None:
    """A name that no result file can have, or that no text can hold."""
    if not deck.name or deck.is_dir():
        raise FileError(f"{deck}: is a folder, not a deck")
    try:
        str(deck.absolute()).encode("utf-8")
    except UnicodeEncodeError:
        raise FileError(f"{deck}: the path is not UTF-8, results cannot name it; rename it") from None


def _each_deck(options: argparse.Namespace, one: Callable[[Path], int], progress: Progress | None) -> int:
    """Run one deck after the other; a deck that fails does not stop the next."""
    codes = []
    for deck in options.decks:
        try:
            _refuse_unfit_name(deck)
            codes.append(one(deck))
        except BrokenPipeError:
            raise
        except Exception as error:
            _clear_progress(progress)
            codes.append(_failed(error))
            if options.json:
                print(json.dumps(failure_record(deck, error, codes[-1])), flush=True)
    return next((code for code in WORST_FIRST if code in codes), codes[0] if len(set(codes)) == 1 else max(codes))


def _failed(error: Exception) -> int:
    """Say what went wrong in one line per fault; the exit status."""
    status, text = words_of(error)
    if status == MblaError.exit_status and os.environ.get("MBLA_TRACEBACK"):
        traceback.print_exception(error)
    return _say(text if isinstance(error, DeckError) else f"mbla: {text}", status)


def _say(text: str, status: int) -> int:
    with contextlib.suppress(OSError):  # nobody listens; the exit status still tells
        print(text, file=sys.stderr, flush=True)
    return status


def _refuse_vanished_folder() -> None:
    try:
        Path.cwd()
    except OSError:
        raise FileError("the current folder does not exist any more") from None


def _terminate(number: int, frame: FrameType | None) -> NoReturn:
    raise Terminated


def _progress() -> Progress | None:
    """A line that rewrites itself on a terminal; nothing elsewhere."""
    if not sys.stderr.isatty():
        return None

    def show(case: str, record: Any) -> None:
        text = f"{case}: program {record.program}, iteration {record.iteration}, load factor {record.load_factor:.6g}"
        print(f"\r{text[:78]:<78}", end="", file=sys.stderr, flush=True)

    return show


def _rung_progress() -> Callable[[int, int, str, str], None] | None:
    """The same for the settings of a study."""
    if not sys.stderr.isatty():
        return None

    def show(number: int, count: int, name: str, case: str) -> None:
        text = f"setting {number} of {count}: {name}" + (f", {case} done" if case else "")
        print(f"\r{text[:78]:<78}", end="", file=sys.stderr, flush=True)

    return show


def _point_progress() -> Callable[[int, int], None] | None:
    """The same for the points of a diagram."""
    if not sys.stderr.isatty():
        return None

    def show(done: int, count: int) -> None:
        print(f"\r{f'{done} of {count} points':<78}", end="", file=sys.stderr, flush=True)

    return show


def _clear_progress(progress: Callable[..., None] | None) -> None:
    if progress is not None:
        print(f"\r{'':<78}\r", end="", file=sys.stderr, flush=True)
