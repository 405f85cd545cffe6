"""The commands that need no file of the user: explain, schema, new."""

from __future__ import annotations

import argparse
import json
import shlex
from typing import Any

from mbla.cli.starters import KINDS
from mbla.process.collector import loading


def add_explain(commands: Any) -> None:
    """``mbla explain``."""
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


def add_schema(commands: Any) -> None:
    """``mbla schema``."""
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


def add_new(commands: Any) -> None:
    """``mbla new``."""
    kinds = "; ".join(f"{kind}: {words}" for kind, words in KINDS.items())
    command = commands.add_parser(
        "new",
        help="write a commented starter deck",
        description=f"Write a commented deck to begin with, which runs as it stands. {kinds}.",
    )
    command.set_defaults(action=new)
    command.add_argument("name", metavar="NAME")
    command.add_argument("--kind", choices=tuple(KINDS), default="wall", help="kind of structure (default wall)")
    command.add_argument("--force", action="store_true", help="replace an existing file")


def new(options: argparse.Namespace) -> int:
    """Write it; its path is printed."""
    with loading():
        from mbla.cli.starter import write_starter

    path = write_starter(options.name, kind=options.kind, replace=options.force)
    print(f"{path} written; run it with: mbla run {shlex.quote(str(path))}")
    return 0
