"""The commands of the program and their options; what they do is in :mod:`mbla.cli`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla import __version__
from mbla.argument_values import degrees, names, relative, relative_above_zero, seconds, shard, threads, workers

EXIT_STATUS = """\
exit status:
  0  every case solved and verified        5  valid, but there is no load factor (dead load not carried,
  1  internal error                           or the live load never brings collapse)
  2  wrong usage                           6  file input or output
  3  deck invalid                          7  time or memory limit
  4  a case not solved or not verified     130, 143  interrupted, terminated

MBLA_TRACEBACK=1 in the environment shows where an internal error arose.
"""


def build_parser() -> argparse.ArgumentParser:
    """The commands and their options; ``command`` of the result is the name of the command."""
    parser = argparse.ArgumentParser(
        prog="mbla",
        description="Limit analysis of masonry: load factor, mechanism and verified bounds of rigid-block assemblies.",
        epilog=EXIT_STATUS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"mbla {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")
    _add_run(commands)
    _add_check(commands)
    _add_result_commands(commands)
    _add_plot(commands)
    _add_report(commands)
    _add_export(commands)
    _add_diff(commands)
    _add_sweep(commands)
    _add_interact(commands)
    _add_tradeoff(commands)
    _add_sweep_plot(commands)
    _add_explain(commands)
    _add_schema_and_new(commands)
    return parser


def _add_run(commands: Any) -> None:
    command = commands.add_parser("run", help="solve every load case of decks and write the results")
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    _add_deck_options(command)
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    command.add_argument("--accuracy", choices=["draft", "standard", "reference"], help="instead of analysis.accuracy")
    command.add_argument(
        "--flow-rule",
        choices=["associative", "non_associative", "dilatancy", "livesley"],
        help="instead of analysis.flow_rule",
    )
    command.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for all load cases, instead of analysis.time_limit"
    )
    command.add_argument(
        "--threads",
        type=threads,
        default=1,
        metavar="N",
        help="threads of clarabel and of the linear algebra libraries, at most (default 1)",
    )
    command.add_argument("--expected", action="store_true", help="compare with the deck's expected section")
    volume = command.add_mutually_exclusive_group()
    volume.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")
    volume.add_argument("-v", "--verbose", action="store_true", help="print the listing instead of the summary")


def _add_check(commands: Any) -> None:
    command = commands.add_parser("check", help="read, build, find contacts, say what the model is; solve nothing")
    command.add_argument("decks", nargs="+", type=Path, metavar="DECK")
    _add_deck_options(command)
    command.add_argument("--vtu", action="store_true", help="write blocks and contacts for ParaView")


def _add_deck_options(
    command: argparse.ArgumentParser, extent: str = "", what: str = "deck", default: str = "DECK.out"
) -> None:
    command.add_argument("-o", "--output", type=Path, metavar="DIR", help=f"folder of the results (default {default})")
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


def _add_result_commands(commands: Any) -> None:
    for name, text in (
        ("show", "print the listing of a result file"),
        ("verify", "recompute residuals and bounds from a result file alone, with no solver"),
    ):
        command = commands.add_parser(name, help=text)
        command.add_argument("result", type=Path, metavar="RESULT.h5")
        command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def _add_plot(commands: Any) -> None:
    command = commands.add_parser(
        "plot",
        help="pictures of model, mechanism and forces (extra mbla[pictures])",
        description="Pictures of model, mechanism and forces. Earlier pictures of the same names are replaced.",
    )
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE|DIR",
        help="PNG, SVG or PDF file, by its name, of one picture; or a folder (default: that of the result)",
    )
    command.add_argument(
        "--kind",
        metavar="KIND",
        help="model, mechanism, forces, history, several with commas, or all "
        "(default: the first three; the mechanism where -o names a file)",
    )
    command.add_argument("--case", metavar="NAME", help="only this load case")
    command.add_argument(
        "--animate", choices=["gif", "mp4"], help="moving pictures of the mechanisms in the place of pictures"
    )
    command.add_argument(
        "--view",
        default="auto",
        metavar="VIEW",
        help="front, back, left, right, top, iso, below, auto, or AZIMUTH,ELEVATION in degrees, as --view=-60,25",
    )
    command.add_argument(
        "--scale", default="auto", metavar="X", help="multiple of the displacements that auto draws (default auto)"
    )
    command.add_argument(
        "--zoom",
        choices=("auto", "off"),
        default="auto",
        help="enlarge what moves beside the whole, where that is a small part of it (default auto)",
    )
    _add_page_options(command)


def _add_page_options(command: Any) -> None:
    command.add_argument("--size", default="1600x1000", metavar="WxH", help="pixels of a PNG at 100 dpi")
    command.add_argument("--dpi", type=int, default=100, help="dots per inch of a PNG (default 100)")
    command.add_argument(
        "--format", choices=["png", "svg", "pdf"], default="png", help="of pictures in a folder (default png)"
    )


def _add_report(commands: Any) -> None:
    command = commands.add_parser(
        "report",
        help="one self-contained HTML file of a result (extra mbla[report])",
        description="One self-contained HTML file of a result. An earlier report of that name is replaced.",
    )
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE|DIR",
        help="HTML file, or a folder for STEM.html (default: that of the result)",
    )
    command.add_argument("--case", metavar="NAME", help="only this load case")
    command.add_argument("--no-3d", action="store_true", help="leave out the views that can be turned, 5 MB less")


def _add_export(commands: Any) -> None:
    command = commands.add_parser("export", help="tables of blocks, interfaces, points and load cases; VTKHDF meshes")
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("--csv", action="store_true", help="CSV, units in the header (what is written by default)")
    command.add_argument("--parquet", action="store_true", help="Parquet (extra mbla[tables])")
    command.add_argument("--vtkhdf", action="store_true", help="VTKHDF for ParaView, one file per load case")
    command.add_argument(
        "-o", "--output", type=Path, metavar="DIR", help="folder of the files (default: that of the result)"
    )
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    command.add_argument(
        "--table",
        type=names,
        default=[],
        metavar="NAME,...",
        help="only these tables, such as blocks,interfaces,points",
    )
    command.add_argument("--force", action="store_true", help="replace earlier files")


def _add_diff(commands: Any) -> None:
    command = commands.add_parser(
        "diff",
        help="what differs between two result files",
        description="Compare decks, settings, models and load cases of two result files; figures of B are brought into "
        "the units of A.",
        epilog="Exit status 0 whatever differs; with --fail 4 where a load case differs in its status or its answer "
        "(load factor, angle or reaction), or is in one file only.",
    )
    command.add_argument("first", type=Path, metavar="A.h5")
    command.add_argument("second", type=Path, metavar="B.h5")
    command.add_argument(
        "--tolerance",
        type=relative,
        metavar="T",
        help="relative difference up to which answers are the same (default: the sum of what both are good to, the "
        "gap of associative factors and the largest residual of others; at least 1e-6)",
    )
    command.add_argument("--fail", action="store_true", help="exit status 4 where a status or an answer differs")
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def _add_explain(commands: Any) -> None:
    command = commands.add_parser(
        "explain",
        help="what an identifier of a warning, a status or an error means, and what to do",
        description="Explain an identifier, such as near-misses, approximate or exit-4. A word or a whole message "
        "finds it too. Without ID: all identifiers, each in a line.",
    )
    command.add_argument("identifier", nargs="*", metavar="ID", help="identifier, word or message")
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def _add_sweep(commands: Any) -> None:
    command = commands.add_parser(
        "sweep",
        help="run a deck over a design of experiments: table, journal",
        description="Solve a base deck at every point of a design of experiments. Each finished point is a row of the "
        "journal at once; --resume goes on after an interruption. The table of all points is sweep.csv.",
        epilog="Exit status 0 where every point has a verified answer; 8 with failed points, which the table names.",
    )
    command.add_argument("sweep", type=Path, metavar="SWEEP")
    command.add_argument("-j", "--jobs", type=workers, default=1, metavar="N", help="processes of this machine (1)")
    command.add_argument("--scheduler", metavar="ADDRESS", help="Dask scheduler, tcp://HOST:PORT or tls://HOST:PORT")
    command.add_argument("--scheduler-file", type=Path, metavar="F", help="file in which a scheduler wrote its address")
    command.add_argument("--tls-ca-file", type=Path, metavar="F", help="for tls://: certificate of the authority")
    command.add_argument("--tls-cert", type=Path, metavar="F", help="for tls://: certificate of this program")
    command.add_argument("--tls-key", type=Path, metavar="F", help="for tls://: its private key")
    command.add_argument("--shard", type=shard, metavar="I/N", help="only the I-th of N parts, for job arrays")
    command.add_argument("--resume", action="store_true", help="go on with the journal; solve what is missing")
    command.add_argument("--retry-failed", action="store_true", help="go on, and solve failed points again")
    command.add_argument("--dry-run", action="store_true", help="list the points and solve nothing")
    command.add_argument("--parquet", action="store_true", help="the table as Parquet too (extra mbla[tables])")
    command.add_argument("--hdf5", action="store_true", help="the table as HDF5 too, along the axes of the design")
    _add_deck_options(command, "for every point", what="sweep", default="SWEEP.out")
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def _add_interact(commands: Any) -> None:
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
        "--directions", type=int, metavar="N", help="points around the horizon (default 72), or of two loads (31)"
    )
    command.add_argument("--from", dest="start", type=degrees, metavar="DEG", help="first angle of two loads (0)")
    command.add_argument(
        "--to", dest="end", type=degrees, metavar="DEG", help="last angle (90 on; 360: both loads with both signs)"
    )
    command.add_argument(
        "-j", "--jobs", type=workers, default=1, metavar="N", help="processes of this machine (1; more: mbla[dask])"
    )
    _add_deck_options(command, "for every point")
    command.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for each point, instead of analysis.time_limit"
    )
    command.add_argument("--accuracy", choices=["draft", "standard", "reference"], help="instead of analysis.accuracy")
    command.add_argument(
        "--flow-rule",
        choices=["associative", "non_associative", "dilatancy", "livesley"],
        help="instead of analysis.flow_rule",
    )
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def _add_tradeoff(commands: Any) -> None:
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
    _add_deck_options(command, "for every setting")
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


def _add_sweep_plot(commands: Any) -> None:
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
        type=Path,
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
    _add_page_options(command)


def _add_schema_and_new(commands: Any) -> None:
    command = commands.add_parser("schema", help="print the JSON Schema of decks, or of sweep files")
    command.add_argument("kind", nargs="?", choices=["deck", "sweep"], default="deck")
    command = commands.add_parser("new", help="write a commented starter deck")
    command.add_argument("name", metavar="NAME")
    command.add_argument("--force", action="store_true", help="replace an existing file")
