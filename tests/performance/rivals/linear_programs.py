"""The linear program through ``scipy.optimize.linprog``, whose solver is HiGHS: exact in a plane, else eight sides.

In space the friction polyhedron is inscribed, with corners along the tangents, so that the answer is on the safe side.
``simplex`` is what a user gets by default, in N and m; ``interior`` the interior point method on the scaled statement.
"""

from __future__ import annotations

from importlib.metadata import version
from typing import Literal

import numpy as np
import scipy.sparse as sp
from scipy.optimize import linprog

from mbla.arrays import FloatArray
from tests.performance.rivals.statement import Statement
from tests.performance.rivals.structure import Answer

SIDES = 8


def highs_version() -> str:
    """Of the library that brings HiGHS along."""
    return f"scipy {version('scipy')}"


def by_default(statement: Statement) -> Answer:
    """In the deck's units, HiGHS choosing its method."""
    return _solved(statement, "highs")


def interior(statement: Statement) -> Answer:
    """In units of weight and block size, by interior points and crossover."""
    return _solved(statement.scaled(), "highs-ipm")


def friction_sides(statement: Statement, sides: int = SIDES) -> sp.csr_array:
    """Rows F with F x ≤ 0: the polyhedron inscribed in every friction cone, its corners along the tangents."""
    points = len(statement.friction)
    one = sp.eye_array(points, format="csr")
    by_friction = sp.diags_array(statement.friction)
    if statement.components == 2:
        return sp.csr_array(sp.vstack([sp.hstack([-by_friction, one]), sp.hstack([-by_friction, -one])]))
    angles = (2 * np.arange(sides) + 1) * np.pi / sides
    near = np.cos(np.pi / sides)
    rows = [sp.hstack([-near * by_friction, np.cos(angle) * one, np.sin(angle) * one]) for angle in angles]
    return sp.csr_array(sp.vstack(rows))


def _solved(statement: Statement, method: Literal["highs", "highs-ipm"]) -> Answer:
    points, unknowns = len(statement.friction), statement.matrix.shape[1]
    sides = friction_sides(statement)
    none = sp.csr_array((sides.shape[0], 1))
    cost: FloatArray = np.append(np.zeros(unknowns), -1.0)
    limits = [(0, None)] * points + [(None, None)] * (unknowns - points + 1)
    answer = linprog(
        cost,
        A_ub=sp.hstack([sides, none], format="csr"),
        b_ub=np.zeros(sides.shape[0]),
        A_eq=sp.hstack([statement.matrix, sp.csr_array(statement.live.reshape(-1, 1))], format="csr"),
        b_eq=-statement.dead,
        bounds=limits,
        method=method,
    )
    if answer.status != 0 or answer.fun is None or answer.x is None:
        return Answer(str(answer.message))
    factor = float(-answer.fun)
    return Answer("optimal", factor, statement.residual(answer.x[:-1], factor))
