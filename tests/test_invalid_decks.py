"""Every deck of tests/invalid_decks is refused where and why its table says, before anything is solved.

The sentences are in one file, and may be mended there: ``python -m tests.faulty_decks --update``.
"""

from __future__ import annotations

import json
import os
import re
import shutil
from pathlib import Path

import pytest

from mbla.assembly import build_assembly
from mbla.cli import main
from mbla.deck import read_deck
from mbla.model import build_model
from tests.deck.decks import write
from tests.faulty_decks import DECKS, FOLDER, SENTENCES, refusal_of, sentences
from tests.faulty_files import place_and_kind, table_of

PLACED = re.compile(r"\S+\.yaml:[1-9]\d*:[1-9]\d* \S.*  \[[a-z0-9-]+\]")
OF_EACH_STAGE = ("deck_147_many_faults.yaml", "model_028_several_faults.yaml", "model_262_boxes_in_one_place.yaml")
"""refused by its types and references, by the model, by the search for contacts"""


def test_there_are_enough() -> None:
    assert len(DECKS) >= 400


@pytest.mark.parametrize("base", table_of(SENTENCES.parent)["bases"].values())
def test_a_base_is_a_deck(base: str, tmp_path: Path) -> None:
    deck = read_deck(write(tmp_path, base))
    build_assembly(deck, build_model(deck))


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_places_and_reasons(path: Path) -> None:
    stage, error = refusal_of(path)
    expected = DECKS[path].faults
    assert expected, "a faulty deck says what is expected of it"
    assert tuple(place_and_kind(fault, path) for fault in error.faults) == expected
    assert path.stem.startswith(stage)


def test_sentences() -> None:
    assert sentences() == SENTENCES.read_text(encoding="utf-8")


def contents(folder: Path) -> dict[str, tuple[int, int] | None]:
    """Everything below a folder, and of a file its node and time of last change, which no write leaves as they are."""
    found: dict[str, tuple[int, int] | None] = {}
    for where, folders, files in os.walk(folder):
        found |= {f"{where}/{name}": None for name in folders}
        for path in (Path(where, name) for name in files):
            seen = path.stat()
            found[str(path)] = (seen.st_ino, seen.st_ctime_ns)
    return found


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("name", OF_EACH_STAGE)
def test_the_command_line_refuses_and_leaves_nothing(
    tmp_path: Path, name: str, command: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(FOLDER, tmp_path / "decks")
    monkeypatch.chdir(tmp_path / "decks")
    before = contents(tmp_path)
    assert main([command, name]) == 3
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == ""
    assert all(PLACED.fullmatch(line) for line in lines)
    assert contents(tmp_path) == before
    assert main([command, name, "--json"]) == 3
    captured = capsys.readouterr()
    record = json.loads(captured.out)
    assert captured.err.splitlines() == lines == record["errors"]
    assert (record["exit_code"], record["deck"]) == (3, name)
