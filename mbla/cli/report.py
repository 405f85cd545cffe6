"""``mbla report``."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from mbla.cli.options import add_result_and_output
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
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
