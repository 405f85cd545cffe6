"""Blocks that are glued: as one block of their union in every flow rule, contact model, result and verification."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.results.collapse.collapse import collapse_of
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.run import RunOptions, run
from mbla.solution.solution import Status
from mbla.verify import verify_file
from tests.asked import tilt_of
from tests.line import case_of, factor_of
from tests.results.changed_files import changing

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}, light: {density: 700}}
joints: {dry: {friction: 0.7}}
supports: [{ground: {z: 0}}]
output: {vtu: false}
"""
BRACKET = (
    HEAD
    + """\
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: high, material: light, min: [0.5, 0, 1], max: [2, 1, 1.5]}
contacts: {joint: dry, overrides: [{between: [low, high], joint: glued}]}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""A block with an arm that reaches out by its own breadth."""

TWO_STACKS = (
    HEAD
    + """\
parameters: {cx: 1, cy: 0}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 0.5]}
BLOCKS
load_cases: {push: {live: [{acceleration: ["=cx", "=cy", 0]}]}}
"""
)
STACK = """\
  - box: {group: tower, material: stone, min: [0.1, 0.1, 0.5], max: [0.9, 0.7, 1]}
  - box: {group: tower, material: stone, min: [0.1, 0.1, 1], max: [0.9, 0.7, 1.3]}
  - box: {group: tower, material: stone, min: [0.1, 0.1, 1.3], max: [0.9, 0.7, 2.4]}
contacts: {joint: dry, overrides: [{between: [tower, tower], orientation: bed, joint: glued}]}
"""
ONE = """\
  - box: {group: tower, material: stone, min: [0.1, 0.1, 0.5], max: [0.9, 0.7, 2.4]}
contacts: {joint: dry}
"""
RULES = (
    ("analysis.flow_rule=associative",),
    ("analysis.flow_rule=associative", "analysis.contact_model=convex"),
    ("analysis.flow_rule=non_associative",),
    ("analysis.flow_rule=non_associative", "analysis.contact_model=convex"),
    ("analysis.flow_rule=dilatancy",),
)


@pytest.mark.parametrize("rule", RULES, ids=" ".join)
def test_a_bracket_rocks_as_its_union(rule: tuple[str, ...]) -> None:
    """Moments about the edge x = 1: Σ W (1 − x) = λ Σ W z, with weights 2000 · 1 and 700 · 0.75."""
    weights, arms, heights = np.array([2000.0, 525.0]), np.array([0.5, -0.25]), np.array([0.5, 1.25])
    assert factor_of(BRACKET, *rule) == pytest.approx(weights @ arms / (weights @ heights), rel=1e-6)


@pytest.mark.every(3)
@pytest.mark.parametrize("rule", RULES, ids=" ".join)
@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.6, 0.8)], ids=["planar", "spatial"])
def test_a_glued_stack_is_one_box(rule: tuple[str, ...], direction: tuple[float, float]) -> None:
    ways = [f"parameters.cx={direction[0]}", f"parameters.cy={direction[1]}"]
    stack, one = (factor_of(TWO_STACKS.replace("BLOCKS\n", blocks), *rule, *ways) for blocks in (STACK, ONE))
    assert stack == pytest.approx(one, rel=1e-9)


def test_velocities_are_those_of_one_rigid_body() -> None:
    model, case = case_of(BRACKET, "analysis.flow_rule=associative")
    assert case.solution.mechanics is not None
    motion = case.solution.mechanics.mechanism
    # turning about the edge x = 1, z = 0
    arms = model.blocks.centroids - [1.0, 0.5, 0.0]
    np.testing.assert_allclose(motion[:, :3], np.cross(motion[:, 3:], arms), atol=1e-6 * np.abs(motion).max())
    np.testing.assert_array_equal(motion[0, 3:], motion[1, 3:])


def test_a_glued_bracket_is_one_part_of_the_mechanism(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(BRACKET, encoding="utf-8")
    results = run(path, RunOptions())
    case = results.cases[0]
    assert case.solution.mechanics is not None
    collapse = collapse_of(results.assembly, case.load_case, case.solution.mechanics)
    assert collapse.parts.tolist() == [1, 1]


def test_the_result_file_is_verified_alone_and_seen_through(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(BRACKET, encoding="utf-8")
    run(path, RunOptions())
    results = read_results_hdf5(tmp_path / "deck.out" / "deck.h5")
    assert results.contacts.solid_of_block is not None
    again, disagreements = verify_file(tmp_path / "deck.out" / "deck.h5")
    assert disagreements == ()
    assert again.exit_code == 0
    case = results.cases[0]
    assert case.solution.mechanics is not None
    motion = case.solution.mechanics.mechanism.copy()
    motion[1, 0] *= 1.001
    forged = replace(
        case, solution=replace(case.solution, mechanics=replace(case.solution.mechanics, mechanism=motion))
    )
    (tmp_path / "forged.h5").write_bytes(write_results_hdf5(replace(results, cases=(forged,))))
    again, _ = verify_file(tmp_path / "forged.h5")
    assert any("move apart" in failure for failure in again.cases[0].checks.failures)
    assert again.exit_code == 4


def test_a_certificate_moves_the_blocks_of_a_body_together() -> None:
    """The arm is too heavy: no equilibrium, and what falls is told block by block."""
    text = BRACKET.replace("material: light", "material: stone").replace("max: [2, 1, 1.5]", "max: [3.2, 1, 1.5]")
    model, case = case_of(text)
    assert case.status is Status.NO_EQUILIBRIUM
    certificate = case.solution.certificate
    assert certificate is not None
    assert certificate.shape == (len(model.blocks), 6)
    np.testing.assert_array_equal(certificate[0, 3:], certificate[1, 3:])
    assert certificate[1, 2] < 0


def test_glued_to_the_ground_is_fixed() -> None:
    """What is left is the upper block on a fixed one."""
    text = BRACKET.replace("between: [low, high]", "between: [low, ground]").replace("[2, 1, 1.5]", "[1.2, 1, 1.5]")
    model, case = case_of(text, "analysis.flow_rule=associative")
    assert case.status is Status.SOLVED
    assert case.solution.mechanics is not None
    assert model.fixed.tolist() == [True, False]
    # 0.7 wide, centroid 0.35 from the left edge and 0.15 from the end of the bed at x = 1, 0.25 above it
    assert case.solution.mechanics.load_factor == pytest.approx(0.6, rel=1e-6)


def test_other_bodies_than_glue_makes_are_told(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(BRACKET, encoding="utf-8")
    run(path, RunOptions())
    file = tmp_path / "deck.out" / "deck.h5"
    with changing(file) as opened:
        opened["contacts/solid_of_block"][:] = [0, 2]
    assert verify_file(file)[1] == ("contacts/solid_of_block is not what the deck in the file gives",)


def test_the_bracket_is_one_rigid_body(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(BRACKET, encoding="utf-8")
    deck = read_deck(path)
    model = build_model(deck)
    bodies = build_assembly(deck, model).glued()
    assert bodies.model.blocks.masses.tolist() == pytest.approx([2525.0])
    assert bodies.load_case(model.load_cases[0]).dead_load[0, 2] == pytest.approx(-2525 * 9.81)


@pytest.mark.parametrize("cohesion", [0, 50], ids=["tangent", "angle"])
def test_a_bracket_on_a_tilting_table(cohesion: int) -> None:
    """It tips at the angle of the tangent (1 − x)/z, also where cohesion has the angle searched for by itself."""
    text = BRACKET.replace("acceleration: [1, 0, 0]", "tilt: {axis: [0, 1, 0]}")
    _, case = case_of(text.replace("friction: 0.7", f"friction: 0.7, cohesion: {cohesion}"))
    assert case.status is Status.SOLVED
    assert case.solution.mechanics is not None
    factor, angle = case.solution.mechanics.load_factor, tilt_of(case.load_case).angle
    expected = (1000 - 0.25 * 525) / (1000 + 1.25 * 525)
    assert (np.tan(np.radians(angle)) if cohesion else factor) == pytest.approx(expected, rel=1e-6)
