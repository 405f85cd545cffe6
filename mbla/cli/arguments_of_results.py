"""The commands on result files and their options, and the options of pictures."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.argument_values import dots, names, place, relative


def add_result_commands(commands: Any) -> None:
    """``mbla show`` and ``mbla verify``."""
    for name, text in (
        ("show", "print the listing of a result file"),
        ("verify", "recompute residuals and bounds from a result file alone, with no solver"),
    ):
        command = commands.add_parser(name, help=text)
        command.add_argument("result", type=Path, metavar="RESULT.h5")
        command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def _add_result_and_output(command: Any, what: str) -> None:
    """A result file, and where what is made of it goes."""
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("-o", "--output", type=place, metavar="FILE|DIR", help=f"{what} (default: that of the result)")


def add_plot(commands: Any) -> None:
    """``mbla plot``."""
    command = commands.add_parser(
        "plot",
        help="pictures of model, mechanism and forces (extra mbla[pictures])",
        description="Pictures of model, mechanism and forces. Earlier pictures of the same names are replaced.",
    )
    _add_result_and_output(command, "PNG, SVG or PDF file, by its name, of one picture; or a folder")
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
    add_page_options(command)


def add_page_options(command: Any) -> None:
    """Size and format of pictures."""
    command.add_argument("--size", default="1600x1000", metavar="WxH", help="pixels of a PNG at 100 dpi")
    command.add_argument("--dpi", type=dots, default=100, help="dots per inch of a PNG (default 100)")
    command.add_argument(
        "--format", choices=["png", "svg", "pdf"], default="png", help="of pictures in a folder (default png)"
    )


def add_report(commands: Any) -> None:
    """``mbla report``."""
    command = commands.add_parser(
        "report",
        help="one self-contained HTML file of a result (extra mbla[report])",
        description="One self-contained HTML file of a result. An earlier report of that name is replaced.",
    )
    _add_result_and_output(command, "HTML file, or a folder for STEM.html")
    command.add_argument("--case", metavar="NAME", help="only this load case")
    command.add_argument("--no-3d", action="store_true", help="leave out the views that can be turned, 5 MB less")


def add_export(commands: Any) -> None:
    """``mbla export``."""
    command = commands.add_parser("export", help="tables of blocks, interfaces, points and load cases")
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("--csv", action="store_true", help="CSV, units in the header (what is written by default)")
    command.add_argument("--parquet", action="store_true", help="Parquet (extra mbla[tables])")
    command.add_argument("--vtkhdf", action="store_true", help=argparse.SUPPRESS)
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


def add_diff(commands: Any) -> None:
    """``mbla diff``."""
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
