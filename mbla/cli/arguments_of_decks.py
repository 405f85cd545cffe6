"""The commands on decks and their options, and the options that commands on a deck share."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.argument_values import place, seconds, threads


def add_run(commands: Any) -> None:
    """``mbla run``."""
    command = commands.add_parser("run", help="solve every load case of decks and write the results")
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    add_deck_options(command)
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    add_analysis_options(command)
    command.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for all load cases, instead of analysis.time_limit"
    )
    command.add_argument(
        "--threads",
        type=threads,
        default=1,
        metavar="N",
        help="threads of the libraries that can use several, at most (default 1): MKL Pardiso, the others are serial",
    )
    command.add_argument("--expected", action="store_true", help="compare with the deck's expected section")
    volume = command.add_mutually_exclusive_group()
    volume.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")
    volume.add_argument("-v", "--verbose", action="store_true", help="print the listing instead of the summary")


def add_check(commands: Any) -> None:
    """``mbla check``."""
    command = commands.add_parser("check", help="read, build, find contacts, say what the model is; solve nothing")
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    add_deck_options(command)
    command.add_argument("--vtu", action="store_true", help="write blocks and contacts for ParaView")


def add_deck_options(
    command: argparse.ArgumentParser, extent: str = "", what: str = "deck", default: str = "DECK.out"
) -> None:
    """Where files go, values of the deck, ``--force`` and ``--json``."""
    command.add_argument("-o", "--output", type=place, metavar="DIR", help=f"folder of the results (default {default})")
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY.PATH=VALUE",
        help=f"change a value of the deck{extent and ' '}{extent} (repeatable); items of lists by number, from 0",
    )
    command.add_argument("--force", action="store_true", help="replace an earlier result")
    command.add_argument(
        "--json", action="store_true", help=f"one JSON object per {what} on standard output, nothing else"
    )


def add_analysis_options(command: argparse.ArgumentParser) -> None:
    """Options in the place of values of ``analysis``."""
    command.add_argument("--accuracy", choices=["draft", "standard", "reference"], help="instead of analysis.accuracy")
    command.add_argument(
        "--flow-rule",
        choices=["associative", "non_associative", "dilatancy", "livesley"],
        help="instead of analysis.flow_rule",
    )
