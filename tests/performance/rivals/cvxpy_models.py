"""The cone program through cvxpy: as a user writes it from the statement, and with the care that it takes.

``plain`` is the static form in N and m with the default solver of cvxpy (Clarabel) and its default tolerances, written
with vectors and not point by point. ``scaled`` is the same with weights and lengths of the size of one and tolerances
of 1e-9.
"""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

from tests.performance.rivals.statement import Statement
from tests.performance.rivals.structure import Answer

SHARP = {"tol_gap_abs": 1e-9, "tol_gap_rel": 1e-9, "tol_feas": 1e-9}


def cvxpy_version() -> str:
    """Of cvxpy and its solver; ImportError where it is not installed."""
    return f"cvxpy {_cvxpy().__version__} clarabel {version('clarabel')}"


def _cvxpy() -> Any:
    return import_module("cvxpy")


def plain(statement: Statement) -> Answer:
    """Static form in the deck's units, everything by default."""
    return _static(statement, {})


def scaled(statement: Statement) -> Answer:
    """Static form in units of weight and block size, sharp tolerances."""
    return _static(statement.scaled(), SHARP)


def _static(statement: Statement, options: dict[str, float]) -> Answer:
    cp = _cvxpy()
    points = len(statement.friction)
    forces, load_factor = cp.Variable(statement.components * points), cp.Variable()
    normal, shears = forces[:points], [forces[j * points : (j + 1) * points] for j in range(1, statement.components)]
    balance = statement.matrix @ forces + statement.dead + load_factor * statement.live == 0
    within = _cone(cp, cp.multiply(statement.friction, normal), shears)
    problem = cp.Problem(cp.Maximize(load_factor), [balance, *within])
    problem.solve(solver="CLARABEL", **options)
    if forces.value is None:
        return Answer(str(problem.status))
    factor = float(load_factor.value)
    return Answer(str(problem.status), factor, statement.residual(np.asarray(forces.value), factor))


def _cone(cp: Any, limit: Any, components: list[Any]) -> list[Any]:
    """‖components‖ ≤ limit at every point: two half-planes of a single component, else a second-order cone."""
    if len(components) == 1:
        return [components[0] <= limit, -components[0] <= limit]
    return [cp.SOC(limit, cp.vstack(components), axis=0)]
