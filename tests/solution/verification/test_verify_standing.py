"""Forces and displacements that show that a structure stands: accepted as they are, refused when anything is off."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.assemble import yield_limits
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.mechanics import forces_of
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing
from mbla.solution.standing.standing import assess_dead_load, settlement_of
from mbla.solution.verification.further_claims import standing_failures
from mbla.solution.verification.statics import contact_resultants
from tests.line import Line, line_of
from tests.solution.standing_structures import STRUCTURES, Structure, bar, box, deck, incline, overhang, rafters

SETTINGS = SolverSettings(tolerance=1e-8)
STANDING = [structure for structure in STRUCTURES if structure.verdict is Standing.YES]


def shown(line: Line, parts: tuple[Program, ...]) -> tuple[FloatArray, FloatArray]:
    """Forces and displacements of the model under its dead load."""
    forces, settlement = np.zeros((len(line.contacts.points), 3)), np.zeros((len(line.model.blocks), 6))
    for program in parts:
        state = assess_dead_load(program, SETTINGS)
        assert state.forces is not None
        assert state.displacements is not None
        forces += forces_of(program, state.forces)
        settlement += settlement_of(program, state.displacements)
    return forces, settlement


def failures(line: Line, forces: FloatArray, settlement: FloatArray) -> tuple[str, ...]:
    """What verification has against them."""
    limits = yield_limits(line.model, line.contacts)
    return standing_failures(line.model, line.contacts, line.load_case, forces, settlement, limits)


@pytest.mark.parametrize("structure", STANDING, ids=lambda structure: structure.name)
def test_what_stands_is_shown_to_stand_by_whole_and_reduced_programs(structure: Structure) -> None:
    line = line_of(structure.text)
    assert failures(line, *shown(line, (line.program,))) == ()
    # the most that is ever left out: halves, points inside the hull of others
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True)
    assert failures(line, *shown(line, reduced.parts)) == ()


def test_thrust_that_was_locked_in_does_not_come_from_displacements() -> None:
    """The bar between two walls: pressed by both, held by friction, in balance, and moved in whatever way."""
    line = line_of(bar("friction: 0.5"))
    weight = 1 * 0.4 * 2000 * 9.81
    normal = np.where(np.abs(line.contacts.frames[:, 0, 0]) > 0.9, weight / 4, 0.0)
    upwards = line.contacts.frames[:, 1:] @ np.array([0.0, 0.0, 1.0])
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    forces = np.column_stack([normal, (sign * weight / 8)[:, None] * upwards])
    assert np.abs(contact_resultants(line.model, line.contacts, forces) + line.load_case.dead_load).max() < 1e-9
    falling = np.array([[0.0, 0.0, -1.0, 0.0, 0.0, 0.0]])
    for settlement in (falling, *np.random.default_rng(7).normal(size=(20, 1, 6))):
        for size in (1e6, 1e20):
            (failure,) = failures(line, forces, size * settlement)
            assert "do not come from the displacements" in failure


@pytest.fixture
def leant() -> tuple[Line, FloatArray, FloatArray]:
    line = line_of(rafters(0.6))
    return line, *shown(line, (line.program,))


Leant = tuple[Line, FloatArray, FloatArray]


def test_forces_that_do_not_balance_are_refused(leant: Leant) -> None:
    line, forces, settlement = leant
    (failure,) = failures(line, forces * (1 - 1e-5), settlement)
    assert "is not balanced" in failure


def test_forces_against_the_displacements_are_refused(leant: Leant) -> None:
    line, forces, settlement = leant
    (failure,) = failures(line, forces, -settlement)
    assert "do not come from the displacements" in failure


@pytest.mark.parametrize("share", [0.0, 0.99])
def test_forces_beyond_what_displacements_bring_about_are_refused(leant: Leant, share: float) -> None:
    line, forces, settlement = leant
    (failure,) = failures(line, forces, share * settlement)
    assert "do not come from the displacements" in failure


def test_shear_across_its_displacement_is_refused(leant: Leant) -> None:
    line, forces, settlement = leant
    sideways = settlement + np.array([0, 0.1 * np.abs(settlement).max(), 0, 0, 0, 0])
    (failure,) = failures(line, forces, sideways)
    assert "do not come from the displacements" in failure


def test_numbers_that_are_none_are_refused(leant: Leant) -> None:
    line, forces, settlement = leant
    forces[0, 0] = np.inf
    (failure,) = failures(line, forces, settlement)
    assert "not finite" in failure


def test_too_little_friction_is_refused() -> None:
    line, rough = line_of(incline(26, 0.3)), line_of(incline(26, 0.5))
    (failure,) = failures(line, *shown(rough, (rough.program,)))
    assert "yield conditions" in failure


def test_fixed_blocks_do_not_settle() -> None:
    line = line_of(overhang(0.9))
    forces, settlement = shown(line, (line.program,))
    settlement[0] = [0, 0, -1e-12 * np.abs(settlement).max(), 0, 0, 0]
    assert "fixed blocks are displaced" in failures(line, forces, settlement)


def test_a_light_block_is_not_lost_beside_a_heavy_one() -> None:
    line = line_of(deck(box(0, 0.01, 0, 0.01, width=0.01) + box(3, 4, 0, 1)))
    forces, settlement = shown(line, (line.program,))
    assert failures(line, forces, settlement) == ()
    forces[line.contacts.points[:, 0] < 1] = 0
    (failure,) = failures(line, forces, settlement)
    assert "block 0" in failure
