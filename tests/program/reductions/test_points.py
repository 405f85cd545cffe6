"""Which contact points reductions leave out, and which stand for one place.

Points as stiff as their shares: torsion by the trapezoidal rule, and unknowns that stand for the same forces.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import IntArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.lift import Lift
from mbla.program.reductions import Reduced, allowed_reductions, reduce_program
from mbla.program.reductions.points import program_by_shares, without_inner_points
from mbla.program.reductions.restrict import chosen_limits, restricted, selection, tidy
from mbla.program.reductions.scene import ProgramGeometry, part_of
from mbla.program.reductions.steps import ProgramSize, ReductionOutcome, ReductionSwitches, size_of
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.standing import stress_free_state
from tests.line import BLOCK, HEAD, WALL, Line, line_of, verified
from tests.program.reductions.scenes import scene
from tests.solution.by_hand import own_points

SADDLE = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: lower, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - polyhedron:
      group: saddle
      material: stone
      vertices: [[0, 0, 1], [1, 0, 1], [1, 0, 0.5], [2, 0, 0.5], [2, 0, 2], [0, 0, 2],
                 [0, 1, 1], [1, 1, 1], [1, 1, 0.5], [2, 1, 0.5], [2, 1, 2], [0, 1, 2]]
      faces: [[0, 1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11], [0, 1, 7, 6], [1, 2, 8, 7], [2, 3, 9, 8], [3, 4, 10, 9],
              [4, 5, 11, 10], [5, 0, 6, 11]]
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0.2, 0]}]}}
analysis: {flow_rule: associative}
"""
)
"""A block that sits on another one and leans against its side: two planes between one pair of bodies."""


def points_alone(whole: ProgramGeometry, points: IntArray) -> ProgramGeometry:
    """The scene with some of its points."""
    n = len(whole.centroids)
    blocks = selection(np.arange(n), n, 6)
    limits = chosen_limits(whole.program.limits, points)
    program = restricted(whole.program, blocks, selection(points, whole.program.n_points, 3), limits)
    return part_of(whole, program, np.arange(n), points)


def test_corners_of_a_finer_joint_are_kept() -> None:
    kept = without_inner_points(scene(BLOCK, "contacts.points.per_edge=3"))
    assert sorted(kept.points[:, :2].tolist()) == [[0, 0], [0, 1], [1, 0], [1, 1]]
    assert kept.program.n_points == 4


def test_points_that_bear_tension_are_all_kept() -> None:
    """There the velocity inside may reach a limit that it does not reach at the corners."""
    for law in ("{friction: 0.5, cohesion: 10}", "{friction: 0.5, compressive_strength: 1.e6}"):
        whole = scene(BLOCK, "contacts.points.per_edge=3", f"joints.dry={law}")
        assert without_inner_points(whole) is whole


def test_planes_of_one_pair_of_bodies_keep_their_own_corners() -> None:
    whole = scene(SADDLE, "contacts.points.per_edge=2")
    kept = without_inner_points(whole)
    between = (kept.bodies >= 0).all(axis=1)
    seat = between & (np.abs(kept.frames[:, 0, 2]) > 0.5)
    side = between & (np.abs(kept.frames[:, 0, 0]) > 0.5)
    assert sorted(kept.points[seat].tolist()) == [[0, 0, 1], [0, 1, 1], [1, 0, 1], [1, 1, 1]]
    assert sorted(kept.points[side].tolist()) == [[1, 0, 0.5], [1, 0, 1], [1, 1, 0.5], [1, 1, 1]]


@pytest.mark.parametrize("axis", [0, 1])
def test_of_points_on_one_line_its_ends_are_kept(axis: int) -> None:
    whole = scene(BLOCK, "contacts.points.per_edge=4")
    edge = points_alone(whole, np.flatnonzero(whole.points[:, 1 - axis] == 0.0))
    assert len(edge.points) == 5
    assert sorted(without_inner_points(edge).points[:, axis].tolist()) == [0.0, 1.0]


SETTINGS = SolverSettings(tolerance=1e-8)

TWIST = BLOCK.replace("analysis: {flow_rule: associative}", "analysis: {flow_rule: non_associative}").replace(
    "live: [{acceleration: [1, 0, 0]}]",
    "live: [{force: [0, 1, 0], on: block, at: [1, 0.5, 1]}, {force: [0, -1, 0], on: block, at: [0, 0.5, 1]}]",
)
"""A block 1 × 1 on the ground turned about its vertical middle axis by a couple of 1 N m."""


def reduced(line: Line) -> Reduced:
    return reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False)


@pytest.mark.every(2)
@pytest.mark.parametrize("n", [2, 4, 7])
def test_torsion_without_dilatancy_follows_the_trapezoidal_rule(n: int) -> None:
    """Pressed evenly, every point slides with friction on its share: μ W Σ s r. With n → ∞ that is 0.3826 μ W a, from
    which the rule is away by O(1/n²); equally stiff points would give 0.428 for n = 8."""
    solution, checks, status = verified(line_of(TWIST, f"contacts.points.per_edge={n}"))
    assert status == "solved", checks.failures
    weight = 2000 * 9.81 * 2
    at = np.arange(n + 1) / n - 0.5
    share = np.where(np.abs(at) < 0.5 - 1e-9, 1.0, 0.5) / n
    torsion = sum(share[i] * share[j] * math.hypot(at[i], at[j]) for i, j in itertools.product(range(n + 1), repeat=2))
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.5 * weight * torsion, rel=1e-5)  # forces move on the way
    assert 0 < torsion - (math.sqrt(2) + math.asinh(1)) / 6 < 0.32 / n**2


@pytest.mark.parametrize("planar", [True, False])
def test_points_share_the_dead_load_as_they_share_the_area(planar: bool) -> None:
    """In the plane two lines of points, one behind the other, with a point between them that bears half of it all."""
    push = "[1, 0, 0]" if planar else "[1, 0.3, 0]"
    line = line_of(BLOCK, "contacts.points.per_edge=2", f"load_cases.push.live=[{{acceleration: {push}}}]")
    (part,) = reduced(line).parts
    assert part.components == (2 if planar else 3)
    state = stress_free_state(part).rest
    assert state is not None
    normal = part.lift.contact_forces(state.forces)[:, 0]
    expected = [0.0625] * 4 + [0.125] * 4 + [0.25]
    assert np.sort(normal / normal.sum()) == pytest.approx(np.array(expected), rel=1e-6)


def test_strengths_stay_those_of_the_points() -> None:
    """x = √s y: cohesion, tension and compression of y are those of x over √s."""
    mortar = "joints.dry={friction: 0.5, cohesion: 3000, tensile_strength: 1000, compressive_strength: 2.e5}"
    line = line_of(BLOCK, "contacts.points.per_edge=3", mortar, "load_cases.push.live=[{acceleration: [1, 0.3, 0]}]")
    (part,) = reduced(line).parts
    root = part.lift.forces.diagonal()[::3]
    assert len(np.unique(root.round(9))) == 3
    full = part.full.limits
    assert root * part.limits.cohesion == pytest.approx(full.cohesion, rel=1e-12)
    assert root * part.limits.tension == pytest.approx(full.tension, rel=1e-12)
    assert root * part.limits.compression == pytest.approx(full.compression, rel=1e-12)
    assert np.mean(root**2) == pytest.approx(1.0, rel=1e-12)


def test_corners_are_all_alike() -> None:
    """Nothing is changed where interfaces have their corners only."""
    line = line_of(WALL, "load_cases.push.live=[{acceleration: [1, 0.3, 0]}]", "analysis.flow_rule=non_associative")
    assert reduced(line).parts == (line.program,)


SMALL_ABOVE = BLOCK.replace(
    "supports:",
    '  - box: {group: cap, material: stone, min: [0.1, 0.1, "=h"], max: [0.5, 0.5, "=h+1"]}\nsupports:',
)
"""A block on the ground, and one on it that is smaller than the spacing of points."""


def test_an_interface_with_its_corners_alone_stays_beside_one_with_more() -> None:
    whole = scene(SMALL_ABOVE, "contacts.points.spacing=0.5")
    by_shares = program_by_shares(whole, whole.program, Lift.identity(whole.program))
    stiffness = by_shares.lift.forces.diagonal()[::3] ** 2
    finer = (whole.bodies < 0).any(axis=1)
    assert stiffness[~finer] == pytest.approx(np.ones(4))
    shares = whole.areas[finer] / whole.areas[finer].mean()
    assert len(np.unique(shares.round(9))) == 3
    assert stiffness[finer] == pytest.approx(shares)


# Which reductions an analysis allows, the record of each, and matrices of smaller programs without rounding.


SMALL, LARGE = ProgramSize(6, 4, 40, 6), ProgramSize(12, 8, 80, 12)


@pytest.mark.parametrize(
    ("on", "allowed", "found", "state"),
    [
        (True, True, 3, ReductionOutcome.APPLIED),
        (True, True, 0, ReductionOutcome.NONE),
        (True, False, 0, ReductionOutcome.BARRED),
        (False, True, 0, ReductionOutcome.OFF),
        (False, False, 0, ReductionOutcome.OFF),
    ],
)
def test_what_became_of_a_reduction(on: bool, allowed: bool, found: int, state: ReductionOutcome) -> None:
    step = ReductionSwitches(on=on).step("planar", allowed, found, LARGE, SMALL)
    assert (step.name, step.state, step.found, step.before, step.after) == ("planar", state, found, LARGE, SMALL)


def test_programs_without_live_load_do_not_count() -> None:
    loaded = own_points([0, -1.0, 0, -1.0], [1.0, 0, 0, 0])
    larger = own_points([0, -1.0] * 3, [0, 0, 0, 0, 0, 1.0])
    idle = own_points([0, -1.0] * 9, [0.0] * 18)
    assert size_of([loaded, idle, larger]) == ProgramSize(unknowns=10, cones=5, entries=10, largest=6)
    assert size_of([larger, loaded]).largest == 6
    assert size_of([idle]) == ProgramSize(0, 0, 0, 0)
    assert np.count_nonzero(idle.live_load) == 0


def test_without_reason_to_the_contrary_the_deck_is_followed() -> None:
    assert allowed_reductions(AnalysisSection()) == ReductionSwitches()
    assert not allowed_reductions(AnalysisSection(reductions=False)).on


def test_rounding_of_the_largest_entry_is_left_out() -> None:
    matrix = tidy(sp.coo_array((np.array([1e-16, -4.0, 1e-3, 0.0]), ([1, 0, 1, 0], [0, 1, 1, 0])), shape=(2, 3)))
    assert matrix.indices.tolist() == [1, 1]
    assert matrix.data.tolist() == [-4.0, 1e-3]
    assert matrix.shape == (2, 3)
    assert tidy(sp.coo_array((2, 3))).nnz == 0
