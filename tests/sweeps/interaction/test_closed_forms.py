"""Diagrams of one block, known exactly."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mbla.sweeps.answers import Answer
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.domain import corners_of
from tests.sweeps.interaction.hand_made import area_of_circle, solved

EXACT = 1e-6


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_a_block_slides_alike_in_all_directions(tmp_path: Path, flow_rule: str) -> None:
    """μ in each; the polygons are those in and around its circle."""
    found = solved(tmp_path, ["parameters.mu=0.3", f"analysis.flow_rule={flow_rule}"], case="push", directions=8)
    assert found.points.known == pytest.approx([0.3] * 8, rel=EXACT)
    assert set(found.table["mechanism.class"].tolist()) == {"sliding"}
    assert not found.domain.crossed
    assert (found.domain.inner.area, found.domain.outer.area) == pytest.approx(area_of_circle(8, 0.3), rel=1e-5)
    assert found.domain.gap == pytest.approx(1 - math.cos(math.pi / 8) ** 2, rel=1e-4)
    assert found.domain.everywhere == pytest.approx(0.3 * math.cos(math.pi / 8), rel=1e-5)
    assert found.study.exit_code == 0


def test_a_block_turns_over_its_edges_and_corners(tmp_path: Path) -> None:
    """About the edges the factor is b/h over the cosine to each normal; the domain is the rectangle of both."""
    found = solved(tmp_path, ["parameters.by=1.4"], case="push", directions=12)
    for factor, way in zip(found.points.known, np.abs(found.points.ways), strict=True):
        assert factor == pytest.approx(min(b / (2 * s) for b, s in zip((1.0, 1.4), way, strict=True) if s), rel=EXACT)
    assert np.abs(corners_of(found.domain.outer)).max(axis=0) == pytest.approx([0.5, 0.7], rel=1e-5)
    assert found.domain.outer.area == pytest.approx(1.0 * 1.4, rel=1e-5)
    assert found.study.record["interaction"]["least"]["angles"] == [0.0, 180.0]


def test_the_interaction_polygon_of_two_loads(tmp_path: Path) -> None:
    """Mass force α W at mid-height and β W at the top: α + β ≤ μ slides, α + 2 β ≤ b/h turns over."""
    found = solved(tmp_path, ["parameters.mu=0.4"], loads=("push", "top"), directions=7)
    for factor, power, angle in zip(found.points.known, found.points.powers, found.question.angles, strict=True):
        cosine, sine = horizontal(angle, 1.0)
        assert factor == pytest.approx(min(0.4 / (cosine + sine), 0.5 / (cosine + 2 * sine)), rel=EXACT)
        assert power @ (cosine, sine) == pytest.approx(1.0)
    corners = {(round(float(x), 5) + 0.0, round(float(y), 5) + 0.0) for x, y in corners_of(found.domain.outer)}
    assert corners == {(0.0, 0.0), (0.4, 0.0), (0.3, 0.1), (0.0, 0.25)}


def test_a_load_that_never_brings_collapse_leaves_the_domain_open(tmp_path: Path) -> None:
    """Pressed down the block slides at μ (W + β): sin φ large enough, never; the ray itself is safe."""
    found = solved(tmp_path, ["parameters.mu=0.4"], loads=("push", "down"), directions=3)
    assert found.points.factors.answer.tolist() == [Answer.VALUE, Answer.VALUE, Answer.UNBOUNDED]
    assert found.domain.cut_off
    assert math.isnan(found.domain.gap)
    assert "it is unbounded at 90 degrees, so that it has no area of which a share could be left open" in found.words
    assert found.study.exit_code == 0


def test_a_point_that_cannot_be_asked_fails_alone(tmp_path: Path) -> None:
    """At 135 degrees a load and the same the other way cancel each other: exit status of the deck that this is."""
    same = ["load_cases.named.live=[{acceleration: [1, 0, 0]}]"]
    found = solved(tmp_path, same, loads=("push", "named"), directions=3, start=90.0, end=180.0)
    assert found.table["state"].tolist() == ["done", "failed", "done"]
    assert "at 135 degrees: " in found.words
    assert "cancel each other" in found.words
    assert found.study.exit_code == 3
