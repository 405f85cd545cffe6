"""Parts in their own units of force: each is solved as if it were alone, however heavy the others are."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.deck.analysis import ReductionSwitches
from mbla.program.reductions import reduce_program
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing
from mbla.solution.standing import assess_standing
from tests.line import WALL, line_of, verified

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
    assert solution.mechanics.load_factor == pytest.approx(alone.mechanics.load_factor, rel=1e-9)
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
        assert assess_standing(part, SolverSettings(tolerance=1e-8)).verdict is Standing.YES


@pytest.mark.parametrize("ratio", [1e-6, 1e6])
def test_motions_of_a_part_go_to_the_model_and_back(ratio: float) -> None:
    line = line_of(BESIDE, f"materials.other.density={2000 * ratio}")
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False)
    rng = np.random.default_rng(5)
    for part in reduced.parts:
        u = rng.normal(size=len(part.dead_load))
        assert part.velocities(part.mechanism(u)) == pytest.approx(u, rel=1e-9)
