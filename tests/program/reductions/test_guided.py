"""Guided blocks in programs: the same answers whatever is reduced, and the exact way back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import assembly_of
from mbla.assembly.assembly import Assembly
from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program import assemble
from mbla.program.reductions import ReductionOutcome, reduce_program
from mbla.program.reductions.restrict import _projector
from mbla.program.reductions.steps import ReductionStep, ReductionSwitches, glued_step, size_of
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Standing, Status
from mbla.solution.solve import solve_parts
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.line import HEAD, case_of, cases_of, factor_of, line_of, unreduced

DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: bed, material: stone, min: [-1, -1, -1], max: [9, 2, 0]}
  - wall: {group: wall, material: stone, unit: [0.6, 0.3, 0.2], length: 2.4, courses: 4}
contacts: {joint: dry}
supports:
  - {blocks: bed}
  - %s
load_cases:
  push: {live: [{acceleration: %s}]}
analysis: {flow_rule: associative}
"""


def answer(tmp_path: Path, support: str, push: str, reduce: bool = True) -> tuple[float, int]:
    """Load factor and dimension; solved and verified."""
    path = tmp_path / "deck.yaml"
    path.write_text(DECK % (support, push), encoding="utf-8")
    deck = read_deck(path)
    model = build_model(deck)
    contacts = find_contacts(model, deck.contacts)
    case = model.load_cases[0]
    program = assemble(model, contacts, case)
    reduced = unreduced(program, contacts)
    if reduce:
        reduced = reduce_program(model, contacts, program, ReductionSwitches(), associative=True)
    solution = solve_parts(reduced, solver_settings(deck.analysis))
    checks = verify(Assembly(model, contacts), case, solution)
    assert verified_status(solution, checks) is Status.SOLVED, checks.failures
    assert solution.mechanics is not None
    assert solution.size is not None
    return solution.mechanics.load_factor, solution.size.dimension


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("support", "push", "dimension"),
    [
        ("{blocks: {group: wall, index: 5}, fixed: [x]}", "[1, 0, 0]", 2),
        ("{blocks: {group: wall, index: 5}, fixed: [y, rx, rz]}", "[1, 0, 0]", 2),
        ("{blocks: {group: wall, index: 5}, fixed: [rx, ry, rz]}", "[0, 1, 0]", 3),
        ("{blocks: wall, fixed: [y, rx, rz]}", "[1, 0, 0]", 2),
        ("{blocks: {group: wall, index: 15}, turn: {axis: [0, 1, 0], about: [2.4, 0, 0]}}", "[1, 0, 0]", 2),
        ("{blocks: {group: wall, index: 15}, slide: [1, 1, 3]}", "[1, 0.2, 0]", 3),
        ("{blocks: {box: [[0, 0, 0.45], [9, 9, 9]]}, fixed: [y], together: true}", "[1, 0, 0]", 2),
        ("{blocks: {box: [[0, 0, 0.45], [9, 9, 9]]}, turn: {axis: [0, 1, 0], about: [2.4, 0, 0.4]}, together: true}",
         "[1, 0, 0]", 2),
    ],
)  # fmt: skip
def test_reduced_and_unreduced_programs_agree(tmp_path: Path, support: str, push: str, dimension: int) -> None:
    reduced, size = answer(tmp_path, support, push)
    plain, _ = answer(tmp_path, support, push, reduce=False)
    assert size == dimension
    assert reduced == pytest.approx(plain, rel=1e-7)


def test_guides_across_the_mirror_plane_are_not_mirrored(tmp_path: Path) -> None:
    """A wall pushed out of its plane is symmetric about its middle; a rail on one end of it is not."""
    for support, planes in (("{blocks: bed}", 1), ("{blocks: {group: wall, index: 0}, fixed: [rx]}", 0)):
        path = tmp_path / "deck.yaml"
        path.write_text(DECK % (support, "[0, 1, 0]"), encoding="utf-8")
        deck = read_deck(path)
        model = build_model(deck)
        contacts = find_contacts(model, deck.contacts)
        program = assemble(model, contacts, model.load_cases[0])
        reduced = reduce_program(model, contacts, program, ReductionSwitches(), associative=True)
        assert reduced.size.mirror_planes == planes


def test_mechanism_and_velocities_are_inverse_on_what_guides_allow(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK % ("{blocks: {group: wall, index: 3}, slide: [1, 2, 3]}", "[1, 0, 0]"), encoding="utf-8")
    deck = read_deck(path)
    model = build_model(deck)
    contacts = find_contacts(model, deck.contacts)
    program = assemble(model, contacts, model.load_cases[0])
    assert len(program.dead_load) == 6 * len(model.free) - 5
    q = np.random.default_rng(1).normal(size=len(program.dead_load))
    mechanism = program.mechanism(q)
    np.testing.assert_allclose(program.velocities(mechanism), q, rtol=1e-12, atol=1e-12)
    block = model.guides.blocks[0]
    np.testing.assert_allclose(mechanism[block, 3:], 0.0, atol=1e-15)
    np.testing.assert_allclose(np.cross(mechanism[block, :3], [1, 2, 3]), 0.0, atol=1e-12 * abs(mechanism).max())


def test_ways_of_a_body_are_told_from_rounding_whatever_the_unit_of_length() -> None:
    ways = np.array([[1.0, 0, 1], [0, 1, 1], [0, 0, 0]])
    for unit in (1e-13, 1.0, 1e13):
        assert _projector(unit * ways) == pytest.approx(np.diag([1.0, 1, 0]), abs=1e-12)


CARRIAGE = (
    HEAD
    + """\
joints: {dry: {friction: 0.4}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: carriage, material: stone, min: [5, 0, 0], max: [6, 1, 1]}
supports: [{ground: {z: 0}, blocks: block}, {blocks: carriage, slide: WAY}]
load_cases:
  push: {dead: [DEAD], live: [{acceleration: [1, 0, 0], on: block}]}
"""
)
BALANCED = ", ".join(
    f"{{force: [{x}, 0, 0], on: carriage, at: [5.5, 0.5, 0.5]}}" for x in (100000.1, 200000.2, -300000.3)
)


@pytest.mark.parametrize(("way", "dead"), [("[1, 0, 0]", BALANCED), ("[1, 2, 0]", "{gravity: [2, -1, -9.81]}")])
def test_rounding_of_loads_moves_nothing_on_its_way(way: str, dead: str) -> None:
    """Loads on it that cancel but for 6e-11 N, or that act across its way but for their last digits, are carried."""
    case = case_of(CARRIAGE.replace("WAY", way).replace("DEAD", dead))[1]
    assert case.status is Status.SOLVED
    assert case.solution.standing is not None
    assert case.solution.standing.verdict is Standing.YES


# What glue saves, and that a glued joint is one whose strength is never reached.


PIERS = (
    HEAD
    + """\
joints: {dry: {friction: 0.55}, strong: {friction: 1, cohesion: 1.e7, tensile_strength: 1.e7}}
contacts: {joint: dry, overrides: [{between: [pier, lintel], joint: LAW}, {between: [foot, pier], joint: FOOT}]}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, -1], max: [1, 1, 0]}
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
  - box: {group: pier, material: stone, min: [3, 0, 0], max: [4, 1, 2]}
  - box: {group: lintel, material: stone, min: [0, 0, 2], max: [4, 1, 3]}
supports: [{blocks: foot}, {ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
).replace("contacts: {joint: dry}\n", "")


def text(law: str, foot: str) -> str:
    return PIERS.replace("LAW", law).replace("FOOT", foot)


def step_of(law: str, foot: str) -> ReductionStep:
    model, case = case_of(text(law, foot), "analysis.flow_rule=associative")
    (step,) = (step for step in case.solution.reductions if step.name == "glued")
    assert len(model.blocks) == 4
    return step


@pytest.mark.parametrize(
    ("law", "foot", "found", "before", "after"),
    [
        ("dry", "dry", 0, 18, 18),  # two piers and the lintel
        ("glued", "dry", 3, 18, 6),  # one body
    ],
)
def test_unknowns_before_and_after(law: str, foot: str, found: int, before: int, after: int) -> None:
    step = step_of(law, foot)
    assert (step.found, step.before.unknowns, step.after.unknowns) == (found, before, after)
    assert step.state is (ReductionOutcome.APPLIED if found else ReductionOutcome.NONE)


@pytest.mark.parametrize(("law", "found"), [("dry", 0), ("glued", 3)])
def test_the_load_cell_of_a_force_is_none_of_the_blocks_that_glue_saves(law: str, found: int) -> None:
    sought = text(law, "dry").replace(
        "push: {live: [{acceleration: [1, 0, 0]}]}", "push: {objective: {force: {from: foot, direction: [0, 0, 1]}}}"
    )
    _, cases = cases_of(sought)
    steps = [step for case in cases for step in case.solution.reductions if step.name == "glued"]
    assert [(step.found, step.before.unknowns - step.after.unknowns) for step in steps] == [(found, 4 * found)] * 2


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_a_joint_that_is_never_overcome_is_glued(flow_rule: str) -> None:
    """The frame slides on its two feet at the friction coefficient, or rocks about the edge of its right foot."""
    flow = f"analysis.flow_rule={flow_rule}"
    glued, strong = (factor_of(text(law, "dry"), flow) for law in ("glued", "strong"))
    assert glued == pytest.approx(0.55, rel=1e-6)
    assert strong == pytest.approx(glued, rel=1e-6)


def test_blocks_held_by_glue_have_no_unknowns() -> None:
    line = line_of(text("dry", "glued"))
    contacts = find_contacts(line.model, line.deck.contacts)
    bodies = assembly_of(line.model, contacts).of(line.load_case)
    program = assemble(bodies.model, bodies.contacts, bodies.load_case(line.load_case))
    step = glued_step(bodies, size_of([program]))
    assert (step.found, step.before.unknowns, step.after.unknowns) == (1, 18, 12)
