"""``mbla check``."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import Any

from mbla.cli.given_decks import each_deck, read_given_deck, run_options
from mbla.cli.options import add_deck_options
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser("check", help="read, build, find contacts, say what the model is; solve nothing")
    command.set_defaults(action=check)
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    add_deck_options(command)
    command.add_argument("--vtu", action="store_true", help="write blocks and contacts for ParaView")


def check(options: argparse.Namespace) -> int:
    """Say what decks are and what solving them needs."""
    chosen = run_options(options)

    def one(deck: Path) -> int:
        content, took = read_given_deck(deck, chosen)
        with loading():
            from mbla.check import check as check_deck

        results, needs = check_deck(content, chosen, options.vtu, time.perf_counter() - took)
        if options.json:
            from mbla.results.record.check_record import check_json
            from mbla.results.record.json_values import json_line

            print(json_line(check_json(results, needs)), flush=True)
        else:
            from mbla.results.listing.sections.model_words import check_listing

            print(check_listing(results, needs), end="", flush=True)
        if options.vtu:
            files = chosen.folder_for(deck) / f"{deck.stem}_check_*.vtu"
            print(f"  files: {files}", file=sys.stderr if options.json else sys.stdout, flush=True)
        return 0

    return each_deck(options, one, None)
