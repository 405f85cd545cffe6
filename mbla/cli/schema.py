"""``mbla schema``."""

from __future__ import annotations

import argparse
import json
from typing import Any

from mbla.process.collector import loading


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser("schema", help="print the JSON Schema of decks, or of sweep files")
    command.set_defaults(action=schema)
    command.add_argument("kind", nargs="?", choices=["deck", "sweep"], default="deck")


def schema(options: argparse.Namespace) -> int:
    """Print it."""
    with loading():
        if options.kind == "sweep":
            from mbla.sweeps.file.schema import sweep_schema as made
        else:
            from mbla.deck.schema import deck_schema as made

    print(json.dumps(made(), indent=2))
    return 0
