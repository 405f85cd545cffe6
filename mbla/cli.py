"""The command line: parse arguments, print, return the exit status; nothing else."""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any, NoReturn

from mbla import __version__
from mbla.errors import DeckError, FileError, LimitError, MblaError, UsageError

if TYPE_CHECKING:
    from mbla.run import Progress, RunOptions

EXIT_STATUS = """\
exit status:
  0  every case solved and verified        5  valid, but there is no load factor (dead load not carried,
  1  internal error                           or the live load never brings collapse)
  2  wrong usage                           6  file input or output
  3  deck invalid                          7  time or memory limit
  4  a case not solved or not verified     130, 143  interrupted, terminated
"""

WORST_FIRST = (1, 6, 7, 3, 4, 5)


class Terminated(BaseException):
    """SIGTERM arrived."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the exit status is the return value (argparse exits by itself on --help and wrong usage)."""
    options = build_parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, _terminate)
    try:
        status = int(options.command(options))
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return _say("interrupted", 130)
    except Terminated:
        return _say("terminated", 143)
    except BrokenPipeError:  # the reader of our output went away: not our error, but the output is not whole
        sys.stdout = Path(os.devnull).open("w")  # noqa: SIM115 - for the interpreter's own flush at exit
        return 6
    except Exception as error:
        return _failed(error, options)


def build_parser() -> argparse.ArgumentParser:
    """The commands and their options."""
    parser = argparse.ArgumentParser(
        prog="mbla",
        description="Limit analysis of masonry: load factor, mechanism and verified bounds of rigid-block assemblies.",
        epilog=EXIT_STATUS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"mbla {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _add_run(commands)
    _add_check(commands)
    _add_result_commands(commands)
    _add_plot(commands)
    _add_schema_and_new(commands)
    return parser


def _add_run(commands: Any) -> None:
    command = commands.add_parser("run", help="solve every load case of decks and write the results")
    command.set_defaults(command=_run)
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    _add_deck_options(command)
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    command.add_argument("--accuracy", choices=["draft", "standard", "reference"], help="instead of analysis.accuracy")
    command.add_argument(
        "--flow-rule", choices=["associative", "non_associative", "dilatancy"], help="instead of analysis.flow_rule"
    )
    command.add_argument("--time-limit", type=_seconds, metavar="S", help="instead of analysis.time_limit")
    command.add_argument(
        "--threads", type=_threads, default=1, metavar="N", help="threads of the cone solver (default 1)"
    )
    command.add_argument("--expected", action="store_true", help="compare with the deck's expected section")
    volume = command.add_mutually_exclusive_group()
    volume.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")
    volume.add_argument("-v", "--verbose", action="store_true", help="print the listing too")


def _add_check(commands: Any) -> None:
    command = commands.add_parser("check", help="read, build, find contacts, say what the model is; solve nothing")
    command.set_defaults(command=_check)
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    _add_deck_options(command)
    command.add_argument("--vtu", action="store_true", help="write blocks and interfaces for ParaView")


def _add_deck_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder of the results (default DECK.out)")
    command.add_argument(
        "--set", action="append", default=[], metavar="KEY.PATH=VALUE", help="change a value of the deck"
    )
    command.add_argument("--force", action="store_true", help="replace an earlier result")
    command.add_argument(
        "--json", action="store_true", help="one JSON object per deck on standard output, nothing else"
    )


def _add_result_commands(commands: Any) -> None:
    for name, action, text in (
        ("show", _show, "print the listing of a result file"),
        ("verify", _verify, "recompute residuals and bounds from a result file alone, with no solver"),
    ):
        command = commands.add_parser(name, help=text)
        command.set_defaults(command=action)
        command.add_argument("result", type=Path, metavar="RESULT.h5")
        command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def _add_plot(commands: Any) -> None:
    command = commands.add_parser("plot", help="picture of the mechanism of each load case (extra mbla[pictures])")
    command.set_defaults(command=_plot)
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("-o", "--output", type=Path, metavar="FILE|DIR", help="PNG file (one case) or folder")
    command.add_argument("--case", metavar="NAME", help="only this load case")


def _add_schema_and_new(commands: Any) -> None:
    command = commands.add_parser("schema", help="print the JSON Schema of decks")
    command.set_defaults(command=_schema)
    command.add_argument("kind", nargs="?", choices=["deck"], default="deck")
    command = commands.add_parser("new", help="write a commented starter deck")
    command.set_defaults(command=_new)
    command.add_argument("name", metavar="NAME")
    command.add_argument("--force", action="store_true", help="replace an existing file")


# --- commands -----------------------------------------------------------------------------------------------------


def _run(options: argparse.Namespace) -> int:
    from mbla.results.json_record import json_line, results_json
    from mbla.results.listing import listing
    from mbla.results.summary import summary_lines
    from mbla.run import run

    run_options = _run_options(options)
    progress = None if options.quiet else _progress()

    def one(deck: Path) -> int:
        results = run(deck, run_options, progress)
        _clear_progress(progress)
        if options.json:
            print(json_line(results_json(results)))
        elif options.verbose:
            print(listing(results), end="")
        if not options.quiet and not options.verbose:
            target = sys.stderr if options.json else sys.stdout
            print("\n".join([*summary_lines(results), f"  files: {run_options.folder_for(deck)}/"]), file=target)
        return results.exit_code

    _refuse_shared_folder(options.decks, run_options)
    return _each_deck(options, one, progress)


def _check(options: argparse.Namespace) -> int:
    from mbla.check import check
    from mbla.results.json_record import check_json, json_line
    from mbla.results.listing import check_listing

    run_options = _run_options(options)

    def one(deck: Path) -> int:
        results, needs = check(deck, run_options, options.vtu)
        print(json_line(check_json(results, needs)) if options.json else check_listing(results, needs), end="")
        if options.json:
            print()
        return 0

    return _each_deck(options, one, None)


def _show(options: argparse.Namespace) -> int:
    from mbla.results.hdf5 import read_results_hdf5
    from mbla.results.json_record import json_line, results_json
    from mbla.results.listing import listing

    results = read_results_hdf5(options.result)
    print(json_line(results_json(results)) + "\n" if options.json else listing(results), end="")
    return 0


def _verify(options: argparse.Namespace) -> int:
    from mbla.results.hdf5 import read_results_hdf5
    from mbla.results.json_record import json_line, verification_json
    from mbla.results.listing import verification_lines
    from mbla.verify_file import verify_results

    results, agreed = verify_results(read_results_hdf5(options.result))
    if options.json:
        print(json_line(verification_json(results, agreed)))
    else:
        print("\n".join(verification_lines(results, agreed)))
    return results.exit_code


def _plot(options: argparse.Namespace) -> int:
    from mbla.results.hdf5 import read_results_hdf5
    from mbla.results.pictures import plot_results

    results = read_results_hdf5(options.result)
    target = options.output or options.result.parent
    for path in plot_results(results, target, options.result.stem, options.case):
        print(path)
    return 0


def _schema(options: argparse.Namespace) -> int:
    from mbla.deck.schema import deck_schema

    print(json.dumps(deck_schema(), indent=2))
    return 0


def _new(options: argparse.Namespace) -> int:
    path = Path(options.name if options.name.endswith((".yaml", ".yml")) else f"{options.name}.yaml")
    starter = (Path(__file__).parent / "starter.yaml").read_text(encoding="utf-8")
    text = starter.replace("NAME.yaml", path.name).replace("NAME.out", f"{path.stem}.out")
    try:
        with path.open("w" if options.force else "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise FileError(f"{path}: exists already; --force replaces it") from None
    except OSError as error:
        raise FileError(f"{path}: {error.strerror or error}") from error
    print(f"{path} written; run it with: mbla run {path}")
    return 0


# --- what the commands share --------------------------------------------------------------------------------------


def _run_options(options: argparse.Namespace) -> RunOptions:
    from mbla.run import RunOptions

    overrides = list(options.set)
    for name in ("accuracy", "flow_rule", "time_limit"):
        value = getattr(options, name, None)
        if value is not None:
            overrides.append(f"analysis.{name}={value}")
    return RunOptions(
        folder=options.output,
        overrides=tuple(overrides),
        cases=tuple(getattr(options, "case", ())),
        force=options.force,
        threads=getattr(options, "threads", 1),
        expected=getattr(options, "expected", False),
    )


def _refuse_shared_folder(decks: Sequence[Path], options: RunOptions) -> None:
    """Two decks of one name would write the same files."""
    targets = [(options.folder_for(deck).resolve(), deck.stem) for deck in decks]
    if len(set(targets)) < len(targets):
        raise UsageError("two of the decks would write the same result files: give them different names or folders")


def _each_deck(options: argparse.Namespace, one: Callable[[Path], int], progress: Progress | None) -> int:
    """Run one deck after the other; a deck that fails does not stop the next."""
    codes = []
    for deck in options.decks:
        try:
            codes.append(one(deck))
        except Exception as error:
            _clear_progress(progress)
            codes.append(_failed(error, options))
            if options.json:
                print(json.dumps(_failure_record(deck, error, codes[-1])))
    return next((code for code in WORST_FIRST if code in codes), codes[0] if len(set(codes)) == 1 else max(codes))


def _failure_record(deck: Path, error: Exception, code: int) -> dict[str, Any]:
    messages = [str(fault) for fault in error.faults] if isinstance(error, DeckError) else [str(error)]
    return {"mbla": __version__, "deck": deck.name, "exit_code": code, "errors": messages}


def _failed(error: Exception, options: argparse.Namespace) -> int:
    """Say what went wrong in one line per fault; the exit status."""
    if isinstance(error, MblaError):
        status = error.exit_status
        text = str(error) if isinstance(error, DeckError) else f"mbla: {error}"
    elif isinstance(error, MemoryError):
        status, text = LimitError.exit_status, "mbla: out of memory"
    elif isinstance(error, OSError):
        name = f"{error.filename}: " if error.filename else ""
        status, text = FileError.exit_status, f"mbla: {name}{error.strerror or error}"
    else:
        status, text = 1, f"mbla: internal error, please report it with the deck: {type(error).__name__}: {error}"
        if getattr(options, "verbose", False):
            raise error
    return _say(text, status)


def _say(text: str, status: int) -> int:
    print(text, file=sys.stderr)
    return status


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


def _clear_progress(progress: Progress | None) -> None:
    if progress is not None:
        print(f"\r{'':<78}\r", end="", file=sys.stderr, flush=True)


def _seconds(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError("must be a positive number of seconds")
    return value


def _threads(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return value
