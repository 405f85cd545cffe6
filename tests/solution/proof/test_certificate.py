"""Motions that prove that the dead load is not carried: what stands is at rest, and verification accepts them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.full_model.mechanics import motion_of
from mbla.solution.proof.certificate import steepest_fall
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Solution, Standing, Status
from mbla.solution.verification.verify import verify
from tests.line import Line, line_of
from tests.solution.standing_structures import (
    FIXED,
    STRUCTURES,
    Structure,
    box,
    deck,
    incline,
    leaning,
    overhang,
    wall_with_opening,
)

SETTINGS = SolverSettings(tolerance=1e-8)
FALLING = [structure for structure in STRUCTURES if structure.verdict is Standing.NO]
STANDING = [structure for structure in STRUCTURES if structure.verdict is not Standing.NO]
LINTEL = wall_with_opening((1.0, 2.0)).replace("friction: 0.8", "friction: 0.5")


def certificate_of(program: Program) -> FloatArray:
    """What the associative program ends on."""
    certificate = solve_associative(program, SETTINGS, lambda record: None).certificate
    assert certificate is not None
    return certificate


def moving(program: Program, velocities: FloatArray) -> list[int]:
    """Blocks of the model that move."""
    return np.flatnonzero(np.abs(motion_of(program, velocities)).max(axis=1)).tolist()


def failures(line: Line, program: Program, velocities: FloatArray) -> tuple[str, ...]:
    """What verification has against the motion as a certificate."""
    solution = Solution(
        flow_rule="associative",
        status=Status.NO_EQUILIBRIUM,
        mechanics=None,
        associative=None,
        certificate=motion_of(program, velocities),
        reason="",
        programs=(),
        iterations=(),
        seconds=0.0,
    )
    return verify(line.assembly, line.load_case, solution).failures


@pytest.mark.parametrize("structure", FALLING, ids=lambda structure: structure.name)
def test_the_steepest_fall_is_found_and_accepted(structure: Structure) -> None:
    line = line_of(structure.text)
    fall = steepest_fall(line.program, SETTINGS, lambda record: None)
    assert fall is not None
    assert np.abs(fall).max() == pytest.approx(1)
    assert failures(line, line.program, fall) == ()
    for part in reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True).parts:
        reduced = steepest_fall(part, SETTINGS, lambda record: None)
        if reduced is not None:
            assert failures(line, part, reduced) == ()
            assert moving(part, reduced) == moving(line.program, fall)


@pytest.mark.parametrize("structure", STANDING, ids=lambda structure: structure.name)
def test_there_is_no_fall_where_some_forces_carry_the_dead_load(structure: Structure) -> None:
    assert steepest_fall(line_of(structure.text).program, SETTINGS, lambda record: None) is None


@pytest.mark.parametrize("distance", [1e-3, 1e-5])
def test_thresholds_are_met_closely(distance: float) -> None:
    limit = 0.14615384615384616
    below = [incline(math.degrees(math.atan(0.5 * (1 - distance))), 0.5), overhang(1 - distance)]
    above = [incline(math.degrees(math.atan(0.5 * (1 + distance))), 0.5), overhang(1 + distance)]
    for text in (*below, leaning(limit * (1 + distance))):
        assert steepest_fall(line_of(text).program, SETTINGS, lambda record: None) is None
    for text in (*above, leaning(limit * (1 - distance))):
        line = line_of(text)
        fall = steepest_fall(line.program, SETTINGS, lambda record: None)
        assert fall is not None
        assert failures(line, line.program, fall) == ()


def test_what_stands_is_at_rest() -> None:
    """The lintel squeezed between its jambs falls and pushes the two blocks beside it; the courses below stand.

    The motion that the cone program ends on moves every block.
    """
    program = line_of(LINTEL).program
    given = certificate_of(program)
    assert moving(program, given) == list(range(9))
    fall = steepest_fall(program, SETTINGS, lambda record: None)
    assert fall is not None
    assert moving(program, fall) == [6, 7, 8]


def test_strength_counts_against_a_fall() -> None:
    """A block hung from a fixed one by 2000·9.81 Pa times 1 m2, and one below it that cannot be held as well."""
    text = deck(
        box(0, 1, 2, 3, group="fixed") + box(0, 1, 1, 2) + box(0, 1, 0, 1),
        FIXED,
        "friction: 0.5, cohesion: 20000, tensile_strength: 30000",
    )
    line = line_of(text)
    fall = steepest_fall(line.program, SETTINGS, lambda record: None)
    assert fall is not None
    motion = motion_of(line.program, fall)
    assert motion[1, 2] == pytest.approx(motion[2, 2], rel=1e-6)
    assert steepest_fall(line_of(text.replace("30000", "40000")).program, SETTINGS, lambda record: None) is None
