"""Parts in their own units of force: each is solved as if it were alone, however heavy the others are.

Parts without live load: out of the programs with it, but they have to stand.
"""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.reductions import Reduced, reduce_program
from mbla.program.reductions.scene import _unit_of_force, part_of_blocks, split_into_parts
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.solution import Standing
from mbla.solution.standing.standing import assess_dead_load
from tests.line import BLOCK, WALL, Line, line_of, verified
from tests.program.reductions.scenes import scene

STEEP = WALL.replace("mu: 0.65, n: 5", "mu: 0.9, n: 4").replace("flow_rule: associative", "flow_rule: non_associative")

BESIDE = STEEP.replace("stone: {density: 2000}", "stone: {density: 2000}, other: {density: 2000}").replace(
    "supports:",
    """  - wall:
      group: other
      material: other
      unit: [0.4, 0.2, 0.175]
      length: "=0.4*n"
      courses: "=n"
      transform: [{translate: [0, 3, 0]}]
supports:""",
)
"""A wall and its copy of another density."""


@pytest.mark.long
@pytest.mark.parametrize("pushed", ["wall", "other", "both"])
@pytest.mark.parametrize("ratio", [1e-6, 1e6])
def test_a_copy_of_another_density_changes_nothing(ratio: float, pushed: str) -> None:
    """In one unit of force for both the lighter wall ended with residuals of 4e-6 and without a static bound."""
    on = "" if pushed == "both" else f", on: {pushed}"
    alone, own_checks, _ = verified(line_of(STEEP))
    line = line_of(
        BESIDE,
        f"materials.other.density={2000 * ratio}",
        f"load_cases.push.live=[{{acceleration: [1, 0, 0]{on}}}]",
    )
    solution, checks, status = verified(line)
    assert status == "solved", checks.failures
    assert solution.mechanics is not None
    assert alone.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(alone.mechanics.load_factor, rel=1e-8)  # a range's end
    assert checks.static_bound == pytest.approx(own_checks.static_bound, rel=1e-7)
    assert checks.kinematic_bound == pytest.approx(own_checks.kinematic_bound, rel=1e-7)
    assert checks.equilibrium_residual < 1e-9
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.YES
    assert not checks.failures  # standing is verified with the settlements of both walls together


@pytest.mark.parametrize("ratio", [1e-6, 1.0, 1e6])
def test_each_part_has_its_own_unit_of_force(ratio: float) -> None:
    line = line_of(BESIDE, f"materials.other.density={2000 * ratio}")
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False)
    for part in reduced.parts:
        sizes = np.linalg.norm(part.dead_load.reshape(-1, 3), axis=1)
        assert sizes.mean() == pytest.approx(1.0, rel=1e-12)
        assert assess_dead_load(part).verdict is Standing.YES


def test_parts_know_their_loads_and_strengths() -> None:
    """Two boxes apart, one of them pushed: a part has the strengths of the joints in its own unit of force."""
    text = BLOCK.replace(
        "supports:", '  - box: {group: other, material: stone, min: [3, 0, 0], max: ["=3+b", 1, "=2*h"]}\nsupports:'
    )
    push = "load_cases.push.live=[{acceleration: [1, 0, 0], on: other}]"
    whole = scene(text, push, "parameters.c=1000", "parameters.ft=500")
    assert part_of_blocks(whole).tolist() == [0, 1]
    alone = split_into_parts(whole)
    assert len(alone) == 2
    for part, weight in zip(alone, (2.0, 4.0), strict=True):
        unit = 2000 * 9.81 * weight
        assert part.program.limits.cohesion * unit == pytest.approx(np.full(4, 1000 / 4))
        assert part.program.limits.tension * unit == pytest.approx(np.full(4, 500 / 4))


def test_a_part_without_dead_load_has_the_unit_of_the_whole() -> None:
    whole = scene(BLOCK, "load_cases.push.dead=[{gravity: [0, 0, 0]}]", "parameters.c=1000")
    push = np.zeros(12)
    assert _unit_of_force(push.reshape(2, 6)) == 1.0
    push[[0, 3]] = 3.0, 4.0
    assert _unit_of_force(push.reshape(2, 6)) == 5.0  # of those that have one
    assert split_into_parts(whole) == [whole]


ASIDE = """\
  - wall:
      group: {}
      material: stone
      unit: [0.4, 0.2, 0.175]
      length: "=0.4*n"
      courses: {}
      transform: [{{translate: {}}}]
"""
UNLOADED = WALL.replace(
    "supports:", ASIDE.format("aside", 4, "[9, 3, 0]") + ASIDE.format("far", 3, "[99, 3, 0]") + "supports:"
).replace("push: {live: [{acceleration: [1, 0, 0]}]}", "push: {live: [{acceleration: [1, 0, 0], on: wall}]}")
"""A wall that is pushed and two that are not."""

SMALL = "parameters.n=3"

FALLS = UNLOADED.replace(
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
    line = line_of(UNLOADED, *flow, f"analysis.reductions={switch}")
    solution, checks, status = verified(line)
    assert status == "solved", checks.failures
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(alone.mechanics.load_factor, rel=1e-6)
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.YES
    speeds = np.abs(solution.mechanics.mechanism).max(axis=1)
    groups = np.array(line.model.blocks.groups)
    assert set(groups[speeds > 1e-2 * speeds.max()]) == {"wall"}  # elastic joints leave 0.3 % to the others
    bodies = np.append(groups == "far", False)[line.contacts.bodies]
    far = np.asarray(bodies).any(axis=-1).reshape(-1)[line.contacts.interface_of_point]
    assert solution.mechanics.contact_forces[far, 0].sum() > 0  # what is at rest carries its weight in the results


def test_what_is_solved_together() -> None:
    """Without live load a part has no load factor: it is shown apart that it stands."""
    line = line_of(UNLOADED, SMALL)
    found = reduced(line)
    assert len(found.parts) == found.size.parts == 3
    n_wall, n_all = line.model.blocks.groups.count("wall"), len(line.model.blocks)
    step = {step.name: step for step in found.steps}["unloaded"]
    assert step.found == n_all - n_wall
    assert (step.before.unknowns, step.after.unknowns) == (6 * n_all, 6 * n_wall)


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


@pytest.mark.parametrize("hair", [0.0, 3e-8, 1e-5])
def test_of_two_walls_of_which_one_is_a_hair_stronger_both_are_proved(hair: float) -> None:
    """At 3e-8 its own collapse is not the load, and next to its collapse least forces have no room.

    Of equal ones the second is at rest at its own collapse load: least forces there were too rough for a static bound.
    """
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
