"""Figures as they were when they were written."""

from __future__ import annotations

from typing import Any

import pytest


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Figures written during a test, in order."""
    figure = pytest.importorskip("matplotlib.figure").Figure
    seen: list[Any] = []
    write = figure.savefig

    def savefig(self: Any, *arguments: Any, **options: Any) -> None:
        write(self, *arguments, **options)
        seen.append(self)

    monkeypatch.setattr(figure, "savefig", savefig)
    return seen
