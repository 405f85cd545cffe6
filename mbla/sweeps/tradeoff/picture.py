"""Error against time on logarithmic scales, the Pareto front marked; one picture for each load case.

Drawn are the runs of the deck's own model that can be held against the reference, each by a number that the legend
names. Distances that are too small to be told lie on the line of the resolution.
"""

from __future__ import annotations

import math
from pathlib import Path

from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, VERMILION, WARNING
from mbla.sweeps.tradeoff.trade import CaseTrade, Row

ROOM = 2.0
"""factor of time and error left free around the points"""


def draw_trade(title: str, trade: CaseTrade, advised: str, path: Path) -> None:
    """Write the picture of one load case.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    rows = [row for row in trade.rows if not row.rung.model and not math.isnan(row.distance + row.seconds)]
    mark = "" if trade.verified else "NOT VERIFIED: no run is verified that the others could be held against"
    with open_diagrams(path, PictureOptions(), [title, f"load case {trade.name}", advised], mark) as sheet:
        if not rows:
            return
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        dress(page, axes, "time of one load case [s]", "relative distance from the reference")
        places = [(row.seconds, max(row.distance, trade.resolution)) for row in rows]
        times, errors = zip(*places, strict=True)
        axes.set(xscale="log", xlim=(min(times) / ROOM, max(times) * ROOM))
        axes.set(yscale="log", ylim=(trade.resolution / ROOM, max(errors) * ROOM))
        axes.axhline(trade.resolution, color=GHOST, linewidth=page.scale, linestyle="--", zorder=0)
        front = sorted(place for row, place in zip(rows, places, strict=True) if row.front)
        style = {"color": VERMILION, "linewidth": 1.8 * page.scale, "zorder": 1}
        axes.plot([x for x, _ in front], [y for _, y in front], drawstyle="steps-post", **style)
        handles = [page.line("Pareto front", **style), page.line("resolution", color=GHOST, linestyle="--")]
        for number, (row, (x, y)) in enumerate(zip(rows, places, strict=True), 1):
            look = {"marker": f"${number}$", "color": _colour(row), "linestyle": "none"}
            axes.plot([x], [y], markersize=(9 if number < 10 else 14) * page.scale, **look)
            handles.append(page.line(row.rung.name + ("" if row.sound else ", not verified"), **look))
        sheet.add_legend(handles)


def _colour(row: Row) -> str:
    return VERMILION if row.front else BLUE if row.sound else WARNING
