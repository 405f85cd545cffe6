"""Fragility: over a parameter the share of a sample that reaches a limit, with its interval, and the lognormal curve.

A line for each limit, a diagram for each combination of the parameters that are neither the sample nor this one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.diagrams import dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import Page
from mbla.sweeps.fragility import VALUES
from mbla.sweeps.fragility_curve import probability
from mbla.sweeps.pictures.sheet import line_style, open_sheet
from mbla.sweeps.pictures.view import MOST_PANELS, ResultView, value_words

SMOOTH = 200
"""points of a curve"""
BESIDE = 0.006
"""of the width of a diagram, by which marks of limits stand beside each other"""


@dataclass(frozen=True)
class Shares:
    """Of one limit in one diagram.

    limit : in words
    at    : values of the other parameters
    x     : (n,) of the parameter, ascending
    share, low, high : (n,) middle of the fractions with unknown points on either side, ends of the interval
    median, dispersion : of the curve; nan without one
    """

    limit: str
    at: Mapping[str, Any]
    x: FloatArray
    share: FloatArray
    low: FloatArray
    high: FloatArray
    median: float
    dispersion: float


def refusal(view: ResultView) -> str:
    """Why there can be no fragility, or nothing."""
    if not view.curves:
        return "the sweep asks for no fragility of limits over a parameter"
    count = len({str(one["at"]) for one in view.curves})
    return f"{count} combinations of the other parameters; {MOST_PANELS} have room" if count > MOST_PANELS else ""


def shares(view: ResultView) -> list[Shares]:
    """Each limit in each diagram, in the order of the sweep file."""
    found, unit = [], f" {view.answers.column.unit}".rstrip()
    for curve in view.curves:
        at, over, limit = curve["at"], curve["over"], curve["limit"]
        own = [one for one in view.shares if {**one["at"], over: None} == {**at, over: None}]
        own.sort(key=lambda one: float(one["at"][over]))
        each = [next(one for one in each["limits"] if one["limit"] == limit) for each in own]
        low, high = np.array([one["interval"] for one in each]).T
        words = limit if isinstance(limit, str) else f"{value_words(limit)}{unit}"
        fitted = [np.nan if curve[name] is None else float(curve[name]) for name in ("median", "dispersion")]
        x, share = [float(one["at"][over]) for one in own], [float(np.mean(one["probability"])) for one in each]
        found.append(Shares(words, at, np.array(x), np.array(share), low, high, *fitted))
    return found


def draw(path: Path, view: ResultView, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    found = shares(view)
    limits = list(dict.fromkeys(each.limit for each in found))
    panels = list({str(each.at): each.at for each in found}.values())
    (over,) = (column for column in view.table.columns if column.name == view.curves[0]["over"])

    def handles(page: Page) -> list[Any]:
        return [page.line(limit, **_style(page, row, limits)) for row, limit in enumerate(limits)]

    what = f"share of the sample whose {view.answers.label} reaches a limit, over {over.header}"
    with open_sheet(path, view, what, options, handles, _notes(view)) as sheet:
        frames = sheet.frames(len(panels), sharex=True, sharey=True)
        for axes, at in zip(frames.flat, panels, strict=False):
            title = ", ".join(f"{name} {value_words(value)}" for name, value in at.items())
            dress(sheet.page, axes, over.header, "share", title)
            for each in (each for each in found if each.at == at):
                row = limits.index(each.limit)
                beside = BESIDE * (row - 0.5 * (len(limits) - 1)) * float(np.ptp(each.x))
                _draw(axes, each, beside, _style(sheet.page, row, limits))
            axes.set_ylim(-0.02, 1.02)
            axes.label_outer()


def _style(page: Page, row: int, limits: Sequence[str]) -> dict[str, Any]:
    return line_style(page, row, len(limits))


def _draw(axes: Any, each: Shares, beside: float, style: Mapping[str, Any]) -> None:
    """Shares as marks with their intervals, some way beside their place, and the curve from the least value on."""
    bars = np.array([each.share - each.low, each.high - each.share])
    marks = dict(style) | {"linestyle": "none"}
    axes.errorbar(
        each.x + beside, each.share, yerr=np.maximum(bars, 0.0), capsize=3.0, elinewidth=0.8, zorder=3, **marks
    )
    if np.isfinite(each.median):
        x = np.linspace(each.x[0], each.x[-1], SMOOTH)
        line = dict(style) | {"marker": ""}
        axes.plot(x, probability(x, each.median, each.dispersion), zorder=2, **line)


def _notes(view: ResultView) -> list[str]:
    one = view.shares[0]
    kind = "values of a list, each counted alike" if one["sampling"] == VALUES else f"{one['sampling']} sample"
    notes = [f"{kind}; bars: {one['confidence']:.0%} of Clopper and Pearson; lines: lognormal curves by likelihood"]
    if any(curve["median"] is None for curve in view.curves):
        notes.append("no line where no point reaches the limit at less than another stands at")
    return notes
