"""``mbla tradeoff``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.given_decks import read_one_deck, run_options
from mbla.cli.options import add_deck_options, add_quiet, relative_above_zero, seconds, threads
from mbla.cli.sweep_progress import solve_and_print
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "tradeoff",
        help="speed against accuracy on a deck: table, CSV and plot",
        description="Run a deck under a ladder of settings, one after the other, and hold time and "
        "error against each other: a sweep over settings, with its table and a picture of each load case (extra "
        "mbla[pictures]) in DECK_tradeoff.out. Without --knob and --setting the ladder has everything that applies to "
        "the deck.",
        epilog="Exit status 0; 4 where no setting is verified that the others could be compared with; 7 where the time "
        "limit came before the reference.",
    )
    command.set_defaults(action=tradeoff, about={"deck": "deck"})
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    add_deck_options(command, "for every setting", default="DECK_tradeoff.out")
    words = "instead of the ladder: a setting for each value; of several, every combination (repeatable)"
    command.add_argument("--knob", action="append", default=[], metavar="KEY.PATH=V,V,...", help=words)
    words = "instead of the ladder: one setting under a name of its own (repeatable)"
    command.add_argument("--setting", action="append", default=[], metavar="'NAME: KEY.PATH=V ...'", help=words)
    words = "relative error for which a setting is advised (default 1e-4)"
    command.add_argument("--wanted-error", type=relative_above_zero, default=1e-4, metavar="E", help=words)
    command.add_argument("--time-limit", type=seconds, metavar="S", help="seconds for all settings together")
    command.add_argument("--run-limit", type=seconds, metavar="S", help="seconds for each setting")
    command.add_argument("--threads", type=threads, default=1, metavar="N", help="as of mbla run (default 1)")
    add_quiet(command)


def tradeoff(options: argparse.Namespace) -> int:
    """Measure a deck under many settings; the table goes to standard output, with ``--json`` the object alone."""
    run = run_options(options, override=False)
    deck = read_one_deck(options.deck, run)
    with loading():
        from mbla.sweeps.tradeoff.study import tradeoff as study

    return solve_and_print(options, lambda report: study(deck, run, options, report))
