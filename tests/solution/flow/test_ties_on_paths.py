"""The path of what ties hold: closed forms, whatever their stiffness and slack, and ties that break."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.stiffness_shares import shares_of
from mbla.solution.flow import path_of_part as entry
from tests.decks.folder import BENCHMARKS
from tests.line import HEAD
from tests.solution.flow.paths import case_of

CLOSE = 1e-5
TIED, ROPES = BENCHMARKS["tied_wall"], BENCHMARKS["ring_rope_and_strip"]
HELD = [("push", 3.566474), ("push_back", 0.2)]
"""With two rods, prestressed, and a strut; without."""

LIFTED = (
    HEAD
    + """\
parameters: {C: 1000, D: 3000}
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, -1], max: [1, 1, 0]}
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
supports: [{blocks: foot}]
ties:
  - {strip: [[0, 0.5, -0.5], [0, 0.5, 0.5]], capacity: "=C"}
  - {strip: [[1, 0.5, -0.5], [1, 0.5, 0.5]], capacity: "=C"}
  - {strip: [[0.5, 0, -0.5], [0.5, 0, 0.5]], capacity: "=D"}
  - {strip: [[0.5, 1, -0.5], [0.5, 1, 0.5]], capacity: "=D"}
load_cases: {lift: {live: [{acceleration: [0, 0, 1]}]}}
"""
)
WEIGHT = 19620.0
"""A block of 1 m that is pulled off its foot, with a strip on each side."""


@pytest.mark.parametrize(("name", "expected"), HELD)
@pytest.mark.parametrize("stiffness", [0.01, 1.0, 100.0])
def test_the_stiffness_of_ties_does_not_count(
    name: str, expected: float, stiffness: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = case_of(TIED, name)
    factor = np.where(case.loaded.limits.friction == 0.0, stiffness, 1.0)
    monkeypatch.setattr(entry, "shares_of", lambda program: factor * shares_of(program))
    assert case.load_factor() == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(
    ("name", "expected", "close"), [("burst", 3.3196, 2e-5), ("lift", 0.301937, 1e-3), ("drag", 0.562128, CLOSE)]
)
def test_rings_strips_and_ropes(name: str, expected: float, close: float) -> None:
    """The rings hold two leaves whose joint the load opens; the strip is brittle: where it breaks is found to 1 %."""
    assert case_of(ROPES, name).load_factor() == pytest.approx(expected, rel=close)


@pytest.mark.parametrize(
    ("capacities", "never", "expected"),
    [
        ((1000.0, 3000.0), False, 6000.0),  # the strong ones bear more alone than all where the weak ones break
        ((1000.0, 1500.0), False, 4000.0),
        ((1000.0, 3000.0), True, 8000.0),
        ((1000.0, 1500.0), True, 5000.0),
    ],
)
def test_strips_that_break_one_after_the_other(capacities: tuple[float, float], never: bool, expected: float) -> None:
    """All get longer alike: at most 4 C, or 2 D once those of the capacity C are gone; 2 C + 2 D of such as yield."""
    text = LIFTED.replace('"=C"}', '"=C", breaks_at: never}').replace('"=D"}', '"=D", breaks_at: never}')
    weak, strong = capacities
    case = case_of(text if never else LIFTED, "lift", f"parameters.C={weak}", f"parameters.D={strong}")
    found = case.path()
    assert found.path is not None
    assert bool(found.path.broken) is not never
    factor = case.loaded.scaling.load_factor(found.load_factor)
    assert factor == pytest.approx((WEIGHT + expected) / WEIGHT, rel=1e-3)


BRITTLE = (
    HEAD
    + """\
parameters: {C: 4000}
joints: {dry: {friction: 0.8}}
blocks: [{box: {group: wall, material: stone, min: [0, 0, 0], max: [0.5, 2, 3]}}]
supports: [{ground: {z: 0}}]
ties: [{through: [[0, 1, 2.5], [-3, 1, 2.5]], on: [wall, ground], capacity: "=C", breaks_at: 0}]
load_cases: {out: {live: [{acceleration: [1, 0, 0]}]}}
"""
)


@pytest.mark.parametrize("capacity", [6e3, 18e3, 20e3])
def test_a_wall_is_held_until_its_rod_breaks(capacity: float) -> None:
    """On joints all closed: base slip u and turn θ under λ W at 1.5 m, a rod as stiff as a point at 2.5 m, four points
    0.25 m off the middle, 0.4 times as stiff along the joint."""
    rod, points = np.array([1.0, 2.5]), np.diag([4 * 0.4, 4 * 0.25**2])
    u = np.linalg.solve(points + np.outer(rod, rod), [1.0, 1.5])
    share = rod @ u  # of λ W
    assert case_of(BRITTLE, "out", f"parameters.C={capacity}").load_factor() == pytest.approx(
        capacity / (share * 3.0 * WEIGHT), rel=1e-3
    )


def test_a_tie_that_breaks_after_an_elongation_does_not_break_within_elastic_displacements() -> None:
    """They are nothing beside a length: rigid blocks have none."""
    text = LIFTED.replace("strip: [[0, 0.5, -0.5], [0, 0.5, 0.5]]", "through: [[0, 0.5, -0.5], [0, 0.5, 0.5]]")
    text = text.replace("strip: [[1, 0.5, -0.5], [1, 0.5, 0.5]]", "through: [[1, 0.5, -0.5], [1, 0.5, 0.5]]")
    later = case_of(text.replace('"=C"}', '"=C", breaks_at: 0.01}'), "lift").load_factor()
    once = case_of(text.replace('"=C"}', '"=C", breaks_at: 0}'), "lift").load_factor()
    assert later == pytest.approx((WEIGHT + 8000.0) / WEIGHT, rel=1e-3)
    assert once == pytest.approx((WEIGHT + 6000.0) / WEIGHT, rel=1e-3)
