"""Verification of a peak of the load path: that the structure can carry it, by statics alone.

The state at a peak is passed and not at rest, so that its velocities prove nothing. Its forces do: they balance the
loads at its load factor within the yield conditions. That the path goes down from there is the word of the solver.
"""

from __future__ import annotations

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.solution.solution import Mechanics
from mbla.solution.verification.residuals import residuals_of

CARRIED = 1e-6
"""Largest residual of equilibrium and yield with which forces show that a load is carried."""


def peak_check(model: Model, contacts: Contacts, load_case: LoadCase, peak: Mechanics | None) -> float:
    """Load factor of a peak where its forces carry it, NaN where they do not or where there is none."""
    if peak is None:
        return np.nan
    residuals = residuals_of(model, contacts, load_case, peak, np.zeros(len(peak.contact_forces)))
    carried = residuals.equilibrium <= CARRIED and residuals.yielding <= CARRIED  # neither where it is no number
    return peak.load_factor if carried else np.nan
