"""The load factor with torsion of uniform pressure beside that of contact points, and what verification says of it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from mbla.program.build import build_program
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.solve import solve
from mbla.solution.verification.verify import verify
from tests.line import BLOCK, Line, case_of, line_of
from tests.solution.convex_structures import TWIST

SQUARE = (np.sqrt(2) + np.log(1 + np.sqrt(2))) / 6


def by_points(line: Line, **analysis: object) -> Solution:
    """Without dilatancy, by contact points."""
    own = line.deck.analysis.model_copy(update={"flow_rule": "non_associative", "contact_model": "concave", **analysis})
    return solve(build_program(line.assembly, line.load_case, own), solver_settings(own))


@cache
def twisted() -> tuple[Line, Solution]:
    """A square block under twice its weight, a fifth of the side off its middle."""
    line = line_of(TWIST, "parameters.e1=0.4")
    return line, by_points(line)


def checked(torsion: Mechanics | None) -> Checks:
    """With another state with torsion in the place of that which was found."""
    line, solution = twisted()
    return verify(line.assembly, line.load_case, replace(solution, torsion=torsion))


def test_corners_overstate_what_a_square_resists() -> None:
    _, solution = twisted()
    assert solution.mechanics is not None
    assert solution.torsion is not None
    assert solution.torsion.load_factor == pytest.approx(0.6 * 2 * SQUARE * 0.8, rel=2e-5)
    assert solution.mechanics.load_factor > 1.5 * solution.torsion.load_factor


def test_its_state_is_verified() -> None:
    _, solution = twisted()
    assert solution.torsion is not None
    assert checked(solution.torsion).torsion_load_factor == solution.torsion.load_factor


@pytest.mark.parametrize("name", ["contact_forces", "mechanism", "interface_motions", "remembered"])
def test_a_state_that_is_another_is_not(name: str) -> None:
    _, solution = twisted()
    assert solution.torsion is not None
    own = getattr(solution.torsion, name)
    other = replace(solution.torsion, **{name: own + 1e-3 * np.abs(own).max()})
    assert np.isnan(checked(other).torsion_load_factor)
    assert np.isnan(checked(None).torsion_load_factor)


def test_what_does_not_twist_keeps_its_load_factor() -> None:
    line = line_of(BLOCK.replace("[1, 0, 0]", "[1, 0.3, 0]"))
    solution = by_points(line)
    assert solution.mechanics is not None
    assert solution.torsion is not None
    assert solution.torsion.load_factor == pytest.approx(solution.mechanics.load_factor, rel=1e-5)


@pytest.mark.parametrize(
    ("text", "analysis"),
    [
        (BLOCK, {}),
        (TWIST, {"accuracy": "draft"}),
        (TWIST, {"torsion": False}),
        (TWIST, {"flow_rule": "dilatancy"}),
        (TWIST, {"contact_model": "convex"}),
    ],
    ids=["planar", "draft", "unasked", "dilatancy", "convex"],
)
def test_where_no_second_path_is_followed(text: str, analysis: dict[str, object]) -> None:
    solution = by_points(line_of(text), **analysis)
    assert solution.mechanics is not None
    assert (solution.torsion, solution.torsion_end) == (None, "")


def test_a_support_that_gives_way_below_interfaces_that_twist() -> None:
    """The own unit of a program is that of its blocks, not of the rows of its interfaces."""
    text = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.7}}
blocks:
  - box: {group: left, material: stone, min: [0, 0, 0], max: [0.5, 1, 1]}
  - box: {group: right, material: stone, min: [1.5, 0, 0], max: [2, 1, 1]}
  - box: {group: beam, material: stone, min: [0, 0.2, 1], max: [2, 0.6, 1.4]}
contacts: {joint: dry}
supports: [{blocks: left}, {blocks: right}]
load_cases: {sinks: {settlement: {on: right, direction: [0, 0, -1]}}}
"""
    solution = case_of(text)[1].solution
    assert solution.mechanics is not None
    assert solution.torsion is not None
    assert solution.torsion.load_factor == pytest.approx(solution.mechanics.load_factor, rel=1e-3)


def test_interfaces_that_crush_are_verified_with_what_they_had_crushed_before() -> None:
    """A pillar pressed off its middle: motion before the step is part of what its interface flows by."""
    line = line_of(BLOCK.replace('friction: "=mu"', "friction: 0.7, compressive_strength: 2.e+5"))
    solution = by_points(line)
    assert solution.stress_blocks
    mechanics = solution.mechanics
    assert mechanics is not None
    assert mechanics.crushed is not None
    assert verify(line.assembly, line.load_case, solution).verified
    other = replace(solution, mechanics=replace(mechanics, crushed=-mechanics.crushed))
    assert not verify(line.assembly, line.load_case, other).verified


@pytest.mark.long
@pytest.mark.parametrize("angle", [0.0, 30.0])
def test_dilatancy_goes_with_stress_blocks(angle: float) -> None:
    """A block that slides to where it crushes: with dilatancy as without, what bears it is the stress block."""
    text = BLOCK.replace('friction: "=mu"', f"friction: 0.7, dilatancy: {angle}, compressive_strength: 2.e+5")
    _, found = case_of(text, "analysis.flow_rule=dilatancy")
    assert found.solution.stress_blocks
    assert found.checks.verified
    assert found.solution.mechanics is not None
    depth = 2 * 2000 * 9.81 / 2e5
    assert found.solution.mechanics.load_factor == pytest.approx(0.5 * (1 - depth), rel=1e-4)
