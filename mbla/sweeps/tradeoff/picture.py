"""Error against time on logarithmic scales, the Pareto front marked; one picture for each load case.

Drawn are the runs of the deck's own model that can be held against the reference, each by a number that the legend
names. Distances that are too small to be told lie on the line of the resolution.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, VERMILION, WARNING
from mbla.sweeps.tradeoff.trade import CaseTrade

ROOM = 2.0
"""factor of time and error left free around the points"""


def draw_trade(title: str, trade: CaseTrade, advised: str, path: Path) -> None:
    """Write the picture of one load case.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    rows = [n for n in np.flatnonzero(np.isfinite(trade.distance + trade.seconds)) if not trade.rungs[n].model]
    mark = "" if trade.reference_verified else "NOT VERIFIED: no run is verified that the others could be held against"
    with open_diagrams(path, PictureOptions(), [title, f"load case {trade.name}", advised], mark) as sheet:
        if not rows:
            return
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        dress(page, axes, "time of one load case [s]", "relative distance from the reference")
        times, errors = trade.seconds, np.maximum(trade.distance, trade.resolution)
        axes.set(xscale="log", xlim=(times[rows].min() / ROOM, times[rows].max() * ROOM))
        axes.set(yscale="log", ylim=(trade.resolution / ROOM, errors[rows].max() * ROOM))
        axes.axhline(trade.resolution, color=GHOST, linewidth=page.scale, linestyle="--", zorder=0)
        front = sorted(np.flatnonzero(trade.front), key=lambda n: times[n])
        style = {"color": VERMILION, "linewidth": 1.8 * page.scale, "zorder": 1}
        axes.plot(times[front], errors[front], drawstyle="steps-post", **style)
        handles = [page.line("Pareto front", **style), page.line("resolution", color=GHOST, linestyle="--")]
        for number, n in enumerate(rows, 1):
            colour = VERMILION if trade.front[n] else BLUE if trade.sound[n] else WARNING
            look = {"marker": f"${number}$", "color": colour, "linestyle": "none"}
            axes.plot(times[n], errors[n], markersize=(9 if number < 10 else 14) * page.scale, **look)
            handles.append(page.line(trade.rungs[n].name + ("" if trade.sound[n] else ", not verified"), **look))
        sheet.add_legend(handles)
