"""``mbla verify --again``: a pushover followed anew from the deck in a file, beside the rows that the file has.

It begins with the state of the file and makes the same steps: on the same machine it comes to the same rows. Another
machine may round otherwise, and behind a jump that may show. So curves are compared, not rows: at each row of the one
the load factor of the other, on the line between its rows.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.model import Model
from mbla.results.listing.history_words import pushover_words
from mbla.results.results import CaseResult, PushoverAgain
from mbla.results.verification.asked import Found
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.followed import greatest_value
from mbla.solution.pushover.push import push
from mbla.solution.pushover.pushover import Pushover
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.solution import Status

ALLOWED = 2e-3
"""Change of a load factor, over the greatest of the curve, and of an energy, up to which two curves are one."""

SAME_ERROR = 2.0
"""Errors of load factors over those found anew, and their inverse, with which they are the same."""

SMALL_ERROR = 1e-4
"""Error over the greatest load factor that need not be the same."""


def pushover_again(deck: Deck, assembly: Assembly, case: CaseResult) -> PushoverAgain | None:
    """The pushover followed anew, beside that of the file; None where it has none, or cannot have.

    case : with checks, status and curve recomputed
    """
    own, load_case = case.solution.further.pushover, case.load_case
    if own.rows is None or load_case.pushover is None or len(own.curve) < 2 or case.status is not Status.SOLVED:
        return None
    if own.curve_end is CurveEnd.LATE:  # as far as it came
        asked = replace(load_case.pushover, steps=len(own.curve) - 1, error=False)
        load_case = replace(load_case, pushover=asked)
    settings = replace(settings_for(load_case, solver_settings(deck.analysis)), deadline=None)
    again, _ = push(assembly, deck.contacts, load_case, case.solution, settings, lambda record: None, solved=True)
    return None if again.rows is None else _beside(case, again)


def _beside(case: CaseResult, again: Pushover) -> PushoverAgain:
    own = case.solution.further.pushover
    late = own.curve_end is CurveEnd.LATE
    greatest = max(greatest_value(case.load_case, _column(each, "load_factor")) for each in (own, again))
    off, at = max(_off(one, other, "load_factor") for one, other in ((own, again), (again, own)))
    energies = ("live_work", "friction", "tie_work", "crushing", "potential")
    size = max(float(np.abs(_column(again, name)).max()) for name in energies)
    of_energy = max(_off(own, again, name)[0] for name in energies)
    against = {
        "its end": own.curve_end is not again.curve_end and not late,
        "its energies": of_energy > ALLOWED * max(size, 1e-300),
        "its errors": not late and not _same_errors(own, again, greatest),
        "where it jumps": sum(row.jumps for row in own.curve) != sum(row.jumps for row in again.curve),
        "the blocks that fall": own.curve[-1].debris != again.curve[-1].debris,
    }
    share = off / max(greatest, 1e-300)
    return PushoverAgain(
        case=case.load_case.name,
        steps=len(again.curve) - 1,
        steps_in_file=len(own.curve) - 1,
        end=again.curve_end.value,
        off=share,
        at=at,
        allowed=ALLOWED,
        others=tuple(name for name, holds in against.items() if holds),
        agrees=share <= ALLOWED and not any(against.values()),
    )


def _column(pushover: Pushover, name: str) -> FloatArray:
    return np.array([getattr(row, name) for row in pushover.curve])


def _off(one: Pushover, other: Pushover, name: str) -> tuple[float, float]:
    """Greatest difference at the rows of one from the other, and its displacement; where that has not been, all."""
    moved, their = _column(one, "displacement"), np.maximum.accumulate(_column(other, "displacement"))
    off = np.abs(_column(one, name) - np.interp(moved, their, _column(other, name)))
    return float(off.max()), float(moved[off.argmax()])


def _same_errors(own: Pushover, again: Pushover, greatest: float) -> bool:
    """Whether the greatest of the errors of load factors, and those of the end, are what they are found to be."""

    def errors(of: Pushover) -> FloatArray:
        rows = _column(of, "error")
        most = float(np.nanmax(rows)) if np.isfinite(rows).any() else np.nan
        way = abs(of.curve[-1].displacement)
        return np.array([most / greatest, of.curve_last_error / greatest, of.curve_end_error / max(way, 1e-300)])

    one, other = errors(own), errors(again)
    near = (one <= SAME_ERROR * other + SMALL_ERROR) & (other <= SAME_ERROR * one + SMALL_ERROR)
    return bool((near | (np.isnan(one) & np.isnan(other))).all())


def held_against_pushover(found: Found, model: Model, case: CaseResult, again: PushoverAgain) -> None:
    """What a pushover that was followed anew shows, added to what was found of a case: it confirms, or differs."""
    if again.agrees:
        found.of_pushover.clear()
    else:
        found.differences.append(pushover_words(model, case.load_case, again))
