"""Ties against closed forms and a linear program that shares nothing with mbla (see ``planar``)."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.solution import Status
from tests.analytic.planar import GROUND, PlanarTie, Rectangle, load_factor, rectangles_in_contact, wall
from tests.line import BLOCK, HEAD, case_of, line_of
from tests.line import factor_of as mbla_load_factor

DENSITY, GRAVITY, DEPTH = 2000.0, 9.81, 0.5
ROD = """
ties:
  - {through: [[0, 0.5, "=ht"], [-3, 0.5, "=ht"]], on: [block, ground], capacity: "=T"}
"""
SLENDER = BLOCK.replace("mu: 0.5, b: 1, h: 2, c: 0", "T: 3000, ht: 1.6, mu: 5, b: 0.4, h: 2, c: 0") + ROD
WEIGHT = 0.4 * 2 * DENSITY * GRAVITY


@pytest.mark.parametrize("flow", ["associative", "non_associative", "dilatancy"])
@pytest.mark.parametrize("contact", ["concave", "convex"])
def test_a_wall_that_overturns_is_held_by_its_tie(flow: str, contact: str) -> None:
    """(W b/2 + T h_t)/(W h/2), whatever the flow rule: nothing slides."""
    if flow == "dilatancy" and contact == "convex":
        return
    factor = (WEIGHT * 0.2 + 3000 * 1.6) / (WEIGHT * 1.0)
    found = mbla_load_factor(SLENDER, f"analysis.flow_rule={flow}", f"analysis.contact_model={contact}")
    assert found == pytest.approx(factor, rel=1e-6)


def test_the_load_factor_rises_with_the_capacity_less_and_less_up_to_that_of_a_support() -> None:
    """Concave in T: nothing at T = 0; where T is large a support, about which friction and weight turn the wall."""
    capacities = [1e-9, 2e3, 1e4, 2e4, 4e4, 1e5, 1e9]
    factors = np.array([mbla_load_factor(SLENDER, f"parameters.T={t}") for t in capacities])
    slopes = np.diff(factors) / np.diff(capacities)
    assert factors[0] == pytest.approx(0.2, rel=1e-6)
    assert (np.diff(factors) >= -1e-9).all()
    assert (np.diff(slopes) <= 1e-12).all()
    assert factors[-1] == pytest.approx((5 * 1.6 + 0.2) / (1.6 - 1.0), rel=1e-6)


def test_a_point_may_be_on_any_of_several_blocks() -> None:
    """A choice of blocks for one point, by the name of the choice too, is one entry of `on`."""
    two = "groups: {all: [block, {group: block, index: 0}]}\n"
    assert mbla_load_factor(two + SLENDER.replace("on: [block", "on: [all")) == pytest.approx(
        mbla_load_factor(SLENDER), rel=1e-9
    )


def test_prestress_changes_no_load_factor() -> None:
    """It is a force that balances itself: what a tie may have in all is the same."""
    found = mbla_load_factor(SLENDER.replace('capacity: "=T"', 'capacity: "=T", prestress: 2000'))
    assert found == pytest.approx(mbla_load_factor(SLENDER), rel=1e-9)


def test_a_strut_pushes_and_a_tie_does_not() -> None:
    """The strut stands on the side to which the wall falls; a tie there goes slack."""
    ahead = SLENDER.replace("[[0, 0.5", "[[0.4, 0.5").replace("[-3, 0.5", "[3, 0.5")
    strut = ahead.replace("capacity:", "acts: compression, capacity:")
    assert mbla_load_factor(strut) == pytest.approx(mbla_load_factor(SLENDER), rel=1e-7)
    assert mbla_load_factor(ahead) == pytest.approx(0.2, rel=1e-7)


def test_a_strip_holds_a_joint_at_its_place() -> None:
    """A block on a fixed one, with a strip over the joint on the side that opens: (W b/2 + F b)/(W h/2)."""
    deck = (
        HEAD
        + """\
joints: {dry: {friction: 5}}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, -1], max: [0.4, 1, 0]}
  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.4, 1, 2]}
supports: [{blocks: foot}]
ties:
  - {strip: [[0, 0.5, -0.5], [0, 0.5, 1.2]], capacity: 4000}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""
    )
    assert mbla_load_factor(deck) == pytest.approx((WEIGHT * 0.2 + 4000 * 0.4) / WEIGHT, rel=1e-6)


def test_a_ring_whose_corners_are_on_joints_holds_both_blocks_there() -> None:
    """Eight blocks in a circle, one pushed outward: the same for each, whichever way they are numbered."""
    angles = np.radians(np.arange(9) * 45.0)
    corners = np.array([1.3, 1.0])[:, None, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    blocks, cases = [], []
    for number in range(8):
        (a, b), (d, c) = corners[:, number : number + 2].tolist()
        vertices = [[*each, z] for z in (0.0, 1.0) for each in (a, b, c, d)]
        faces = "[[0,1,2,3],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]"
        blocks.append(f"  - polyhedron: {{group: b{number}, material: stone, vertices: {vertices}, faces: {faces}}}")
        out = (corners[0, number] + corners[0, number + 1]).tolist()
        cases.append(f"  c{number}: {{live: [{{acceleration: {[*out, 0.0]}, on: b{number}}}]}}")
    head = HEAD + "joints: {dry: {friction: 0.1}}\nsupports: [{ground: {z: 0}}]\nanalysis: {flow_rule: associative}\n"
    ring = f"ties: [{{ring: {{around: [{', '.join(f'b{n}' for n in range(8))}], z: [0.5]}}, capacity: 1000}}]\n"
    factors = [
        mbla_load_factor(head + ring + "blocks:\n" + "\n".join(blocks) + f"\nload_cases:\n{case}\n") for case in cases
    ]
    assert factors == pytest.approx([factors[0]] * 8, rel=1e-6)
    assert factors[0] > 1.2 * mbla_load_factor(head + "blocks:\n" + "\n".join(blocks) + f"\nload_cases:\n{cases[0]}\n")


def test_a_strip_with_its_corners_on_joints_holds_them() -> None:
    """Under an arch from corner to corner of its intrados: a joint at each corner but the ends, none missed."""
    deck = (
        HEAD
        + """\
joints: {dry: {friction: 2}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.5, width: 1, voussoirs: 8}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""
    )
    angles = np.radians(np.linspace(180.0, 0.0, 9))
    places = np.stack([2.0 + 2.0 * np.cos(angles), np.full(9, 0.5), 2.0 * np.sin(angles)], axis=1)
    model = line_of(deck + f"ties: [{{strip: {places.tolist()}, capacity: 1}}]\n").model
    held = model.ties.bodies.reshape(-1, 2)
    assert [sorted(pair) for pair in held.tolist()] == [[n, n + 1] for n in range(7)]
    middle = model.ties.start[3]
    assert model.ties.pulls[middle] == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)


def test_a_rope_over_a_block_presses_it_down_and_has_one_force() -> None:
    """A rope from ground to ground over a sliding block: mu (W + T (2 sin a)), a its slope on either side."""
    deck = BLOCK.replace("mu: 0.5, b: 1, h: 2", "mu: 0.3, b: 2, h: 1") + (
        "ties:\n  - {through: [[-1, 0.5, 0], [1, 0.5, 1], [3, 0.5, 0]], on: [ground, block, ground], capacity: 10000}\n"
    )
    weight, sine, cosine = 2 * DENSITY * GRAVITY, 1 / np.sqrt(5), 2 / np.sqrt(5)
    # where it passes without friction it does not get longer, but presses: its force may be any
    assert 0.3 - 1e-9 <= mbla_load_factor(deck, "analysis.flow_rule=non_associative") <= 0.3 * (1 + 2e4 * sine / weight)
    fixed = deck.replace("capacity", "points: fixed, capacity")
    # one stretch yields, the other is slack: T cos a back, T sin a down
    expected = (0.3 * (weight + 10000 * sine) + 10000 * cosine) / weight
    assert mbla_load_factor(fixed) == pytest.approx(expected, rel=1e-6)


def random_case(seed: int) -> tuple[str, float | None]:
    """A wall of random courses with random ties, as a deck, and what the linear program makes of it."""
    rng = np.random.default_rng(seed)
    rows = [[1.0] * 3 if level % 2 else [0.5, 1, 1, 0.5] for level in range(int(rng.integers(3, 6)))]
    bricks = list(wall(rows, unit=0.4, height=0.25))
    centroids = np.array([brick.centroid for brick in bricks])
    weights = np.array([brick.area for brick in bricks]) * DEPTH * DENSITY * GRAVITY
    mu = float(rng.uniform(0.3, 1.2))
    ties = [random_tie(rng, bricks, float(weights.sum())) for _ in range(int(rng.integers(1, 5)))]
    blocks = "\n".join(
        f"  - box: {{group: b{i}, material: stone, min: [{b.left}, 0, {b.bottom}], max: [{b.right}, {DEPTH}, {b.top}]}}"
        for i, b in enumerate(bricks)
    )
    lines = [_tie_line(tie) for tie in ties]
    deck = (
        f"{HEAD}joints: {{dry: {{friction: {mu}}}}}\nblocks:\n{blocks}\nties:\n" + "\n".join(lines) + "\n"
        "supports: [{ground: {z: 0}}]\nload_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
        "analysis: {flow_rule: associative, accuracy: reference}\n"
    )
    live = np.outer(weights, [1.0, 0.0])
    return deck, load_factor(rectangles_in_contact(bricks, mu), centroids, np.outer(weights, [0.0, -1.0]), live, ties)


def random_tie(rng: np.random.Generator, bricks: list[Rectangle], weight: float) -> PlanarTie:
    """Between two or three bricks, or a brick and the ground, pulling, pushing or both."""
    count = int(rng.integers(2, 4))
    chosen = rng.choice(len(bricks), count, replace=False)
    bodies, points = [], []
    for brick in chosen:
        b = bricks[brick]
        points.append((float(rng.uniform(b.left, b.right)), float(rng.uniform(b.bottom, b.top))))
        bodies.append(int(brick))
    if rng.random() < 0.3:
        bodies[0], points[0] = GROUND, (-1.0, float(rng.uniform(0, 1)))
    capacity = float(10 ** rng.uniform(-2, 0.5)) * weight
    sense = rng.choice(3) if count == 2 else 0
    least, greatest = [(0.0, capacity), (-capacity, 0.0), (-capacity, capacity)][int(sense)]
    return PlanarTie(tuple(bodies), tuple(points), least, greatest)


def _tie_line(tie: PlanarTie) -> str:
    points = ", ".join(f"[{x!r}, {DEPTH / 2}, {z!r}]" for x, z in tie.points)
    on = ", ".join("ground" if body == GROUND else f"b{body}" for body in tie.bodies)
    acts = "both" if tie.least < 0 < tie.greatest else "tension" if tie.greatest > 0 else "compression"
    return f"  - {{through: [{points}], on: [{on}], acts: {acts}, capacity: {max(tie.greatest, -tie.least)!r}}}"


@pytest.mark.parametrize("seed", range(12))
def test_random_walls_with_random_ties_have_the_factor_of_the_linear_program(seed: int) -> None:
    deck, expected = random_case(seed)
    _, case = case_of(deck)
    assert expected is not None
    if np.isinf(expected):
        assert case.status is Status.UNBOUNDED
    else:
        assert case.checks.verified
        assert case.solution.mechanics is not None
        assert case.solution.mechanics.load_factor == pytest.approx(expected, rel=1e-6)


def test_nothing_depends_on_units_or_on_where_the_structure_stands() -> None:
    """The same in millimetres, kN and tonnes, turned by 35 degrees about the vertical and moved by a kilometre."""
    turn, far = np.radians(35.0), np.array([1e6, -2e6, 5e5])

    def there(x: float, y: float, z: float) -> str:
        cos, sin = np.cos(turn), np.sin(turn)
        return str((1e3 * np.array([cos * x - sin * y, sin * x + cos * y, z]) + far).tolist())

    deck = f"""\
mbla: 1
units: {{length: mm, force: kN, mass: t}}
materials: {{stone: {{density: "2000 kg/m^3"}}}}
joints: {{dry: {{friction: 5}}}}
blocks:
  - box:
      {{group: block, material: stone, min: [0, 0, 0], max: [400, 1000, 2000], transform: [{{rotate: {{axis: [0, 0, 1],
       angle: 35}}}}, {{translate: {far.tolist()}}}]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: {far[2]}}}}}]
ties:
  - {{through: [{there(0, 0.5, 1.6)}, {there(-3, 0.5, 1.6)}], on: [block, ground], capacity: 3}}
load_cases: {{push: {{live: [{{acceleration: [{np.cos(turn)}, {np.sin(turn)}, 0]}}]}}}}
analysis: {{flow_rule: associative}}
"""
    assert mbla_load_factor(deck) == pytest.approx(mbla_load_factor(SLENDER), rel=1e-6)
