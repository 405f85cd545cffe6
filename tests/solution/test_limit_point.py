"""Peaks of the load path: found where friction from the dead load is lost by sliding, and only there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.yield_conditions import yield_violation
from mbla.solution import gravity
from mbla.solution import limit_point as limit_point_module
from mbla.solution.associative import solve_associative
from mbla.solution.factor_range import unbalanced
from mbla.solution.law_state import LawState
from mbla.solution.limit_point import STEPS, LimitPoint, limit_point
from mbla.solution.mechanics import mechanics_of
from mbla.solution.solution import Status
from mbla.solution.verify_peak import peak_check
from mbla.solution.weakening import Outcome, Weakening
from tests.line import BLOCK, HEAD, Line, line_of
from tests.solution.failing_solver import said
from tests.solution.planar import planar_program
from tests.solution.test_factor_range import FERRIS_3, SETTINGS, solved


def prism(group: str, *corners: tuple[float, float]) -> str:
    """A block with the given corners in the x-z plane, 0.5 thick."""
    n = len(corners)
    vertices = [[x, y, z] for y in (0.0, 0.5) for x, z in corners]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return f"  - polyhedron: {{group: {group}, material: stone, vertices: {vertices}, faces: {faces}}}\n"


PLANK = (
    HEAD
    + "joints: {dry: {friction: 0.4}}\nblocks:\n"
    + prism("base", (0, 0), (1, 0), (1, 1), (0, 0.9))
    + prism("back", (0, 0.9), (0.7, 0.97), (0.7, 1.17), (0, 1.05))
    + prism("plank", (0.7, 0.97), (1.5, 1.05), (1.5, 1.17 + 0.8 * 0.12 / 0.7), (0.7, 1.17))
    + prism("top", (0, 1.05), (1, 1.17 + 0.3 * 0.12 / 0.7), (1, 2.1), (0, 2.1))
    + "supports: [{blocks: base}]\nload_cases: {pull: {live: [{acceleration: [1, 0, 0], on: plank}]}}\n"
)
"""A plank thicker outside than inside, clamped under a wall and pulled out."""


@pytest.fixture(scope="module")
def plank() -> tuple[Line, LawState, LimitPoint]:
    line = line_of(PLANK)
    state = solved(line.program)
    return line, state, limit_point(line.program, state, SETTINGS, lambda record: None, 5)


def test_a_clamped_plank_is_held_by_what_it_loses_as_it_slides(plank: tuple[Line, LawState, LimitPoint]) -> None:
    line, state, found = plank
    assert found.peak is not None
    assert found.peak.load_factor > 1.5 * state.load_factor
    assert found.change < 1e-2
    assert "the peak is the collapse load" in found.remark
    assert [record.program for record in found.programs] == list(range(5, 5 + len(found.programs)))
    associative = solve_associative(line.program, SETTINGS, lambda record: None).state
    assert associative is not None
    assert found.peak.load_factor < associative.load_factor


def test_the_forces_of_a_peak_carry_its_load(plank: tuple[Line, LawState, LimitPoint]) -> None:
    line, _, found = plank
    assert found.peak is not None
    assert unbalanced(line.program, found.peak) < 1e-8
    assert yield_violation(found.peak.forces, line.program.limits).max() < 1e-9
    assert found.peak.residual > 1e-3  # passed, not at rest: its velocities are none of a mechanism at this load


def test_a_peak_is_verified_by_statics(plank: tuple[Line, LawState, LimitPoint]) -> None:
    line, _, found = plank
    assert found.peak is not None
    peak = mechanics_of(line.program, found.peak)
    here = line.model, line.contacts, line.load_case
    assert peak_check(*here, peak) == peak.load_factor
    assert np.isnan(peak_check(*here, replace(peak, load_factor=1.001 * peak.load_factor)))
    assert np.isnan(peak_check(*here, replace(peak, contact_forces=peak.contact_forces * np.array([1.0, 2.0, 2.0]))))
    assert np.isnan(peak_check(*here, None))


@pytest.mark.parametrize("text", [FERRIS_3, BLOCK])
def test_walls_and_sliding_blocks_have_no_peak(text: str) -> None:
    line = line_of(text, *(("parameters.h=0.5",) if text is BLOCK else ()))
    program = line.program if text is BLOCK else planar_program(line)
    found = limit_point(program, solved(program), SETTINGS, lambda record: None, 1)
    assert found.peak is None
    assert found.remark == ""
    assert [record.kind for record in found.programs] == ["load path"]


def test_next_to_the_associative_factor_no_path_is_followed() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    assert limit_point(program, state, SETTINGS, lambda record: None, 1, state.load_factor).programs == ()


def test_a_keystone_upside_down_carries_no_live_load() -> None:
    """Only a thrust that someone locks in holds it; once it moves its joints open, and its weight must be undone."""
    text = HEAD + (
        "joints: {dry: {friction: 0.4}}\nblocks:\n"
        + prism("walls", (-1, 0), (-0.05, 0), (0.05, 0.5), (-1, 0.5))
        + prism("walls", (1.05, 0), (2, 0), (2, 0.5), (0.95, 0.5))
        + prism("stone", (-0.05, 0), (1.05, 0), (0.95, 0.5), (0.05, 0.5))
        + "supports: [{blocks: walls}]\nload_cases: {push: {live: [{acceleration: [0, 0, -1]}]}}\n"
    )
    program = line_of(text).program
    state = solved(program)
    found = limit_point(program, state, SETTINGS, lambda record: None, 1)
    assert state.load_factor * program.scaling.live == pytest.approx(-1.0, rel=1e-6)
    assert found.peak is not None
    assert found.peak.load_factor == 0.0
    assert "no live load is carried" in found.remark


def test_without_a_gravity_state_no_path_is_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK).program
    state = solved(program)
    monkeypatch.setattr(gravity, "interior_point_solver", said(Status.NUMERICAL_ERROR))
    undecided = Weakening(Outcome.UNDECIDED, None, np.nan, "")
    found = limit_point(program, state, SETTINGS, lambda record: None, 5, known=undecided)
    assert found.peak is None
    assert "no gravity state was found to start from" in found.remark


def test_a_peak_that_moves_with_the_steps_is_that_of_the_shortest(monkeypatch: pytest.MonkeyPatch) -> None:
    """Higher by a tenth each time the steps are made shorter."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    heights = iter(1.0 + 0.1 * np.arange(1, 1 + len(STEPS)))

    def follow(*arguments: object) -> limit_point_module._Path:
        peak = replace(state, load_factor=state.load_factor * float(next(heights)))
        return limit_point_module._Path(program, peak, fell=True)

    monkeypatch.setattr(limit_point_module, "_follow", follow)
    found = limit_point(program, state, SETTINGS, lambda record: None, 5)
    assert found.peak is not None
    assert found.peak.load_factor == pytest.approx((1.0 + 0.1 * len(STEPS)) * state.load_factor)
    assert found.change == pytest.approx(0.1 / (1.0 + 0.1 * len(STEPS)))
    assert [record.program for record in found.programs] == list(range(5, 5 + len(STEPS)))


def test_a_path_without_a_first_step_says_so(
    plank: tuple[Line, LawState, LimitPoint], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It has gone nowhere: there is no load factor up to which it was followed."""
    line, state, _ = plank
    monkeypatch.setattr(limit_point_module, "next_step", lambda *_: None)
    found = limit_point(line.program, state, SETTINGS, lambda record: None, 5)
    assert found.peak is None
    assert found.remark == (
        "whether the load rises above the load factor on the way to it was not seen: "
        "not even the first step of the load path from the dead load was found"
    )
