"""What a picture of a sweep is made from: one result of its table, axes of parameters, points of equal values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.suggestions import unknown
from mbla.errors import UsageError
from mbla.sweeps.answers import Answer, Answers, answers_of, numbers_of
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable

WIDE = 30.0
"""greatest by least value from which an axis of positive values is logarithmic"""
DIRECTIONS = ("azimuth", "elevation")


@dataclass(frozen=True)
class ParameterAxis:
    """A parameter with its values.

    levels  : numbers ascending; texts in the order of the design
    place   : (n_points,) which of them each point has
    log     : the values are far apart
    partners: parameters that change together with it
    """

    column: SweepColumn
    levels: tuple[Any, ...]
    place: IntArray
    log: bool = False
    partners: tuple[str, ...] = ()

    @property
    def categorical(self) -> bool:
        """Whether the values have names rather than places on a scale."""
        return self.column.kind in ("text", "bool")

    @property
    def coordinates(self) -> FloatArray:
        """(n_levels,) values, or the numbers of categories from 0."""
        return np.arange(len(self.levels), dtype=float) if self.categorical else np.array(self.levels, dtype=float)

    @property
    def label(self) -> str:
        """``thickness [m]``, with what changes together with it."""
        return self.column.header + (f", with {', '.join(self.partners)}" if self.partners else "")

    @property
    def names(self) -> list[str]:
        """Each value in few letters."""
        return [value_words(level) for level in self.levels]


def value_words(value: Any) -> str:
    """A value of a parameter in few letters."""
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    return f"{value:.4g}" if isinstance(value, int | float) else str(value)


def design_columns(table: SweepTable) -> tuple[SweepColumn, ...]:
    """Columns that the design fills."""
    return table.of_role("parameter", *DIRECTIONS)


def is_sampled(table: SweepTable, dimension: str) -> bool:
    """Whether the points along a dimension are a sample: nearly every one has values of its own."""
    if dimension == table.samples:
        return True
    own = [column for column in design_columns(table) if column.dimension == dimension]
    return bool(own) and dimension.startswith(("random", "latin_hypercube", "sobol")) and own[0].name != dimension


def axis_of(table: SweepTable, column: SweepColumn) -> ParameterAxis:
    """The axis of a column of the design."""
    partners = tuple(
        other.name
        for other in design_columns(table)
        if other.dimension == column.dimension and other.name != column.name and not is_sampled(table, other.dimension)
    )
    if column.kind in ("text", "bool"):
        found: dict[Any, int] = {}
        numbers = [found.setdefault(value, len(found)) for value in table[column.name].tolist()]
        return ParameterAxis(column, tuple(found), np.array(numbers, dtype=np.int64), partners=partners)
    levels, place = np.unique(numbers_of(column, table[column.name]), return_inverse=True)
    wide = bool(0 < WIDE * levels[0] <= levels[-1])
    return ParameterAxis(column, tuple(levels.tolist()), place.reshape(-1).astype(np.int64), wide, partners)


def grid_axes(table: SweepTable) -> tuple[ParameterAxis, ...]:
    """One axis for each dimension of two values and more that is no sample and no sphere; most values first.

    Of parameters that change together the first number is taken.
    """
    axes = []
    for dimension in table.dimensions:
        columns = [column for column in design_columns(table) if column.dimension == dimension.name]
        over_sphere = any(column.role == "elevation" for column in columns)
        if not columns or over_sphere or is_sampled(table, dimension.name):
            continue
        numeric = [column for column in columns if column.kind in ("float", "int")]
        axis = axis_of(table, (numeric or columns)[0])
        if len(axis.levels) > 1:
            axes.append(axis)
    return tuple(sorted(axes, key=lambda axis: (axis.categorical, -len(axis.levels))))


@dataclass(frozen=True)
class ResultView:
    """One result of a sweep.

    by      : parameter that the user put first; empty where the kind of picture is to choose
    demands : values of the result that are asked of the structure
    shares, curves : what is known of limits of the result, as ``fragility_keys`` and ``curve_keys`` describe it
    """

    table: SweepTable
    answers: Answers
    by: str = ""
    demands: tuple[float, ...] = ()
    shares: tuple[Mapping[str, Any], ...] = ()
    curves: tuple[Mapping[str, Any], ...] = ()

    @cached_property
    def axes(self) -> tuple[ParameterAxis, ...]:
        """Axes of the grid, the chosen parameter first, then those of most values, categories last."""
        if not self.by:
            return grid_axes(self.table)
        chosen = column_by_name(self.table, self.by)
        if is_sampled(self.table, chosen.dimension):
            return grid_axes(self.table)
        rest = [axis for axis in grid_axes(self.table) if axis.column.dimension != chosen.dimension]
        return (axis_of(self.table, chosen), *rest)

    @property
    def sampled(self) -> bool:
        """Whether a part of the design is a sample."""
        return any(is_sampled(self.table, dimension.name) for dimension in self.table.dimensions)

    @property
    def text_refused(self) -> str:
        """Why there can be no picture of numbers where the result is text, and what shows it; or nothing."""
        if not self.answers.categories:
            return ""
        return f"the result is text{'; map shows it' * (len(self.axes) > 1)}"


def view_of(table: SweepTable, result: SweepColumn, by: str = "", demands: tuple[float, ...] = ()) -> ResultView:
    """The view on one result; UsageError where ``by`` is no parameter."""
    if by:
        column_by_name(table, by)
    return ResultView(table, answers_of(table, result), by, demands)


def column_by_name(table: SweepTable, name: str) -> SweepColumn:
    """A parameter by its name; raises UsageError for none."""
    names = {column.name: column for column in design_columns(table)}
    if name not in names:
        raise UsageError("unknown-column", f"--by {name}: {unknown('parameter', name, names, 'the sweep has')}")
    return names[name]


def chosen_results(table: SweepTable, name: str | None) -> tuple[SweepColumn, ...]:
    """Result columns by name, or of every load case by key path; the load factors unless one is named.

    Raises UsageError where there is none of that name, and for a table without results.
    """
    results = table.of_role("result")
    if not results:
        raise UsageError("nothing-to-draw", "the sweep has no result columns to draw")
    if name is None:
        numeric = [column.path for column in results if column.kind in ("float", "int")]
        paths = [column.path for column in results]
        name = "load_factor" if "load_factor" in paths else (numeric or paths)[0]
    chosen = [column for column in results if column.name == name] or [each for each in results if each.path == name]
    if not chosen:
        names = [column.name for column in results]
        raise UsageError("unknown-column", f"--result {name}: {unknown('result', name, names, 'the sweep has')}")
    return tuple(chosen)


Cells: TypeAlias = "np.recarray[Any, np.dtype[Any]]"
"""points by their values of some parameters, with an axis for each of these

value : the point's, or the median of several; nan where there is none
low, high : least and greatest value of several points; nan where there is none
answer : of ``Answer``; NO_POINT where there is none
count : points
"""
CELL = np.dtype([("answer", np.int64), ("value", float), ("low", float), ("high", float), ("count", np.int64)])
NO_POINT = -1


def pooled(answers: Answers, axes: Sequence[ParameterAxis]) -> Cells:
    """The points of a result by their values of some parameters.

    The median is one in rank: what does not stand lies below all values, what nothing brings down above all. It is that
    of the points with an answer; where others are among them, the cell is marked.
    """
    shape = tuple(len(axis.levels) for axis in axes)
    place = np.ravel_multi_index(tuple(axis.place for axis in axes), shape)
    cells = np.full(int(np.prod(shape)), np.array((NO_POINT, np.nan, np.nan, np.nan, 0), CELL))
    order = np.argsort(place, kind="stable")
    found, begins = np.unique(place[order], return_index=True)
    for cell, own in zip(found, np.split(order, begins[1:]), strict=True):
        cells[cell] = (*_together(answers, own), len(own))
    return cells.reshape(shape).view(np.recarray)


def _together(answers: Answers, own: IntArray) -> tuple[int, float, float, float]:
    """Answer, median, least and greatest of some points."""
    kinds, values = answers.answer[own], answers.values[own]
    good = values[kinds == Answer.VALUE]
    if len(own) == 1:
        return int(kinds[0]), values[0], values[0], values[0]
    if not len(good) and np.ptp(kinds) == 0:
        return int(kinds[0]), np.nan, np.nan, np.nan
    if answers.categories:
        one = len(good) == len(own) and np.ptp(good) == 0
        return (Answer.VALUE, good[0], good[0], good[0]) if one else (Answer.MIXED, np.nan, np.nan, np.nan)
    ends = np.full(answers.below[own].sum(), -np.inf), np.full(answers.above[own].sum(), np.inf)
    ranked = np.sort(np.concatenate([ends[0], good, ends[1]]))
    if not len(ranked):
        return int(kinds.max()), np.nan, np.nan, np.nan
    middle = ranked[[(len(ranked) - 1) // 2, len(ranked) // 2]]
    median = float(middle.mean() if np.isfinite(middle).all() else middle[0])
    low, high = (good.min(), good.max()) if len(good) else (np.nan, np.nan)
    if not np.isfinite(median):
        return (Answer.NO_EQUILIBRIUM if median < 0 else Answer.UNBOUNDED), np.nan, low, high
    return (Answer.VALUE if len(ranked) == len(own) else Answer.PARTLY), median, low, high


def several(cells: Cells) -> bool:
    """Whether any cell has more than one point."""
    return bool(cells.count.max(initial=0) > 1)


@dataclass(frozen=True)
class Grid:
    """The points of a view by up to three parameters.

    x, lines, panels : along the diagram, across its lines or cells, and from one diagram to the next
    cells : (n_panels, n_lines, n_x), 1 for parameters that are None
    """

    x: ParameterAxis
    lines: ParameterAxis | None
    panels: ParameterAxis | None
    cells: Cells

    def title(self, number: int) -> str:
        """Of a diagram: ``thickness 0.3 m``."""
        if self.panels is None:
            return ""
        unit = f" {self.panels.column.unit}" if self.panels.column.unit else ""
        return f"{self.panels.column.name} {self.panels.names[number]}{unit}"

    def median_words(self, what: str) -> list[str]:
        """A note on cells of several points; none without."""
        count = self.cells.count.max()
        return [f"{what}: median of up to {count} points of the other parameters"] * several(self.cells)


MOST_PANELS = 16
"""diagrams on a page in which anything can be read"""


def gridded(answers: Answers, x: ParameterAxis, *rest: ParameterAxis) -> Grid:
    """The points by one parameter and those after it; further parameters are taken together."""
    lines = rest[0] if rest else None
    panels = rest[1] if len(rest) > 1 and len(rest[1].levels) <= MOST_PANELS else None
    along = (panels, lines, x)
    cells = pooled(answers, [axis for axis in along if axis is not None])
    sizes = [1 if axis is None else len(axis.levels) for axis in along]
    return Grid(x, lines, panels, cells.reshape(sizes).view(np.recarray))
