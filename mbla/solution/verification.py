"""Verification of one load case: each claim of a solution is recomputed by the file that knows it.

- :mod:`mbla.solution.verify`: residuals of forces and mechanism, bounds of the associative load factor, certificates;
- :mod:`mbla.solution.verify_range`: both ends of the range of a load factor without normality.
"""

from __future__ import annotations

from dataclasses import replace

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.solution.solution import Checks, Solution
from mbla.solution.verify import verify as verify_mechanics
from mbla.solution.verify_range import range_checks


def verify(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute everything that a solution claims, from model and contacts alone; NaN where there is nothing to check.

    No solver is asked, and no matrix of the program stage is used for a verdict.
    """
    checks = verify_mechanics(model, contacts, load_case, solution)
    lower, upper = range_checks(model, contacts, load_case, solution)
    return replace(checks, lower=lower, upper=upper)
