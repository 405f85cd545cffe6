"""Run a deck given as a tree, as a user would, and read what comes out."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from tests.properties.random_items import Tree


@dataclass(frozen=True)
class Run:
    """Exit status, the object of ``--json`` (empty where there is none), and what went to standard error."""

    code: int
    record: dict[str, Any]
    errors: str

    @property
    def cases(self) -> list[dict[str, Any]]:
        """Load cases of the record."""
        found: list[dict[str, Any]] = self.record.get("cases", [])
        return found


def write_deck(deck: Tree, folder: Path, name: str = "deck") -> Path:
    """The deck as a file; JSON is YAML."""
    path = folder / f"{name}.yaml"
    path.write_text(json.dumps(deck), encoding="utf-8")
    return path


def run_deck(path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """What ``mbla run --json --force`` makes of it."""
    code = main(["run", str(path), "--json", "--force"])
    streams = capsys.readouterr()
    record = json.loads(streams.out, parse_constant=_refuse) if streams.out else {}
    return Run(code, record, streams.err)


def _refuse(name: str) -> None:
    raise AssertionError(f"{name} is no JSON")
