"""Equilibrium, units and sizes of a program, beside sums that are done by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.assemble import (
    LIGHT,
    _arms,
    assemble,
    equilibrium_matrix,
    lever_arms,
    own_units,
    yield_limits,
)
from mbla.program.facts import ModelFacts
from mbla.program.lift import Lift
from mbla.program.program import Program, Scaling
from mbla.program.yield_conditions import YieldLimits
from tests.line import BLOCK, Line, line_of

STACK = BLOCK.replace(
    'max: ["=b", 1, "=h"]}',
    'max: ["=b", 1, "=h"]}\n  - box: {group: top, material: stone, min: [0.25, 0, 2], max: [1.25, 1, 2.5]}',
)
LAWS = "friction: 0.5, cohesion: 8, tensile_strength: 4, compressive_strength: 64, dilatancy: 14"


@pytest.fixture(scope="module")
def stack() -> Line:
    """A block 1 x 1 x 2 on the ground, and one 1 x 1 x 0.5 on it, 0.25 beyond its edge."""
    return line_of(STACK.replace('friction: "=mu", cohesion: "=c", tensile_strength: "=ft"', LAWS))


def test_contact_forces_push_apart_and_turn_about_the_centroids(stack: Line) -> None:
    model, contacts = stack.model, stack.contacts
    matrix = equilibrium_matrix(model, contacts, model.free)
    n_points = len(contacts.points)
    assert matrix.shape == (12, 3 * n_points)
    forces = np.random.default_rng(1).normal(size=(n_points, 3))
    found = (matrix @ forces.ravel()).reshape(2, 6)
    expected = np.zeros((2, 6))
    for point in range(n_points):
        in_space = forces[point] @ contacts.frames[point]
        a, b = contacts.bodies[contacts.interface_of_point[point]]
        for body, sign in ((a, -1.0), (b, 1.0)):
            if body < 2:
                arm = contacts.points[point] - model.blocks.centroids[body]
                expected[body] += sign * np.concatenate([in_space, np.cross(arm, in_space)])
    assert found == pytest.approx(expected)


def test_rows_of_fixed_blocks_are_left_out(stack: Line) -> None:
    whole = equilibrium_matrix(stack.model, stack.contacts, np.array([0, 1]))
    for block in (0, 1):
        alone = equilibrium_matrix(stack.model, stack.contacts, np.array([block]))
        assert (alone - whole[6 * block : 6 * block + 6]).nnz == 0
    turned = equilibrium_matrix(stack.model, stack.contacts, np.array([1, 0]))
    assert (sp.vstack([turned[6:], turned[:6]]) - whole).nnz == 0


def arms_by_hand() -> tuple[float, float]:
    """Corners of the ground joint and of the joint between, from both centroids."""
    ground, between = np.sqrt(0.5**2 + 0.5**2 + 1), [np.sqrt(0.25**2 + 0.5**2 + 1), np.sqrt(0.5**2 + 0.5**2 + 1)]
    top = [np.hypot(np.hypot(0.5, 0.5), 0.25), np.hypot(np.hypot(0.25, 0.5), 0.25)]
    return float((4 * ground + 2 * sum(between)) / 8), float(np.mean(top))


def test_lever_arms(stack: Line) -> None:
    """Mean distances of contact points; the size of a block without any."""
    arms = lever_arms(stack.model, stack.contacts, np.array([0, 1]))
    assert arms == pytest.approx(arms_by_hand())
    assert lever_arms(stack.model, stack.contacts, np.array([1])) == pytest.approx(arms_by_hand()[1:])
    apart = line_of(STACK.replace("min: [0.25, 0, 2], max: [1.25, 1, 2.5]", "min: [5, 0, 2], max: [6, 1, 2.5]"))
    assert lever_arms(apart.model, apart.contacts, np.array([1])) == pytest.approx([0.5 ** (1 / 3)])


def test_the_lever_arm_of_a_block_with_one_contact_point_is_its_distance() -> None:
    centroids, sizes = np.array([[0.0, 0, 0], [0, 0, 5.0]]), np.array([7.0, 9.0])
    arms = _arms(centroids, sizes, np.array([[2, 0]]), np.array([[3.0, 0, 4.0]]), np.array([0, 1]))
    assert arms.tolist() == [5.0, 9.0]


def test_limits_are_the_laws_by_area(stack: Line) -> None:
    """Quarters of 1 and of 0.75, by the law in the deck's units of force."""
    limits = yield_limits(stack.model, stack.contacts)
    shares = np.where(stack.contacts.areas[stack.contacts.interface_of_point] > 0.9, 0.25, 0.1875)
    assert sorted(set(shares.tolist())) == [0.1875, 0.25]
    assert limits.friction.tolist() == [0.5] * 8
    assert limits.dilatancy == pytest.approx([np.tan(np.radians(14))] * 8)
    assert limits.cohesion == pytest.approx(8 * shares)
    assert limits.tension == pytest.approx(4 * shares)
    assert limits.compression == pytest.approx(64 * shares)
    dry = line_of(STACK)
    assert np.isinf(yield_limits(dry.model, dry.contacts).compression).all()


def test_units_of_a_program(stack: Line) -> None:
    """Force: the mean weight; moment: that times the lever arm; live load: its root mean square comes to the force."""
    program, load_case = stack.program, stack.load_case
    weights = np.linalg.norm(load_case.dead_load[:, :3], axis=1)
    assert weights == pytest.approx(np.array([2.0, 0.5]) * weights[0] / 2.0)
    force, arms = weights.mean(), arms_by_hand()
    assert program.scaling.force == pytest.approx(force)
    assert program.scaling.live == pytest.approx(force / np.sqrt((weights**2).mean()))
    per_row = np.concatenate([[1.0] * 3 + [1.0 / arm] * 3 for arm in arms]) / force
    assert program.scaling.row == pytest.approx(per_row)
    assert program.dead_load == pytest.approx(per_row * load_case.dead_load.ravel())
    assert program.live_load == pytest.approx(per_row * load_case.live_load.ravel() * program.scaling.live)
    matrix = equilibrium_matrix(stack.model, stack.contacts, stack.model.free)
    difference = program.equilibrium_matrix - sp.diags_array(per_row * force) @ matrix
    assert abs(difference).max() < 1e-12
    in_units = yield_limits(stack.model, stack.contacts).scaled(1.0 / force)
    for name in ("friction", "dilatancy", "cohesion", "tension", "compression"):
        assert getattr(program.limits, name) == pytest.approx(getattr(in_units, name))


def test_a_couple_has_a_size_too(stack: Line) -> None:
    """A dead load of moments alone, and a live load on one block alone."""
    arms = arms_by_hand()
    dead, live = np.zeros((2, 6)), np.zeros((2, 6))
    dead[0, 4], live[1, 0] = 3.0, 5.0
    program = assemble(stack.model, stack.contacts, replace(stack.load_case, dead_load=dead, live_load=live))
    assert program.scaling.force == pytest.approx(3.0 / arms[0])
    assert program.scaling.live == pytest.approx(3.0 / arms[0] / (5.0 / np.sqrt(2.0)))
    weightless = assemble(stack.model, stack.contacts, replace(stack.load_case, dead_load=0 * dead, live_load=live))
    assert weightless.scaling.force == pytest.approx(5.0)
    assert weightless.scaling.live == pytest.approx(np.sqrt(2.0))


def test_mechanisms_and_back(stack: Line) -> None:
    program = stack.program
    scaled = np.random.default_rng(2).normal(size=12)
    mechanism = program.mechanism(scaled)
    assert mechanism.shape == (2, 6)
    assert mechanism.ravel() == pytest.approx(scaled * program.scaling.row * program.scaling.live)
    assert program.velocities(mechanism) == pytest.approx(scaled)
    power = float((stack.load_case.live_load * mechanism).sum())
    assert power == pytest.approx(program.live_load @ scaled)
    assert program.scaling.load_factor(2.0) == 2.0 * program.scaling.live
    forces = np.arange(6.0)
    assert program.scaling.forces(forces).tolist() == (forces.reshape(2, 3) * program.scaling.force).tolist()


def rows(dead: list[list[float]], live: list[list[float]], components: int = 3) -> Program:
    """A program with these loads of its blocks, and nothing else of interest."""
    n = sum(len(load) for load in dead)
    none = np.zeros(0)
    return Program(
        equilibrium_matrix=sp.csr_array((n, 0)),
        dead_load=np.concatenate([np.array(load, dtype=float) for load in dead]),
        live_load=np.concatenate([np.array(load, dtype=float) for load in live]),
        limits=YieldLimits(none, none, none, none, none),
        scaling=Scaling(2.0, 5.0, np.ones(n)),
        facts=ModelFacts(free=np.arange(len(dead)), n_blocks=len(dead), areas=none),
        components=components,
    )


SIX = [[3.0, 0, 0, 4.0, 0, 0], [0.0] * 6, [0, 0, 1.0, 0, 0, 0]]


def test_sizes_of_loads() -> None:
    program = rows(SIX, [[0, 2.0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 4.0], [0.0] * 6])
    assert program.n_points == 0
    assert program.dead_over_live == pytest.approx(np.sqrt(26 / 20))
    assert program.own_unit == pytest.approx(3.0 / np.sqrt(20 / 3))
    assert rows(SIX, [[0.0] * 6] * 3).own_unit == 1.0
    assert rows([[0.0] * 6] * 3, SIX).own_unit == 1.0
    planar = rows([[3.0, 4.0, 0.0], [0, 0, 1.0]], [[0, 2.0, 0], [0, 0, 0.0]], components=2)
    assert planar.own_unit == pytest.approx(3.0 / np.sqrt(2.0))


@pytest.mark.parametrize(("speed", "moved"), [(0.01, 0.05), (0.1, 0.5), (1.0, np.sqrt(26 / 20)), (-0.1, 0.5)])
def test_the_dead_load_that_moves(speed: float, moved: float) -> None:
    program = rows(SIX, [[0, 2.0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 4.0], [0.0] * 6])
    u = np.zeros(18)
    u[1] = speed
    assert program.moved_over_live(u) == pytest.approx(moved)
    u[7] = 1.0  # of a block without dead load
    assert program.moved_over_live(u) == pytest.approx(moved)
    unloaded = replace(program, live_load=np.zeros(18))
    assert unloaded.moved_over_live(u) == pytest.approx(5.0 * abs(speed))


def reduced(full: Program, ways: FloatArray, of_blocks: bool = False) -> Program:
    program = rows([(ways.T @ full.dead_load).tolist()], [(ways.T @ full.live_load).tolist()])
    way = Lift(full, sp.csr_array(ways), sp.csr_array((0, 0)), 3)
    return replace(program, facts=full.facts, reduction=way, of_blocks=way if of_blocks else None)


def test_sizes_of_what_is_reduced_are_those_of_the_whole() -> None:
    """A block that may move along one line only counts with what of its load does work there."""
    full = rows([[3.0, 0, 0, 4.0, 0, 0]], [[6.0, 8.0, 0, 0, 0, 0]])
    ways = np.zeros((6, 1))
    ways[0, 0] = 1.0
    program = reduced(full, ways, of_blocks=True)
    assert program.own_unit == pytest.approx(3.0 / 6.0)
    assert program.moved_over_live(np.array([0.1])) == pytest.approx(0.3)
    assert program.mechanism(np.array([2.0])).tolist() == [[10.0, 0, 0, 0, 0, 0]]
    assert program.velocities(np.array([[10.0, 7.0, 0, 0, 0, 0]])) == pytest.approx([2.0])


def test_the_way_back_takes_off_the_unit_of_a_part() -> None:
    full = rows([[3.0, 0, 0, 4.0, 0, 0]], [[6.0, 8.0, 0, 0, 0, 0]])
    ways = np.zeros((6, 2))
    ways[0, 0] = 4.0
    program = reduced(full, ways)
    assert program.velocities(np.array([[10.0, 7.0, 0, 0, 0, 0]])) == pytest.approx([0.5, 0.0])


def test_what_is_the_same_whatever_the_live_load() -> None:
    full = rows([[3.0, 0, 0, 4.0, 0, 0]], [[6.0, 8.0, 0, 0, 0, 0]])
    program = reduced(full, np.eye(6))
    for stripped, whole in ((program.without_live_load(), program), (full.without_live_load(), full)):
        assert not stripped.live_load.any()
        assert len(stripped.live_load) == 6
        assert stripped.scaling.live == 1.0
        assert stripped.scaling.force == 2.0
        assert np.array_equal(stripped.dead_load, whole.dead_load)
    inner = program.without_live_load().reduction
    assert inner is not None
    assert not inner.full.live_load.any()
    assert full.without_live_load().reduction is None


# Programs from model, contacts and loads: equilibrium, units of force, and units of light blocks.


@pytest.mark.parametrize(
    "overrides",
    [
        ("units.length=mm", "parameters.b=1000", "parameters.h=2000", "materials.stone.density=2e-6"),
        ("materials.stone.density=2e-3",),
        ("units.force=kip",),
        ("units.mass=lb", "materials.stone.density=5"),
    ],
)
def test_the_program_does_not_know_units(overrides: tuple[str, ...]) -> None:
    text = BLOCK.replace('max: ["=b", 1, "=h"]', 'max: ["=b", "=b", "=h"]')
    here, there = line_of(text).program, line_of(text, *overrides).program
    assert there.equilibrium_matrix.toarray() == pytest.approx(here.equilibrium_matrix.toarray(), abs=1e-12)
    assert there.dead_load == pytest.approx(here.dead_load)
    assert there.live_load == pytest.approx(here.live_load)


FIXED = -1


@pytest.mark.parametrize(
    ("loads", "bodies", "units"),
    [
        ([1, 1e-12], [(FIXED, 0), (0, 1)], [1, 1e-12]),
        ([1, 1e-12], [(FIXED, 0), (1, 0), (0, 1)], [1, 1e-12]),
        ([1, 2 * LIGHT], [(FIXED, 0), (0, 1)], [1, 1]),
        ([1e-12, 1], [(FIXED, 0), (0, 1)], [1, 1]),  # light below heavy
        ([1, 1e-12, 1], [(FIXED, 0), (0, 1), (1, 2)], [1, 1, 1]),
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (1, 2)], [1, 1e-10, 1e-10]),  # a pile has the unit of its largest load
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (0, 2)], [1, 1e-12, 1e-10]),
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (1, 2), (FIXED, 2)], [1, 1, 1]),
        ([1, 1e-12], [(FIXED, 0), (FIXED, 1)], [1, 1e-12]),
        ([1, 0], [(FIXED, 0), (0, 1)], [1, 1]),  # without a load there is nothing to measure by
        ([1, 1], [(FIXED, 0), (0, 1)], [1, 1]),
    ],
)
def test_units(loads: list[float], bodies: list[tuple[int, int]], units: list[float]) -> None:
    assert own_units(np.array(loads, dtype=np.float64), np.array(bodies)).tolist() == units
