"""``mbla plot``."""

from __future__ import annotations

import argparse
from typing import Any

from mbla.cli.options import add_page_options, add_result_and_output
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "plot",
        help="pictures of model, mechanism and forces (extra mbla[pictures])",
        description="Pictures of model, mechanism and forces. Earlier pictures of the same names are replaced.",
    )
    command.set_defaults(action=plot)
    add_result_and_output(command, "PNG, SVG or PDF file, by its name, of one picture; or a folder")
    words = (
        "model, mechanism, forces, history, curve (of a pushover, or over time), several with commas, or all "
        "(default: the first three, and the history of a load that travels; the mechanism where -o names a file)"
    )
    command.add_argument("--kind", metavar="KIND", help=words)
    command.add_argument(
        "--case", metavar="NAME", help="only this load case; of a load that travels the worst position"
    )
    words = (
        "moving pictures of the mechanisms, or of structures in time, in the place of pictures, with --kind curve of "
        "the steps of a pushover"
    )
    command.add_argument("--animate", choices=["gif", "mp4"], help=words)
    words = "front, back, left, right, top, iso, below, auto, or AZIMUTH,ELEVATION in degrees, as --view=-60,25"
    command.add_argument("--view", default="auto", metavar="VIEW", help=words)
    words = "factor on the displacements of the default, auto"
    command.add_argument("--scale", default="auto", metavar="X", help=words)
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
