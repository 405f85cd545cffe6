"""The deck that ``mbla new`` writes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mbla.cli import main


def test_new_writes_a_deck_that_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "house"]) == 0
    assert main(["new", "house"]) == 6
    assert main(["run", "house.yaml", "-q"]) == 0
    assert (tmp_path / "house.out" / "house.h5").is_file()


def test_new_points_editors_to_the_schema(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "a b"]) == 0
    first = Path("a b.yaml").read_text().splitlines()[0]
    address = first.removeprefix("# yaml-language-server: $schema=")
    assert json.loads(Path(address.removeprefix("file://")).read_text())["title"]
    assert "mbla run 'a b.yaml'" in capsys.readouterr().out
    assert main(["new", "missing/x"]) == 6
    assert "no folder missing" in capsys.readouterr().err
