"""Two programs in turn: each of them by a second solver, G that never rises, and penalties that end lower."""

from __future__ import annotations

from itertools import islice, pairwise

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.nonassociative.alternation import FLOOR, Alternation
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord
from tests.line import BLOCK, line_of
from tests.solution.nonassociative.structures import FERRIS_3, least_of
from tests.solution.planar import planar_program

SHARP = SolverSettings(tolerance=1e-10)


def programs_of(program: Program, slope: FloatArray | float = 0.0) -> Alternation:
    records: list[ProgramRecord] = []
    slopes = slope * np.ones(program.n_points)
    return Alternation(program, slopes, SHARP, lambda record: None, records)


def off_the_law(alternation: Alternation, forces: FloatArray, load_factor: float, velocities: FloatArray) -> float:
    """G, non-dimensional, of joints without a strength in compression."""
    program, limits = alternation.program, alternation.program.limits
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, program.components)
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    opening = v[:, 0] - alternation.slope * sliding
    held = np.maximum((limits.friction - alternation.slope) * forces[:, 0] + limits.cohesion, FLOOR)
    power = held @ sliding + limits.tension @ np.maximum(opening, 0.0)
    return float(power - program.dead_load @ velocities - load_factor)


@pytest.mark.parametrize("overrides", [(), ("joints.dry.cohesion=300", "joints.dry.tensile_strength=200")])
@pytest.mark.parametrize("share", [0.0, 0.3])
def test_neither_program_lets_the_state_leave_the_law(share: float, overrides: tuple[str, ...]) -> None:
    program = planar_program(line_of(FERRIS_3, *overrides))
    alternation = programs_of(program, share * program.limits.friction)
    normal, values = np.exp(np.random.default_rng(0).normal(size=program.n_points)), []
    velocities = alternation.motion_for(normal)
    for _ in range(4):
        assert velocities is not None
        found = alternation.forces_for(velocities, 0.0)
        assert found is not None
        values.append(off_the_law(alternation, *found, velocities))
        velocities = alternation.motion_for(found[0][:, 0])
        assert velocities is not None
        values.append(off_the_law(alternation, *found, velocities))
    assert all(after <= before + 1e-8 for before, after in pairwise(values))
    assert values[0] > 1e-4  # else the comparison would say little
    assert min(values) > -1e-8


def test_a_state_of_the_law_is_left_as_it_is() -> None:
    """A sliding block: forces of friction on a motion along the ground, λ = μ and G = 0 from the first pair on."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    alternation = programs_of(program)
    velocities = alternation.motion_for(np.full(program.n_points, 1.0 / program.n_points))
    assert velocities is not None
    found = alternation.forces_for(velocities, 0.0)
    assert found is not None
    forces, load_factor = found
    assert program.scaling.load_factor(load_factor) == pytest.approx(0.5, rel=1e-8)
    assert off_the_law(alternation, forces, load_factor, velocities) == pytest.approx(0.0, abs=1e-8)
    state = next(alternation.states_from(alternation.motion_for(forces[:, 0])))
    assert state.residual < 1e-8


@pytest.mark.parametrize(("tilt", "end"), [(1e-3, 0.3558174), (-1e-3, 0.3793852)])
def test_a_little_tilt_finds_an_end_of_the_range_of_a_mechanism(tilt: float, end: float) -> None:
    """G is an exact penalty. Two cone programs of another author gave 0.35582 ... 0.37938 for wall 3."""
    program = planar_program(line_of(FERRIS_3))
    velocities = least_of(program, settings=SHARP).velocities
    _, load_factor = programs_of(program).forces_for(velocities, tilt) or (np.nan, np.nan)
    assert program.scaling.load_factor(load_factor) == pytest.approx(end, abs=2e-7)


def test_each_pair_is_recorded_as_two_programs() -> None:
    alternation = programs_of(line_of(BLOCK).program)
    states = list(islice(alternation.states_from(alternation.motion_for(np.ones(alternation.program.n_points))), 2))
    assert len(states) == 2
    kinds = [record.kind for record in alternation.records]
    assert kinds == ["motion", "forces", "motion", "forces", "motion"]
    assert alternation.work == sum(record.iterations for record in alternation.records)
    assert not alternation.late
