"""``mbla new``."""

from __future__ import annotations

import argparse
import shlex
from typing import Any

from mbla.cli.starters import KINDS, write_starter


def add(commands: Any) -> None:
    """The command and its options."""
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
    path = write_starter(options.name, kind=options.kind, replace=options.force)
    print(f"{path} written; run it with: mbla run {shlex.quote(str(path))}")
    return 0
