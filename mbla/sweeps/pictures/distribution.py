"""Distribution of a result over a sample: histogram, and cumulative curve with its confidence band.

The band is that of Dvoretzky, Kiefer and Wolfowitz with the constant of Massart, Ann. Probab. 18 (1990) 1269-1283,
doi:10.1214/aop/1176990746: the entire curve of the population lies in it with the confidence stated, for independent
points. What does not stand counts below every value, what nothing brings down above; what failed is unknown: the lower
edge of the band takes it as above, the upper edge as below.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.pictures.diagrams import dress, tint
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import VERMILION, Page
from mbla.sweeps.answers import Answers
from mbla.sweeps.pictures.sheet import open_sheet
from mbla.sweeps.pictures.view import ResultView, axis_of, column_by_name, grid_axes, is_sampled

CONFIDENCE = 0.95
MOST_CURVES = 12
"""curves of which each can be found again; more ask for one parameter with --by"""


@dataclass(frozen=True)
class Cumulative:
    """A cumulative curve.

    values : verified ones, ascending
    share  : of all points that lie at or below each of them
    low, high : edges of the band there
    below, above, unknown : points below every value, above every value, and without an answer
    points : all
    """

    values: FloatArray
    share: FloatArray
    low: FloatArray
    high: FloatArray
    below: int
    above: int
    unknown: int
    points: int


def refusal(view: ResultView) -> str:
    """Why there can be no distribution, or nothing."""
    if view.text_refused:
        return view.text_refused
    count = len(_groups(view))
    if count > MOST_CURVES:
        return f"{count} combinations of the other parameters; {MOST_CURVES} have room, choose one with --by"
    return "" if view.answers.good.any() else "no point has a verified value"


def cumulative(answers: Answers, own: BoolArray, band: bool = True) -> Cumulative:
    """The curve of some points, (n_points,) true for those; without a band its edges show only what is unknown."""
    values = np.sort(answers.values[own & answers.good])
    below, above, unknown = (int((which & own).sum()) for which in (answers.below, answers.above, answers.unknown))
    points = int(own.sum())
    reach = float(np.sqrt(np.log(2 / (1 - CONFIDENCE)) / (2 * points))) if band else 0.0
    least = (below + np.searchsorted(values, values, side="right")) / points
    share = least * points / max(points - unknown, 1)
    low, high = np.clip(least - reach, 0, 1), np.clip(least + unknown / points + reach, 0, 1)
    return Cumulative(values, share, low, high, below, above, unknown, points)


def draw(path: Path, view: ResultView, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    groups, sampled, answers = _groups(view), bool(view.table.samples), view.answers
    curves = [cumulative(answers, own, sampled) for _, own in groups]

    def handles(page: Page) -> list[Any]:
        lines = [
            page.line(name, linewidth=2 * page.scale, **_style(page, i, len(groups)))
            for i, (name, _) in enumerate(groups)
            if name
        ]
        return lines + [page.line("demand", color=VERMILION, linestyle="--")] * bool(view.demands)

    what = f"distribution of {answers.label}"
    with open_sheet(path, view, what, options, handles, _notes(view, curves)) as sheet:
        page = sheet.page
        upper, lower = sheet.frames(2, columns=1, sharex=True, height_ratios=(2, 3))[:, 0]
        dress(page, upper, "", "points")
        dress(page, lower, answers.label, "probability of a lower value" if sampled else "share of the points")
        edges = np.histogram_bin_edges(answers.values[answers.good], bins="auto")
        for i, ((_, own), curve) in enumerate(zip(groups, curves, strict=True)):
            style = _style(page, i, len(groups)) | {"linewidth": 1.8 * page.scale}
            upper.hist(answers.values[own & answers.good], bins=edges, histtype="step", **style)
            _draw_curve(lower, curve, style)
        lower.set_ylim(-0.02, 1.02)
        for demand in view.demands:
            for axes in (upper, lower):
                axes.axvline(demand, color=VERMILION, linestyle="--", linewidth=1.4 * page.scale, zorder=2)


def _groups(view: ResultView) -> list[tuple[str, BoolArray]]:
    """Points of each value of the chosen parameter, or of each combination of those that are not sampled."""
    table = view.table
    axes = grid_axes(table) if view.sampled else ()
    if view.by and not is_sampled(table, column_by_name(table, view.by).dimension):
        axes = (axis_of(table, column_by_name(table, view.by)),)
    groups: dict[str, list[int]] = {}
    for row, places in enumerate(zip(*(axis.place for axis in axes), strict=True)):
        names = (
            f"{axis.column.name} {axis.names[at]} {axis.column.unit}" for axis, at in zip(axes, places, strict=True)
        )
        groups.setdefault(", ".join(map(str.strip, names)), []).append(row)
    return [(name, np.isin(np.arange(len(table)), rows)) for name, rows in groups.items()] or [
        ("", np.ones(len(table), dtype=bool))
    ]


def _style(page: Page, number: int, count: int) -> dict[str, Any]:
    colour = tint(page, number, count) if count > 1 else tint(page, 3, 11)
    return {"color": colour, "linestyle": ("-", "--", "-.", ":")[number % 4]}


def _draw_curve(axes: Any, curve: Cumulative, style: dict[str, Any]) -> None:
    """Steps from what lies below every value to what lies not above the greatest."""
    if not len(curve.values):
        return
    start = curve.below / max(curve.points - curve.unknown, 1)
    steps = np.append(curve.values[0], curve.values), np.append(start, curve.share)
    axes.plot(*steps, drawstyle="steps-post", zorder=3, **style)
    band = {"step": "post", "alpha": 0.2, "color": style["color"], "linewidth": 0.0, "zorder": 1}
    axes.fill_between(curve.values, curve.low, curve.high, **band)


def _notes(view: ResultView, curves: Sequence[Cumulative]) -> list[str]:
    notes = ["points of no random sample: shares of the points, no probabilities"]
    if view.table.samples:
        kind = view.table.sampling.replace("_", " ")
        notes = [
            f"{kind} sample; band: {CONFIDENCE:.0%} for the entire curve of independent points, as random ones are "
            "(Dvoretzky-Kiefer-Wolfowitz)"
        ]
    if any(curve.below or curve.above for curve in curves):
        notes.append("no equilibrium counts below every value, unbounded above every value")
    if any(curve.unknown for curve in curves):
        notes.append("line: over the points with an answer; the band takes those without one as below and as above")
    return notes
