"""``mbla strengthen``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.given_decks import read_one_deck, run_options
from mbla.cli.options import add_analysis_options, add_deck_options, add_quiet
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "strengthen",
        help="the cheapest ties with which a structure carries its required loads",
        description="Find the cheapest capacities of the candidates of the section strengthen with which each load "
        "case carries its required load factor: one program of all load cases, whose mechanisms prove what they cost "
        "at least. Then the strengthened structure is analysed by the deck's own flow rule, and while that falls short "
        "the program is asked for more. Writes DECK_strengthened.yaml with the meshes and tables that it "
        "names beside it, a table of the candidates as CSV and the results, with pictures where the extra "
        "mbla[pictures] is installed.",
        epilog="Exit status 0: strengthened, and every load factor is verified; 4: not verified, or still short; 5: no "
        "capacities of these candidates suffice.",
    )
    command.set_defaults(action=strengthen, about={"deck": "deck"})
    command.add_argument("deck", type=Path, metavar="DECK")
    add_deck_options(command)
    add_analysis_options(command)
    add_quiet(command)


def strengthen(options: argparse.Namespace) -> int:
    """Find, analyse and write; table and sentences go to standard output, with ``--json`` the object alone."""
    chosen = run_options(options)
    content = read_one_deck(options.deck, chosen)
    with loading():
        from mbla.results.record.json_values import json_line
        from mbla.sweeps.strengthen.report import lines_of, record_of
        from mbla.sweeps.strengthen.study import strengthen as study
    answer = study(content, chosen, lambda record: None)
    if options.json:
        print(json_line(record_of(answer)), flush=True)
    elif not options.quiet:
        print("\n".join(lines_of(answer)), flush=True)
    return answer.exit_code
