"""Modes about the state that a time history leaves: how much longer periods are says what has opened and slid.

It is at rest there: where what it came to is in balance but for what still vibrates. Else there are none.
"""

from __future__ import annotations

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.assembly.structure_at import StructureAt
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.solution.modes.checked import modes_remarks, modes_wrong
from mbla.solution.modes.find import modes_of
from mbla.solution.modes.modes import Modes
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.judged import CUT_SHORT
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.time_history.still_moves import FAR, still_moves
from mbla.solution.verification.modes import checked_modes

AFTER = "after the time history: "
"""before remarks on these modes"""
LESS_AREA = 10.0
"""Motion to the state at rest over the sag, up to which it is that of joints which press by less of their area."""
TIES = "what ties have stretched by is not known there"
TO_NO_END = "the time history does not come to its end"
HAS_FALLEN = "a block has fallen"
IT_MOVES = "it still moves at the end of the time history"
ELSEWHERE = "where the time history ends it is not at rest: it would move on before it were"


def checked_modes_after(
    assembly: Assembly, section: ContactsSection, load_case: LoadCase, history: TimeHistoryResult
) -> tuple[Modes, tuple[Message, ...]]:
    """As many modes as the load case asks for, verified, and remarks on them; or none, and a remark that says why."""
    there = left_by(assembly, section, load_case, history)
    if isinstance(there, str):
        return Modes(reason=there), (no_modes_after(there),)
    modes = modes_of(there, load_case.modes)
    if len(modes) and _far(there.assembly.model, modes, history.sag):
        modes = Modes(reason=ELSEWHERE)
    modes, wrong = checked_modes(there, modes)
    remarks = () if len(modes) else (no_modes_after(modes.reason),)
    return modes, (*remarks, *remarks_after(there, modes, wrong))


def left_by(
    assembly: Assembly, section: ContactsSection, load_case: LoadCase, history: TimeHistoryResult
) -> StructureAt | str:
    """The structure where its time history has left it, or why no modes are sought there, in words."""
    model, asked, peaks = assembly.model.of_case(load_case), load_case.time_history, history.peaks
    if asked is None or peaks is None or history.end in CUT_SHORT:
        return TO_NO_END
    if history.end is HistoryEnd.COLLAPSE or peaks.first_to_fall >= 0:
        return HAS_FALLEN
    if history.end is HistoryEnd.DISPLACED or still_moves(model, history):
        return IT_MOVES
    if len(model.ties):
        return TIES
    return StructureAt.moved(assembly, section, load_case, asked, peaks.ends, history.sag)


def remarks_after(there: StructureAt, modes: Modes, wrong: tuple[str, ...]) -> tuple[Message, ...]:
    """What a reader of these modes must know, with what is wrong with them."""
    model = there.assembly.model.of_case(there.load_case)
    found = (*map(modes_wrong, wrong), *modes_remarks(model, there.load_case, modes))
    return tuple(Message(each.identifier, AFTER + each.words) for each in found)


def no_modes_after(reason: str) -> Message:
    """The remark on why there are none."""
    return Message("no-modes-after", f"there are no modes of vibration after the time history: {reason}")


def _far(model: Model, modes: Modes, sag: float) -> bool:
    """Whether the state at rest is not near the one that was left: a block goes far, for its size and for the sag."""
    by = np.linalg.norm(modes.settlement[:, :3], axis=1)
    return bool((by > np.maximum(FAR * model.blocks.sizes, LESS_AREA * sag)).any())
