"""The cheapest ties against closed forms and a linear program that shares nothing with mbla (see ``planar``)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.optimize import linprog

from mbla.deck import read_deck
from mbla.solution.further.strengthening.cheapest import cheapest
from mbla.solution.further.strengthening.strengthening import Cheapest
from mbla.solution.solution import WITH_VALUE, Status
from mbla.sweeps.strengthen.question import question_of
from tests.analytic.planar import (
    Array,
    PlanarJoint,
    PlanarTie,
    _equilibrium,
    _friction,
    _pulls,
    _with_moments,
    rectangles_in_contact,
    wall,
)
from tests.analytic.test_ties import DENSITY, DEPTH, GRAVITY, SLENDER, WEIGHT, random_tie
from tests.line import HEAD

ALONE = SLENDER.split("ties:")[0]
ROD = '{through: [[0, 0.5, "=ht"], [-3, 0.5, "=ht"]], on: [block, ground]}'


def cheapest_of(text: str) -> Cheapest:
    """The cheapest capacities of the candidates of a deck, by associative flow."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(text, encoding="utf-8")
        return cheapest(question_of(read_deck(path), lambda record: None)[2])


def test_a_wall_that_overturns_needs_so_much_of_a_rod() -> None:
    """T = (lambda W h/2 - W b/2)/h_t, and what its moment costs."""
    deck = ALONE + f"strengthen: {{required: {{push: 0.5}}, candidates: [{ROD.replace('on:', 'cost: 2, on:')}]}}\n"
    found, capacity = cheapest_of(deck), WEIGHT * (0.5 * 1.0 - 0.2) / 1.6
    assert found.status is Status.SOLVED
    assert found.capacities == pytest.approx([capacity], rel=1e-7)
    assert (found.cost, found.least_cost) == pytest.approx((2 * 3 * capacity,) * 2, rel=1e-7)
    assert found.use == pytest.approx([1.0], rel=1e-7)


def test_the_rod_with_the_longer_lever_arm_for_its_cost_is_taken_and_the_other_priced() -> None:
    """Worth of a rod at half the height: half of its cost."""
    low = ROD.replace('"=ht"', '"=ht/2"')
    deck = ALONE + f"strengthen: {{required: {{push: 0.5}}, candidates: [{low}, {ROD}]}}\n"
    found = cheapest_of(deck)
    assert found.capacities == pytest.approx([0.0, WEIGHT * 0.3 / 1.6], rel=1e-7, abs=1e-6)
    assert found.use == pytest.approx([0.5, 1.0], rel=1e-6)


def test_what_is_carried_already_needs_nothing_and_what_no_tie_holds_cannot_be_had() -> None:
    behind = ROD.replace("[[0, 0.5", "[[0.4, 0.5").replace("[-3, 0.5", "[3, 0.5")
    nothing = cheapest_of(ALONE + f"strengthen: {{required: {{push: 0.1}}, candidates: [{ROD}]}}\n")
    assert nothing.cost == pytest.approx(0.0, abs=1e-6 * WEIGHT)
    never = cheapest_of(ALONE + f"strengthen: {{required: {{push: 0.5}}, candidates: [{behind}]}}\n")
    assert never.status is Status.NO_EQUILIBRIUM


def test_a_greatest_capacity_sends_the_rest_to_the_next_candidate() -> None:
    """The good rod bears no more than 1000 N; that at half the height the rest of the moment."""
    low, most = ROD.replace('"=ht"', '"=ht/2"'), ROD.replace("on:", "most: 1000, on:")
    found = cheapest_of(ALONE + f"strengthen: {{required: {{push: 0.5}}, candidates: [{low}, {most}]}}\n")
    assert found.capacities == pytest.approx([(WEIGHT * 0.3 - 1600) / 0.8, 1000], rel=1e-6)
    assert found.least_cost == pytest.approx(found.cost, rel=1e-6)


def random_case(seed: int) -> tuple[str, float]:
    """A random wall pushed both ways with random candidates, as a deck, and the least cost by the linear program."""
    rng = np.random.default_rng(1000 + seed)
    rows = [[1.0] * 3 if level % 2 else [0.5, 1, 1, 0.5] for level in range(int(rng.integers(3, 6)))]
    bricks = list(wall(rows, unit=0.4, height=0.25))
    centroids = np.array([brick.centroid for brick in bricks])
    weights = np.array([brick.area for brick in bricks]) * DEPTH * DENSITY * GRAVITY
    mu, factors = float(rng.uniform(0.5, 1.5)), rng.uniform(0.3, 0.8, 2)
    ties = [replace(random_tie(rng, bricks, 1.0), least=0.0, greatest=np.inf) for _ in range(int(rng.integers(3, 8)))]
    rates = rng.uniform(0.5, 2.0, len(ties))
    boxes = "\n".join(
        f"  - box: {{group: b{i}, material: stone, min: [{b.left}, 0, {b.bottom}], max: [{b.right}, {DEPTH}, {b.top}]}}"
        for i, b in enumerate(bricks)
    )
    lines = [
        f"    - {{through: {[[x, DEPTH / 2, z] for x, z in tie.points]}, "
        f"on: [{', '.join('ground' if body < 0 else f'b{body}' for body in tie.bodies)}], cost: {float(rate)!r}}}"
        for tie, rate in zip(ties, rates, strict=True)
    ]
    deck = (
        f"{HEAD}joints: {{dry: {{friction: {mu}}}}}\nblocks:\n{boxes}\nsupports: [{{ground: {{z: 0}}}}]\n"
        "load_cases:\n  right: {live: [{acceleration: [1, 0, 0]}]}\n  left: {live: [{acceleration: [-1, 0, 0]}]}\n"
        "analysis: {flow_rule: associative, accuracy: reference}\n"
        f"strengthen:\n  required: {{right: {factors[0]}, left: {factors[1]}}}\n  candidates:\n"
        + "\n".join(lines)
        + "\n"
    )
    lengths = [
        sum(float(np.hypot(*np.subtract(p, q))) for p, q in zip(t.points, t.points[1:], strict=False)) for t in ties
    ]
    live = [factor * np.outer(weights, [sign, 0.0]) for factor, sign in zip(factors, (1.0, -1.0), strict=True)]
    loads = [np.outer(weights, [0.0, -1.0]) + each for each in live]
    return deck, least_cost(rectangles_in_contact(bricks, mu), centroids, loads, ties, rates * np.array(lengths))


def least_cost(
    joints: Sequence[PlanarJoint], centroids: Array, loads: Sequence[Array], ties: Sequence[PlanarTie], costs: Array
) -> float:
    """By HiGHS: forces of joints, tensions of every load case, and one capacity a tie; inf where none suffice."""
    m, k, unit = len(joints), len(ties), float(np.abs(loads[0]).max())
    forces, limits, pulls = _equilibrium(joints, centroids), _friction(joints), _pulls(ties, centroids)
    one, n = sp.eye_array(k), len(loads)
    equations = sp.block_array([[sp.block_diag([sp.hstack([forces, pulls])] * n), None]])
    equations = sp.hstack([equations, sp.csr_array((equations.shape[0], k))])
    friction = sp.hstack(
        [sp.block_diag([sp.hstack([limits, sp.csr_array((2 * m, k))])] * n), sp.csr_array((2 * m * n, k))]
    )
    below = sp.hstack([sp.block_diag([sp.hstack([sp.csr_array((k, 3 * m)), one])] * n), sp.vstack([-one] * n)])
    answer = linprog(  # type: ignore[call-overload]  # its stubs do not know sparse matrices
        np.concatenate([np.zeros(n * (3 * m + k)), costs]),
        A_ub=sp.csr_array(sp.vstack([friction, below])),
        b_ub=np.zeros(2 * m * n + k * n),
        A_eq=sp.csr_array(equations),
        b_eq=np.concatenate([-_with_moments(load).ravel() / unit for load in loads]),
        bounds=([(0, None), (0, None), (None, None)] * m + [(0, None)] * k) * n + [(0, None)] * k,
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    return float("inf") if answer.status == 2 else float(answer.fun) * unit


@pytest.mark.parametrize("seed", range(20))
def test_random_walls_have_the_least_cost_of_the_linear_program(seed: int) -> None:
    deck, expected = random_case(seed)
    found = cheapest_of(deck)
    if np.isinf(expected):
        assert found.status is Status.NO_EQUILIBRIUM
        return
    assert found.status in WITH_VALUE
    size = max(expected, 1e-3 * DENSITY * GRAVITY)
    assert found.cost == pytest.approx(expected, abs=1e-6 * size)
    assert found.least_cost == pytest.approx(expected, abs=1e-6 * size)
