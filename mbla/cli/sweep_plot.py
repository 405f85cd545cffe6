"""``mbla sweep-plot``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.options import add_page_options, place
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "sweep-plot",
        help="pictures of a sweep: curves, maps, distributions, fragility (extra mbla[pictures])",
        description="Pictures of the table of a sweep, sweep_KIND_RESULT.png and so on; those that suit the table "
        "unless kinds are named. Points without a verified value are marked as such. Earlier pictures of the same "
        "names are replaced.",
    )
    command.set_defaults(action=sweep_plot)
    command.add_argument("sweep", type=Path, metavar="SWEEP.out|sweep.csv", help="folder of the sweep, or its table")
    words = (
        "PNG, SVG or PDF file, by its name, of one picture: the first that suits the table unless --kind "
        "says which; or a folder (default: that of the sweep)"
    )
    command.add_argument("-o", "--output", type=place, metavar="FILE|DIR", help=words)
    words = "curve, map, distribution, fragility, several with commas, or all that fit the table"
    command.add_argument("--kind", metavar="KIND", help=words)
    words = "column, or key path for all load cases (default: load_factor, or that of the fragility)"
    command.add_argument("--result", metavar="NAME", help=words)
    words = "parameter along the axis of curves and maps, or of the curves of a distribution"
    command.add_argument("--by", metavar="PARAMETER", help=words)
    add_page_options(command)


def sweep_plot(options: argparse.Namespace) -> int:
    """Draw pictures of a sweep; their paths are printed."""
    with loading():
        from mbla.sweeps.pictures.plot import plot_sweep_files

    for path in plot_sweep_files(options.sweep, options):
        print(path)
    return 0
