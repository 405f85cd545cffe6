"""What a reader of a time history must know although nothing is wrong, from its deck and what is on record."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.solution.time_history.ductile import ductile_remark
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.judged import is_rough, missed_words
from mbla.solution.time_history.still_moves import STILL_MOVES, still_moves

SOFT = 1e-3
"""Sag over the size of blocks from which the joints are told to be soft."""

COARSE = 20.0
"""Steps in the first period at least: a step damps by ωh/2 of critical damping, which is less than π/20 then."""


def history_remarks(model: Model, contacts: Contacts, case: LoadCase, result: TimeHistoryResult) -> tuple[Message, ...]:
    """All of them.

    model : as it may move under the load case
    """
    return tuple(_remarks(model, contacts, case, result))


def _remarks(model: Model, contacts: Contacts, case: LoadCase, result: TimeHistoryResult) -> Iterator[Message]:
    history, rows = case.time_history, result.rows
    if history is None or rows is None:
        return
    if result.sag > SOFT * float(model.blocks.sizes[model.free].mean()):
        words = (
            f"joints give by {result.sag:.2g} {model.units.length} under the dead load, more than a thousandth of the "
        )
        words += "size of blocks: their stiffness is low for figures of blocks that hardly deform"
        yield Message("time-history-soft", words)
    if history.step > result.period / COARSE:
        words = f"a step of {history.step:g} s is long for the first period of {result.period:.3g} s: vibration of the "
        words += f"joints is damped by the step, to {result.damping:.2g} of critical damping"
        yield Message("time-history-coarse", words)
    if model.soils:
        yield Message("time-history-soil", _soil_words(model, case))
    if (remark := ductile_remark(model, contacts, result)) is not None:
        yield remark
    if rows.missed[-1] > 0 and not is_rough(rows):
        yield Message("time-history-missed", missed_words(rows))
    if still_moves(model, result):
        yield Message("history-still-moves", STILL_MOVES)


def _soil_words(model: Model, case: LoadCase) -> str:
    """Of cells as they are, which other load cases may have moved the corners of."""
    moved = any(soil.moved for soil in model.soils)
    how = "where other load cases slip, which have moved their corners" if moved else "as they are divided"
    words = f"soil slips along the edges of its cells alone, {how}: it may hold where soil would slip, "
    words += "and what it holds may move too little"
    return f"{words}; mbla run --case {case.name} follows it on cells as they are divided" if moved else words
