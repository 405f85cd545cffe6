"""Tornado: which parameters a result depends on most, the greatest at the top.

Of samples: Spearman's rank correlation with its interval by Fisher's transformation, variance of Bonett and Wright,
Psychometrika 65 (2000) 23-28, doi:10.1007/BF02294183. Of grids: the change of the result from the least value of a
parameter to the greatest, and its range over all of them, at each combination of the other parameters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
from scipy.stats import rankdata

from mbla.arrays import FloatArray
from mbla.results.pictures.diagrams import dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, INK, VERMILION, Page
from mbla.sweeps.answers import numbers_of, told_apart
from mbla.sweeps.pictures.sheet import open_sheet
from mbla.sweeps.pictures.view import Axis, View, design_columns
from mbla.sweeps.tables.sweep_table import SweepColumn

CONFIDENCE = 0.95
LEAST_POINTS = 10
"""points from which a correlation and its interval are worth a picture; the interval's variance needs more than 3"""


@dataclass(frozen=True)
class Correlation:
    """Rank correlation with one parameter, nan where either does not vary; its interval; points with a value."""

    name: str
    value: float
    low: float
    high: float
    points: int


@dataclass(frozen=True)
class Swing:
    """What one parameter of a grid does to the result.

    change : mean change from its least value to its greatest; nan where its values have no order
    least, most : of that change among the combinations of the others; nan where it is
    span : mean of greatest less least result over its values
    combinations : of the other parameters that have a verified value at each value of this one
    left_out : the other combinations
    """

    name: str
    change: float
    least: float
    most: float
    span: float
    combinations: int
    left_out: int


def correlation(view: View, column: SweepColumn) -> Correlation:
    """Rank correlation of the result with a parameter over the points with a verified value."""
    x, y = numbers_of(column, view.table[column.name]), view.answers.values
    good = view.answers.good & np.isfinite(x)
    count = int(good.sum())
    rho = rank_correlation(x[good], told_apart(y[good]))
    if not np.isfinite(rho) or count <= 3:
        return Correlation(column.name, rho, np.nan, np.nan, count)
    reach = NormalDist().inv_cdf((1 + CONFIDENCE) / 2) * np.sqrt((1 + rho**2 / 2) / (count - 3))
    low, high = np.tanh(np.arctanh(np.clip(rho, -1 + 1e-15, 1 - 1e-15)) + np.array([-reach, reach]))
    return Correlation(column.name, rho, float(low), float(high), count)


def rank_correlation(x: FloatArray, y: FloatArray) -> float:
    """Spearman's coefficient of (n,) and (n,), equal values at their mean rank; nan where either does not vary."""
    if len(x) < 2 or np.ptp(x) == 0 or np.ptp(y) == 0:
        return float("nan")
    return float(np.corrcoef(rankdata(x), rankdata(y))[0, 1])


def swing(view: View, axis: Axis) -> Swing:
    """What a parameter of a grid does; combinations of the others in which a point is missing are left out."""
    others = [i for i, own in enumerate(view.table.dimensions) if own.name != axis.column.dimension]
    _, group = np.unique(view.table.position[:, others], axis=0, return_inverse=True)
    group = group.reshape(-1)
    result = np.full((int(group.max()) + 1, len(axis.levels)), np.nan)
    result[group, axis.place] = np.where(view.answers.good, view.answers.values, np.nan)
    own = told_apart(result[np.isfinite(result).all(axis=1)])
    if not len(own):
        return Swing(axis.column.name, np.nan, np.nan, np.nan, np.nan, 0, len(result))
    ordered = not axis.categorical and axis.column.role == "parameter"
    change = own[:, -1] - own[:, 0] if ordered else np.array([np.nan])
    ends = float(change.min()), float(change.max()), float(np.ptp(own, axis=1).mean())
    return Swing(axis.column.name, float(change.mean()), *ends, len(own), len(result) - len(own))


INTERVAL = f"{CONFIDENCE:.0%} interval"


def refusal(view: View) -> str:
    """Why there can be no tornado, or nothing."""
    if view.text_refused:
        return view.text_refused
    if view.sampled:
        good = int(view.answers.good.sum())
        if good < LEAST_POINTS:
            return f"{good} points with a verified value; correlations of samples need {LEAST_POINTS}"
        return "" if _ordered(view) else "no parameter is a number that can be put in order"
    if not view.axes:
        return "no parameter has two values"
    if not any(each.combinations for each in _swings(view)):
        return "nowhere has every value of a parameter a verified result, the others kept"
    return ""


def usual(view: View) -> bool:
    """Whether it is drawn without being asked for: of one parameter there is nothing to compare."""
    return not refusal(view) and len(_ordered(view) if view.sampled else view.axes) > 1


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    bars, along, notes = _correlation_bars(view) if view.sampled else _swing_bars(view)
    with open_sheet(path, view, f"{view.answers.label}: sensitivity to parameters", options, None, notes) as sheet:
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        dress(page, axes, f"{along} {view.answers.label}")
        style = {"color": INK, "marker": "|", "markersize": 9 * page.scale, "linewidth": 1.4 * page.scale, "zorder": 3}
        for row, bar in enumerate(bars):
            value = np.nan_to_num(bar.value)
            axes.barh(row, value, color=VERMILION if value < 0 else BLUE, height=0.6, zorder=2)
            if np.isfinite(bar.low) and np.isfinite(bar.high):
                axes.plot([bar.low, bar.high], [row, row], **style)
        axes.margins(x=0.12)
        _name_rows(page, axes, bars)


@dataclass(frozen=True)
class Bar:
    """A row: its name at the left, figures at the right, a bar with whiskers; nan for none."""

    name: str
    words: str
    value: float
    low: float
    high: float


def _ordered(view: View) -> list[SweepColumn]:
    """Parameters whose values have an order: no texts, no directions."""
    columns = design_columns(view.table)
    return [column for column in columns if column.role == "parameter" and column.kind in ("float", "int")]


def _swings(view: View) -> list[Swing]:
    return [swing(view, axis) for axis in view.axes]


def _correlation_bars(view: View) -> tuple[list[Bar], str, list[str]]:
    """Rows of a sample, what they show of the result, and notes."""
    found = [correlation(view, column) for column in _ordered(view)]
    found.sort(key=lambda each: np.nan_to_num(-abs(each.value), nan=1.0))
    repeated = len(view.table.dimensions) > 1  # samples that are repeated over a grid are not independent
    notes = [f"bars: Spearman rank correlation over {found[0].points} points with a verified value"]
    notes += [f"whiskers: {INTERVAL} (Bonett and Wright), which takes the points as independent"] * (not repeated)
    notes += _tangled(view)
    bars = []
    for each in found:
        words = "does not vary" if np.isnan(each.value) else f"{each.value:+.2f}"
        low, high = (np.nan, np.nan) if repeated else (each.low, each.high)
        bars.append(Bar(each.name, words, each.value, low, high))
    return bars, "rank correlation with", notes


LEAST_TANGLED = 0.3
"""rank correlation of two parameters with each other from which what each does cannot be told by this picture"""


def _tangled(view: View) -> list[str]:
    """A warning where parameters of the sample go together, as constraints and zipped lists make them."""
    columns = _ordered(view)
    good = view.answers.good
    together = []
    for i, first in enumerate(columns):
        for second in columns[i + 1 :]:
            one, other = (np.asarray(view.table[column.name], dtype=float)[good] for column in (first, second))
            if abs(rank_correlation(one, other)) > LEAST_TANGLED:
                together.append(f"{first.name} with {second.name}")
    return [f"parameters that go together, so that their bars cannot be told apart: {', '.join(together)}"] * bool(
        together
    )


def _swing_bars(view: View) -> tuple[list[Bar], str, list[str]]:
    """The same of a grid."""
    found = sorted(_swings(view), key=lambda each: np.nan_to_num(-each.span, nan=1.0))
    notes = [
        "bars: mean change from the least to the greatest value of the parameter at each combination of the others; "
        "whiskers: least and most of these changes; range: over all its values, mean"
    ]
    left = [f"{each.name} {each.left_out} of {each.left_out + each.combinations}" for each in found if each.left_out]
    if left:
        notes.append(f"combinations left out as a point has no verified value: {', '.join(left)}")
    bars = [Bar(_ends(view, each), _swing_words(each), each.change, each.least, each.most) for each in found]
    return bars, "change of", notes


def _name_rows(page: Page, axes: Any, bars: Sequence[Bar]) -> None:
    """Names at the left, figures at the right, the first row at the top."""
    axes.axvline(0.0, color=INK, linewidth=page.scale, zorder=4)
    axes.set_ylim(len(bars) - 0.4, -0.6)
    axes.set_yticks(range(len(bars)), [bar.name for bar in bars], parse_math=False)
    axes.grid(visible=False, axis="y")
    other = axes.twinx()
    other.set_ylim(axes.get_ylim())
    other.set_yticks(range(len(bars)), [bar.words for bar in bars], parse_math=False)
    other.tick_params(labelsize=page.small, colors=INK, length=0)
    other.spines[["top", "right", "bottom", "left"]].set_visible(False)


def _swing_words(found: Swing) -> str:
    if not found.combinations:
        return "not known"
    return f"range {found.span:.3g}" if np.isnan(found.change) else f"{found.change:+.3g}, range {found.span:.3g}"


def _ends(view: View, found: Swing) -> str:
    """Name of a parameter with its least and greatest value, or the number of values that have no order."""
    axis = next(axis for axis in view.axes if axis.column.name == found.name)
    if np.isnan(found.change):
        return f"{axis.label}\n{len(axis.levels)} values"
    return f"{axis.label}\n{axis.names[0]} to {axis.names[-1]}"
