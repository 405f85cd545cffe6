"""``mbla show``."""

from __future__ import annotations

import argparse
from typing import Any

from mbla.cli.options import result_command
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    result_command(commands, "show", show, "print the listing of a result file")


def show(options: argparse.Namespace) -> int:
    """Print the listing, or the JSON object."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.listing.listing import listing
        from mbla.results.record.json_record import results_json
        from mbla.results.record.json_values import json_line

    results = read_results_hdf5(options.result)
    print(json_line(results_json(results)) + "\n" if options.json else listing(results), end="")
    return 0
