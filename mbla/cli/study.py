"""What commands that run a deck as a sweep of their own share."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from mbla.cli.given_decks import read_given_deck, refuse_unfit_name
from mbla.cli.sweep_progress import print_finished, solved
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.process.run_options import RunOptions


def run_study(options: argparse.Namespace, run: RunOptions, study: Callable[[], Any]) -> int:
    """Read the deck, solve what is asked of it and print what came out; the exit status.

    study : imports what solves it
    """
    refuse_unfit_name(options.deck)
    content, _ = read_given_deck(options.deck, run)
    with loading():
        solve = study()
    finished = solved(options, lambda report: solve(content, run, options, report))
    print_finished(options, finished, finished.lines)
    return int(finished.exit_code)
