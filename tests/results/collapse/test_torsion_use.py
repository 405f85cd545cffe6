"""Shear and torsion of an interface over what it carries of both, against closed forms and another minimisation."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from mbla.results.collapse.thrust import thrust_of
from mbla.results.collapse.torsion_use import torsion_use
from tests.decks.folder import BENCHMARKS
from tests.line import case_of, line_of
from tests.results.synthetic import horizontal_contacts, tower_model

MU = 0.65
"""of the tower's joints"""


def use_of(forces: list[list[float]], width: float = 2.0, depth: float = 2.0, friction: float = MU) -> float:
    """One interface, its corners in the order (0, 0), (width, 0), (width, depth), (0, depth); forces N, T1, T2."""
    model = tower_model()
    model = replace(model, joints={name: replace(law, friction=friction) for name, law in model.joints.items()})
    contacts = horizontal_contacts([[0, 1]], [(0, width, 0, depth, 0)])
    (use,) = torsion_use(model, contacts, np.array(forces, dtype=float), "concave")
    return float(use)


def around(sizes: list[float], normal: float = 10.0) -> list[list[float]]:
    """Shear forces at the corners of a square at right angles to their arms, all in one sense."""
    contacts = horizontal_contacts([[0, 1]], [(0, 2, 0, 2, 0)])
    arms = np.einsum("pjx,px->pj", contacts.frames[:, 1:], contacts.points - contacts.centroids[0])
    across = np.column_stack([-arms[:, 1], arms[:, 0]]) / np.sqrt(2)
    return [[normal, *(size * way).tolist()] for size, way in zip(sizes, across, strict=True)]


@pytest.mark.parametrize("share", [1.0, 0.4])
def test_pure_torsion_of_a_square_at_failure_is_1(share: float) -> None:
    assert use_of(around([share * MU * 10.0] * 4)) == pytest.approx(share)


def test_pure_shear_is_the_use_of_friction() -> None:
    assert use_of([[10, 3, 0]] * 4) == pytest.approx(0.3 / MU)


def test_forces_without_a_resultant_use_nothing() -> None:
    """Points of one face that strain against each other ask nothing of the interface."""
    assert use_of([[10, 5, 0], [10, -5, 0], [10, -5, 0], [10, 5, 0]]) == pytest.approx(0.0, abs=1e-12)


def test_a_turn_about_the_one_point_that_presses_more() -> None:
    """Three points slide about the fourth, which is pressed so much that it stays: they alone carry the moment."""
    forces = around([0.0] * 4)
    forces[0][0] = 1000.0
    arms = [2.0, 2.0 * np.sqrt(2.0), 2.0]  # of corners 1, 2 and 3 about corner 0
    for corner, (first, second) in zip((1, 2, 3), ((0, 1), (-1, 1), (-1, 0)), strict=True):
        way = np.array([first, second]) / np.hypot(first, second)
        forces[corner][1:] = (MU * 10.0 * way).tolist()
    forces[0][1:] = (-np.sum([force[1:] for force in forces[1:]], axis=0)).tolist()
    moments = MU * 10.0 * np.array(arms)
    assert moments.sum() == pytest.approx(MU * 10.0 * (4.0 + 2.0 * np.sqrt(2.0)))
    assert use_of(forces) == pytest.approx(1.0)


def test_nothing_acts_nothing_is_allowed_and_unlimited_friction() -> None:
    assert np.isnan(use_of([[0, 0, 0]] * 4))
    assert use_of(around([1.0] * 4), friction=np.inf) == 0.0
    assert use_of([[10, 1, 0]] * 4, friction=0.0) == np.inf


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_neither_force_nor_length_matters(scale: float) -> None:
    forces = np.array([[10, 3, 1], [2, 0, -1], [7, 1, 1], [0.1, 0, 0.05]])
    assert use_of((scale * forces).tolist(), 3.0 * scale, scale) == pytest.approx(use_of(forces.tolist(), 3.0, 1.0))


@pytest.mark.parametrize("seed", range(12))
def test_the_use_is_the_maximum_over_motions(seed: int) -> None:
    """A simplex search over slips and rotations finds no motion that gives more."""
    rng = np.random.default_rng(seed)
    forces = np.column_stack([10.0 * rng.random(4) ** 3, rng.normal(size=(4, 2))])
    contacts = horizontal_contacts([[0, 1]], [(0, 3, 0, 1, 0)])
    arms = np.einsum("pjx,px->pj", contacts.frames[:, 1:], contacts.points - contacts.centroids[0])

    def less(motion: Any) -> float:
        velocity = motion[:2] + motion[2] * np.column_stack([-arms[:, 1], arms[:, 0]])
        dissipated = float(MU * forces[:, 0] @ np.linalg.norm(velocity, axis=1))
        return -abs(float(np.sum(forces[:, 1:] * velocity))) / dissipated

    starts = rng.normal(size=(2, 3))
    found = max(-float(minimize(less, start, method="Nelder-Mead", tol=1e-9).fun) for start in starts)
    use = use_of(forces.tolist(), 3.0, 1.0)
    assert use >= found * (1 - 1e-3)
    # what at each point would do for the same resultant is no less
    assert use <= np.max(np.hypot(forces[:, 1], forces[:, 2]) / (MU * forces[:, 0])) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("deck", "case"), [("torque", 0), ("torque_inset", 0), ("torque_convex", 0), ("torque_convex", 1)]
)
def test_blocks_that_fail_by_torsion_use_all_while_their_shear_is_none(deck: str, case: int) -> None:
    """On the path an interface whose force point is in the middle gives up a thousandth of what it can resist."""
    text = BENCHMARKS[deck].read_text(encoding="utf-8")
    model, result = case_of(text, case=case)
    mechanics = result.solution.mechanics
    assert mechanics is not None
    within = {"torque_convex": (1.1e-3, 1e-5)[case]}.get(deck, 3e-6)
    contacts = line_of(text).contacts
    assert thrust_of(model, contacts, mechanics.contact_forces).friction_use == pytest.approx(0.0, abs=1e-9)
    use = torsion_use(model, contacts, mechanics.contact_forces, result.solution.contact_model)
    assert use == pytest.approx(1.0, abs=within)
    half = mechanics.contact_forces * [1.0, 0.5, 0.5]
    assert torsion_use(model, contacts, half, result.solution.contact_model) == pytest.approx(0.5, abs=within)
