"""Expected load factors worked out by formulations that share nothing with the program stage."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.optimize import linprog

from mbla.arrays import FloatArray, IntArray
from tests.analytic.planar import arch_load_factor, polygon_arch
from tests.extremes.structures_alike import CROWNS, DOME, DOME_FACTOR, PUSHES
from tests.line import line_of
from tests.performance.rivals.statement import Statement, statement_of

pytestmark = pytest.mark.long

FRICTION = 5.0
VIOLATED = 1e-6
"""Excess over a friction cone, in mean block weights, that is cut off no further: the load factor of the dome would
fall by 1e-8 of itself."""


@pytest.mark.parametrize(("voussoirs", "thickness"), CROWNS)
def test_arches_pressed_at_the_crown(voussoirs: int, thickness: float) -> None:
    arch = polygon_arch(1 - thickness / 2, 1 + thickness / 2, np.pi, voussoirs)
    live = np.zeros((voussoirs, 2))
    live[voussoirs // 2, 1] = -1.0
    factor = arch_load_factor(arch, FRICTION, live)
    assert factor == pytest.approx(CROWNS[voussoirs, thickness], rel=1e-8)


@pytest.mark.parametrize(("voussoirs", "thickness"), PUSHES)
def test_arches_pushed(voussoirs: int, thickness: float) -> None:
    arch = polygon_arch(1 - thickness / 2, 1 + thickness / 2, np.pi, voussoirs)
    assert arch_load_factor(arch, FRICTION) == pytest.approx(PUSHES[voussoirs, thickness], rel=1e-8)


def test_dome_pushed() -> None:
    """The dome by linear programs that cut the friction cones where they are left: from above, to the cones."""
    line = line_of(DOME)
    statement = statement_of(line.model, line.contacts, line.load_case, planar=False).scaled()
    assert cut_to_cones(statement) == pytest.approx(DOME_FACTOR, rel=1e-6)


def cut_to_cones(statement: Statement) -> float:
    """Load factor within the true cones, from above: planes t·d ≤ μ n at the directions d of shear beyond them."""
    points, unknowns = len(statement.friction), statement.matrix.shape[1]
    every = np.arange(points)
    factor = np.inf
    cuts = [_cuts(statement, every, np.full(points, angle)) for angle in np.arange(8) * np.pi / 4]
    for _ in range(40):
        answer = linprog(
            np.append(np.zeros(unknowns), -1.0),
            A_ub=sp.vstack(cuts, format="csr"),
            b_ub=np.zeros(sum(cut.shape[0] for cut in cuts)),
            A_eq=sp.hstack([statement.matrix, sp.csr_array(statement.live.reshape(-1, 1))], format="csr"),
            b_eq=-statement.dead,
            bounds=[(0, None)] * points + [(None, None)] * (unknowns - points + 1),
            method="highs-ipm",
            options={"primal_feasibility_tolerance": 1e-9, "dual_feasibility_tolerance": 1e-9},
        )
        assert answer.status == 0, answer.message
        assert answer.x is not None
        factor = float(answer.x[-1])
        n, along, across = answer.x[:-1].reshape(3, -1)
        beyond = np.flatnonzero(np.hypot(along, across) - statement.friction * n > VIOLATED)
        if not len(beyond):
            break
        cuts.append(_cuts(statement, beyond, np.arctan2(across[beyond], along[beyond])))
    return factor


def _cuts(statement: Statement, points: IntArray, angles: FloatArray) -> sp.csr_array:
    """Rows t1 cos + t2 sin − μ n ≤ 0 of some points, (n, unknowns + 1)."""
    count, rows = len(statement.friction), np.arange(len(points))
    values = np.concatenate([-statement.friction[points], np.cos(angles), np.sin(angles)])
    columns = np.concatenate([points, points + count, points + 2 * count])
    shape = (len(points), statement.matrix.shape[1] + 1)
    return sp.csr_array((values, (np.tile(rows, 3), columns)), shape=shape)
