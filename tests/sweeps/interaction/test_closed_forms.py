"""Diagrams of one block, known exactly."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.domain import area, everywhere, extremes
from tests.sweeps.interaction.hand_made import solved

EXACT = 1e-6


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_a_block_slides_alike_in_all_directions(tmp_path: Path, flow_rule: str) -> None:
    """μ in each; of the circle the polygons have n/2 sin(2π/n) and n tan(π/n), whose ratio is cos² (π/n)."""
    study = solved(tmp_path, ["parameters.mu=0.3", f"analysis.flow_rule={flow_rule}"], case="push", directions=8)
    assert [point.load_factor for point in study.points] == pytest.approx([0.3] * 8, rel=EXACT)
    assert {point.mechanism for point in study.points} == {"sliding"}
    assert study.domain is not None
    assert not study.domain.crossings
    assert study.domain.gap == pytest.approx(1 - math.cos(math.pi / 8) ** 2, rel=1e-4)
    assert area(study.domain.inner) == pytest.approx(4 * 0.09 * math.sin(math.pi / 4), rel=1e-5)
    least = everywhere(study.domain, closed=True)
    assert least == pytest.approx(0.3 * math.cos(math.pi / 8), rel=1e-5)
    assert study.exit_code == 0


def test_a_block_turns_over_its_edges_and_corners(tmp_path: Path) -> None:
    """About the edges the factor is b/h over the cosine to each normal; the domain is the rectangle of both."""
    study = solved(tmp_path, ["parameters.by=1.4"], case="push", directions=12)
    for point in study.points:
        cosine, sine = map(abs, horizontal(point.angle, 1.0))
        expected = min(b / (2 * share) for b, share in ((1.0, cosine), (1.4, sine)) if share)
        assert point.load_factor == pytest.approx(expected, rel=EXACT)
    assert study.domain is not None
    assert np.abs(study.domain.outer).max(axis=0) == pytest.approx([0.5, 0.7], rel=1e-5)
    assert area(study.domain.outer) == pytest.approx(1.0 * 1.4, rel=1e-5)
    ends = extremes(study.points)
    assert ends is not None
    assert ends[0].angles == (0.0, 180.0)


def test_the_interaction_polygon_of_two_loads(tmp_path: Path) -> None:
    """Mass force α W at mid-height and β W at the top: α + β ≤ μ slides, α + 2 β ≤ b/h turns over."""
    study = solved(tmp_path, ["parameters.mu=0.4"], loads=("push", "top"), directions=7)
    for point in study.points:
        cosine, sine = horizontal(point.angle, 1.0)
        assert point.load_factor == pytest.approx(min(0.4 / (cosine + sine), 0.5 / (cosine + 2 * sine)), rel=EXACT)
        assert point.powers["push"] * cosine + point.powers["top"] * sine == pytest.approx(1.0)
    assert study.domain is not None
    corners = {(round(float(x), 5) + 0.0, round(float(y), 5) + 0.0) for x, y in study.domain.outer}
    assert corners == {(0.0, 0.0), (0.4, 0.0), (0.3, 0.1), (0.0, 0.25)}


def test_a_load_that_never_brings_collapse_leaves_the_domain_open(tmp_path: Path) -> None:
    """Pressed down the block slides at μ (W + β): sin φ large enough, never; the ray itself is safe."""
    study = solved(tmp_path, ["parameters.mu=0.4"], loads=("push", "down"), directions=3)
    assert [point.unbounded for point in study.points] == [False, False, True]
    assert study.domain is not None
    assert study.domain.cut_off
    assert math.isnan(study.domain.gap)
    assert study.exit_code == 0
