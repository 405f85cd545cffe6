"""Standing before any live load: structures that statics decides, the distance from thresholds, and invariances."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.flow.gravity_step import gravity_step
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing, StandingResult, Status
from mbla.solution.standing import standing as module
from mbla.solution.standing.standing import assess_dead_load, standing_without_equilibrium, worst_standing
from tests.decks.folder import DECKS
from tests.line import WALL, line_of
from tests.solution.standing_structures import STRUCTURES, Structure, arch, bar, incline, leaning, overhang

SETTINGS = SolverSettings(tolerance=1e-8)


def standing(program: Program) -> StandingResult:
    """Assessment of the dead load as the solver stage does it."""
    associative = solve_associative(program, SETTINGS, lambda record: None)
    if associative.certificate is not None:
        return standing_without_equilibrium(program, associative.certificate)
    return assess_dead_load(program, carried=True)


def stands(program: Program) -> bool:
    """By the gravity step alone, whatever a cone program says."""
    return assess_dead_load(program, carried=True).verdict is Standing.YES


@pytest.mark.every(3)
@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_standing_is_what_statics_says(structure: Structure) -> None:
    program = line_of(structure.text).program
    result = standing(program)
    assert result.verdict is structure.verdict, result
    assert (result.block is None) if structure.verdict is Standing.YES else (result.block in structure.blocks)
    assert stands(program) is (structure.verdict is Standing.YES)  # and contradicts no cone program


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_reduced_programs_give_the_same_verdict_and_block(structure: Structure) -> None:
    line = line_of(structure.text)
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False)
    parts = [standing(program) for program in reduced.parts]
    assert worst_standing(parts).verdict is structure.verdict
    assert worst_standing(parts).block in (structure.blocks or (None,))


def test_the_gravest_part_speaks_for_the_structure() -> None:
    order = [Standing.NO, Standing.SELF_STRESS, Standing.DOUBTFUL, Standing.YES]
    results = [StandingResult(verdict, i, "") for i, verdict in enumerate(order)]
    for i in range(len(order)):
        assert worst_standing(results[: i - 1 : -1] if i else results[::-1]) == results[i]


def slope(excess: float) -> str:
    """An incline whose tangent is the friction times 1 + excess."""
    return incline(math.degrees(math.atan(0.5 * (1 + excess))), 0.5)


@pytest.mark.parametrize("distance", [1e-3, 1e-5])
@pytest.mark.parametrize(
    "text",
    [slope, lambda excess: overhang(1 + excess), lambda excess: leaning(0.14615384615384616 * (1 - excess))],
    ids=["incline", "overhang", "leaning"],
)
def test_thresholds_are_met_closely(text: Callable[[float], str], distance: float) -> None:
    """One part in 100,000 on either side."""
    assert [stands(line_of(text(sign * distance)).program) for sign in (-1, 1)] == [True, False]


@pytest.mark.parametrize(
    "override",
    ["units.length=mm", "materials.stone.density=2e-6", "materials.stone.density=2e9"],
)
@pytest.mark.parametrize("text", [bar("friction: 0.5"), overhang(1.001), arch(0.108)], ids=["bar", "overhang", "arch"])
def test_units_do_not_matter(text: str, override: str) -> None:
    here, there = (line_of(text, *overrides).program for overrides in ((), (override,)))
    assert standing(there).verdict is standing(here).verdict


def test_a_tall_column_leans_on_no_spring() -> None:
    """The head of 150 blocks settles by thousands of units."""
    wall = WALL.replace('length: "=0.4*n", courses: "=n"', "length: 0.4, courses: 150, bond: stack")
    program = line_of(wall).program
    assert len(program.facts.free) == 150
    assert assess_dead_load(program, carried=True).verdict is Standing.YES


def test_an_equilibrium_that_was_not_decided_leaves_a_fall_doubtful() -> None:
    program = line_of(bar("friction: 0.5")).program
    result = assess_dead_load(program, carried=None)
    assert result.verdict is Standing.DOUBTFUL
    assert "was not decided" in result.reason
    assert assess_dead_load(program, carried=False).verdict is Standing.NO


def test_ratios_of_stiffness_that_disagree_leave_it_doubtful(monkeypatch: pytest.MonkeyPatch) -> None:
    carried, by_step = iter([True, False]), gravity_step
    monkeypatch.setattr(module, "gravity_step", lambda joints: replace(by_step(joints), carried=next(carried)))
    result = assess_dead_load(line_of(arch(0.12)).program)
    assert result.verdict is Standing.DOUBTFUL
    assert result.reason.endswith(module.BY_STIFFNESS)


@pytest.mark.parametrize(("rise", "friction"), [(0.15, 0.65), (0.17, 0.5), (0.17, 0.65), (0.17, 0.8)])
def test_segmental_arches_in_a_wall_are_decided(rise: float, friction: float) -> None:
    """Thrust and friction of the arch take each other away in turn."""
    text = (DECKS / "tutorials" / "lintels_and_arches.yaml").read_text()
    line = line_of(text.replace("rise: 0.2", f"rise: {rise}").replace("friction: 0.65", f"friction: {friction}"))
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True)
    (planar,) = reduced.parts
    assert stands(planar)


def test_a_load_that_is_zero_is_carried() -> None:
    program = line_of(bar("friction: 0.5", dead="[{gravity: none}]")).program
    assert not np.any(program.dead_load)
    assert stands(program)


def test_status_of_the_equilibrium_does_not_decide_standing() -> None:
    """What limit analysis alone says of the bar between two walls: that no load ever moves it."""
    program = line_of(bar("friction: 0.01")).program
    assert solve_associative(program, SETTINGS, lambda record: None).status is Status.UNBOUNDED
