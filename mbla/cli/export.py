"""The commands that make something of results: plot, sweep-plot, report, export.

Everything of a command is imported when it is called, so that the program starts at once.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.options import add_page_options, add_result_and_output, names, place
from mbla.errors import UsageError
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.results.results import Results


def add_plot(commands: Any) -> None:
    """``mbla plot``."""
    command = commands.add_parser(
        "plot",
        help="pictures of model, mechanism and forces (extra mbla[pictures])",
        description="Pictures of model, mechanism and forces. Earlier pictures of the same names are replaced.",
    )
    command.set_defaults(action=plot)
    add_result_and_output(command, "PNG, SVG or PDF file, by its name, of one picture; or a folder")
    command.add_argument(
        "--kind",
        metavar="KIND",
        help="model, mechanism, forces, history, curve (of a pushover), several with commas, or all "
        "(default: the first three, and the history of a load that travels; the mechanism where -o names a file)",
    )
    command.add_argument("--case", metavar="NAME", help="only this load case")
    command.add_argument(
        "--animate",
        choices=["gif", "mp4"],
        help="moving pictures of the mechanisms in the place of pictures, with --kind curve of the steps of a pushover",
    )
    command.add_argument(
        "--view",
        default="auto",
        metavar="VIEW",
        help="front, back, left, right, top, iso, below, auto, or AZIMUTH,ELEVATION in degrees, as --view=-60,25",
    )
    command.add_argument(
        "--scale", default="auto", metavar="X", help="factor on the displacements of the default, auto"
    )
    add_page_options(command)


def plot(options: argparse.Namespace) -> int:
    """Draw pictures or films; their paths are printed."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.pictures.options import picture_options
        from mbla.results.pictures.plot import plot_results

    chosen = picture_options(options)
    results = read_results_hdf5(options.result)
    target = options.output or options.result.parent
    for path in plot_results(results, target, options.result.stem, chosen):
        print(path)
    return 0


def add_sweep_plot(commands: Any) -> None:
    """``mbla sweep-plot``."""
    command = commands.add_parser(
        "sweep-plot",
        help="pictures of a sweep: curves, maps, distributions (extra mbla[pictures])",
        description="Pictures of the table of a sweep, sweep_KIND_RESULT.png and so on; those that suit the table "
        "unless kinds are named. Points without a verified value are marked as such. Earlier pictures of the same "
        "names are replaced.",
    )
    command.set_defaults(action=sweep_plot)
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
        help="curve, map, distribution, several with commas, or all that fit the table",
    )
    command.add_argument(
        "--result", metavar="NAME", help="column, or key path for all load cases (default: load_factor)"
    )
    command.add_argument(
        "--by",
        metavar="PARAMETER",
        help="parameter along the axis of curves and maps, or of the curves of a distribution",
    )
    add_page_options(command)


def sweep_plot(options: argparse.Namespace) -> int:
    """Draw pictures of a sweep; their paths are printed."""
    with loading():
        from mbla.sweeps.pictures.plot import plot_sweep_files

    for path in plot_sweep_files(options.sweep, options):
        print(path)
    return 0


def add_report(commands: Any) -> None:
    """``mbla report``."""
    command = commands.add_parser(
        "report",
        help="one self-contained HTML file of a result (extra mbla[report])",
        description="One self-contained HTML file of a result. An earlier report of that name is replaced.",
    )
    command.set_defaults(action=report)
    add_result_and_output(command, "HTML file, or a folder for STEM.html")
    command.add_argument("--case", metavar="NAME", help="only this load case")
    command.add_argument("--no-3d", action="store_true", help="leave out the views that can be turned, 5 MB less")


def report(options: argparse.Namespace) -> int:
    """Write the HTML file; its path is printed, remarks on what it lacks go to standard error."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.report.report import report_path, write_report

    results = read_results_hdf5(options.result)
    target = report_path(options.output, options.result)
    for remark in write_report(results, target, options.case, view=not options.no_3d):
        print(f"mbla: {remark}", file=sys.stderr)
    print(target)
    return 0


def add_export(commands: Any) -> None:
    """``mbla export``."""
    command = commands.add_parser(
        "export", help="tables of blocks, interfaces, points and load cases; decks of macro-blocks"
    )
    command.set_defaults(action=export)
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("--csv", action="store_true", help="CSV, units in the header (what is written by default)")
    command.add_argument("--parquet", action="store_true", help="Parquet (extra mbla[tables])")
    command.add_argument(
        "--macro-blocks",
        action="store_true",
        help="in the place of tables a deck for each load case, STEM_CASE_macro.yaml, whose blocks are the rigid parts "
        "of its mechanism; with associative flow they have the same load factor",
    )
    command.add_argument(
        "--associative",
        action="store_true",
        help="with --macro-blocks: parts of the mechanism of associative flow, whatever the flow rule of the deck",
    )
    command.add_argument(
        "-o", "--output", type=place, metavar="DIR", help="folder of the files (default: that of the result)"
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


def export(options: argparse.Namespace) -> int:
    """Write tables, or decks of macro-blocks; their paths are printed.

    Raises UsageError for options that do not go together.
    """
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.tables.tables import export_results

    results = read_results_hdf5(options.result)
    folder = options.output or options.result.parent
    if options.macro_blocks:
        return _export_macro_blocks(options, results, folder)
    if options.associative:
        raise UsageError("command-line", "export: --associative applies with --macro-blocks")
    formats = {"csv": options.csv or not options.parquet, "parquet": options.parquet}
    chosen = (options.case, options.table)
    for path in export_results(results, folder, options.result.stem, *chosen, **formats, force=options.force):
        print(path)
    return 0


def _export_macro_blocks(options: argparse.Namespace, results: Results, folder: Path) -> int:
    from mbla.results.macro_blocks import write_macro_blocks

    if options.csv or options.parquet or options.table:
        raise UsageError("command-line", "export: --macro-blocks writes no tables: leave out --csv, --parquet, --table")
    chosen = (options.case, options.associative)
    for path in write_macro_blocks(results, folder, options.result.stem, *chosen, force=options.force):
        print(path)
    return 0
