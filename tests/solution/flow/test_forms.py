"""The path of equivalent programs: orders of blocks and points, axes turned, reduced or not, parts or the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.program.program import Program
from mbla.program.stiffness_shares import shares_of
from mbla.solution.flow.path_of_part import path_by
from mbla.solution.flow.path_record import Stop
from mbla.solution.nonassociative.moving_part import moving_part
from tests.decks.folder import PATHS
from tests.line import WALL, line_of, unreduced
from tests.solution.flow.paths import DEFAULT, case_of, load_factor_of
from tests.solution.nonassociative.structures import FERRIS_3

DECK = {path.stem: path for path in PATHS}


def turned(program: Program, seed: int) -> Program:
    """The same in another order of blocks and points, with other axes for shear at each point."""
    rng = np.random.default_rng(seed)
    size, n = program.components, program.n_points
    blocks, points = rng.permutation(len(program.dead_load) // 6), rng.permutation(n)
    rows = (6 * blocks[:, None] + np.arange(6)).ravel()
    columns = (size * points[:, None] + np.arange(size)).ravel()
    cosine, sine = np.cos(angle := rng.uniform(0.0, 2.0 * np.pi, n)), np.sin(angle)
    axes = np.zeros((n, 3, 3))
    axes[:, 0, 0] = 1.0
    axes[:, 1:, 1:] = np.stack([np.stack([cosine, -sine]), np.stack([sine, cosine])]).transpose(2, 0, 1)
    matrix = program.equilibrium_matrix[rows][:, columns] @ sp.block_diag(list(axes))
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(matrix),
        dead_load=program.dead_load[rows],
        live_load=program.live_load[rows],
        limits=type(program.limits)(**{name: values[points] for name, values in vars(program.limits).items()}),
        facts=replace(program.facts, areas=shares_of(program)[points]),
        reduction=None,
    )


@pytest.mark.parametrize(
    ("deck", "name"),
    [
        ("corner", "corner_out"),
        ("cross_vault_on_piers", "along_x"),
        ("spiral_stair", "push_x"),
    ],
)
@pytest.mark.long
def test_order_and_axes_do_not_count(deck: str, name: str) -> None:
    case = case_of(DECK[deck], name)
    associative = case.associative().state
    assert associative is not None
    found = [path_by(turned(case.loaded, seed), associative.load_factor, DEFAULT) for seed in (1, 2)]
    assert all(each.is_answer for each in found)
    expected = case.path().load_factor
    assert [each.load_factor for each in found] == pytest.approx(2 * [expected], rel=2e-4)


def test_a_wall_in_the_plane_is_the_wall_in_space() -> None:
    line = line_of(FERRIS_3)
    (program,) = unreduced(line.program, line.contacts).parts
    live = line.program.scaling.live
    whole = path_by(program, 0.403694 / live, DEFAULT)
    assert live * whole.load_factor == pytest.approx(load_factor_of(line), rel=1e-3)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "close"),
    [("push_y", 3e-3), ("push_x", 4e-3)],  # 0.3 % along x, by processor
)
def test_what_moves_alone_leads_to_the_load_factor_of_the_whole(name: str, close: float) -> None:
    case = case_of(DECK["room_to_strengthen"], name)
    program, associative = case.loaded, case.associative().state
    assert associative is not None
    part = moving_part(program, associative.velocities, DEFAULT)
    assert part is not None
    alone, whole = (path_by(program, associative.load_factor, DEFAULT, part=each) for each in (part, None))
    assert alone.load_factor == pytest.approx(whole.load_factor, rel=close)


@pytest.mark.long
@pytest.mark.parametrize(("length", "courses"), [(30, 30), (40, 25)])
def test_walls_of_which_a_part_moves(length: int, courses: int) -> None:
    text = WALL.replace('length: "=0.4*n", courses: "=n"', f"length: {0.4 * length}, courses: {courses}")
    case = case_of(text, "push")
    program, associative = case.loaded, case.associative().state
    assert associative is not None
    part = moving_part(program, associative.velocities, DEFAULT)
    assert part is not None
    alone, whole = (path_by(program, associative.load_factor, DEFAULT, part=each) for each in (part, None))
    assert alone.is_answer
    assert whole.is_answer
    assert alone.load_factor == pytest.approx(whole.load_factor, rel=3e-3)


@pytest.mark.long
def test_a_load_that_rises_again_after_a_dip_is_not_flat() -> None:
    """A cross vault dips at 0.3738 and then rises to 0.377: a blocked step more or less after the dip moves 0.1 %."""
    case = case_of(DECK["cross_vault"], "along_x")
    associative = case.associative().state
    assert associative is not None
    programs = (case.loaded, *(turned(case.loaded, seed) for seed in (1, 2)))
    found = [path_by(program, associative.load_factor, DEFAULT) for program in programs]
    factors = [case.loaded.scaling.load_factor(each.load_factor) for each in found]
    assert [each.stop for each in found] == 3 * [Stop.FAR]
    assert factors == pytest.approx(3 * [0.3773], rel=2e-3)
