"""The commands of the program and their options; what they do is in :mod:`mbla.cli`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from itertools import takewhile
from typing import Any, NoReturn

from mbla import __version__
from mbla.cli.arguments_of_decks import add_check, add_run
from mbla.cli.arguments_of_results import add_diff, add_export, add_plot, add_report, add_result_commands
from mbla.cli.arguments_of_studies import add_interact, add_sweep, add_sweep_plot, add_tradeoff
from mbla.errors import UsageError

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


class _Parser(argparse.ArgumentParser):
    """Raises what is wrong, after the line that says how the command is used."""

    def error(self, message: str) -> NoReturn:
        self.print_usage(sys.stderr)
        command = self.prog.partition(" ")[2]
        raise UsageError("command-line", f"{command}: {message}" if command else message)


def wants_json(arguments: Sequence[str]) -> bool:
    """Whether ``--json``, which may be shortened, is among arguments that need not be right otherwise."""
    options = takewhile(lambda argument: argument != "--", arguments)
    return any(len(option) > len("--j") and "--json".startswith(option) for option in options)


def build_parser() -> argparse.ArgumentParser:
    """The commands and their options; ``command`` of the result is the name of the command."""
    parser = _Parser(
        prog="mbla",
        description="Limit analysis of masonry: load factor, mechanism and verified bounds of rigid-block assemblies.",
        epilog=EXIT_STATUS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"mbla {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")
    add_run(commands)
    add_check(commands)
    add_result_commands(commands)
    add_plot(commands)
    add_report(commands)
    add_export(commands)
    add_diff(commands)
    add_sweep(commands)
    add_sweep_plot(commands)
    add_interact(commands)
    add_tradeoff(commands)
    _add_explain(commands)
    _add_schema_and_new(commands)
    return parser


def _add_explain(commands: Any) -> None:
    command = commands.add_parser(
        "explain",
        help="what an identifier of a warning, a status or an error means, and what to do",
        description="Explain an identifier, such as near-misses, approximate or exit-4. A word or a whole message "
        "finds it too. Without ID: all identifiers, each in a line.",
    )
    command.add_argument("identifier", nargs="*", metavar="ID", help="identifier, word or message")
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def _add_schema_and_new(commands: Any) -> None:
    command = commands.add_parser("schema", help="print the JSON Schema of decks, or of sweep files")
    command.add_argument("kind", nargs="?", choices=["deck", "sweep"], default="deck")
    command = commands.add_parser("new", help="write a commented starter deck")
    command.add_argument("name", metavar="NAME")
    command.add_argument("--force", action="store_true", help="replace an existing file")
