"""The path with each law of joints: closed forms, and the associative figure where they dilate by their friction."""

from __future__ import annotations

import pytest

from mbla.solution.flow.settings import PathSettings
from tests.decks.folder import BENCHMARKS, PATHS
from tests.solution.flow.paths import case_of

CLOSE = 1e-5
DECK = {path.stem: path for path in PATHS}


@pytest.mark.parametrize(
    ("name", "expected"), [("sheared", 1.519368), ("pulled", 1.509684), ("rocking", 0.754842)], ids=str
)
def test_cohesion_and_tension(name: str, expected: float) -> None:
    assert case_of(BENCHMARKS["mortar_joint"], name).load_factor() == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(
    ("deck", "slope", "expected", "close"),
    [
        ("groove", 0.0, 0.969948, 3e-3),  # it creeps: at D = 50 a little is left
        ("groove_dilatancy", None, 1.056043, 3e-3),
        ("groove", 1.0, 1.109110, 5e-5),
    ],
)
def test_a_wedge_lifts_by_its_own_dilatancy(deck: str, slope: float | None, expected: float, close: float) -> None:
    case = case_of(BENCHMARKS[deck], "along")
    limits = case.loaded.limits
    own = float((limits.dilatancy / limits.friction).mean()) if slope is None else slope
    assert case.load_factor(slope=own) == pytest.approx(expected, rel=close)


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("deck", "name"),
    [
        ("ferris_wall_1", "push_x"),
        ("ferris_wall_5", "push_x"),
        ("leaves_rough", "to_thin"),
        ("wall_10x10", "in_plane"),
        ("arch_on_piers", "along"),
        ("two_leaf_walls", "unbonded"),
        ("cross_vault", "along_x"),
    ],
)
def test_with_normality_it_is_the_associative_figure(deck: str, name: str) -> None:
    """Far enough: where joints dilate the load rises slowly."""
    case = case_of(DECK[deck], name)
    associative = case.associative().state
    assert associative is not None
    found = case.path(PathSettings(until=500.0), slope=1.0)
    assert found.is_answer
    assert found.load_factor == pytest.approx(associative.load_factor, rel=3e-4)
