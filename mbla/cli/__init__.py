"""The command line: parse arguments, print, return the exit status; nothing else.

Each command has its options and its action in one module of this folder; no other modules print.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path
from typing import Any, NoReturn

from mbla import __version__
from mbla.cli import (
    assess,
    check,
    diff,
    explain,
    export,
    find,
    interact,
    new,
    plot,
    report,
    run,
    schema,
    show,
    strengthen,
    sweep,
    sweep_plot,
    tradeoff,
    verify,
)
from mbla.cli.terminal import drop_output, prepare_streams
from mbla.cli.terminal import failed as failed
from mbla.errors import FileError, UsageError
from mbla.process.limits import limit_threads, refuse_too_low_limits, without_plugins
from mbla.results.failures import ENDINGS

COMMANDS = (
    *(run, check, show, verify, assess, plot, report, export, diff),
    *(sweep, sweep_plot, interact, tradeoff, find, strengthen, explain, schema, new),
)
"""A module each, in the order of the help"""

EXIT_STATUS = """\
exit status:
  0  every case solved and verified        5  valid, but there is no load factor (dead load not carried,
  1  internal error                           or the live load never brings collapse)
  2  wrong usage                           6  file input or output
  3  deck or sweep file invalid            7  time or memory limit
  4  a case not solved or not verified     8  sweep finished with failed points
                                           130, 143  interrupted, terminated

MBLA_TRACEBACK=1 in the environment shows where an internal error arose.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the exit status is the return value (argparse exits by itself on --help and --version)."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    as_json, options = wants_json(given), argparse.Namespace()
    try:
        without_plugins()
        prepare_streams(json_lines=as_json)
        options = build_parser().parse_args(given)
        limit_threads(getattr(options, "threads", 1))
        _refuse_vanished_folder()
        refuse_too_low_limits()
        status: int = options.action(options)
        sys.stdout.flush()
        return status
    except BrokenPipeError:  # the reader of our output went away: not our error, but the output is incomplete
        drop_output()
        return FileError.exit_status
    except ENDINGS as error:
        if isinstance(error, OSError) and error.filename is None:
            drop_output()
        about = getattr(options, "about", {})
        return failed(error, {key: getattr(options, name) for key, name in about.items()}, as_json)


def _refuse_vanished_folder() -> None:
    try:
        Path.cwd()
    except OSError:
        raise FileError("current-folder-gone", "the current folder does not exist any more") from None


class _Parser(argparse.ArgumentParser):
    """Raises what is wrong, after the line that says how the command is used."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:
        """Options; raises UsageError for an unknown one, of a command after the usage of that command."""
        options, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return options, unknown

    def error(self, message: str) -> NoReturn:
        """Raises UsageError, after the line that says how the command is used."""
        self.print_usage(sys.stderr)
        command = self.prog.partition(" ")[2]
        raise UsageError("command-line", f"{command and command + ': '}{message}; see {self.prog} --help")


def wants_json(arguments: Sequence[str]) -> bool:
    """Whether ``--json``, which may be shortened, is among arguments that need not be right otherwise."""
    options = takewhile(lambda argument: argument != "--", arguments)
    return any(len(option) > len("--j") and "--json".startswith(option) for option in options)


def build_parser() -> argparse.ArgumentParser:
    """The commands and their options."""
    parser = _Parser(
        prog="mbla",
        description="Limit analysis of masonry: load factor, mechanism and verified bounds of rigid-block assemblies.",
        epilog=EXIT_STATUS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"mbla {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")
    for command in COMMANDS:
        command.add(commands)
    return parser
