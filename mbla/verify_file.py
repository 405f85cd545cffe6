"""``mbla verify``: every residual and bound recomputed from a result file alone, with no solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.exit_status import exit_code
from mbla.results.results import Results
from mbla.solution.solution import Checks
from mbla.solution.verification import verify
from mbla.solution.verify import verified_status

AGREEMENT = 1e-6
"""Difference of stored and recomputed figures, relative and absolute, beyond which the file is not what a run wrote;
sparse factorisations of another machine may round differently."""


def verify_results(results: Results) -> tuple[Results, tuple[str, ...]]:
    """Results with checks, status and exit status recomputed, and where they disagree with what the file says."""
    cases, disagreements = [], []
    for case in results.cases:
        checks = verify(results.model.of_case(case.load_case), results.contacts, case.load_case, case.solution)
        status = verified_status(case.solution, checks)
        name = case.load_case.name
        disagreements += [f"{name}: {text}" for text in _differences(case.checks, checks)]
        if status is not case.status:
            disagreements.append(f"{name}: the file says {case.status}, recomputed it is {status}")
        cases.append(replace(case, checks=checks, status=status))
    code = exit_code(cases)
    if disagreements and code in (0, 5):
        code = 4
    return replace(results, cases=tuple(cases), exit_code=code), tuple(disagreements)


def _differences(stored: Checks, recomputed: Checks) -> list[str]:
    found = []
    for name in (
        "static_bound",
        "kinematic_bound",
        "equilibrium_residual",
        "yield_violation",
        "tension_violation",
        "slip_residual",
        "peak_load_factor",
        "lower",
        "upper",
        "complementarity_residual",
    ):
        old, new = getattr(stored, name), getattr(recomputed, name)
        same = np.isclose(old, new, rtol=AGREEMENT, atol=AGREEMENT, equal_nan=True)
        if not same:
            found.append(f"{name.replace('_', ' ')} is {new:.6g} recomputed, the file says {old:.6g}")
    return found
