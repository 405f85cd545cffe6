"""The commands that solve a deck many times and their options: sweeps, diagrams and trades of speed for accuracy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mbla.cli.argument_values import degrees, place, points, relative_above_zero, seconds, shard, threads, workers
from mbla.cli.arguments_of_decks import add_analysis_options, add_deck_options
from mbla.cli.arguments_of_results import add_page_options


def add_sweep(commands: Any) -> None:
    """``mbla sweep``."""
    command = commands.add_parser(
        "sweep",
        help="run a deck over a design of experiments: a table of all points",
        description="Solve a base deck at every point of a design of experiments. Each finished point is a row of "
        "journal.csv at once; --resume goes on after an interruption. When none is missing, sweep.csv and sweep.json "
        "hold all points in the order of the design, and mbla sweep-plot draws them. mbla schema sweep says what a "
        "sweep file may have.",
        epilog="Exit status 0 where every point has a verified answer, also that there is no load factor; 8 with "
        "failed points, whose rows say why.",
    )
    command.add_argument("sweep", type=Path, metavar="SWEEP", help="sweep file (YAML)")
    command.add_argument(
        "-j",
        "--jobs",
        type=workers,
        default=1,
        metavar="N",
        help="processes of this machine (default 1; more: extra mbla[dask])",
    )
    command.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="a Dask scheduler, whose workers solve the points: tcp://HOST:PORT or tls://HOST:PORT (extra mbla[dask])",
    )
    command.add_argument(
        "--scheduler-file",
        type=Path,
        metavar="F",
        help="the same, by the file in which the scheduler wrote its address",
    )
    command.add_argument("--tls-ca-file", type=Path, metavar="F", help="for tls://: certificate of the authority")
    command.add_argument("--tls-cert", type=Path, metavar="F", help="for tls://: certificate of this program")
    command.add_argument("--tls-key", type=Path, metavar="F", help="for tls://: its private key")
    command.add_argument(
        "--shard",
        type=shard,
        metavar="I/N",
        help="only the I-th of N parts, for job arrays; the last to end writes the table",
    )
    command.add_argument("--resume", action="store_true", help="go on with the journal: solve what is missing")
    command.add_argument("--retry-failed", action="store_true", help="as --resume, and solve failed points again")
    command.add_argument("--dry-run", action="store_true", help="list the points and solve nothing")
    command.add_argument("--parquet", action="store_true", help="the table as Parquet too (extra mbla[tables])")
    command.add_argument("--hdf5", action="store_true", help="the table as HDF5 too, along the axes of the design")
    add_deck_options(command, "for every point", what="sweep", default="SWEEP.out")
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def add_sweep_plot(commands: Any) -> None:
    """``mbla sweep-plot``."""
    command = commands.add_parser(
        "sweep-plot",
        help="pictures of a sweep: curves, maps, scatter, distribution, tornado, polar (extra mbla[pictures])",
        description="Pictures of the table of a sweep, sweep_KIND_RESULT.png and so on; those that suit the table "
        "unless kinds are named. Points without a verified value are marked as such. Earlier pictures of the same "
        "names are replaced.",
    )
    command.add_argument("sweep", type=Path, metavar="SWEEP.out|sweep.csv", help="folder of the sweep, or its table")
    command.add_argument(
        "-o",
        "--output",
        type=place,
        metavar="FILE|DIR",
        help="PNG, SVG or PDF file, by its name, of one picture: the first that suits the table unless --kind "
        "says which; or a folder (default: that of the sweep)",
    )
    command.add_argument(
        "--kind",
        metavar="KIND",
        help="curve, map, polar, scatter, distribution, tornado, several with commas, or all that fit the table",
    )
    command.add_argument(
        "--result", metavar="NAME", help="column, or key path for all load cases (default: load_factor)"
    )
    command.add_argument(
        "--by",
        metavar="PARAMETER",
        help="parameter along the axis of curves and maps, of the curves of a distribution, or the only one of scatter",
    )
    add_page_options(command)


def add_interact(commands: Any) -> None:
    """``mbla interact``."""
    command = commands.add_parser(
        "interact",
        help="load factor over horizontal direction, or over two live loads: table and diagram",
        description="Turn the live load of a load case around the horizon, or let the live loads of two load cases act "
        "together in all proportions: table, STEM_interact.csv (of two loads STEM_interact_A_B.csv), .json, and a "
        "diagram (extra mbla[pictures]). Turned are the horizontal parts of live accelerations and forces, all "
        "together; azimuth 0 pushes along +x, 90 along +y. Two loads A and B act as A cos + B sin of an angle, with "
        "the one dead load that both must have.",
        epilog="Exit status 0 where every point is answered and verified (also that the load never brings collapse "
        "there); else that of the gravest point: 4 not solved or not verified, 7 time or memory limit; 4 also where "
        "bounds of points contradict each other; 5 where no point has a load factor; 130 where it was interrupted: "
        "points solved until then are written, unless there are earlier files.",
    )
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
        "-j", "--jobs", type=workers, default=1, metavar="N", help="processes of this machine (1; more: mbla[dask])"
    )
    add_deck_options(command, "for every point")
    command.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for each point, instead of analysis.time_limit"
    )
    add_analysis_options(command)
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def add_tradeoff(commands: Any) -> None:
    """``mbla tradeoff``."""
    command = commands.add_parser(
        "tradeoff",
        help="speed against accuracy on a deck: table, CSV and plot",
        description="Run a deck under a ladder of settings, each in a process of its own, and hold time, memory and "
        "error against each other: table, STEM_tradeoff.csv, .json, and a picture of each load case (extra "
        "mbla[pictures]). Without --knob and --setting the ladder has everything that applies to the deck.",
        epilog="Exit status 0; 4 where no setting is verified that the others could be held against; 7 where the time "
        "limit came before the reference.",
    )
    command.add_argument("deck", type=Path, metavar="DECK")
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    add_deck_options(command, "for every setting")
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
