"""Verification of the range of a non-associative load factor: each end is a state of the joint law of its own.

An end is believed where its own forces balance the loads at its load factor, keep to the yield conditions and fit, by
the flow rule claimed, the mechanism of the load factor reported; all recomputed as for the load factor itself. That
nothing lies beyond the ends is the word of the solver; that everything between them is possible needs no more than the
two, since the states of one mechanism are convex.
"""

from __future__ import annotations

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.solution.solution import Mechanics, Solution
from mbla.solution.verification.residuals import residuals_of

END_RESIDUAL = 1e-6
"""Largest residual of an end; that of the load factor reported where that is larger."""

MOST_RESIDUAL = 1e-4
"""Beyond this residual of the load factor reported nothing is said of its range."""

SAME = 1e-9
"""Share of the largest velocity by which the mechanism of an end may differ: it is stored as the same."""


def range_checks(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> tuple[float, float]:
    """Lower and upper end of the range where they are verified, NaN where they are not or where there is none."""
    found = solution.mechanics
    if found is None or (solution.lower is None and solution.upper is None):
        return np.nan, np.nan
    limits = yield_limits(model, contacts)
    dilatancy = limits.dilatancy if solution.flow_rule == "dilatancy" else np.zeros_like(limits.dilatancy)
    left = residuals_of(model, contacts, load_case, found, dilatancy).largest
    if not left <= MOST_RESIDUAL:
        return np.nan, np.nan
    allowed = max(END_RESIDUAL, left)

    def verified(end: Mechanics | None, sign: float) -> float:
        if end is None or sign * (end.load_factor - found.load_factor) < 0.0:
            return np.nan
        speed = float(np.abs(found.mechanism).max(initial=0.0))
        if np.abs(end.mechanism - found.mechanism).max(initial=0.0) > SAME * speed:
            return np.nan
        fits = residuals_of(model, contacts, load_case, end, dilatancy).largest <= allowed
        return end.load_factor if fits else np.nan

    return verified(solution.lower, -1.0), verified(solution.upper, 1.0)
