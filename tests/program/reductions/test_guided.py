"""Guided blocks in programs: the same answers whatever is reduced, and the exact way back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program import assemble
from mbla.program.reductions import reduce_program, unreduced
from mbla.program.reductions.restrict import _projector
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Status
from mbla.solution.solve import solve_parts
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status

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
    checks = verify(model, contacts, case, solution)
    assert verified_status(solution, checks) is Status.SOLVED, checks.failures
    assert solution.mechanics is not None
    assert solution.size is not None
    return solution.mechanics.load_factor, solution.size.dimension


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
