"""Pictures of tables made by hand, and what stands in them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.pictures.plot import SweepPictures, plot_sweep
from mbla.sweeps.tables.sweep_table import SweepTable

SMALL = PictureOptions(size=(800, 500))


def draw(table: SweepTable, folder: Path, kind: str, **changes: Any) -> None:
    """A picture of one kind, small unless ``page`` says otherwise."""
    plot_sweep(table, folder, SweepPictures((kind,), **{"page": SMALL} | changes))


def lines_with(axes: Any, marker: str) -> list[Any]:
    """Lines of hollow markers of a kind."""
    return [line for line in axes.lines if line.get_marker() == marker and line.get_markerfacecolor() == "none"]


def words(figure: Any) -> str:
    """Title, counts and notes."""
    return " ".join(" ".join(text.get_text() for text in figure.texts).split())


def names_along(axes: Any, which: str) -> list[str]:
    """Names at the ticks along ``x`` or ``y``."""
    return [text.get_text() for text in getattr(axes, f"get_{which}ticklabels")()]
