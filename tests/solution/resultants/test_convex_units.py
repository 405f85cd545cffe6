"""Light blocks beside heavy ones in the convex contact model."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.resultants import assemble_convex, convex_form
from mbla.solution.resultants.convex_units import in_units, loses_light_blocks, units_of_unknowns
from tests.extremes.weights import TOWER, tower_factor
from tests.line import Line, line_of
from tests.solution.convex_structures import convex


def tower(*loads: float) -> Line:
    """Three blocks on each other, the lowest first."""
    values = [f"parameters.{key}={load:.1e}" for key, load in zip("abc", loads, strict=True)]
    return line_of(TOWER, *values, "analysis.flow_rule=associative")


@pytest.mark.parametrize("ratio", [1e4, 1e6, 1e8])
def test_a_light_tower_on_a_heavy_block_rocks_as_by_itself(ratio: float) -> None:
    """In the units of the heavy block the factor was 0.646 at 1e4 and 1.2, that of the heavy one, at 1e8."""
    solution, checks = convex(tower(ratio, 1.0, 1.0))
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(tower_factor((ratio, 1.0, 1.0)), rel=1e-7)
    assert checks.static_bound == pytest.approx(checks.kinematic_bound, rel=1e-7)
    kinds = [record.kind for record in solution.programs]
    assert kinds == ["associative", "reverse", "associative", "reverse"]


def test_like_blocks_are_solved_once() -> None:
    solution, _ = convex(tower(1.0, 1.0, 1.0))
    assert [record.kind for record in solution.programs] == ["associative", "reverse"]


def test_units_follow_the_loads_and_leave_the_dual_program_as_it_is() -> None:
    line = tower(1e4, 1.0, 1.0)
    program = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    form = convex_form(program)
    weight = np.abs(program.points.dead_load).reshape(-1, 6).max(axis=1)
    forces = np.zeros((program.points.n_points, 3))
    forces[:, 0] = weight[-1] / 4
    units = units_of_unknowns(form, program, forces)
    assert units.shape == form.cone_program.cost.shape
    assert units.max() <= 1.0
    heavy, light = (units[: program.n_block_rows].reshape(-1, 6)[i, 2] for i in (0, 2))
    assert light == pytest.approx(2.0 * weight[2])  # its weight and what it rests on
    assert heavy > 1e3 * light
    assert np.all(units[program.n_block_rows :][-8:] < 1e-3)  # conditions of the uppermost interface
    z, scaled = np.random.default_rng(2).normal(size=len(form.cone_program.rhs)), in_units(form.cone_program, units)
    assert scaled.matrix.T @ z * units == pytest.approx(form.cone_program.matrix.T @ z)
    assert scaled.cost * units == pytest.approx(form.cone_program.cost)


def test_what_is_lost_is_a_share_of_what_a_light_block_carries() -> None:
    """An unbalanced force of 1e-7 mean loads is nothing to the heavy block, and all to the light one."""
    solution, _ = convex(tower(1e4, 1.0, 1.0))
    line = tower(1e4, 1.0, 1.0)
    program = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    scaling, mechanics = program.points.scaling, solution.mechanics
    assert mechanics is not None
    forces, factor = mechanics.contact_forces / scaling.force, mechanics.load_factor / scaling.live
    assert not loses_light_blocks(program, forces, factor)
    upper, lower = forces.copy(), forces.copy()
    height = line.contacts.points[:, 2]
    upper[np.argmax(height), 0] += 1e-7
    lower[np.argmin(height), 0] += 1e-7
    assert loses_light_blocks(program, upper, factor)
    assert not loses_light_blocks(program, lower, factor)
