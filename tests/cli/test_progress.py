"""What a terminal shows while the command line works, and that nothing shows elsewhere."""

from __future__ import annotations

import sys
from types import SimpleNamespace
from typing import Any

import pytest

from mbla.cli import decks, study_commands


def shown(monkeypatch: pytest.MonkeyPatch, module: Any, *, terminal: bool = True) -> list[str]:
    """Texts that a module writes over each other."""
    texts: list[str] = []
    monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal, raising=False)
    monkeypatch.setattr(module, "rewrite_line", texts.append)
    return texts


def test_iterations_of_a_load_case(monkeypatch: pytest.MonkeyPatch) -> None:
    texts = shown(monkeypatch, decks)
    show = decks._progress()
    assert show is not None
    show("push", SimpleNamespace(program=2, iteration=7, load_factor=0.123456789))  # type: ignore[arg-type]
    assert texts == ["push: program 2, iteration 7, load factor 0.123457"]


def test_points_and_settings_of_a_study(monkeypatch: pytest.MonkeyPatch) -> None:
    texts = shown(monkeypatch, study_commands)
    show = study_commands._progress("points")
    assert show is not None
    show(3, 24)
    assert texts == ["3 of 24 points"]


def test_nothing_off_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    shown(monkeypatch, study_commands, terminal=False)
    assert study_commands._progress("settings") is None
    assert decks._progress() is None
