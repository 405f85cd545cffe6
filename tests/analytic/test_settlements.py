"""Supports that give way, against statics on their own.

Thrust lines of a circular arch as a linear program in three unknowns: force on its right springer, and its place.

Across joint i the arch left of it pushes what is right of it with the force on the springer plus the weights between.
The thrust line passes the joint inside where this force has moments of opposite signs about the ends of the joint, and
friction holds where |T| <= μ N.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog

from mbla.arrays import FloatArray
from mbla.results.collapse.mechanics import load_on_structure, reactions_of
from mbla.results.outcome import answer_of
from mbla.results.results import CaseResult, Results
from mbla.run import RunOptions, run
from mbla.solution.solution import Standing, Status
from tests.asked import settlement_of
from tests.decks.folder import BENCHMARKS
from tests.line import HEAD, case_of


def springer_thrusts(span: float, t: float, width: float, n: int, mu: float, weight: float) -> dict[str, float]:
    """Least and greatest horizontal thrust, and least vertical force, of a semicircular arch on its right springer.

    weight : per volume
    """
    angles = np.linspace(np.pi, 0.0, n + 1)
    radial = np.column_stack([np.cos(angles), np.sin(angles)])
    inner, outer = span / 2 * radial, (span / 2 + t) * radial
    weights, centroids = voussoirs(inner, outer, width * weight)
    rows, room = _inside(inner, outer, radial, weights, centroids, mu)
    # unknowns: force on the right springer (Fx, Fz) and moment about the origin there
    bounds = [(None, None)] * 3

    def least(cost: list[float]) -> float:
        found = linprog(cost, A_ub=rows, b_ub=room, bounds=bounds, method="highs")
        assert found.status == 0
        assert found.fun is not None
        return float(found.fun)

    return {"least": least([1, 0, 0]), "greatest": -least([-1, 0, 0]), "vertical": least([0, -1, 0])}


def voussoirs(inner: FloatArray, outer: FloatArray, weight: float) -> tuple[FloatArray, FloatArray]:
    """Weights and centroids of straight-edged voussoirs: areas of quadrilaterals from their diagonals."""
    a, b, c, d = inner[:-1], outer[:-1], outer[1:], inner[1:]
    first, second = (np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2 for u, v in ((b - a, c - a), (c - a, d - a)))
    area = first + second
    centroid = (first[:, None] * (a + b + c) + second[:, None] * (a + c + d)) / (3 * area[:, None])
    return area * weight, centroid


def _inside(
    inner: FloatArray, outer: FloatArray, radial: FloatArray, weights: FloatArray, centroids: FloatArray, mu: float
) -> tuple[FloatArray, FloatArray]:
    """Conditions rows @ (Fx, Fz, M) <= room, of the force on the springer and its moment about the origin."""
    rows, room = [], []
    for i in range(len(inner)):
        # across joint i on what is right of it: the force on the springer, with the weights right of i lifted
        lifted, moment = weights[i:].sum(), float((weights[i:] * centroids[i:, 0]).sum())
        # F = (Fx, Fz + lifted); anticlockwise moment about the origin x Fz - z Fx: M + moment
        along = np.array([radial[i, 1], -radial[i, 0]])  # compression, to the right across the joint
        for end, sign in ((inner[i], 1.0), (outer[i], -1.0)):
            # moment about the end: M + moment - (x (Fz + lifted) - z Fx)
            rows.append(sign * np.array([end[1], -end[0], 1.0]))
            room.append(-sign * (moment - end[0] * lifted))
        for side in (1.0, -1.0):
            rows.append(np.append(side * radial[i] - mu * along, 0.0))
            room.append(-(side * radial[i, 1] - mu * along[1]) * lifted)
        rows.append(np.append(-along, 0.0))
        room.append(along[1] * lifted)
    return np.array(rows), np.array(room)


WEIGHT = 2000 * 9.81
EXACT = 1e-7


def solved(tmp_path: Path, deck: str, *overrides: str, cases: tuple[str, ...] = ()) -> Results:
    options = RunOptions(folder=tmp_path / "out", overrides=(*overrides, "output.vtu=false"), cases=cases, force=True)
    return run(BENCHMARKS[deck], options)


def reaction(case: CaseResult) -> float:
    found = answer_of(case)
    assert found is not None, (case.status, case.solution.reason, case.checks.failures)
    return found


@pytest.mark.every(2)
@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
@pytest.mark.parametrize(("length", "height"), [(2.0, 0.05), (20.0, 2.0)])
def test_the_beam_on_three_supports(tmp_path: Path, length: float, height: float, flow_rule: str) -> None:
    overrides = [f"parameters.l={length}", f"parameters.h={height}", f"analysis.flow_rule={flow_rule}"]
    results = solved(tmp_path, "beam_on_three_supports", *overrides)
    weight = WEIGHT * length * 0.5 * height
    assert reaction(results.case("right_settles")) == pytest.approx(weight / 3, rel=EXACT)
    assert abs(reaction(results.case("left_settles"))) < EXACT * weight


PADS = """
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.5}}}}
blocks:
  - box: {{group: pads, material: stone, min: [0, 0, -1], max: [0.4, 0.5, 0]}}
  - box: {{group: middle, material: stone, min: [1.8, 0, -1], max: [{end}, 0.5, 0]}}
  - box: {{group: beam, material: stone, min: [0, 0, 0], max: [{length}, 0.5, 0.4]}}
{more}
contacts: {{joint: dry}}
supports: [{{blocks: [pads, middle]}}]
load_cases: {{sink: {{settlement: {{on: middle, direction: [0, 0, -1]}}}}}}
analysis: {{flow_rule: associative}}
"""
RIGHT = "  - box: {group: pads, material: stone, min: [3.6, 0, -1], max: [4, 0.5, 0]}"
WHOLE = PADS.format(end=2.2, length=4, more=RIGHT)
HALF = PADS.format(end=2, length=2, more="symmetry: [{x: 2, halves: [middle, beam]}]")


@pytest.mark.parametrize("deck", [WHOLE, HALF], ids=["whole", "half"])
def test_at_rest_the_least_forces_spread_over_every_point(tmp_path: Path, deck: str) -> None:
    """Three equal pads of four points carry a third each, in the squares of the forces the least; W/3 less nothing."""
    path = tmp_path / "pads.yaml"
    path.write_text(deck, encoding="utf-8")
    (case,) = run(path, RunOptions(folder=tmp_path / "out", overrides=("output.vtu=false",), force=True)).cases
    weight = WEIGHT * 4 * 0.5 * 0.4
    assert abs(reaction(case)) < EXACT * weight
    assert settlement_of(case.load_case).reference == pytest.approx(weight / 3, rel=EXACT)


@pytest.mark.parametrize("friction", [0.05, 0.5])
def test_a_support_that_slides_away_is_let_go_by_friction(tmp_path: Path, friction: float) -> None:
    overrides = [
        "load_cases.right_settles.settlement.direction=[1, 0, 0]",
        f"joints.dry.friction={friction}",
        "analysis.flow_rule=associative",
    ]
    results = solved(tmp_path, "beam_on_three_supports", *overrides, cases=("right_settles",))
    # the beam rests on the right pad with W/2 at most, which then bears all friction it can: the pad has to be pulled
    assert reaction(results.cases[0]) == pytest.approx(-friction * WEIGHT * 0.8 / 2, rel=1e-6)


@pytest.mark.every(3)
@pytest.mark.parametrize(("t", "n", "mu"), [(0.6, 26, 1.0), (0.5, 15, 0.9), (0.9, 12, 0.45)])
def test_the_thrusts_of_an_arch(tmp_path: Path, t: float, n: int, mu: float) -> None:
    overrides = [
        f"parameters.t={t}",
        f"parameters.n={n}",
        f"parameters.mu={mu}",
        "analysis.flow_rule=associative",
    ]
    results = solved(tmp_path, "spreading_arch", *overrides)
    exact = springer_thrusts(4.0, t, 1.0, n, mu, WEIGHT)
    assert reaction(results.case("spreads")) == pytest.approx(exact["least"], rel=EXACT)
    assert reaction(results.case("pushed_in")) == pytest.approx(-exact["greatest"], rel=EXACT)
    assert reaction(results.case("sinks")) == pytest.approx(exact["vertical"], rel=EXACT)


def test_the_least_thrust_is_that_of_three_hinges(tmp_path: Path) -> None:
    """H = max over joints j of the moment about the intrados over the rise from there to the extrados of the crown."""
    angles = np.linspace(np.pi / 2, 0, 14)
    radial = np.column_stack([np.cos(angles), np.sin(angles)])
    inner, outer = 2.0 * radial, 2.6 * radial
    weights, centroids = voussoirs(inner, outer, WEIGHT)
    moments = [(weights[:j] * (inner[j, 0] - centroids[:j, 0])).sum() for j in range(1, 14)]
    exact = max(moment / (2.6 - inner[j, 1]) for j, moment in enumerate(moments, start=1))
    case = solved(tmp_path, "spreading_arch", cases=("spreads",)).cases[0]
    assert reaction(case) == pytest.approx(exact, rel=EXACT)
    settlement = settlement_of(case.load_case)
    # the kinematic bound of the load factor is the lower bound of the reaction
    assert settlement.reaction(case.checks.kinematic_bound) <= exact * (1 + 1e-9)
    assert settlement.reaction(case.checks.static_bound) >= exact * (1 - 1e-9)


def test_the_mechanism_has_unit_power_and_moves_the_support_along(tmp_path: Path) -> None:
    case = solved(tmp_path, "spreading_arch", cases=("spreads",)).cases[0]
    settlement, mechanics = settlement_of(case.load_case), case.solution.mechanics
    assert settlement is not None
    assert mechanics is not None
    motion = mechanics.mechanism[settlement.blocks]
    np.testing.assert_allclose(motion, [[1 / settlement.unit, 0, 0, 0, 0, 0]], atol=1e-12 / settlement.unit)
    left = 26  # the other springer
    assert settlement.blocks.tolist() == [27]
    assert not mechanics.mechanism[left].any()


def test_a_structure_that_does_not_stand_on_the_held_support_has_no_reaction(tmp_path: Path) -> None:
    results = solved(tmp_path, "spreading_arch", "parameters.t=0.2", cases=("spreads",))
    assert results.cases[0].status.value == "no_equilibrium"
    assert math.isnan(answer_of(results.cases[0]))


@pytest.mark.parametrize("length", ["mm", "ft"])
def test_the_reaction_follows_the_units(tmp_path: Path, length: str) -> None:
    """The same numbers in another unit of length: another arch, whose thrust goes with the volume."""
    plain = reaction(solved(tmp_path, "spreading_arch", cases=("spreads",)).cases[0])
    metres = {"mm": 1e-3, "ft": 0.3048}[length]
    overrides = [f"units.length={length}", 'materials.stone.density="2000 kg/m^3"']
    other = reaction(solved(tmp_path, "spreading_arch", *overrides, cases=("spreads",)).cases[0])
    assert other == pytest.approx(plain * metres**3, rel=EXACT)


@pytest.mark.long
def test_supports_and_guides_balance_the_loads(tmp_path: Path) -> None:
    """Reactions of the listing: beds, guides and supports that give way hold what acts on the structure."""
    for deck in ("guided_blocks", "spreading_arch"):
        results = solved(tmp_path, deck)
        for case in results.cases:
            mechanics = case.solution.mechanics
            assert mechanics is not None
            model = results.model
            found = reactions_of(model, results.contacts, case.load_case, mechanics)
            load = load_on_structure(model, case.load_case, mechanics.load_factor)
            total = np.sum([each.wrench for each in found], axis=0)
            np.testing.assert_allclose(total, -load, atol=1e-6 * np.abs(load).max())
            assert any(each.support.startswith("guide of") for each in found) == (deck == "guided_blocks")


BESIDE = (
    HEAD.replace("contacts: {joint: dry}\n", "")
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: buttress, material: stone, min: [GAP, 0, 0], max: [9, 1, 1]}
  - box: {group: wall, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
contacts: {joint: dry, isolated: allow, overrides: OVERRIDES}
supports: [{blocks: buttress}, {ground: {z: 0}, blocks: wall}]
TIES
load_cases: {settles: {settlement: {on: buttress, direction: DIRECTION}}}
"""
)


def reaction_beside(direction: str, gap: float = 1, overrides: str = "[]", ties: str = "") -> float:
    """Of a buttress that gives way beside a wall that stands by itself."""
    text = BESIDE
    words = {"GAP": str(gap), "OVERRIDES": overrides, "TIES": ties, "DIRECTION": direction}
    for word, value in words.items():
        text = text.replace(word, value)
    case = case_of(text)[1]
    assert case.status is Status.SOLVED
    standing, reaction = case.solution.standing, answer_of(case)
    assert standing is not None
    assert standing.verdict is Standing.YES
    assert reaction is not None
    return reaction


@pytest.mark.parametrize("direction", ["[0, 0, -1]", "[0, 0, 1]", "[1, 0, 0]"])
def test_a_buttress_without_friction_beside_a_wall_holds_nothing(direction: str) -> None:
    """Nothing moves against a force: the motion alone does not say so but for rounding."""
    smooth = "[{joint: frictionless, between: [buttress, wall]}]"
    assert reaction_beside(direction, overrides=smooth) == pytest.approx(0.0, abs=1e-4)


def test_a_buttress_beside_a_wall_starts_from_no_thrust() -> None:
    """Least forces would press them together; without that the wall stands, and holds the buttress up by no more."""
    assert -19620.0 < reaction_beside("[0, 0, -1]") <= 1e-4


@pytest.mark.parametrize(("direction", "reaction"), [("[0, 0, -1]", 0.0), ("[1, 0, 0]", -100.0)])
def test_a_support_that_a_tie_alone_reaches(direction: str, reaction: float) -> None:
    """The tie is level and slack at first; it is stretched as the support goes away."""
    tie = "ties: [{through: [[5, 0.5, 0.5], [1, 0.5, 0.5]], on: [buttress, wall], capacity: 100}]"
    assert reaction_beside(direction, 5, ties=tie) == pytest.approx(reaction, abs=1e-4)
