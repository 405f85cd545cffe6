"""Tables of what there is to list: programs, iterations, load path, reactions, travelling loads, notices."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mbla.errors import Notice
from mbla.model.model import TravelPosition
from mbla.results.collapse.mechanics import Reaction, reactions_of
from mbla.results.outcome import notices_of
from mbla.results.record.quantity import STORED, Kind, Quantity, UnitKind, real
from mbla.results.record.scene import FIGURES_TOLD, Scene, Values, as_text
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, factor_of, position_of, series_of
from mbla.results.tables.table import TableColumn, TableKind, case_scenes, described


def _list_table(name: str, words: str) -> TableKind:
    """A table of the records that a solution lists under one name, as the result file has them."""

    def values(quantity: Quantity, case: CaseResult) -> Values:
        column = [getattr(record, quantity.name) for record in getattr(case.solution, name)]
        return as_text([str(value) for value in column]) if quantity.kind == "text" else np.array(column)

    def case_name(case: CaseResult) -> Values:
        return as_text([case.load_case.name] * len(getattr(case.solution, name)))

    held = [quantity for quantity in STORED if quantity.place == f"cases/*/{name}"]
    columns = [column for quantity in held for column in described(quantity, partial(values, quantity))]
    return TableKind(name, words, (texts("case", "load case", case_name), *columns), lambda _, cases: cases)


def texts(name: str, words: str, of: Callable[[Any], Values]) -> TableColumn:
    """A column of text."""
    return TableColumn(name, "text", "1", words, of)


def numbers(
    name: str, words: str, of: Callable[[Any], Values], unit: UnitKind = "1", kind: Kind = "float"
) -> TableColumn:
    """A column of numbers."""
    return TableColumn(name, kind, unit, words, of)


PROGRAMS = _list_table("programs", "each program that was solved for a load case")
ITERATIONS = _list_table("iterations", "each iteration of each program")
PATH = _list_table("path", "each step of the load path that was followed")


# --- reactions ----------------------------------------------------------------------------------------------------


def _reactions(scene: Scene) -> tuple[Reaction, ...]:
    """Of supports, then of guides, in the order of the listing."""
    if scene.mechanics is None or scene.case is None:
        return ()
    return reactions_of(scene.model, scene.contacts, scene.case.load_case, scene.mechanics)


def _wrenches(scene: Scene) -> Values:
    return np.array([reaction.wrench for reaction in _reactions(scene)]).reshape(-1, 6)


REACTIONS = TableKind(
    "reactions",
    "each support of the structure at collapse, for each load case with forces",
    (
        texts(
            "case",
            "load case",
            lambda scene: as_text([scene.case.load_case.name for _ in _reactions(scene)]),
        ),
        texts("support", "ground, block, group or guide", lambda s: as_text([r.support for r in _reactions(s)])),
        texts("figures", FIGURES_TOLD.words, lambda scene: as_text([scene.figures for _ in _reactions(scene)])),
        *described(
            real(
                "reaction",
                "force on the structure, and its moment about the origin",
                "load",
                "component",
            ),
            _wrenches,
        ),
    ),
    case_scenes,
)


# --- travelling loads ---------------------------------------------------------------------------------------------


def _positions(series: Series) -> list[TravelPosition]:
    return [position_of(case) for case in series.cases]


def _series(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[tuple[Results, Series]]:
    """Positions of the cases asked for; the worst is that of all."""
    names = {case.load_case.name for case in cases}
    for series in series_of(results.cases):
        chosen = tuple(case for case in series.cases if case.load_case.name in names)
        if chosen:
            yield results, replace(series, cases=chosen)


def _block_names(source: tuple[Results, Series]) -> Values:
    results, series = source
    carrying = [int(position.blocks[0]) for position in _positions(series)]
    return as_text([results.model.blocks.name(block) if block >= 0 else "" for block in carrying])


def _axles(source: tuple[Results, Series]) -> Values:
    places = [position.distances.tolist() for position in _positions(source[1])]
    return as_text([" ".join(f"{place:.9g}" for place in row) for row in places])


SERIES = TableKind(
    "series",
    "each position of each travelling load",
    (
        texts("series", "load case of the deck", lambda source: as_text([source[1].name] * len(source[1].cases))),
        texts("case", "load case", lambda source: as_text([case.load_case.name for case in source[1].cases])),
        numbers(
            "position",
            "number of the position, from 1",
            lambda source: np.array([p.number for p in _positions(source[1])]),
            kind="int",
        ),
        numbers(
            "count",
            "positions on the path",
            lambda source: np.array([p.count for p in _positions(source[1])]),
            kind="int",
        ),
        *described(
            real("point", "where the first axle stands, or the only force", "length", "axis"),
            lambda source: np.array([p.point for p in _positions(source[1])]),
        ),
        numbers(
            "distance",
            "its distance along the path, of which it may be off",
            lambda source: np.array([p.distance for p in _positions(source[1])]),
            "length",
        ),
        texts("block", "the block that carries it; empty: it is off the path", _block_names),
        texts("axles", "distances along the path of all axles, the first one first", _axles),
        texts("status", "status", lambda source: as_text([case.status.value for case in source[1].cases])),
        numbers(
            "load_factor",
            "load factor; inf: no multiple brings anything down; empty: no result",
            lambda source: np.array([factor_of(case) for case in source[1].cases]),
        ),
        numbers(
            "worst",
            "the least load factor; none where some position has no result",
            lambda source: np.array([case is source[1].worst for case in source[1].cases]),
            kind="bool",
        ),
    ),
    _series,
)


# --- notices ------------------------------------------------------------------------------------------------------


def _notices(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[tuple[Notice, ...]]:
    return [notices_of(results)]


NOTICES = TableKind(
    "notices",
    "each remark of the run",
    (
        texts("severity", "notice or warning", lambda notices: as_text([n.severity for n in notices])),
        texts("identifier", "stable identifier", lambda notices: as_text([n.identifier for n in notices])),
        texts("message", "in words", lambda notices: as_text([n.message for n in notices])),
        texts("case", "load case that it is about; empty: the whole run", lambda ns: as_text([n.case for n in ns])),
    ),
    _notices,
)
