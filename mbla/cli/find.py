"""``mbla find``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.given_decks import read_one_deck, run_options
from mbla.cli.options import add_analysis_options, add_quiet, points, relative_above_zero, target
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "find",
        help="the value of a parameter at which a load factor is a target, the structure just stands, or falls in time",
        description="Look for the value of a number of the deck at which a load factor is a target, or at which the "
        "dead load is just carried, between two bounds. Slopes of the associative load factor cost no further solve, "
        "so that 5 to 8 solves do; without dilatancy there are none, and 5 to 20 solves are needed. Of a structure in "
        "time it is the value at which a block falls, or its greatest displacement is a target, at some 10 solves. The "
        "question stands in the section find of the deck; options go before it. Where a stretch of values meets the "
        "target, both of its ends are found. Prints every value that was looked at; writes no files.",
        epilog="Exit status 0: found and verified; 4: the last answer is not verified, is a jump of the load factor or "
        "stands only by self-stress, or nothing was found and of some steps of --scan nothing is known; 5: no value "
        "between the bounds, as far as the steps show.",
    )
    command.set_defaults(action=find, about={"deck": "deck"}, output=None, force=False)
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--parameter", metavar="KEY.PATH", help="key path of a real number in the deck, as for --set")
    words = "load_factor=VALUE, least_load_factor=VALUE, stands; of a structure in time falls, peak=VALUE"
    command.add_argument("--target", type=target, metavar="WHAT", help=words)
    words = "least and greatest value, in the deck's units"
    command.add_argument("--bounds", nargs=2, type=float, metavar=("LOW", "HIGH"), help=words)
    command.add_argument("--case", metavar="NAME", help="the load case; needed if there are several")
    words = "equal steps between the bounds that are solved first"
    command.add_argument("--scan", type=points, metavar="N", help=words)
    words = "the first value alone, upwards from the lower bound: steps behind it are not solved"
    command.add_argument("--first", action="store_true", help=words)
    words = "error of the value, over the larger bound (default 1e-6; of a structure in time 1e-3)"
    command.add_argument("--tolerance", type=relative_above_zero, metavar="T", help=words)
    words = "change a value of the deck (repeatable)"
    command.add_argument("--set", action="append", default=[], metavar="KEY.PATH=VALUE", help=words)
    add_analysis_options(command)
    command.add_argument("--json", action="store_true", help="one JSON object on standard output, nothing else")
    add_quiet(command)


def find(options: argparse.Namespace) -> int:
    """Look for values; table and sentences go to standard output, with ``--json`` the object alone."""
    content = read_one_deck(options.deck, run_options(options))
    with loading():
        from mbla.results.record.json_values import json_line
        from mbla.sweeps.find.study import find as look
    found = look(content, options)
    if options.json:
        print(json_line(found.record), flush=True)
    elif not options.quiet:
        print("\n".join(found.lines), flush=True)
    return found.exit_code
