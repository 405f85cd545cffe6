"""The program of the motion against given friction: its forces are allowed by the formulas, its cost is their power."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.resultants.assemble import (
    ConvexProgram,
    assemble_convex,
    given_friction,
    given_friction_cost,
    given_friction_form,
)
from mbla.program.resultants.conditions import MN, T1, T2
from mbla.program.resultants.crushing import crushing_violation
from mbla.program.resultants.friction_limit import curve_size, curve_support
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Status
from tests.program.resultants.test_shapes import prism_line

SETTINGS = solver_settings(AnalysisSection(tolerance=1e-10))
OUTLINES: dict[str, tuple[tuple[float, float], ...]] = {
    "rectangle": ((0, 0), (1.25, 0), (1.25, 0.75), (0, 0.75)),
    "triangle": ((0, 0), (1.0, 0), (0.25, 0.75)),
    "ell": ((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)),
}
STRENGTH = "compressive_strength: 2.e5"


def allowed(
    convex: ConvexProgram, forces: FloatArray, limit: FloatArray, share: FloatArray, rest: FloatArray
) -> FloatArray:
    """What each condition leaves, by the formulas; below zero where it is broken."""
    law, r = convex.points.limits, convex.resultants_of(forces)
    left = [forces[:, 0] + law.tension, limit - np.linalg.norm(forces[:, 1:], axis=1)]
    if len(share):
        of_torsion = r[convex.torsion.interfaces]
        beyond = np.maximum(np.hypot(of_torsion[:, T1], of_torsion[:, T2]) - rest, 0.0)
        twist = np.abs(of_torsion[:, MN]) / convex.torsion.radii
        left.append(share - curve_size(beyond, twist, convex.torsion.thetas))
    left.append(-crushing_violation(convex.crushing, r))
    return np.concatenate(left)


@pytest.mark.every(5)
@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize(
    "law",
    [
        "friction: 0.5",
        f"friction: 0.5, {STRENGTH}",
        f"friction: 0.5, cohesion: 20000, tensile_strength: 10000, {STRENGTH}",
        f"friction: 0, {STRENGTH}",
    ],
    ids=["dry", "crushes", "mortar", "slippery"],
)
def test_forces_and_power_at_given_limits(name: str, law: str) -> None:
    """Of one block on the ground under loads of any direction; strong duality joins the two."""
    line = prism_line(OUTLINES[name], f"joints.dry={{{law}}}")
    whole = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    draw, seen = np.random.default_rng(1), 0
    n, n_torsion = whole.points.n_points, len(whole.torsion.interfaces)
    for _ in range(20):
        live = draw.normal(size=6) * [1, 1, 0.3, 1, 1, 1]
        convex = replace(whole, points=replace(whole.points, live_load=live))
        none = given_friction(convex)
        limit = draw.uniform(0.25, 2.0, n)
        share, rest = draw.uniform(0.05, 2.0, n_torsion), draw.uniform(0.0, 1.0, n_torsion)
        form = given_friction_form(none)
        program = replace(form.cone_program, cost=given_friction_cost(form, none, limit, share, rest))
        solution = ClarabelProgram(program, SETTINGS, lambda *_: None).solve(1, 1.0)
        if solution.status is not Status.SOLVED:
            continue
        seen += 1
        left = allowed(convex, form.contact_forces(solution.z), limit, share, rest)
        assert -1e-6 < left.min() < 1e-5
        velocities = form.velocities(solution.x)
        blocks, motions = velocities[: convex.n_block_rows], none.flows(velocities)
        own = convex.own_velocities((convex.points.equilibrium_matrix.T @ blocks).reshape(-1, 3), motions)
        motion = motions[convex.torsion.interfaces, 0]
        slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * convex.torsion.radii
        power = limit @ np.hypot(own[:, 1], own[:, 2]) + convex.points.limits.tension @ np.maximum(own[:, 0], 0.0)
        power += share @ curve_support(slip, twist, convex.torsion.thetas) + rest @ slip
        crushed = -(convex.resultants_of(form.contact_forces(solution.z)) * motions[:, 1]).sum()
        assert solution.objective == pytest.approx(power + crushed - convex.points.dead_load @ blocks, abs=1e-5)
    assert seen > 5
