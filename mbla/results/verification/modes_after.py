"""Modes of vibration after a time history, derived anew: what they are, what is said of them, whether they lack."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.results.results import CaseResult
from mbla.solution.further.further import Further
from mbla.solution.modes.after import left_by, no_modes_after, remarks_after
from mbla.solution.modes.modes import Modes
from mbla.solution.solution import WITH_VALUE
from mbla.solution.verification.modes import checked_modes


def modes_after_again(deck: Deck | None, assembly: Assembly, load_case: LoadCase, further: Further) -> Modes:
    """As far as they are verified: not without the deck, nor where there can be none."""
    there = None if deck is None else left_by(assembly, deck.contacts, load_case, further.time_history)
    if there is None or isinstance(there, str):
        return replace(further.modes_after, residual=np.nan, verified=False)
    return checked_modes(there, further.modes_after)[0]


def modes_after_remarks(deck: Deck, assembly: Assembly, case: CaseResult) -> tuple[Message, ...]:
    """What a run must say of them; where it found none although they can be sought, it alone can say why."""
    if not _asked(case):
        return ()
    modes = case.solution.further.modes_after
    there = left_by(assembly, deck.contacts, case.load_case, case.solution.further.time_history)
    if isinstance(there, str):
        return (no_modes_after(there),)
    return remarks_after(there, modes, checked_modes(there, modes)[1]) if len(modes) else ()


def lacks_modes_after(deck: Deck, assembly: Assembly, case: CaseResult) -> bool:
    """Whether they are asked for, can be sought, and are not there."""
    if not _asked(case) or len(case.solution.further.modes_after):
        return False
    return not isinstance(left_by(assembly, deck.contacts, case.load_case, case.solution.further.time_history), str)


def _asked(case: CaseResult) -> bool:
    asked = case.load_case.modes > 0 and case.load_case.time_history is not None
    return asked and case.status in WITH_VALUE
