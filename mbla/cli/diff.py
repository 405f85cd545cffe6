"""``mbla diff``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.cli.options import relative
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "diff",
        help="what differs between two result files",
        description="Compare deck texts, figures and mechanisms of two result files; figures of B are brought into the "
        "units of A.",
        epilog="Exit status 0 whatever differs; with --fail 4 where a load case differs in its status or its answer "
        "(load factor, angle or reaction), or is in one file only.",
    )
    command.set_defaults(action=diff, about={"first": "first", "second": "second"})
    command.add_argument("first", type=Path, metavar="A.h5")
    command.add_argument("second", type=Path, metavar="B.h5")
    words = (
        "relative difference up to which answers are the same (default: the sum of what both are good to, the "
        "gap of associative factors and the largest residual of others; at least 1e-6)"
    )
    command.add_argument("--tolerance", type=relative, metavar="T", help=words)
    command.add_argument("--fail", action="store_true", help="exit status 4 where a status or an answer differs")
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def diff(options: argparse.Namespace) -> int:
    """Print what differs; status 4 only where it is asked for."""
    with loading():
        from mbla.results.diff.comparison import compare_results, comparison_json
        from mbla.results.diff.words import comparison_text
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.record.json_values import json_line

    names = str(options.first), str(options.second)
    results = read_results_hdf5(options.first), read_results_hdf5(options.second)
    comparison = compare_results(*results, options.tolerance)
    if options.json:
        print(json_line(comparison_json(comparison, names)))
    else:
        print(comparison_text(comparison, names), end="")
    return 4 if options.fail and comparison.differing else 0
