"""The README tells the truth: its deck runs and prints what it says, its commands and pictures exist."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from mbla.arguments import build_parser
from mbla.cli import main

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(start: str) -> str:
    """Text of the first code block after a piece of text."""
    return README.split(start, 1)[1].split("```", 2)[1].split("\n", 1)[1]


def test_the_deck_of_the_readme_prints_what_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wall.yaml").write_text(block("`wall.yaml`:"), encoding="utf-8")
    assert main(["run", "wall.yaml"]) == 0
    assert capsys.readouterr().out.splitlines() == block("`mbla run wall.yaml` prints").splitlines()
    written = {path.name for path in Path("wall.out").iterdir()}
    for name in re.findall(r"`(wall[\w.]+\.(?:lst|h5|json|sta|vtu|pvd))`", README):
        assert name in written


def test_python_of_the_readme_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the figures that its comments give; without output it leaves no files."""
    monkeypatch.chdir(tmp_path)
    Path("wall.yaml").write_text(block("`wall.yaml`:"), encoding="utf-8")
    names: dict[str, Any] = {}
    exec(block("<!-- python:begin -->"), names)
    push = names["push"]
    assert f"# {push.load_factor:.6g}, {push.verified};" in README
    assert push.mechanism.shape == (49, 6)
    assert push.contact_forces.shape == (460, 3)
    assert capsys.readouterr().out.startswith("push_x: collapses at 0.581056 g, verified: 7 hinges")
    assert [path.name for path in tmp_path.iterdir()] == ["wall.yaml"]


def test_commands_of_the_readme_are_those_of_the_program() -> None:
    commands = re.findall(r"^mbla ([\w-]+)", block("## Commands"), flags=re.MULTILINE)
    help_text = build_parser().format_help()
    listed = re.findall(r"^    ([\w-]+)(?: |$)", help_text, flags=re.MULTILINE)
    assert commands == listed


def test_links_and_pictures_exist() -> None:
    for target in re.findall(r"\]\(([^)#]+)\)", README):
        if not target.startswith("http"):
            assert (ROOT / target).exists(), target


def test_nothing_was_left_to_fill_in() -> None:
    assert not re.search(r"@[A-Z]+@", README)
