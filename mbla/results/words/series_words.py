"""Travelling loads in words: a row for each position, and the worst."""

from __future__ import annotations

import numpy as np

from mbla.model.model import Model
from mbla.results.results import CaseResult
from mbla.results.series import Series, factor_of, position_of
from mbla.results.words.answer_words import status_name
from mbla.results.words.text import counted, heading, number, sentence, table, vector


def series_lines(model: Model, series: Series) -> list[str]:
    """The section of one travelling load in the listing."""
    length = model.units.length
    lines = heading(f"Travelling load {series.name}") + sentence(worst_words(model, series) + ".")
    head = ["load case", "status", f"along path [{length}]", f"at [{length}]", "block", "load factor"]
    return [*lines, "", *table(head, [_row(model, series, case) for case in series.cases], left=2)]


def worst_words(model: Model, series: Series) -> str:
    """``worst at position 6 of 21, (1.2, 0.5, 3) m: load factor 2.31``."""
    among = "" if series.complete else f" among the {counted(len(series.cases), 'position')} solved"
    if series.worst is None:
        unknown = [case for case in series.cases if not factor_of(case) > 0]
        if not unknown:
            return f"{series.name}: no multiple of the load brings the structure down at any position{among}"
        names = ", ".join(case.load_case.name for case in unknown[:5]) + (" and others" if len(unknown) > 5 else "")
        return f"{series.name}: the worst position is not known, for there is no load factor at {names}"
    position, length = position_of(series.worst), model.units.length
    where = f"position {position.number} of {position.count}, at {vector(position.point)} {length}"
    return f"{series.name}: worst{among} at {where}: load factor {number(factor_of(series.worst))}"


def _row(model: Model, series: Series, case: CaseResult) -> list[str]:
    position = position_of(case)
    mark = "  (worst)" if case is series.worst else ""
    return [
        case.load_case.name + mark,
        status_name(case.status),
        number(position.distance),
        vector(position.point),
        model.blocks.name(position.block),
        "any multiple" if np.isinf(factor_of(case)) else number(factor_of(case)),
    ]
