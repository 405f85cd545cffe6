"""What a picture of a sweep is made from: the table, one result of it, and what the user chose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mbla.deck.suggestions import unknown
from mbla.errors import UsageError
from mbla.sweeps.answers import Answers, answers_of
from mbla.sweeps.pictures.axes import Axis, axis_of, design_columns, grid_axes, is_sampled
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable


@dataclass(frozen=True)
class View:
    """One result of a sweep.

    by      : parameter that the user put first; empty where the kind of picture is to choose
    demands : values of the result that are asked of the structure
    """

    table: SweepTable
    answers: Answers
    by: str = ""
    demands: tuple[float, ...] = ()

    @cached_property
    def axes(self) -> tuple[Axis, ...]:
        """Axes of the grid, the chosen parameter first, then those of most values, categories last."""
        if not self.by:
            return grid_axes(self.table)
        chosen = column_by_name(self.table, self.by)
        if is_sampled(self.table, chosen.dimension):
            return grid_axes(self.table)
        rest = [axis for axis in grid_axes(self.table) if axis.column.dimension != chosen.dimension]
        return (axis_of(self.table, chosen), *rest)

    @cached_property
    def sampled(self) -> tuple[SweepColumn, ...]:
        """Parameters that are sampled."""
        return tuple(column for column in design_columns(self.table) if is_sampled(self.table, column.dimension))

    @property
    def text_refused(self) -> str:
        """Why there can be no picture of numbers where the result is text, and what shows it; or nothing."""
        if not self.answers.categories:
            return ""
        shown = "map and scatter show it" if len(self.axes) > 1 else "scatter shows it"
        return f"the result is text; {shown}"


def view_of(table: SweepTable, result: SweepColumn, by: str = "", demands: tuple[float, ...] = ()) -> View:
    """The view on one result; UsageError where ``by`` is no parameter."""
    if by:
        column_by_name(table, by)
    return View(table, answers_of(table, result), by, demands)


def column_by_name(table: SweepTable, name: str) -> SweepColumn:
    """A parameter by its name; UsageError for none."""
    names = {column.name: column for column in design_columns(table)}
    if name not in names:
        raise UsageError("unknown-column", f"--by {name}: {unknown('parameter', name, names, 'the sweep has')}")
    return names[name]


def chosen_results(table: SweepTable, name: str | None) -> tuple[SweepColumn, ...]:
    """Result columns by name, or of every load case by key path; the load factors unless one is named.

    Raises UsageError where there is none of that name, and for a table without results.
    """
    results = table.of_role("result")
    if name is not None:
        chosen = [column for column in results if column.name == name]
        chosen = chosen or [column for column in results if column.path == name]
        if not chosen:
            names = [column.name for column in results]
            raise UsageError("unknown-column", f"--result {name}: {unknown('result', name, names, 'the sweep has')}")
        return tuple(chosen)
    for path in ("load_factor", *dict.fromkeys(column.path for column in results if column.kind in ("float", "int"))):
        chosen = [column for column in results if column.path == path]
        if chosen:
            return tuple(chosen)
    if results:
        return (results[0],)
    raise UsageError("nothing-to-draw", "the sweep has no result columns to draw")
