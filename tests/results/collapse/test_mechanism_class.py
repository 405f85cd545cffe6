"""Mechanisms whose class is known, solved or put together by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mbla
from mbla.results.collapse.failure import NOTABLE, MovingJoints, mechanism_class
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.records.json_record import results_json
from tests.decks.folder import BENCHMARKS

BLOCK = """
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.5}}}}
blocks:
  - box: {{group: block, material: stone, min: [0, 0, 0], max: [1, 1, {height}]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}, joint: dry}}]
load_cases: {{case: {{live: [{live}]}}}}
analysis: {{flow_rule: associative}}
"""


def classes_of(deck: str | Path) -> list[str]:
    return [case["mechanism"]["class"] for case in results_json(mbla.run(deck).records)["cases"]]


@pytest.mark.parametrize(
    ("height", "live", "expected"),
    [
        (0.4, "{acceleration: [1, 0, 0]}", "sliding"),  # b/h = 2.5 above the friction of 0.5
        (4, "{acceleration: [1, 0, 0]}", "overturning"),  # b/h = 0.25 below it
        (1, "{moment: [0, 0, 1000], on: block}", "twisting"),
        (1, "{force: [0, 0, 1000], on: block, at: [0.5, 0.5, 1]}", "opening"),
    ],
)
def test_a_block(height: float, live: str, expected: str) -> None:
    assert classes_of(BLOCK.format(height=height, live=live)) == [expected]


def test_an_arch_of_four_hinges() -> None:
    """Three parts hinge on each other and on the springers."""
    deck = BENCHMARKS["arch_20_voussoirs"].read_text(encoding="utf-8")
    assert classes_of(deck) == ["hinging"]


def test_a_wall_in_bond_pushed_in_its_plane() -> None:
    """Blocks slide on bed joints and rock at the same time (Ferris and Tin-Loi 2001, wall 1)."""
    assert classes_of(BENCHMARKS["ferris_wall_1"]) == ["sliding and hinging"]


def test_supports_that_give_way() -> None:
    """The beam turns on the middle pad and follows the right one; the left one sinks and leaves the beam at rest."""
    deck = BENCHMARKS["beam_on_three_supports"].read_text(encoding="utf-8")
    assert classes_of(deck) == ["hinging", "opening"]


# --- put together by hand -----------------------------------------------------------------------------------------


def line(clusters: tuple[int, int] = (1, 0), **changes: Any) -> HingeLine:
    at, along = np.zeros(3), np.array([0.0, 1.0, 0.0])
    one = HingeLine(clusters, np.array([0]), at, along, along, 1.0, 1.0, slides=False, crushes=False, shear=0.0)
    return replace(one, **changes)


def plane(**changes: Any) -> SlidingPlane:
    at, normal = np.zeros(3), np.array([0.0, 0.0, 1.0])
    one = SlidingPlane((1, 0), np.array([0]), 1.0, at, normal, np.array([1.0, 0, 0]), False, 1.0, 1.0, 1.0)
    return replace(one, **changes)


def moving(*joints: HingeLine | SlidingPlane) -> MovingJoints:
    lines = tuple(joint for joint in joints if isinstance(joint, HingeLine))
    planes = tuple(joint for joint in joints if isinstance(joint, SlidingPlane))
    return MovingJoints(np.array([1]), 0.0, lines, planes)


@pytest.mark.parametrize(
    ("joints", "expected"),
    [
        ((line((1, 0)), line((2, 0))), "overturning"),  # two towers, each by itself
        ((line((1, 0)), line((2, 1))), "hinging"),
        ((line((1, 0)), line((2, 1), share=NOTABLE / 2)), "overturning"),
        ((line(), plane()), "sliding and hinging"),
        ((line(), plane(speed=NOTABLE / 2)), "overturning"),
        ((line(), plane(twists=True)), "sliding and hinging"),
        ((plane(), plane(twists=True)), "sliding"),
        ((plane(twists=True), plane(twists=True)), "twisting"),
        ((line(slides=True, shear=2 * NOTABLE),), "sliding and hinging"),
        ((line(slides=True, shear=NOTABLE / 2),), "overturning"),
        ((line(slides=True, shear=float("nan")),), "overturning"),
        ((), "opening"),
    ],
)
def test_only_joints_that_move_notably_count(joints: tuple[HingeLine | SlidingPlane, ...], expected: str) -> None:
    assert mechanism_class(moving(*joints)) == expected
