"""``mbla sweep-plot``: which pictures of a sweep go to which files."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Protocol, TypeAlias

from mbla.errors import FileError, UsageError
from mbla.results.pictures.options import PictureOptions, format_of, is_single, page_options, parse_kinds
from mbla.results.pictures.page import PictureFile, write_pictures
from mbla.sweeps.pictures import curve, distribution, fragility, map
from mbla.sweeps.pictures.view import ResultView, chosen_results, view_of
from mbla.sweeps.tables.sweep_json import JSON, read_sweep_table
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable


class PictureKind(Protocol):
    """A kind of picture, a module each."""

    def refusal(self, view: ResultView) -> str:
        """Why a table does not fit it, in words; empty where it does."""

    def draw(self, path: Path, view: ResultView, options: PictureOptions) -> None:
        """Write it; raises as ``open_diagrams`` does."""


KINDS: dict[str, PictureKind] = {"curve": curve, "map": map, "distribution": distribution, "fragility": fragility}
"""by name, in the order in which they are made"""
USUAL: dict[str, Callable[[ResultView], bool]] = {
    "map": lambda view: min(len(axis.levels) for axis in view.axes[:2]) > 2,  # else it shows no more than curves
    "distribution": lambda view: view.sampled or not view.axes,
}
"""which of those that fit a table are drawn of it without being asked for; kinds that are not here always are"""


Records: TypeAlias = tuple[Mapping[str, Any], ...]


@dataclass(frozen=True)
class Fragility:
    """What sweep.json has of probabilities, as ``fragility_keys`` and ``curve_keys`` describe it."""

    shares: Records = ()
    curves: Records = ()

    def demands(self, result: str) -> tuple[float, ...]:
        """On a result column, ascending."""
        own = (one for one in self.shares if one["result"] == result)
        return tuple(sorted({float(each["demand"]) for one in own for each in one["demands"]}))

    def of(self, result: str) -> tuple[Records, Records]:
        """Shares and curves of a result column."""
        both = (self.shares, self.curves)
        shares, curves = (tuple(one for one in records if one["result"] == result) for records in both)
        return shares, curves


def fragility_in(folder: Path) -> Fragility:
    """Probabilities of a sweep; none where it asks for none.

    Raises FileError where the record is invalid.
    """
    try:
        record = json.loads((folder / JSON).read_bytes())
        found = Fragility(tuple(record["fragility"]), tuple(record.get("fragility_curves", ())))
        for one in found.shares:
            found.demands(str(one["result"]))
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise FileError("sweep-table-damaged", f"{folder / JSON}: its fragility cannot be read") from error
    return found


CLASS = "mechanism.class"
"""text result of which a map is made in addition to that of the load factor"""


@dataclass(frozen=True)
class SweepPictures:
    """What a user chooses about pictures of a sweep.

    kinds   : names in ``KINDS``; empty for those that suit the table
    every   : of the kinds those that the table does not fit are left out, rather than refused
    result  : name or key path of result columns; None for the load factors
    by      : parameter that comes first
    known   : probabilities: demands are marked in distributions, limits are what fragility shows
    page    : size, dots per inch and format
    """

    kinds: tuple[str, ...] = ()
    every: bool = False
    result: str | None = None
    by: str = ""
    known: Fragility = field(default_factory=Fragility)
    page: PictureOptions = field(default_factory=PictureOptions)


def plot_sweep_files(path: Path, arguments: Any) -> list[Path]:
    """Pictures of a sweep from its folder, sweep.csv or sweep.json, as the command line asks for them.

    Raises as ``read_sweep_table`` and ``plot_sweep`` do, and UsageError for a text that is no choice.
    """
    kinds = () if arguments.kind is None else parse_kinds(arguments.kind, tuple(KINDS))
    every = arguments.kind is not None and arguments.kind.strip() == "all"
    page, folder = page_options(arguments), path if path.is_dir() else path.parent
    table = read_sweep_table(path)
    chosen = SweepPictures(kinds, every, arguments.result, arguments.by or "", fragility_in(folder), page)
    return plot_sweep(table, arguments.output or folder, chosen)


def plot_sweep(table: SweepTable, target: Path, chosen: SweepPictures | None = None) -> list[Path]:
    """Pictures of a sweep; the paths written.

    ``sweep_KIND_RESULT.png`` and so on; earlier ones of the same names are replaced.

    target : a file with the suffix .png, .svg or .pdf, for a single picture: the first that suits the table unless a
             kind and a result are chosen; else a folder, created if missing

    Raises UsageError: a kind that does not fit the table, no such result or parameter, several pictures for one file,
    another suffix, nothing to draw; the extra for pictures is not installed. Raises FileError: a picture or the folder
    cannot be written.
    """
    chosen = chosen or SweepPictures()
    pictures = pictures_of(table, chosen)
    if is_single(target):
        format_of(target)
        pictures = pictures if chosen.kinds else pictures[:1]
    return write_pictures(pictures, target, "sweep_", chosen.page.format, "--kind and --result")


def pictures_of(table: SweepTable, chosen: SweepPictures) -> list[PictureFile]:
    """The pictures to make, kind by kind of each result; raises as ``plot_sweep`` does."""
    if not len(table):
        raise UsageError("nothing-to-draw", "the sweep has no points to draw")
    views = [_view(table, result, chosen) for result in _results(table, chosen)]
    if chosen.kinds:
        found = [(kind, view) for view in views for kind in chosen.kinds if _fits(kind, view, chosen.every)]
    else:
        classes = [column for column in table.of_role("result") if column.path == CLASS and chosen.result is None]
        maps = [view for view in (view_of(table, column, chosen.by) for column in classes) if view.answers.good.any()]
        asked = [(kind, view) for view in views for kind in KINDS] + [("map", view) for view in maps]
        found = [(kind, view) for kind, view in asked if not KINDS[kind].refusal(view)]
        found = [(kind, view) for kind, view in found if kind not in USUAL or USUAL[kind](view)]
    if not found:
        reasons = [f"{kind}: {KINDS[kind].refusal(views[0]) or 'only where --kind asks for it'}" for kind in KINDS]
        name = views[0].answers.column.name
        raise UsageError("nothing-to-draw", f"no kind of picture suits {name} ({'; '.join(reasons)})")
    draw = {kind: partial(KINDS[kind].draw, options=chosen.page) for kind, _ in found}
    return [PictureFile(_name(kind, view), partial(draw[kind], view=view)) for kind, view in found]


def _results(table: SweepTable, chosen: SweepPictures) -> Sequence[SweepColumn]:
    """Those chosen, or those of which probabilities are asked where none is."""
    asked = {one["result"] for one in chosen.known.curves}
    if chosen.result is None and asked:
        return [column for column in table.of_role("result") if column.name in asked]
    return chosen_results(table, chosen.result)


def _view(table: SweepTable, result: SweepColumn, chosen: SweepPictures) -> ResultView:
    known = chosen.known
    shares, curves = known.of(result.name)
    return replace(view_of(table, result, chosen.by, known.demands(result.name)), shares=shares, curves=curves)


def _name(kind: str, view: ResultView) -> str:
    """``curve_load_factor``: what is no letter, number, full stop or hyphen becomes a low line."""
    return f"{kind}_{re.sub(r'[^A-Za-z0-9.-]+', '_', view.answers.column.name)}"


def _fits(kind: str, view: ResultView, every: bool) -> bool:
    reason = KINDS[kind].refusal(view)
    if reason and not every:
        raise UsageError("nothing-to-draw", f"--kind {kind} of {view.answers.column.name}: {reason}")
    return not reason
