"""Conditions that are taken in where forces need them prove what all of them do."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.associative.proved_solution import AssociativeRun, proved_solution
from mbla.solution.associative.taken_conditions import TakenConditions
from mbla.solution.settings import SolverSettings
from tests.decks.folder import DECKS
from tests.solution.flow.paths import case_of

SETTINGS = SolverSettings(tolerance=1e-9)
CASES = [("nave_crushing", "roof_thrust"), ("nave_crushing", "quake"), ("bridge_axle_crushing", "axle")]


def run_of(taken: TakenConditions) -> AssociativeRun:
    return AssociativeRun(taken, SETTINGS, lambda record: None, 1, [])


@pytest.mark.parametrize(("deck", "case"), CASES)
def test_fewer_prove_the_same(deck: str, case: str) -> None:
    whole = case_of(DECKS / "regressions" / f"{deck}.yaml", case).loaded
    some, every = run_of(TakenConditions.least(whole)), run_of(TakenConditions.least(whole).with_all())
    found, known = proved_solution(some), proved_solution(every)
    assert found.gap is not None
    assert known.gap is not None
    assert every.conditions.program is whole
    assert 0 < some.conditions.taken.sum() < len(some.conditions.taken)
    assert found.gap.static <= known.gap.kinematic * (1.0 + 1e-9)
    assert known.gap.static <= found.gap.kinematic * (1.0 + 1e-9)
    assert found.gap.static == pytest.approx(known.gap.static, rel=1e-7)
    assert len(found.gap.velocities) == len(known.gap.velocities)


def test_of_every_piece_the_condition_that_is_exceeded_most_is_taken_in() -> None:
    whole = case_of(DECKS / "regressions" / "bridge_axle_crushing.yaml", "axle").loaded
    conditions, least = whole.conditions, TakenConditions.least(whole)
    assert conditions is not None
    (reserves,) = conditions.reserves
    at_corner = np.zeros((whole.n_points, whole.components))
    at_corner[0, 0] = reserves.pieces.strength.max()
    more, left = least.with_exceeded(at_corner), reserves.of(at_corner)
    assert more is not None
    assert (left.min(axis=0) < -0.1).sum() == 1
    assert np.unique(conditions.single[more.taken]).tolist() == [left.argmin()]
    assert more.with_exceeded(0.0 * at_corner) is None
    n_rows = len(whole.dead_load)
    velocities = more.of_whole(np.ones(n_rows + int(more.taken.sum())))
    assert velocities.tolist() == np.append(np.ones(n_rows), more.taken).tolist()
    assert least.keep(0.0 * at_corner)
    assert not more.keep(at_corner)


def test_where_pieces_act_side_by_side_all_are_taken_in_from_the_beginning() -> None:
    whole = case_of(DECKS / "regressions" / "block_crushing_a_corner.yaml", "diagonal").loaded
    least = TakenConditions.least(whole)
    assert least.are_all
    assert least.program is whole
    assert not least.keep(np.zeros((whole.n_points, whole.components)))  # they are no functions of forces
