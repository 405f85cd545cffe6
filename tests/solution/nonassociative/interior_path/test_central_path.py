"""The path's own equations: where it begins, what lies on it, and that its end is the exact law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.nonassociative.interior_path.arc_length import follow
from mbla.solution.nonassociative.interior_path.central_path import (
    central_path,
    first_point,
    off_path,
    residuals,
    state_of,
)
from mbla.solution.nonassociative.interior_path.condensed_matrix import matrix_map
from mbla.solution.nonassociative.interior_path.descent import inside, room
from tests.line import WALL, line_of
from tests.solution.nonassociative.interior_path.structures import mixed_program


@pytest.mark.parametrize("components", [2, 3])
@pytest.mark.parametrize("kappa", [0.0, 2.0])
def test_the_first_point_lies_on_the_path_and_inside_the_law(components: int, kappa: float) -> None:
    program = mixed_program(components)
    path = central_path(program, 0.5, 3, np.ones((4, components)), kappa)
    point = first_point(path)
    assert off_path(path, point, residuals(path, point)) < 1e-12
    assert inside(path, point)


def test_a_point_of_small_sigma_fits_the_exact_law_in_proportion() -> None:
    """What the law leaves unexplained is σ at an open contact and σ/2 at a sliding one: all of it goes with σ."""
    program = line_of(WALL, "parameters.n=3").program
    path, ratios = central_path(program, 0.0, 0, None, 0.0), []
    for stage in follow(path, matrix_map(program), first_point(path), 60):
        sigma = float(np.exp(stage.point.log_sigma))
        ratios.append(state_of(program, stage.point).residual / sigma)
    assert sigma < 1e-8
    assert ratios[-3:] == pytest.approx([ratios[-1]] * 3, rel=1e-2)


def test_other_seeds_are_other_paths_and_the_same_seed_is_the_same() -> None:
    program = mixed_program()
    one, same, other = (central_path(program, 0.1, seed, None, 0.0).weights for seed in (1, 1, 2))
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)
    assert central_path(program, 0.0, 1, None, 0.0).weights == pytest.approx(np.ones((4, 2)))


@pytest.mark.parametrize("part", ["forces", "opening", "crushing", "slip_size", "slip"])
def test_room_ends_where_a_cone_or_half_line_does(part: str) -> None:
    """Just before the end of the room a point is inside, just beyond it is not; each quantity moved by itself."""
    program = mixed_program()
    path = central_path(program, 0.3, 5, None, 0.0)
    point, rng = first_point(path), np.random.default_rng(7)
    zero = replace(point.plus(point, -1.0), load_factor=0.0, log_sigma=0.0)
    size = np.shape(getattr(point, part))
    for _ in range(20):
        change = replace(zero, **{part: rng.normal(size=size)})
        h = room(path, point, change)
        if np.isfinite(h):
            assert inside(path, point.plus(change, 0.999 * h))
            assert not inside(path, point.plus(change, 1.001 * h))
        else:
            assert inside(path, point.plus(change, 1e6))
