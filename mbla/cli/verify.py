"""``mbla verify``."""

from __future__ import annotations

import argparse
from typing import Any

from mbla.cli.options import result_command
from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = result_command(
        commands, "verify", verify, "recompute residuals and bounds from a result file alone, with no solver"
    )
    words = (
        "follow each path of elastic joints anew from the deck in the file, by other steps and with joints of "
        "another stiffness in shear, and each pushover: whether the history in the file is that of the loading (needs "
        "the solver, and as long as the run)"
    )
    command.add_argument("--again", action="store_true", help=words)


def verify(options: argparse.Namespace) -> int:
    """Recompute what the file claims; the exit status says whether it was confirmed."""
    with loading():
        from mbla.results.listing.listing import verification_lines
        from mbla.results.record.json_record import verification_json
        from mbla.results.record.json_values import json_line
        from mbla.verify import verify_file

    results, agreed = verify_file(options.result, anew=options.again)
    if options.json:
        print(json_line(verification_json(results, agreed)))
    else:
        print("\n".join(verification_lines(results, agreed)))
    return results.exit_code
