"""Standing before any live load: structures that statics decides, the distance from thresholds, and invariances."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing, StandingResult, Status
from mbla.solution.standing.standing import assess_dead_load, standing_without_equilibrium, worst_standing
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening, agreed, weaken_springs
from tests.decks.folder import DECKS
from tests.line import WALL, line_of
from tests.solution.standing_structures import STRUCTURES, Structure, arch, bar, incline, leaning, overhang

SETTINGS = SolverSettings(tolerance=1e-8)


def standing(program: Program) -> StandingResult:
    """Assessment of the dead load as the solver stage does it."""
    associative = solve_associative(program, SETTINGS, lambda record: None)
    if associative.certificate is not None:
        return standing_without_equilibrium(program, associative.certificate)
    return assess_dead_load(program, SETTINGS, carried=True).standing


@pytest.mark.every(3)
@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_standing_is_what_statics_says(structure: Structure) -> None:
    program = line_of(structure.text).program
    result = standing(program)
    assert result.verdict is structure.verdict, result
    assert (result.block is None) if structure.verdict is Standing.YES else (result.block in structure.blocks)
    # the springs know nothing of what the cone program said, and must not contradict it
    outcome = weaken_springs(program, "dead_load", program.limits, SETTINGS).outcome
    assert outcome is (Outcome.CARRIED if structure.verdict is Standing.YES else Outcome.FALLS)


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
    """One part in 100,000 on either side; the share on springs is of the order of the load that is not carried."""
    below, above = (line_of(text(sign * distance)).program for sign in (-1, 1))
    assert weaken_springs(below, "dead_load", below.limits, SETTINGS).outcome is Outcome.CARRIED
    fall = weaken_springs(above, "dead_load", above.limits, SETTINGS)
    assert fall.outcome is Outcome.FALLS
    assert 0.1 * distance < fall.share < 3 * distance


@pytest.mark.parametrize(
    "override",
    ["units.length=mm", "materials.stone.density=2e-6", "materials.stone.density=2e9"],
)
@pytest.mark.parametrize("text", [bar("friction: 0.5"), overhang(1.001), arch(0.108)], ids=["bar", "overhang", "arch"])
def test_units_do_not_matter(text: str, override: str) -> None:
    here, there = (line_of(text, *overrides).program for overrides in ((), (override,)))
    first, second = (weaken_springs(program, "dead_load", program.limits, SETTINGS) for program in (here, there))
    assert second.outcome is first.outcome
    assert second.share == pytest.approx(first.share, rel=1e-3, abs=1e-7)


def test_a_tall_column_leans_on_strong_springs_only() -> None:
    """The head of 150 blocks settles by 3000 units: its spring would carry more than the block weighs at κ = 1e-3."""
    wall = WALL.replace('length: "=0.4*n", courses: "=n"', "length: 0.4, courses: 150, bond: stack")
    program = line_of(wall).program
    assert len(program.free) == 150
    assert assess_dead_load(program, SETTINGS, carried=True).standing.verdict is Standing.YES


def test_an_equilibrium_that_was_not_decided_leaves_a_fall_doubtful() -> None:
    program = line_of(bar("friction: 0.5")).program
    result = assess_dead_load(program, SETTINGS, carried=None).standing
    assert result.verdict is Standing.DOUBTFUL
    assert "was not decided" in result.reason
    assert assess_dead_load(program, SETTINGS, carried=False).standing.verdict is Standing.NO


def test_no_time_leaves_it_doubtful() -> None:
    program = line_of(arch(0.108)).program
    late = SolverSettings(tolerance=1e-8, deadline=time.monotonic() - 1.0)
    result = assess_dead_load(program, late, carried=True).standing
    assert result.verdict is Standing.DOUBTFUL
    assert "time limit" in result.reason


def test_ratios_of_stiffness_that_disagree_leave_it_doubtful() -> None:
    carried, falls = Weakening(Outcome.CARRIED, 3, 1e-8), Weakening(Outcome.FALLS, 7, 0.2)
    assert agreed(falls, falls) is falls
    for pair in ((carried, falls), (falls, carried)):
        both = agreed(*pair)
        assert (both.outcome, both.block) == (Outcome.UNDECIDED, 7)


@pytest.mark.parametrize(("rise", "friction"), [(0.15, 0.65), (0.17, 0.5), (0.17, 0.65), (0.17, 0.8)])
def test_segmental_arches_in_a_wall_are_decided(rise: float, friction: float) -> None:
    """Thrust and friction of the arch take each other away in turn: with limits that follow the normal forces at once
    no state was found near κ = 5e-3, or at 1."""
    text = (DECKS / "tutorials" / "lintels_and_arches.yaml").read_text()
    line = line_of(text.replace("rise: 0.2", f"rise: {rise}").replace("friction: 0.65", f"friction: {friction}"))
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True)
    (planar,) = reduced.parts
    assert weaken_springs(planar, "dead_load", planar.limits, SETTINGS).outcome is Outcome.CARRIED


def test_a_load_that_is_zero_is_carried() -> None:
    program = line_of(bar("friction: 0.5", dead="[{gravity: none}]")).program
    assert not np.any(program.dead_load)
    assert weaken_springs(program, "dead_load", program.limits, SETTINGS).outcome is Outcome.CARRIED


def test_status_of_the_equilibrium_does_not_decide_standing() -> None:
    """What limit analysis alone says of the bar between two walls: that no load ever moves it."""
    program = line_of(bar("friction: 0.01")).program
    assert solve_associative(program, SETTINGS, lambda record: None).status is Status.UNBOUNDED
