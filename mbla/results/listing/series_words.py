"""Travelling loads in words: where a vehicle stands, a row for each position, and the worst."""

from __future__ import annotations

import numpy as np

from mbla.deck.suggestions import listed
from mbla.model.model import Model, TravelPosition
from mbla.results.listing.answer_words import status_name
from mbla.results.listing.text import counted, heading, number, sentence, table, vector
from mbla.results.results import CaseResult
from mbla.results.series import Series, factor_of, position_of

MOST_NAMED = 5
"""positions without a load factor that are named, and axles whose places are"""


def series_lines(model: Model, series: Series) -> list[str]:
    """The section of one travelling load in the listing."""
    length = model.units.length
    lines = heading(f"Travelling load {series.name}")
    for words in (worst_words(model, series), spread_over_positions(series)):
        lines += sentence(f"{words}.")
    vehicle = _is_vehicle(series)
    what = ("axle 1 at", "axles that act") if vehicle else ("at", "block")
    head = ["load case", "status", f"along path [{length}]", f"{what[0]} [{length}]", what[1], "load factor"]
    return [*lines, "", *table(head, [_row(model, series, case) for case in series.cases], left=2)]


def worst_words(model: Model, series: Series) -> str:
    """``worst at position 6 of 21, at (1.2, 0.5, 3) m: load factor 2.31``; of a vehicle, where its axles stand."""
    among = "" if series.complete else f" among the {counted(len(series.cases), 'position')} solved"
    if series.worst is None:
        unknown = [case for case in series.cases if not factor_of(case) > 0]
        if not unknown:
            return f"{series.name}: no multiple of the load brings the structure down at any position{among}"
        names = ", ".join(case.load_case.name for case in unknown[:MOST_NAMED])
        names += " and others" if len(unknown) > MOST_NAMED else ""
        return f"{series.name}: the worst position is not known, for there is no load factor at {names}"
    position = position_of(series.worst)
    where = f"position {position.number} of {position.count}, {standing_words(model, position)}"
    return f"{series.name}: worst{among} at {where}: load factor {number(factor_of(series.worst))}"


def standing_words(model: Model, position: TravelPosition) -> str:
    """``at (1.2, 0.5, 3) m``; of a vehicle its first axle, the others by how far they are along the path."""
    length, axles = model.units.length, len(position.points)
    if axles == 1:
        return f"at {vector(position.point)} {length}"
    others = [f"{place:.4g}" for place in position.distances[1:MOST_NAMED].tolist()]
    others += ["..."] if axles > MOST_NAMED else []
    words = f"first axle at {vector(position.point)} {length}, {position.distance:.4g} {length} along the path"
    words += f", the others at {', '.join(others)} {length}"
    acting = (np.flatnonzero(position.acting) + 1).tolist()
    if len(acting) == axles:
        return words
    which = f"axle {acting[0]} is" if len(acting) == 1 else f"axles {listed([str(axle) for axle in acting], 'and')} are"
    return f"{words}; of {axles} only {which} on the path"


def spread_over_positions(series: Series) -> str:
    """At how many positions the load brings the structure down, and between which load factors."""
    factors = np.array([factor_of(case) for case in series.cases])
    finite, count = factors[np.isfinite(factors)], len(factors)
    ends = f", at load factors from {number(finite.min())} to {number(finite.max())}" if len(finite) else ""
    words = f"{series.name}: it brings the structure down at {len(finite)} of {counted(count, 'position')}{ends}"
    for many, what in ((np.isinf(factors), "no multiple does"), (np.isnan(factors), "there is no load factor")):
        words += f"; at {int(many.sum())} {what}" if many.any() else ""
    return words


def _is_vehicle(series: Series) -> bool:
    return len(position_of(series.cases[0]).points) > 1


def _acting(position: TravelPosition) -> str:
    """Numbers of the axles that act, from 1: ``3, 4``."""
    return ", ".join(str(axle + 1) for axle in np.flatnonzero(position.acting).tolist())


def _row(model: Model, series: Series, case: CaseResult) -> list[str]:
    position = position_of(case)
    mark = "  (worst)" if case is series.worst else ""
    return [
        case.load_case.name + mark,
        status_name(case.status),
        number(position.distance),
        vector(position.point),
        _acting(position) if _is_vehicle(series) else model.blocks.name(int(position.blocks[0])),
        "any multiple" if np.isinf(factor_of(case)) else number(factor_of(case)),
    ]
