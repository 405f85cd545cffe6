"""``mbla interact``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.given_decks import read_one_deck, run_options
from mbla.cli.options import add_analysis_options, add_deck_options, add_jobs, add_quiet, degrees, points, seconds
from mbla.cli.sweep_progress import solve_and_print
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "interact",
        help="load factor over horizontal direction, or over two live loads: table and diagram",
        description="Turn the live load of a load case around the horizon, or let the live loads of two load cases act "
        "together in all proportions: a sweep over the angle, with its table and a diagram (extra mbla[pictures]) in "
        "DECK_interact.out, of two loads DECK_interact_A_B.out. Turned are the horizontal parts of live accelerations "
        "and forces, all together; azimuth 0 pushes along +x, 90 along +y. Two loads A and B act as A cos + B sin of "
        "an angle, with the one dead load that both must have.",
        epilog="Exit status 0 where every point is answered and verified (also that the load never brings collapse "
        "there); else that of the worst point: 4 not solved or not verified, 7 time or memory limit; 4 also where "
        "bounds of points contradict each other; 5 where no point has a load factor; 130 where it was interrupted: "
        "the same command continues with the points that are solved.",
    )
    command.set_defaults(action=interact, about={"deck": "deck"})
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--case", metavar="NAME", help="the load case that is turned; needed if there are several")
    command.add_argument("--loads", nargs=2, metavar=("A", "B"), help="two load cases whose live loads act together")
    words = "points around the horizon (default 72), or of two loads (31)"
    command.add_argument("--directions", type=points, metavar="N", help=words)
    command.add_argument("--from", dest="start", type=degrees, metavar="DEG", help="first angle of two loads (0)")
    words = "last angle (90 on; 360: both loads with both signs)"
    command.add_argument("--to", dest="end", type=degrees, metavar="DEG", help=words)
    add_jobs(command)
    add_deck_options(command, "for every point", default="DECK_interact.out")
    words = "seconds for each point, instead of analysis.time_limit"
    command.add_argument("--time-limit", type=seconds, metavar="S", help=words)
    add_analysis_options(command)
    add_quiet(command)


def interact(options: argparse.Namespace) -> int:
    """Solve the points of a diagram; the table goes to standard output, with ``--json`` the object alone."""
    run = run_options(options)
    deck = read_one_deck(options.deck, run)
    with loading():
        from mbla.sweeps.interaction.study import interact as study

    return solve_and_print(options, lambda report: study(deck, run, options, report))
