"""Tables of what there is to list: programs, iterations, load path, reactions, travelling loads, notices.

A source of such a table is a list of items, a row each.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from mbla.errors import Notice
from mbla.results.collapse.mechanics import Reaction, reactions_of
from mbla.results.outcome import notices_of
from mbla.results.record.quantity import STORED, Kind, Quantity, UnitKind, real
from mbla.results.record.scene import FIGURES_TOLD, Scene, Values, as_text
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, factor_of, position_of, series_of
from mbla.results.tables.table import TableColumn, TableKind, case_scenes, described


def each(name: str, words: str, get: Callable[[Any], Any], kind: Kind = "text", unit: UnitKind = "1") -> TableColumn:
    """A column with what an item has, row by row."""

    def values(items: Sequence[Any]) -> Values:
        found = [get(item) for item in items]
        return as_text(found) if kind == "text" else np.array(found)

    return TableColumn(name, kind, unit, words, values)


def _list_table(name: str, words: str) -> TableKind:
    """A table of the records that a solution lists under one name, as the result file has them."""

    def items(_: Results, cases: tuple[CaseResult, ...]) -> Iterable[list[tuple[CaseResult, Any]]]:
        return [[(case, record) for record in getattr(case.solution, name)] for case in cases]

    def column(quantity: Quantity) -> TableColumn:
        ((_, called, unit),) = quantity.components()
        as_told = str if quantity.kind == "text" else lambda value: value
        return each(called, quantity.words, lambda item: as_told(getattr(item[1], quantity.name)), quantity.kind, unit)

    held = [column(quantity) for quantity in STORED if quantity.place == f"cases/*/{name}"]
    case = each("case", "load case", lambda item: item[0].load_case.name)
    return TableKind(name, words, (case, *held), items)


PROGRAMS = _list_table("programs", "each program that was solved for a load case")
ITERATIONS = _list_table("iterations", "each iteration of each program")
PATH = _list_table("path", "each step of the load path that was followed")


def _reactions(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[list[tuple[Scene, CaseResult, Reaction]]]:
    """Of supports, then of guides, in the order of the listing."""
    for scene, case in zip(case_scenes(results, cases), cases, strict=True):
        if scene.mechanics is not None:
            found = reactions_of(scene.model, scene.contacts, case.load_case, scene.mechanics)
            yield [(scene, case, reaction) for reaction in found]


REACTIONS = TableKind(
    "reactions",
    "each support of the structure at collapse, for each load case with forces",
    (
        each("case", "load case", lambda item: item[1].load_case.name),
        each("support", "ground, block, group or guide", lambda item: item[2].support),
        each("figures", FIGURES_TOLD.words, lambda item: item[0].figures),
        *described(
            real("reaction", "force on the structure, and its moment about the origin", "load", "component"),
            lambda items: np.array([reaction.wrench for *_, reaction in items]).reshape(-1, 6),
        ),
    ),
    _reactions,
)


def _positions(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[list[tuple[Results, Series, CaseResult]]]:
    """Positions of the cases asked for; the worst is that of all."""
    names = {case.load_case.name for case in cases}
    for series in series_of(results.cases):
        yield [(results, series, case) for case in series.cases if case.load_case.name in names]


def _block(item: tuple[Results, Series, CaseResult]) -> str:
    block = int(position_of(item[2]).blocks[0])
    return item[0].model.blocks.name(block) if block >= 0 else ""


def _axles(item: tuple[Results, Series, CaseResult]) -> str:
    return " ".join(f"{place:.9g}" for place in position_of(item[2]).distances.tolist())


SERIES = TableKind(
    "series",
    "each position of each travelling load",
    (
        each("series", "load case of the deck", lambda item: item[1].name),
        each("case", "load case", lambda item: item[2].load_case.name),
        each("position", "number of the position, from 1", lambda item: position_of(item[2]).number, "int"),
        each("count", "positions on the path", lambda item: position_of(item[2]).count, "int"),
        *described(
            real("point", "where the first axle stands, or the only force", "length", "axis"),
            lambda items: np.array([position_of(case).point for *_, case in items]).reshape(-1, 3),
        ),
        each(
            "distance",
            "its distance along the path, of which it may be off",
            lambda item: position_of(item[2]).distance,
            "float",
            "length",
        ),
        each("block", "the block that carries it; empty: it is off the path", _block),
        each("axles", "distances along the path of all axles, the first one first", _axles),
        each("status", "status", lambda item: item[2].status.value),
        each(
            "load_factor",
            "load factor; inf: no multiple brings anything down; empty: no result",
            lambda item: factor_of(item[2]),
            "float",
        ),
        each(
            "worst",
            "the least load factor; none where some position has no result",
            lambda item: item[2] is item[1].worst,
            "bool",
        ),
    ),
    _positions,
)


def _notices(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[tuple[Notice, ...]]:
    return [notices_of(results)]


NOTICES = TableKind(
    "notices",
    "each remark of the run",
    (
        each("severity", "notice or warning", lambda notice: notice.severity),
        each("identifier", "stable identifier", lambda notice: notice.identifier),
        each("message", "in words", lambda notice: notice.message),
        each("case", "load case that it is about; empty: the whole run", lambda notice: notice.case),
    ),
    _notices,
)
