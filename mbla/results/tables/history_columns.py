"""Tables of how a load case was solved, and what else there is to list: reactions, programs, travel, notices."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mbla.errors import Notice
from mbla.model.model import TravelPosition
from mbla.results.collapse.mechanics import Reaction, guide_reactions, support_reactions
from mbla.results.outcome import notices_of
from mbla.results.record.quantity import Kind, UnitKind
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, factor_of, position_of, series_of
from mbla.results.tables.case_rows import CaseRows, case_rows
from mbla.results.tables.column import Column, Values, as_text, bools, floats, ints, texts, vector
from mbla.results.tables.table import TableKind


def _list_table(name: str, words: str, records: str, columns: tuple[tuple[str, Kind, UnitKind, str], ...]) -> TableKind:
    """A table of the records that a solution lists under one name: column, type, unit, meaning."""

    def listed(case: CaseResult) -> tuple[Any, ...]:
        return tuple(getattr(case.solution, records))

    def values(field: str, kind: Kind) -> Callable[[CaseResult], Values]:
        def of(case: CaseResult) -> Values:
            column = [getattr(record, field) for record in listed(case)]
            return as_text([str(value) for value in column]) if kind == "text" else np.array(column)

        return of

    case: Column[CaseResult] = texts(
        "case", "load case", lambda case: as_text([case.load_case.name] * len(listed(case)))
    )
    described = (Column(field, kind, unit, text, values(field, kind)) for field, kind, unit, text in columns)
    return TableKind(name, words, (case, *described), lambda _, cases: cases)


PROGRAMS = _list_table(
    "programs",
    "each program that was solved for a load case",
    "programs",
    (
        ("program", "int", "1", "number of the program, from 1"),
        ("kind", "text", "1", "what it is for"),
        ("status", "text", "1", "its status"),
        ("load_factor", "float", "1", "its load factor, not verified by itself"),
        ("change", "float", "1", "relative change of the load factor"),
        ("iterations", "int", "1", "its iterations"),
        ("seconds", "float", "time", "its time"),
        ("solver", "text", "1", "mbla, clarabel or highs; empty: steps of the joint law"),
        ("factorization", "text", "1", "library that factorised its linear systems; empty: the solver's own, or none"),
    ),
)
ITERATIONS = _list_table(
    "iterations",
    "each iteration of each program",
    "iterations",
    (
        ("program", "int", "1", "number of the program, from 1"),
        ("iteration", "int", "1", "iteration within it"),
        ("load_factor", "float", "1", "load factor at this iteration, no result"),
        ("gap", "float", "1", "relative gap of the program"),
        ("primal_residual", "float", "1", "primal residual of the program"),
        ("dual_residual", "float", "1", "dual residual of the program"),
        ("step", "float", "1", "length of the step taken"),
        ("seconds", "float", "time", "time since the program began"),
    ),
)
PATH = _list_table(
    "path",
    "each step of the load path that was followed",
    "path",
    (
        ("step", "int", "1", "step of the load path"),
        ("load_factor", "float", "1", "load factor there"),
        ("open", "int", "1", "contact points open"),
        ("slide", "int", "1", "contact points sliding"),
        ("residual", "float", "1", "how badly the state fits the law"),
    ),
)


# --- reactions ----------------------------------------------------------------------------------------------------


def _reactions(rows: CaseRows) -> tuple[Reaction, ...]:
    """Of supports, then of guides, in the order of the listing."""
    if rows.mechanics is None:
        return ()
    return (
        *support_reactions(rows.model, rows.contacts, rows.mechanics.contact_forces),
        *guide_reactions(rows.model, rows.contacts, rows.case.load_case, rows.mechanics),
    )


def _wrenches(part: slice, rows: CaseRows) -> Values:
    return np.array([reaction.wrench[part] for reaction in _reactions(rows)]).reshape(-1, 3)


REACTIONS = TableKind(
    "reactions",
    "each support of the structure at collapse, for each load case with forces",
    (
        texts("case", "load case", lambda rows: rows.same(len(_reactions(rows)), rows.case.load_case.name)),
        texts("support", "ground, block, group or guide", lambda rows: as_text([r.support for r in _reactions(rows)])),
        texts(
            "figures",
            "what its forces are: result; best_iterate where the case has no result",
            lambda rows: rows.same(len(_reactions(rows)), rows.figures),
        ),
        *vector("force", "force", "force of the support on the structure", partial(_wrenches, slice(0, 3))),
        *vector("moment", "moment", "its moment about the origin", partial(_wrenches, slice(3, 6))),
    ),
    case_rows,
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
        ints("position", "number of the position, from 1", lambda s: np.array([p.number for p in _positions(s[1])])),
        ints("count", "positions on the path", lambda source: np.array([p.count for p in _positions(source[1])])),
        *vector(
            "point",
            "length",
            "where the first axle stands, or the only force",
            lambda source: np.array([p.point for p in _positions(source[1])]),
        ),
        floats(
            "distance",
            "length",
            "its distance along the path, of which it may be off",
            lambda source: np.array([p.distance for p in _positions(source[1])]),
        ),
        texts("block", "the block that carries it; empty: it is off the path", _block_names),
        texts("axles", "distances along the path of all axles, the first one first", _axles),
        texts("status", "status", lambda source: as_text([case.status.value for case in source[1].cases])),
        floats(
            "load_factor",
            "1",
            "load factor; inf: no multiple brings anything down; empty: no result",
            lambda source: np.array([factor_of(case) for case in source[1].cases]),
        ),
        bools(
            "worst",
            "the least load factor; none where some position has no result",
            lambda source: np.array([case is source[1].worst for case in source[1].cases]),
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
