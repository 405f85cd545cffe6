"""``mbla assess``: what a code says of a result that exists."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "assess",
        help="what a code says of a result, for another earthquake too; solves nothing",
        description="Assess the load cases of a result by the deck in the file, changed by --set; nothing is solved, "
        "and the file stays as it is.",
    )
    command.set_defaults(action=assess, about={"result": "result"})
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    words = "change load_cases.NAME.assessment, or a parameter that it alone uses (repeatable)"
    command.add_argument("--set", action="append", default=[], metavar="KEY.PATH=VALUE", help=words)
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def assess(options: argparse.Namespace) -> int:
    """Print the assessment of every load case that has one, or the JSON object of the result with them."""
    with loading():
        from mbla.codes.again import assessed_again
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.listing.sections.assessment_words import all_assessment_lines
        from mbla.results.record.json_record import results_json
        from mbla.results.record.json_values import json_line

    results = assessed_again(read_results_hdf5(options.result), options.set)
    print(json_line(results_json(results)) if options.json else "\n".join(all_assessment_lines(results)))
    return 0
