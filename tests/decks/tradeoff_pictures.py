"""The pictures of decks/tradeoff/README.md: error of the presets against their time over the standard set."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GREEN, INK, VERMILION, add_words, open_page
from tests.decks.tradeoff_record import FOLDER, Entry
from tests.decks.tradeoff_text import RULES
from tests.performance.standard_set import FLOW_RULES

LOOKS = {"draft": ("^", VERMILION), "standard": ("o", BLUE), "reference": ("s", GREEN)}
PROMISED = {"draft": 1e-2, "standard": 1e-4, "reference": 1e-7}
"""errors that the presets promise"""
SIZE = (1200, 760)


def write_pictures(entries: Sequence[Entry], folder: Path = FOLDER) -> None:
    """One PNG for each flow rule."""
    for rule in FLOW_RULES:
        own = [entry for entry in entries if entry.flow_rule == rule]
        if own:
            draw_presets(folder / f"presets_{rule}.png", own, RULES[rule])


def draw_presets(path: Path, entries: Sequence[Entry], rule: str) -> None:
    """Verified runs of the presets, one point for each structure; the promised errors as lines."""
    with open_page(path, PictureOptions(size=SIZE)) as page:
        above = add_words(page, [f"Presets over the standard set, {rule}", "verified runs; lines: promised errors"])
        axes = page.figure.add_axes((0.1, 0.12, 0.87, 0.86 - above))
        axes.set_xscale("log")
        axes.set_yscale("log")
        for preset, (marker, colour) in LOOKS.items():
            chosen = [e for e in entries if e.rung == f"accuracy: {preset}" and e.verified and e.error == e.error]
            axes.axhline(PROMISED[preset], color=colour, linewidth=1.0, linestyle="--")
            look = {"linestyle": "none", "marker": marker, "color": colour, "markerfacecolor": "none"}
            axes.plot([e.time for e in chosen], [e.error for e in chosen], markersize=8, label=preset, **look)
        axes.tick_params(labelsize=0.85 * page.letter, colors=INK)
        axes.grid(visible=True, color="#DDDDDD", linewidth=0.6)
        axes.set_xlabel("time of one load case [s]", fontsize=0.9 * page.letter, color=INK)
        axes.set_ylabel("relative distance from the reference", fontsize=0.9 * page.letter, color=INK)
        axes.legend(fontsize=0.85 * page.letter, framealpha=0.9, loc="best")
