"""Every faulty deck through the command line: exit status 3, messages with places, nothing written, no traceback."""

from __future__ import annotations

import json
import os
import re
import shutil
from pathlib import Path

import pytest

from mbla.cli import main

FOLDER = Path(__file__).parents[1] / "invalid_decks"
DECKS = sorted(path.name for path in FOLDER.glob("*.yaml"))
PLACED = re.compile(r"\S+\.(yaml|obj|step):[1-9]\d*:[1-9]\d* \S.*  \[[a-z0-9-]+\]")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of all faulty decks with the files they name."""
    copy = tmp_path_factory.mktemp("faulty") / "decks"
    shutil.copytree(FOLDER, copy)
    return copy


def contents(folder: Path) -> dict[str, tuple[int, int] | None]:
    """Everything below a folder, and of a file its node and time of last change, which no write leaves as they are."""
    found: dict[str, tuple[int, int] | None] = {}
    for where, folders, files in os.walk(folder):
        found |= {f"{where}/{name}": None for name in folders}
        for path in (Path(where, name) for name in files):
            seen = path.stat()
            found[str(path)] = (seen.st_ino, seen.st_ctime_ns)
    return found


def test_there_are_decks_of_both_stages() -> None:
    assert len(DECKS) >= 60
    assert {name.split("_")[0] for name in DECKS} == {"deck", "model"}


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("name", DECKS)
def test_a_faulty_deck_is_refused_and_leaves_nothing(
    folder: Path, name: str, command: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    before = contents(folder.parent)
    assert main([command, name]) == 3
    captured = capsys.readouterr()
    assert captured.out == ""
    lines = captured.err.splitlines()
    assert lines
    for line in lines:
        assert PLACED.fullmatch(line), line
    assert contents(folder.parent) == before


@pytest.mark.parametrize("name", DECKS)
def test_the_same_messages_as_json(
    folder: Path, name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    assert main(["run", name, "--json"]) == 3
    captured = capsys.readouterr()
    (record,) = [json.loads(line) for line in captured.out.splitlines()]
    assert record["exit_code"] == 3
    assert record["deck"] == name
    assert record["errors"] == captured.err.splitlines()
