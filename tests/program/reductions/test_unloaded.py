"""Parts without live load: out of the programs with it, but they have to stand."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.reductions import Reduced, reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing
from mbla.solution.standing.standing import assess_dead_load
from tests.line import WALL, Line, line_of, verified

ASIDE = """\
  - wall:
      group: {}
      material: stone
      unit: [0.4, 0.2, 0.175]
      length: "=0.4*n"
      courses: {}
      transform: [{{translate: {}}}]
"""
BESIDE = WALL.replace(
    "supports:", ASIDE.format("aside", 4, "[9, 3, 0]") + ASIDE.format("far", 3, "[99, 3, 0]") + "supports:"
).replace("push: {live: [{acceleration: [1, 0, 0]}]}", "push: {live: [{acceleration: [1, 0, 0], on: wall}]}")
"""A wall that is pushed and two that are not."""

SMALL = "parameters.n=3"

FALLS = BESIDE.replace(
    "supports:",
    "  - box: {group: over, material: stone, min: [99.8, 3, 0.525], max: [101.8, 3.2, 0.7]}\nsupports:",
)
"""On the last wall, of 1.2 m, lies a block that reaches 1 m beyond its end with a middle 0.4 m before it."""


def reduced(line: Line) -> Reduced:
    associative = line.deck.analysis.flow_rule == "associative"
    return reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=associative)


@pytest.mark.parametrize("switch", ["true", "false"])
@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_the_answer_is_that_of_the_loaded_wall(flow_rule: str, switch: str) -> None:
    flow = (f"analysis.flow_rule={flow_rule}", SMALL)
    alone, _, _ = verified(line_of(WALL, *flow))
    assert alone.mechanics is not None
    line = line_of(BESIDE, *flow, f"analysis.reductions={switch}")
    solution, checks, status = verified(line)
    assert status == "solved", checks.failures
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(alone.mechanics.load_factor, rel=1e-6)
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.YES
    speeds = np.abs(solution.mechanics.mechanism).max(axis=1)
    groups = np.array(line.model.blocks.groups)
    assert set(groups[speeds > 1e-6 * speeds.max()]) == {"wall"}
    bodies = np.append(groups == "far", False)[line.contacts.bodies]
    far = np.asarray(bodies).any(axis=-1).reshape(-1)[line.contacts.interface_of_point]
    assert solution.mechanics.contact_forces[far, 0].sum() > 0  # what is at rest carries its weight in the results


def test_what_is_solved_together() -> None:
    """Without live load a part has no load factor: it is shown apart that it stands."""
    line = line_of(BESIDE, SMALL)
    found = reduced(line)
    assert len(found.parts) == found.size.parts == 3
    n_wall, n_all = line.model.blocks.groups.count("wall"), len(line.model.blocks)
    step = {step.name: step for step in found.steps}["unloaded"]
    assert step.found == n_all - n_wall
    assert (step.before.unknowns, step.after.unknowns) == (6 * n_all, 6 * n_wall)


def test_two_loaded_parts_and_one_without() -> None:
    live = "load_cases.push.live=[{acceleration: [1, 0, 0], on: [wall, far]}]"
    steps = {step.name: step for step in reduced(line_of(BESIDE, live)).steps}
    assert steps["parts"].found == 2
    assert steps["parts"].after.largest < steps["parts"].before.largest == steps["unloaded"].after.unknowns


@pytest.mark.parametrize("switch", ["true", "false"])
def test_a_part_without_live_load_that_falls_decides(switch: str) -> None:
    line = line_of(FALLS, SMALL, f"analysis.reductions={switch}")
    solution, _, status = verified(line)
    assert status == "no_equilibrium"
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.NO
    assert solution.certificate is not None
    moving = np.abs(solution.certificate).max(axis=1) > 1e-3
    groups = np.array(line.model.blocks.groups)
    assert "over" in set(groups[moving])
    assert "wall" not in set(groups[moving])


def test_each_part_stands_by_itself() -> None:
    found = reduced(line_of(BESIDE, SMALL))
    verdicts = [assess_dead_load(part, SolverSettings(tolerance=1e-8)).standing.verdict for part in found.parts]
    assert verdicts == [Standing.YES] * 3


@pytest.mark.parametrize("hair", [3e-8, 1e-5])
def test_of_two_walls_of_which_one_is_a_hair_stronger_both_are_proved(hair: float) -> None:
    """At 3e-8 its own collapse is not the load, and next to its collapse least forces have no room."""
    push = (
        f"push: {{live: [{{acceleration: [1, 0, 0], on: wall}}, {{acceleration: [{1.0 - hair!r}, 0, 0], on: copy}}]}}"
    )
    text = WALL.replace("supports:", ASIDE.format("copy", 8, "[9, 3, 0]") + "supports:")
    text = text.replace("push: {live: [{acceleration: [1, 0, 0]}]}", push)
    solution, checks, status = verified(line_of(text, "parameters.n=8", "parameters.mu=0.7"))
    assert solution.size is not None
    assert solution.size.parts == 2
    assert status == "solved", checks.failures
    assert checks.gap < 1e-6


def test_of_two_equal_walls_both_are_proved() -> None:
    """The second is at rest at its own collapse load: least forces there were too rough for a static bound."""
    text = WALL.replace("supports:", ASIDE.format("copy", 8, "[9, 3, 0]") + "supports:")
    solution, checks, status = verified(line_of(text, "parameters.n=8", "parameters.mu=0.7"))
    assert solution.size is not None
    assert solution.size.parts == 2
    assert status == "solved", checks.failures
    assert checks.gap < 1e-6
