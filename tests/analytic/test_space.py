"""Single blocks in space against closed forms, in directions and shapes that no deck has."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import fsolve, minimize_scalar

from tests.line import HEAD, line_of, load_factor, verified
from tests.reached import reaches

SAME = 1e-7

BLOCK = (
    HEAD
    + """\
parameters: {mu: 0.5, b: 1, d: 1, h: 0.1, t: 0}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", "=d", "=h"]}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: ["=cos(t)", "=sin(t)", 0]}]}
analysis: {flow_rule: associative, accuracy: reference}
"""
)
"""A block pushed at the angle t in plan."""

WEDGE = """\
joints: {{dry: {{friction: {mu!r}}}}}
parameters: {{b1: {b1!r}, b2: {b2!r}}}
blocks:
  - polyhedron:
      group: wedge
      material: stone
      vertices:
        [[0, 0, 0], ["=cos(b1)", 0, "=sin(b1)"], ["=-cos(b2)", 0, "=sin(b2)"],
         [0, 8, 0], ["=cos(b1)", 8, "=sin(b1)"], ["=-cos(b2)", 8, "=sin(b2)"]]
      faces: [[0, 1, 2], [5, 4, 3], [3, 4, 1, 0], [4, 5, 2, 1], [5, 3, 0, 2]]
supports:
  - {{ground: {{point: [0, 0, 0], normal: ["=-sin(b1)", 0, "=cos(b1)"]}}}}
  - {{ground: {{point: [0, 0, 0], normal: ["=sin(b2)", 0, "=cos(b2)"]}}}}
load_cases:
  along: {{live: [{{acceleration: [0, 1, 0]}}]}}
analysis: {{flow_rule: {flow_rule}, published: {{tolerance: 1.e-6}}}}
"""
"""A wedge between planes of different inclination that meet along y."""


@settings(max_examples=25, derandomize=True)
@given(mu=st.floats(0.05, 1.5), degrees=st.floats(0, 360), d=st.floats(0.4, 3.0))
def test_sliding_is_the_same_in_every_direction(mu: float, degrees: float, d: float) -> None:
    overrides = (f"parameters.mu={mu!r}", f"parameters.t={degrees!r}", f"parameters.d={d!r}")
    assert load_factor(BLOCK, *overrides) == pytest.approx(mu, rel=SAME)


@settings(max_examples=25, derandomize=True)
@given(degrees=st.floats(0, 360), d=st.floats(0.4, 3.0), h=st.floats(4.0, 20.0))
def test_rocking_is_about_the_edge_that_the_resultant_meets(degrees: float, d: float, h: float) -> None:
    t = math.radians(degrees)
    edges = [side / abs(share) for side, share in ((1.0, math.cos(t)), (d, math.sin(t))) if abs(share) > 1e-12]
    overrides = ("parameters.mu=2", f"parameters.t={degrees!r}", f"parameters.d={d!r}", f"parameters.h={h!r}")
    assert load_factor(BLOCK, *overrides) == pytest.approx(min(edges) / h, rel=SAME)


@pytest.mark.parametrize(("b1", "b2", "mu"), [(20, 40, 0.5), (30, 60, 0.4), (10, 70, 0.2), (45, 45, 0.6)])
def test_an_unequal_groove_with_associative_flow(b1: float, b2: float, mu: float) -> None:
    """Sliding by 1 along y, the wedge moves by (p, q) in the section so that both planes open as their slip demands.

    Each plane of inclination b, on its own side: q cos b -/+ p sin b = mu sqrt(1 + (p cos b +/- q sin b)^2);
    the weight does the work -W q, so that the load factor is q.
    """
    one, two = math.radians(b1), math.radians(b2)

    def lack(motion: NDArray[np.float64]) -> list[float]:
        p, q = motion
        return [
            q * math.cos(one) - p * math.sin(one) - mu * math.hypot(1.0, p * math.cos(one) + q * math.sin(one)),
            q * math.cos(two) + p * math.sin(two) - mu * math.hypot(1.0, p * math.cos(two) - q * math.sin(two)),
        ]

    (_, q), _, success, message = fsolve(lack, np.array([0.0, mu]), xtol=1e-13, full_output=True)
    assert success == 1, message
    assert load_factor(_wedge(b1, b2, mu, "associative")) == pytest.approx(q, rel=SAME)


@pytest.mark.parametrize(("b1", "b2", "mu"), [(20, 40, 0.5), (30, 60, 0.4), (15, 25, 0.7)])
def test_an_unequal_groove_without_dilatancy(b1: float, b2: float, mu: float) -> None:
    """N1 = W sin b2/sin(b1 + b2), N2 = W sin b1/sin(b1 + b2), both sliding along the line of intersection."""
    one, two = math.radians(b1), math.radians(b2)
    exact = mu * (math.sin(one) + math.sin(two)) / math.sin(one + two)
    solution, checks, status = verified(line_of(_wedge(b1, b2, mu, "non_associative")))
    assert solution.mechanics is not None
    assert reaches(solution.mechanics.load_factor, exact), (status, checks.failures)


@pytest.mark.parametrize(("lever", "mu"), [(0.1, 0.5), (0.3, 0.5), (0.8, 0.3), (3.0, 0.7)])
def test_an_eccentric_push_turns_and_slides(lever: float, mu: float) -> None:
    """Push along x at the level of the base, off the centre of a square of side 1 by a lever arm.

    The block turns about a point at the distance r behind the centre. Normality lifts each corner by mu times its
    speed; corners of one y move equally fast, so that the lifts fit a rigid tilt, in which the weight rises by their
    mean. The load factor is the least over r of mu times the mean speed of the corners over the speed of the push.
    """
    corners = [(x, y) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]

    def ratio(logarithm: float) -> float:
        r = math.exp(logarithm)
        return mu / 4 * sum(math.hypot(x, y + r) for x, y in corners) / (r + lever)

    exact = minimize_scalar(ratio, bounds=(-16, 16), method="bounded", options={"xatol": 1e-10}).fun
    weight = 2000 * 9.81 * 0.1
    push = f"{{force: [{weight}, 0, 0], on: block, at: [0.5, {0.5 - lever!r}, 0]}}"
    text = BLOCK.replace('{acceleration: ["=cos(t)", "=sin(t)", 0]}', push)
    assert load_factor(text, f"parameters.mu={mu}") == pytest.approx(exact, rel=SAME)


def _wedge(b1: float, b2: float, mu: float, flow_rule: str) -> str:
    return HEAD + WEDGE.format(mu=mu, b1=b1, b2=b2, flow_rule=flow_rule)
