"""The convex contact model: torsion, crushing, and the concave model beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.solution import ContactMode, Status
from mbla.solution.verification.verify import verify
from tests.line import BLOCK, HEAD, WALL, factor_of, line_of, solution_of
from tests.solution.convex_structures import DECKS, TWIST, concave, convex, factor, prism

SQUARE = (np.sqrt(2) + np.log(1 + np.sqrt(2))) / 6

THETA = 2 - 4 * SQUARE * np.arcsinh(1.0)


# --- torsion ------------------------------------------------------------------------------------------------------


def test_square_under_uniform_pressure() -> None:
    line = line_of(TWIST)
    assert factor(TWIST) == pytest.approx(2 * 0.6 * SQUARE, rel=1e-7)
    assert concave(line) == pytest.approx(2 * 0.6 * np.sqrt(0.5), rel=1e-6)  # corners: 85 % more


def test_pure_torsion_is_the_closed_form_with_either_flow_rule() -> None:
    """No opening resists a twist under constant weight: dilatancy makes no difference.

    The path gives up a thousandth of the torsion where the force point is in the middle.
    """
    assert factor(TWIST, flow_rule="non_associative") == pytest.approx(2 * 0.6 * SQUARE, rel=1.1e-3)


@pytest.mark.parametrize(("e1", "e2"), [(0.3, 0.0), (0.0, -0.5), (0.4, 0.3), (-0.6, 0.2)])
def test_eccentric_force_leaves_less_of_the_area(e1: float, e2: float) -> None:
    """The force 2 W is at (e1, e2)/2; the tangent to ρ(a', b') takes ρ (e1' + e2')/a off."""
    expected = 0.6 * 2 * SQUARE * (1 - abs(e1) / 2 - abs(e2) / 2)
    assert factor(TWIST, f"parameters.e1={e1}", f"parameters.e2={e2}") == pytest.approx(expected, rel=1e-6)


@pytest.mark.every(3)
@pytest.mark.parametrize("arm", [0.1, 0.3, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_shear_and_torsion_follow_the_safe_curve(arm: float, flow_rule: str) -> None:
    """t² = (1 − m)(1 + (1 − θ) m) with t = λ/μ, m = λ arm/(μ ρ): a quadratic equation for λ."""
    m = arm / SQUARE
    size = 0.5 * (THETA * m + np.sqrt(((2 - THETA) * m) ** 2 + 4))
    found = factor(TWIST, f"parameters.arm={arm}", case=1, flow_rule=flow_rule)
    assert found == pytest.approx(0.6 / size, rel=1e-6 if flow_rule == "associative" else 1.1e-3)


def test_cohesion_twists_with_the_whole_area() -> None:
    base = ("parameters.c=0.7", "parameters.ft=0.5", "parameters.e1=0.4")
    # shifted by f_t: c' = c − μ f_t all over, friction of N' = 2 W + f_t A, whose point is at 0.4/2.5
    expected = SQUARE * ((0.7 - 0.6 * 0.5) + 0.6 * 2.5 * (1 - 0.4 / 2.5))
    assert factor(TWIST, *base) == pytest.approx(expected, rel=1e-6)
    assert factor(TWIST, "parameters.c=0.7", "parameters.mu=0") == pytest.approx(0.7 * SQUARE, rel=1e-6)


def test_points_of_a_twisting_interface_slide() -> None:
    solution, _ = convex(line_of(TWIST))
    assert solution.mechanics is not None
    assert solution.mechanics.modes.tolist() == [ContactMode.SLIDE] * 4


def test_resultants_are_those_of_the_loads() -> None:
    solution, _ = convex(line_of(TWIST, "parameters.e1=0.3"))
    assert solution.mechanics is not None
    assert solution.mechanics.resultants is not None
    weight = 2000 * 9.81 * 0.5
    normal, t1, t2, twist, m1, m2 = solution.mechanics.resultants[0] / weight
    assert normal == pytest.approx(2.0)
    assert (t1, t2) == pytest.approx((0.0, 0.0), abs=1e-7)
    assert abs(twist) == pytest.approx(solution.mechanics.load_factor)
    assert np.hypot(m1, m2) == pytest.approx(0.3)


# --- crushing -----------------------------------------------------------------------------------------------------


RECTANGLE = ((0, 0), (1.2, 0), (1.2, 0.8), (0, 0.8))

TRIANGLE = ((0, 0), (1, 0), (0.2, 0.9))

CENTROID = np.array([0.4, 0.3])


@pytest.mark.every(3)
@pytest.mark.parametrize("model", ["concave", "convex"])
@pytest.mark.parametrize(
    ("e1", "e2", "block"),
    [
        (0.0, 0.0, 0.96),
        (0.3, 0.0, 0.6 * 0.8),
        (0.0, -0.2, 1.2 * 0.4),
        (0.2, 0.15, 1.2 * 0.75 / 2),  # a triangle with three times the distances from the corner as legs
        (-0.4, -0.2, 0.6 * 0.6 / 2),
    ],
)
def test_rectangular_stress_block(e1: float, e2: float, block: float, model: str) -> None:
    text = prism(RECTANGLE, [0.6 + e1, 0.4 + e2])
    assert factor_of(text, f"analysis.contact_model={model}") == pytest.approx(20 * block - 1, rel=1e-6)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.6])
def test_stress_block_in_the_corner_of_a_triangle_is_homothetic(share: float) -> None:
    point = (1 - share) * CENTROID + share * np.array(TRIANGLE[1])
    expected = 20 * 0.45 * (1 - share) ** 2 - 1
    assert factor(prism(TRIANGLE, point.tolist())) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("share", [0.3, 0.6])
def test_stress_block_along_an_edge_of_a_triangle(share: float) -> None:
    """A strip up to t of the height: 2 t - t^2 of the area, with its centroid at t (1 - 2 t/3)/(2 - t)."""
    height = (1 - share) / 3
    t = 0.75 * (1 + height - np.sqrt((1 + height) ** 2 - 16 * height / 3))
    point = (1 - share) * CENTROID + share * np.array([0.5, 0.0])
    expected = 20 * 0.45 * (2 * t - t**2) - 1
    assert factor(prism(TRIANGLE, point.tolist())) == pytest.approx(expected, rel=1e-6)


def test_crushing_is_associative_whatever_the_flow_rule() -> None:
    text = prism(RECTANGLE, [0.9, 0.4])
    assert factor(text, flow_rule="non_associative") == pytest.approx(factor(text), rel=1e-5)


@pytest.mark.every(2)
@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
@pytest.mark.parametrize("model", ["concave", "convex"])
def test_outlines_that_are_not_convex_crush_in_triangles(model: str, flow_rule: str) -> None:
    """An angle under full stress up to x = 0.7: two rectangles."""
    angle = ((0, 0), (1, 0), (1, 0.4), (0.4, 0.4), (0.4, 1), (0, 1))
    point = (0.4 * np.array([0.2, 0.5]) + 0.12 * np.array([0.55, 0.2])) / 0.52
    ways = (f"analysis.contact_model={model}", f"analysis.flow_rule={flow_rule}")
    assert factor_of(prism(angle, point.tolist()), *ways) == pytest.approx(20 * 0.52 - 1, rel=1e-5)


# --- against the concave model --------------------------------------------------------------------------------------


ARCH = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 1.85, thickness: 0.15, width: 0.3, voussoirs: 15}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""
)


@pytest.mark.long
def test_wall_bent_between_its_ends_twists_its_bed_joints() -> None:
    """Ends held, pushed out of its plane: the bed joints twist, corners overstate it, and no more than they allow."""
    text = (
        WALL.replace(
            "supports: [{ground: {z: 0}}]",
            "supports: [{ground: {z: 0}}, {blocks: {box: [[-1, -1, -1], [0.41, 1, 2]]}}]",
        )
        .replace("[1, 0, 0]", "[0, 1, 0]")
        .replace("parameters: {mu: 0.65, n: 5}", "parameters: {mu: 0.65, n: 3}")
    )
    line = line_of(text)
    with_torsion, with_corners = factor(text), concave(line)
    assert with_torsion < 0.99 * with_corners
    assert factor(text, flow_rule="non_associative") <= with_torsion * (1 + 1e-6)


# --- no equilibrium, no collapse ------------------------------------------------------------------------------------


def test_dead_load_that_twists_too_much_is_not_carried() -> None:
    """A dead couple of 0.3 W a: corners carry it (0.424), a uniformly pressed square does not (0.2296)."""
    ends = (("=0.3*W", "=a"), ("=-0.3*W", "=0*a"))
    couple = ", ".join(f'{{force: [0, "{w}", 0], on: block, at: ["{x}", "=a/2", "=h/2"]}}' for w, x in ends)
    text = BLOCK.replace("live:", "dead: [{gravity: [0, 0, -9.81]}, " + couple + "], live:").replace(
        "b: 1, h: 2, c: 0", "b: 1, h: 0.5, a: 1, W: 9810, c: 0"
    )
    text = text.replace("mu: 0.5", "mu: 0.6").replace("[1, 0, 0]", "[0, 0, 1]")
    line = line_of(text)
    assert solution_of(line).status is not Status.NO_EQUILIBRIUM
    solution, checks = convex(line)
    assert solution.status is Status.NO_EQUILIBRIUM
    assert checks.verified, checks.failures
    weaker = replace(solution, certificate_motions=None)
    assert not verify(line.assembly, line.load_case, weaker).verified


def test_load_that_only_presses_is_unbounded_with_proof() -> None:
    line = line_of(BLOCK.replace("[1, 0, 0]", "[0, 0, -1]"))
    solution, checks = convex(line)
    assert solution.status is Status.UNBOUNDED
    assert checks.verified, checks.failures
    assert solution.lock is not None
    pushed = replace(solution, lock=solution.lock + np.array([0.0, 0.0, 100.0]))
    assert not verify(line.assembly, line.load_case, pushed).verified


# --- without dilatancy ----------------------------------------------------------------------------------------------


def test_block_in_a_groove_slides_without_dilatancy() -> None:
    """Tan of the tilt μ/cos 30° along the groove, where all friction is along it: the path still rises to it."""
    text = (DECKS / "groove.yaml").read_text(encoding="utf-8")
    solution, checks = convex(line_of(text), "non_associative")
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.84 / np.cos(np.pi / 6), rel=5e-4)
    assert checks.elastic_residual < 1e-4


def test_result_without_dilatancy_is_below_the_associative_one_and_fits_the_law() -> None:
    text = WALL.replace("[1, 0, 0]", "[1, 0.3, 0]")
    line = line_of(text, "parameters.n=3")
    solution, checks = convex(line, "non_associative")
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    assert solution.associative is not None
    assert checks.elastic_residual < 1e-4
    assert solution.mechanics.load_factor <= solution.associative.load_factor * (1 + 1e-7)


def test_rotation_with_gravity_does_not_matter() -> None:
    """The block of ``prism``, pushed and twisted, turned in space: another frame of its interface, the same factor."""
    angle = 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    lean = np.array([[1, 0, 0], [0, np.cos(0.4), -np.sin(0.4)], [0, np.sin(0.4), np.cos(0.4)]])
    corners = np.array([[x, y, z] for z in (0, 0.6) for x, y in ((0, 0), (1, 0), (0.8, 0.7), (0.1, 0.9))])
    values = []
    for matrix in (np.eye(3), lean @ turn):

        def moved(vector: Sequence[float], matrix: np.typing.NDArray[np.float64] = matrix) -> str:
            return str((matrix @ np.array(vector)).tolist())

        text = (
            HEAD
            + f"""\
joints: {{dry: {{friction: 0.6}}}}
blocks:
  - polyhedron: {{group: block, material: stone, vertices: {(corners @ matrix.T).tolist()},
      faces: [[0,1,2,3],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]}}
supports: [{{ground: {{point: {moved([0, 0, 0])}, normal: {moved([0, 0, 1])}}}}}]
load_cases:
  push:
    dead: [{{gravity: {moved([0, 0, -9.81])}}}]
    live: [{{force: {moved([300, 900, 0])}, on: block, at: {moved([1, 0.4, 0.1])}}}]
"""
        )
        values.append(factor(text))
    assert values[1] == pytest.approx(values[0], rel=1e-7)
