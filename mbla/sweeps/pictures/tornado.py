"""Tornado: which parameters a result depends on most, the greatest at the top.

Of samples: Spearman's rank correlation with its interval by Fisher's transformation, variance of Bonett and Wright,
Psychometrika 65 (2000) 23-28, doi:10.1007/BF02294183. Of grids: the change of the result from the least value of a
parameter to the greatest, and its range over all of them, at each combination of the other parameters.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from statistics import NormalDist

import numpy as np
from scipy.stats import rankdata

from mbla.arrays import FloatArray
from mbla.results.pictures.diagrams import dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, INK, VERMILION
from mbla.sweeps.answers import numbers_of, told_apart
from mbla.sweeps.pictures.sheet import open_sheet
from mbla.sweeps.pictures.view import Axis, View, design_columns
from mbla.sweeps.tables.sweep_table import SweepColumn

CONFIDENCE = 0.95
LEAST_POINTS = 10
"""points from which a correlation and its interval are worth a picture; the interval's variance needs more than 3"""
NOTE_OF_SAMPLE = (
    "bars: Spearman rank correlation over the points with a verified value; whiskers: 95% interval (Bonett and Wright) "
    "of independent points; bars of parameters that go together, by constraints or a zip, cannot be separated"
)
NOTE_OF_GRID = (
    "bars: mean change from the least to the greatest value of the parameter at each combination of the others; "
    "whiskers: least and most of these changes; range: over all its values, mean"
)


@dataclass(frozen=True)
class Bar:
    """What one parameter does to the result; nan where it is not known.

    value     : rank correlation, or mean change from the least value of the parameter to the greatest
    low, high : ends of the interval, or least and greatest of these changes
    size      : by which the bars are sorted
    words     : figures, next to the name
    """

    name: str
    value: float
    low: float
    high: float
    size: float
    words: str


def correlation(view: View, column: SweepColumn) -> Bar:
    """Rank correlation of the result with a parameter over the points with a verified value."""
    good = view.answers.good
    x, y = numbers_of(column, view.table[column.name])[good], told_apart(view.answers.values[good])
    rho = rank_correlation(x, y)
    if not np.isfinite(rho) or len(x) <= 3:
        return Bar(column.name, rho, np.nan, np.nan, abs(rho), "does not vary")
    reach = NormalDist().inv_cdf((1 + CONFIDENCE) / 2) * np.sqrt((1 + rho**2 / 2) / (len(x) - 3))
    low, high = np.tanh(np.arctanh(np.clip(rho, -1 + 1e-15, 1 - 1e-15)) + np.array([-reach, reach]))
    return Bar(column.name, rho, float(low), float(high), abs(rho), f"{rho:+.2f}")


def rank_correlation(x: FloatArray, y: FloatArray) -> float:
    """Spearman's coefficient of (n,) and (n,), equal values at their mean rank; nan where either does not vary."""
    if len(x) < 2 or np.ptp(x) == 0 or np.ptp(y) == 0:
        return float("nan")
    return float(np.corrcoef(rankdata(x), rankdata(y))[0, 1])


def swing(view: View, axis: Axis) -> Bar:
    """What a parameter of a grid does; combinations of the others in which a point is missing are left out."""
    others = [i for i, own in enumerate(view.table.dimensions) if own.name != axis.column.dimension]
    _, group = np.unique(view.table.position[:, others], axis=0, return_inverse=True)
    group = group.reshape(-1)
    result = np.full((int(group.max()) + 1, len(axis.levels)), np.nan)
    result[group, axis.place] = np.where(view.answers.good, view.answers.values, np.nan)
    own = told_apart(result[np.isfinite(result).all(axis=1)])
    name = f"{axis.label}, {axis.names[0]} to {axis.names[-1]}"
    if not len(own):
        return Bar(name, np.nan, np.nan, np.nan, np.nan, "not known")
    span = float(np.ptp(own, axis=1).mean())
    words = f"range {span:.3g} over {len(own)} of {len(result)} combinations"
    if axis.categorical or axis.column.role != "parameter":  # whose values have no order
        return Bar(f"{axis.label}, {len(axis.levels)} values", np.nan, np.nan, np.nan, span, words)
    change = own[:, -1] - own[:, 0]
    mean = float(change.mean())
    return Bar(name, mean, float(change.min()), float(change.max()), span, f"{mean:+.3g}, {words}")


def refusal(view: View) -> str:
    """Why there can be no tornado, or nothing."""
    if view.text_refused:
        return view.text_refused
    good = int(view.answers.good.sum())
    if view.sampled and good < LEAST_POINTS:
        return f"{good} points with a verified value; correlations of samples need {LEAST_POINTS}"
    if view.sampled:
        return "" if ordered(view) else "no parameter is a number that can be put in order"
    if not view.axes:
        return "no parameter has two values"
    known = any(np.isfinite(swing(view, axis).size) for axis in view.axes)
    return "" if known else "nowhere has every value of a parameter a verified result, the others kept"


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    if view.sampled:
        bars, along = [correlation(view, column) for column in ordered(view)], "rank correlation with"
    else:
        bars, along = [swing(view, axis) for axis in view.axes], "change of"
    notes = [NOTE_OF_SAMPLE if view.sampled else NOTE_OF_GRID]
    bars.sort(key=lambda bar: np.nan_to_num(-bar.size, nan=1.0))
    whiskers = not view.sampled or len(view.table.dimensions) == 1  # samples repeated over a grid are not independent
    with open_sheet(path, view, f"{view.answers.label}: sensitivity to parameters", options, None, notes) as sheet:
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        dress(page, axes, f"{along} {view.answers.label}")
        style = {"color": INK, "marker": "|", "markersize": 9 * page.scale, "linewidth": 1.4 * page.scale, "zorder": 3}
        for row, bar in enumerate(bars):
            value = np.nan_to_num(bar.value)
            axes.barh(row, value, color=VERMILION if value < 0 else BLUE, height=0.6, zorder=2)
            if whiskers and np.isfinite(bar.low):
                axes.plot([bar.low, bar.high], [row, row], **style)
        axes.margins(x=0.12)
        axes.axvline(0.0, color=INK, linewidth=page.scale, zorder=4)
        axes.set_ylim(len(bars) - 0.4, -0.6)
        axes.set_yticks(range(len(bars)), [f"{bar.name}\n{bar.words}" for bar in bars], parse_math=False)
        axes.grid(visible=False, axis="y")


def ordered(view: View) -> list[SweepColumn]:
    """Parameters whose values have an order: no texts, no directions."""
    columns = design_columns(view.table)
    return [column for column in columns if column.role == "parameter" and column.kind in ("float", "int")]
