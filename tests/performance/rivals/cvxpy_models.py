"""The cone program through cvxpy: as a user writes it from the statement, and with the care that it takes.

``plain`` is the static form in N and m with the default solver of cvxpy (Clarabel) and its default tolerances, written
with vectors and not point by point. ``scaled`` is the same with weights and lengths of the size of one and tolerances
of 1e-9; ``kinematic`` the dual in velocities, scaled likewise, whose tolerance costs less accuracy of the load factor.
"""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

from tests.performance.rivals.answer import Answer, timed
from tests.performance.rivals.statement import Statement

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


def kinematic(statement: Statement) -> Answer:
    """min −f_D·u  subject to  f_L·u = 1,  vn ≥ μ ‖vt‖,  v = Aᵀu; scaled, sharp tolerances."""
    cp = _cvxpy()
    scaled = statement.scaled()
    mechanism = cp.Variable(len(scaled.dead))
    points = len(scaled.friction)
    velocities = scaled.matrix.T @ mechanism
    slips = [velocities[j * points : (j + 1) * points] for j in range(1, scaled.components)]
    live = scaled.live @ mechanism == 1
    opening = _cone(cp, velocities[:points], [cp.multiply(scaled.friction, slip) for slip in slips])
    problem = cp.Problem(cp.Minimize(-scaled.dead @ mechanism), [live, *opening])
    status, seconds = _solved(problem, SHARP)
    if mechanism.value is None:
        return Answer(status, None, None, None, seconds)
    return Answer(status, float(problem.value), None, None, seconds)


def _static(statement: Statement, options: dict[str, float]) -> Answer:
    cp = _cvxpy()
    points = len(statement.friction)
    forces, load_factor = cp.Variable(statement.components * points), cp.Variable()
    normal, shears = forces[:points], [forces[j * points : (j + 1) * points] for j in range(1, statement.components)]
    balance = statement.matrix @ forces + statement.dead + load_factor * statement.live == 0
    within = _cone(cp, cp.multiply(statement.friction, normal), shears)
    problem = cp.Problem(cp.Maximize(load_factor), [balance, *within])
    status, seconds = _solved(problem, options)
    if forces.value is None:
        return Answer(status, None, None, None, seconds)
    factor = float(load_factor.value)
    return Answer(status, factor, statement.residual(np.asarray(forces.value), factor), None, seconds)


def _cone(cp: Any, limit: Any, components: list[Any]) -> list[Any]:
    """‖components‖ ≤ limit at every point: two half-planes of a single component, else a second-order cone."""
    if len(components) == 1:
        return [components[0] <= limit, -components[0] <= limit]
    return [cp.SOC(limit, cp.vstack(components), axis=0)]


def _solved(problem: Any, options: dict[str, float]) -> tuple[str, float]:
    """Status, and seconds of the processor in Clarabel; the steps are those of ``problem.solve()``."""
    data, chain, inverse = problem.get_problem_data("CLARABEL", solver_opts=options)
    raw, seconds = timed(lambda: chain.solve_via_data(problem, data, False, False, options))
    problem.unpack_results(raw, chain, inverse)
    return str(problem.status), seconds
