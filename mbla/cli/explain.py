"""``mbla explain``."""

from __future__ import annotations

import argparse
from typing import Any

from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "explain",
        help="what an identifier of a warning, a status or an error means, and what to do",
        description="Explain an identifier, such as near-misses, approximate or exit-4. A word or a complete message "
        "finds it too. Without ID: all identifiers, each in a line.",
    )
    command.set_defaults(action=explain)
    command.add_argument("identifier", nargs="*", metavar="ID", help="identifier, word or message")
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")


def explain(options: argparse.Namespace) -> int:
    """Print what identifiers mean."""
    with loading():
        from mbla.results.explanations import (
            all_text,
            explanation_json,
            explanation_text,
            explanations,
            find_explanations,
        )
        from mbla.results.record.json_values import json_line

    asked = " ".join(options.identifier)
    found = find_explanations(asked) if asked.strip() else tuple(explanations().values())
    if options.json:
        print(json_line({"explanations": [explanation_json(entry) for entry in found]}))
    else:
        print(explanation_text(found) if asked.strip() else all_text(), end="")
    return 0
