"""The commands that solve a deck many times: call what does the work, print, return the exit status; nothing else.

They print as ``cli`` does, which calls them and says what went wrong; sweeps are in ``sweep_commands``.
Everything of a command is imported when it is called, so that the program starts at once.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.decks import read_given_deck, refuse_unfit_name, run_options
from mbla.cli.options import (
    add_analysis_options,
    add_deck_options,
    degrees,
    points,
    relative_above_zero,
    seconds,
    target,
    threads,
    workers,
)
from mbla.cli.sweep_commands import print_finished, solved
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.process.run_options import RunOptions


def add_interact(commands: Any) -> None:
    """``mbla interact``."""
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
    command.add_argument(
        "--directions", type=points, metavar="N", help="points around the horizon (default 72), or of two loads (31)"
    )
    command.add_argument("--from", dest="start", type=degrees, metavar="DEG", help="first angle of two loads (0)")
    command.add_argument(
        "--to", dest="end", type=degrees, metavar="DEG", help="last angle (90 on; 360: both loads with both signs)"
    )
    command.add_argument(
        "-j", "--jobs", type=workers, default=1, metavar="N", help="processes of this machine (default 1)"
    )
    add_deck_options(command, "for every point", default="DECK_interact.out")
    command.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for each point, instead of analysis.time_limit"
    )
    add_analysis_options(command)
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def interact(options: argparse.Namespace) -> int:
    """Solve the points of a diagram; the table goes to standard output, with ``--json`` the object alone."""

    def study() -> Any:
        from mbla.sweeps.interaction.study import interact

        return interact

    return _run_study(options, run_options(options), study)


def add_tradeoff(commands: Any) -> None:
    """``mbla tradeoff``."""
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
    command.add_argument(
        "--knob",
        action="append",
        default=[],
        metavar="KEY.PATH=V,V,...",
        help="instead of the ladder: a setting for each value; of several, every combination (repeatable)",
    )
    command.add_argument(
        "--setting",
        action="append",
        default=[],
        metavar="'NAME: KEY.PATH=V ...'",
        help="instead of the ladder: one setting under a name of its own (repeatable)",
    )
    command.add_argument(
        "--wanted-error",
        type=relative_above_zero,
        default=1e-4,
        metavar="E",
        help="relative error for which a setting is advised (default 1e-4)",
    )
    command.add_argument("--time-limit", type=seconds, metavar="S", help="seconds for all settings together")
    command.add_argument("--run-limit", type=seconds, metavar="S", help="seconds for each setting")
    command.add_argument("--threads", type=threads, default=1, metavar="N", help="as of mbla run (default 1)")
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def tradeoff(options: argparse.Namespace) -> int:
    """Measure a deck under many settings; the table goes to standard output, with ``--json`` the object alone."""

    def study() -> Any:
        from mbla.sweeps.tradeoff.study import tradeoff

        return tradeoff

    return _run_study(options, run_options(options, override=False), study)


def add_find(commands: Any) -> None:
    """``mbla find``."""
    command = commands.add_parser(
        "find",
        help="the value of a parameter at which a load factor is a target, or the structure just stands",
        description="Look for the value of a number of the deck at which a load factor is a target, or at which the "
        "dead load is just carried, between two bounds: by slopes of the associative load factor, which cost no "
        "further solve, so that 5 to 8 solves do. The question stands in the section find of the deck; options go "
        "before it. Values that meet the target over a stretch are told from end to end. Prints every value that was "
        "looked at; writes no files.",
        epilog="Exit status 0: found and verified; 4: the last answer is not verified, is a jump of the load factor or "
        "stands only by self-stress, or nothing was found and of some steps of --scan nothing is known; 5: no value "
        "between the bounds, as far as the steps show.",
    )
    command.set_defaults(action=find, about={"deck": "deck"}, output=None, force=False)
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--parameter", metavar="KEY.PATH", help="key path of a real number in the deck, as for --set")
    command.add_argument(
        "--target", type=target, metavar="WHAT", help="load_factor=VALUE, least_load_factor=VALUE, or stands"
    )
    command.add_argument(
        "--bounds", nargs=2, type=float, metavar=("LOW", "HIGH"), help="least and greatest value, in the deck's units"
    )
    command.add_argument("--case", metavar="NAME", help="the load case; needed if there are several")
    command.add_argument(
        "--scan", type=points, metavar="N", help="equal steps between the bounds that are solved first"
    )
    command.add_argument(
        "--tolerance",
        type=relative_above_zero,
        metavar="T",
        help="error of the value, over the larger bound (default 1e-6)",
    )
    command.add_argument(
        "--set", action="append", default=[], metavar="KEY.PATH=VALUE", help="change a value of the deck (repeatable)"
    )
    add_analysis_options(command)
    command.add_argument("--json", action="store_true", help="one JSON object on standard output, nothing else")
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def find(options: argparse.Namespace) -> int:
    """Look for values; table and sentences go to standard output, with ``--json`` the object alone."""
    refuse_unfit_name(options.deck)
    content, _ = read_given_deck(options.deck, run_options(options))
    with loading():
        from mbla.results.record.json_values import json_line
        from mbla.sweeps.find.study import find as look
    found = look(content, options)
    if options.json:
        print(json_line(found.record), flush=True)
    elif not options.quiet:
        print("\n".join(found.lines), flush=True)
    return found.exit_code


def _run_study(options: argparse.Namespace, run: RunOptions, study: Callable[[], Any]) -> int:
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
