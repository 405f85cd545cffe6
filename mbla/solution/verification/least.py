"""Least: the state of rigid joints of the least load factor that a search found.

The state is accepted where its forces balance the loads at its load factor, lie within the yield conditions and fit
its mechanism by the flow rule of rigid joints. Nothing claims that no lower state exists.
"""

from __future__ import annotations

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.solution.solution import Solution
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.residuals import residuals_of


def least_check(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> float:
    """Load factor of the least state where it fits the law of rigid joints; NaN where not, and where there is none."""
    least = solution.least
    if least is None:
        return np.nan
    case = LoadedModel(model, contacts, load_case)
    dilatancy = case.limits.dilatancy if solution.flow_rule == "dilatancy" else np.zeros(len(contacts.points))
    fits = residuals_of(case, least, dilatancy).largest <= SOLVED_RESIDUAL
    return least.load_factor if fits else np.nan
