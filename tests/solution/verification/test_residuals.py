"""Residuals of one block on the ground, by hand: weight W on four corners, sliding along +x at unit speed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from mbla.contacts.contacts import Contacts
from mbla.solution.solution import Mechanics
from mbla.solution.verification.case import Case
from mbla.solution.verification.residuals import Residuals, residuals_of
from tests.line import BLOCK, Line, line_of

MU = 0.3


@pytest.fixture(scope="module")
def line() -> Line:
    return line_of(BLOCK, f"parameters.mu={MU}", "parameters.h=0.5")


def sliding(line: Line) -> Mechanics:
    """The exact state without dilatancy: pushed by μ W, each corner carries its share of weight and moment."""
    weight = float(-line.load_case.dead_load[0, 2])
    lean = 0.25 * MU * 0.5 * weight  # moment of the push about the ground, over two corners a metre apart
    points, bodies = line.contacts.points, line.contacts.bodies[line.contacts.interface_of_point]
    on_block = np.where(bodies[:, :1] == 0, -1.0, 1.0)  # forces on b along the frame; the block may be a
    normal = 0.25 * weight + np.where(points[:, 0] > 0.5, lean, -lean)
    pushed = on_block * np.array([[-1.0, 0.0, 0.0]])
    friction = MU * normal[:, None] * pushed
    forces = np.einsum("pjx,px->pj", line.contacts.frames, friction)
    forces[:, 0] = normal
    mechanism = np.array([[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]]) / float(line.load_case.live_load[0, 0])
    return Mechanics(MU, forces, np.zeros_like(forces), mechanism, np.zeros(len(forces), dtype=np.int64))


def residuals(line: Line, mechanics: Mechanics, tangent: float = 0.0) -> Residuals:
    dilatancy = np.full(len(line.contacts.points), tangent)
    return residuals_of(Case(line.model, line.contacts, line.load_case), mechanics, dilatancy)


def test_the_exact_state_has_none(line: Line) -> None:
    found = residuals(line, sliding(line))
    assert found.largest < 1e-14
    assert max(found.tension, found.slip) < 1e-14
    assert found.live_power == pytest.approx(1.0)


def test_dilatancy_claimed_but_not_there(line: Line) -> None:
    """Associative flow would open by μ: N μ s at every corner is the whole power."""
    found = residuals(line, sliding(line), tangent=MU)
    assert found.complementarity == pytest.approx(1.0)
    assert found.slip < 1e-14


def test_sliding_across_the_friction(line: Line) -> None:
    """Turned by 90 degrees the friction does no work: all of μ W s is unexplained, and counted as slip."""
    state = sliding(line)
    turned = state.mechanism[:, [1, 0, 2, 3, 4, 5]]
    found = residuals(line, replace(state, mechanism=turned))
    assert found.slip == pytest.approx(1.0)
    assert found.complementarity == pytest.approx(1.0)


def test_opening_under_force(line: Line) -> None:
    """Lifting by a tenth of the sliding: W times that of the power μ W, none of it slip."""
    state = sliding(line)
    lifted = state.mechanism.copy()
    lifted[0, 2] = 0.1 * lifted[0, 0]
    found = residuals(line, replace(state, mechanism=lifted))
    assert found.slip < 1e-14
    assert found.complementarity == pytest.approx(0.1 / MU)


def test_tension_is_told_apart_from_too_much_shear(line: Line) -> None:
    state = sliding(line)
    weight = float(-line.load_case.dead_load[0, 2])
    pulled, sheared = state.contact_forces.copy(), state.contact_forces.copy()
    pulled[0] = [-0.01 * weight, 0.0, 0.0]
    sheared[0, 1:] *= 1.5
    assert residuals(line, replace(state, contact_forces=pulled)).tension == pytest.approx(0.01)
    found = residuals(line, replace(state, contact_forces=sheared))
    assert found.tension == 0.0
    shear = float(np.linalg.norm(state.contact_forces[0, 1:]))
    assert found.yielding == pytest.approx(0.5 * shear / weight)


def test_the_largest_is_not_a_number_where_one_is_not(line: Line) -> None:
    state = sliding(line)
    found = residuals(line, replace(state, mechanism=np.zeros_like(state.mechanism)))
    assert np.isnan(found.largest)


@pytest.mark.parametrize("share", [1.0, 1e-4, 1e-8])
def test_an_unbalanced_light_block_is_judged_by_its_own_weight(share: float) -> None:
    """Two blocks side by side, forces everywhere zero: whatever its weight, the whole of it is unbalanced."""
    light = "  - box: {group: light, material: feather, min: [5, 0, 0], max: [6, 1, 1]}\n"
    text = BLOCK.replace("blocks:\n", f"blocks:\n{light}").replace(
        "stone: {density: 2000}", f"stone: {{density: 2000}}, feather: {{density: {2000 * share!r}}}"
    )
    line = line_of(text)
    none: NDArray[np.float64] = np.zeros((len(line.contacts.points), 3))
    motion = np.zeros((2, 6))
    motion[:, 0] = 1.0 / line.load_case.live_load[:, 0].sum()
    carried = _weight_of_the_other(line.contacts, none, line)
    found = residuals(line, Mechanics(0.0, carried, none, motion, np.zeros(len(none), dtype=np.int64)))
    assert found.equilibrium == pytest.approx(1.0)


def _weight_of_the_other(contacts: Contacts, forces: NDArray[np.float64], line: Line) -> NDArray[np.float64]:
    """The heavy block on its corners, the light one on nothing."""
    heavy = int(np.argmin(line.load_case.dead_load[:, 2]))
    here = (contacts.bodies[contacts.interface_of_point] == heavy).any(axis=1)
    carried = forces.copy()
    carried[here, 0] = -line.load_case.dead_load[heavy, 2] / here.sum()
    return carried
