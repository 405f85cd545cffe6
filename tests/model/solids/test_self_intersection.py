from __future__ import annotations

import numpy as np
import pytest

from tests.model.shapes import L_OUTLINE, Shape, box, build, moved, prism, rotation

PENTAGRAM = [(np.cos(4 * np.pi * i / 5), np.sin(4 * np.pi * i / 5)) for i in range(5)]
CROSSED = [(0, 0), (2, 0), (2, 2), (0, 2), (0, 1.5), (3, 1), (0, 0.5)]
COMB = [(0, 0), (5, 0), (5, 2), (4, 2), (4, 1), (3, 1), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
SLIT = [(0, 0), (2, 0), (2, 2), (1.0001, 2), (1.0001, 1), (1, 1), (1, 2), (0, 2)]


def spiked(tip: float) -> Shape:
    """A box whose top is drawn to a tip inside it; the tip leaves through the bottom for ``tip`` below 0."""
    vertices, faces = box()
    spike = [[4, 5, 8], [5, 6, 8], [6, 7, 8], [7, 4, 8]]
    return [*vertices, [0.4, 0.45, tip]], [faces[0], *spike, *faces[2:]]


@pytest.mark.parametrize("outline", [L_OUTLINE, COMB, SLIT])
@pytest.mark.parametrize("seed", [0, 1])
def test_non_convex_blocks_are_sound(outline: list[tuple[float, float]], seed: int) -> None:
    built = build(moved(prism(outline), rotation(seed), (100, 0, 0)))
    assert not built.defects
    assert built.blocks.convex.tolist() == [False]


@pytest.mark.parametrize("tip", [0.5, 0.1, 0.001])
def test_spike_inside_is_sound(tip: float) -> None:
    built = build(spiked(tip))
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([1 - (1 - tip) / 3])


@pytest.mark.parametrize("tip", [-0.001, -0.1, -5.0])
@pytest.mark.parametrize("seed", [0, 1])
def test_spike_through_the_bottom(tip: float, seed: int) -> None:
    (defect,) = build(moved(spiked(tip), rotation(seed))).defects
    assert defect.message.startswith("intersects itself: the edge between vertices")
    assert defect.message.endswith("meets face 0")
    assert defect.face == 0


def test_spike_that_touches_the_bottom() -> None:
    (defect,) = build(spiked(0.0)).defects
    assert defect.message.startswith("intersects itself")


@pytest.mark.parametrize("outline", [PENTAGRAM, CROSSED])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_outlines_that_cross_themselves(outline: list[tuple[float, float]], scale: float) -> None:
    (defect,) = build(moved(prism(outline), scale * rotation(2))).defects
    assert defect.message.startswith("intersects itself")


def test_bodies_joined_by_a_bridge_pass_through_each_other() -> None:
    # a U-shaped prism whose left leg is bent across its right one
    outline = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (4, 2), (4, 2.5)]
    (defect,) = build(prism(outline)).defects
    assert defect.message.startswith("intersects itself")


def test_only_the_culprit_is_reported() -> None:
    built = build(prism(L_OUTLINE), spiked(-0.1), prism(COMB), spiked(0.1))
    assert [defect.block for defect in built.defects] == [1]


def test_bent_neighbours_within_the_tolerance_do_not_intersect() -> None:
    vertices, faces = prism(L_OUTLINE)
    shaken = np.array(vertices) + np.random.default_rng(0).uniform(-2e-4, 2e-4, (12, 3))
    built = build((shaken.tolist(), faces))
    assert not built.defects
    assert [notice.identifier for notice in built.notices] == ["faces-not-quite-planar"]
