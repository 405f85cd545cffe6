"""The scheme without dilatancy for the convex contact model, where its programs or its steps end early."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.resultants import ConvexProgram, assemble_convex
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.resultants import convex_proximal
from mbla.solution.resultants.convex_proximal import solve_convex_proximal
from mbla.solution.resultants.stress_fields import StressFields, nearest_stress
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.standing import standing
from mbla.solution.verification.interface_laws import InterfaceLaws, crushing_excess
from tests.line import WALL, line_of
from tests.solution.failing_solver import said
from tests.solution.outlines import OUTLINES, STRENGTH, full_stress, laws_of, random_closing

SETTINGS = SolverSettings(1e-8)


@pytest.fixture(scope="module")
def wall() -> ConvexProgram:
    line = line_of(WALL.replace("[1, 0, 0]", "[1, 0.3, 0]"), "parameters.n=2")
    return assemble_convex(line.model, line.contacts, line.load_case, "convex")


def sequence(convex: ConvexProgram) -> SequenceResult:
    return solve_convex_proximal(convex, (), SETTINGS, lambda record: None)


@pytest.mark.parametrize("after", [0, 1, 3])
@pytest.mark.parametrize(
    ("said_to_be", "status"),
    [
        (Status.UNBOUNDED, Status.NOT_VERIFIED),
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED),
        (Status.TIME_LIMIT, Status.TIME_LIMIT),
    ],
)
def test_a_program_without_a_solution_ends_the_scheme(
    after: int, said_to_be: Status, status: Status, wall: ConvexProgram, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first is that of the gravity state; what is said of the others is not said of the structure."""
    solver = said(said_to_be, after)
    for module in (standing, convex_proximal):
        monkeypatch.setattr(module, "interior_point_solver", solver)
    result = sequence(wall)
    assert result.status is status
    assert f"ended without a solution (clarabel: said {said_to_be})" in result.reason
    assert (result.state is None) is (after < 2)
    assert [record.kind for record in result.programs] == ["gravity", *["convex step"] * max(after - 1, 0)]


def test_steps_that_may_not_go_on_say_how_far_they_came(wall: ConvexProgram, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_proximal, "MOST_STEPS", 2)
    result = sequence(wall)
    assert result.status in (Status.APPROXIMATE, Status.NOT_VERIFIED)
    assert "did not converge in 2 iterations" in result.reason
    assert result.state is not None
    assert result.spread is not None
    assert result.spread[0] <= result.state.load_factor <= result.spread[1]


# Full stress and how it grows, and the nearest forces that fields of stress carry.


EVERY = pytest.mark.parametrize("name", OUTLINES)
N = 60


def fields_of(laws: InterfaceLaws) -> StressFields:
    return StressFields.of(laws.shapes, np.arange(len(laws.strength)), laws.strength)


def resultants_of(fields: StressFields, forces: FloatArray) -> FloatArray:
    resultants = np.zeros((len(forces), 6))
    resultants[:, [0, 4, 5]] = forces / fields.scale
    return resultants


@EVERY
def test_full_stress_is_that_of_the_part_that_closes(name: str) -> None:
    laws = laws_of(name, N)
    fields, closing = fields_of(laws), random_closing(laws.shapes, N, 1)
    expected = STRENGTH * np.array([full_stress(laws.shapes, q) for q in closing])
    found, _ = fields.carried(closing / fields.scale)  # dual to forces
    assert found / fields.scale == pytest.approx(expected, abs=1e-11 * float(laws.strength[0]))


@EVERY
def test_it_grows_as_differences_say(name: str) -> None:
    laws = laws_of(name, N)
    fields, closing = fields_of(laws), random_closing(laws.shapes, N, 2)
    _, growth = fields.carried(closing)
    for axis in range(3):
        step = 1e-5 * np.linalg.norm(closing, axis=1)[:, None] * np.eye(3)[axis]
        by_difference = (fields.carried(closing + step)[0] - fields.carried(closing - step)[0]) / (2 * step[:, [axis]])
        size = np.abs(growth).max(axis=(1, 2))[:, None]
        off = np.abs(growth[:, :, axis] - by_difference) / size
        assert np.median(off) < 1e-7
        assert np.quantile(off, 0.9) < 1e-3  # the line may run through a corner between both


@EVERY
def test_the_nearest_forces_are_at_the_border_and_along_a_normal(name: str) -> None:
    """Beyond the border along what full stress closes by, those are the nearest; found without knowing of it."""
    laws = laws_of(name, N)
    fields, draw = fields_of(laws), np.random.default_rng(3)
    wanted = 0.6 * float(laws.strength[0]) * draw.normal(size=(N, 3))
    wanted[:, 0] += 0.5 * float(laws.strength[0])
    outside = crushing_excess(laws, resultants_of(fields, wanted)) > 0.0
    assert set(outside.tolist()) == {False, True}
    nearest, follows, d = nearest_stress(fields, wanted, outside, np.zeros((N, 3)))
    size = float(laws.strength[0])
    assert np.array_equal(nearest[~outside], wanted[~outside])
    assert follows[~outside] == pytest.approx(np.broadcast_to(np.eye(3), follows[~outside].shape))
    off = (wanted - nearest)[outside]
    assert crushing_excess(laws, resultants_of(fields, nearest))[outside] == pytest.approx(0.0, abs=1e-8 * size)
    distance = np.linalg.norm(off, axis=1)
    assert off == pytest.approx(distance[:, None] * d[outside], abs=1e-9 * size)
    # no other forces that can be carried lie further along the normal
    carried = fields.carried(random_closing(laws.shapes, N, 4))[0]
    assert np.all((carried[None] - nearest[outside][:, None]) @ d[outside][:, :, None] <= 1e-9 * size)


@EVERY
def test_from_a_known_neighbour_they_are_the_same(name: str) -> None:
    laws = laws_of(name, N)
    fields, draw = fields_of(laws), np.random.default_rng(7)
    wanted = draw.normal(scale=float(laws.strength[0]), size=(N, 3))
    outside = crushing_excess(laws, resultants_of(fields, wanted)) > 0.0
    nearest, _, d = nearest_stress(fields, wanted, outside, np.zeros((N, 3)))
    near = d + 0.1 * draw.normal(size=d.shape)
    again, _, _ = nearest_stress(fields, wanted, outside, near / np.linalg.norm(near, axis=1)[:, None])
    assert again == pytest.approx(nearest, abs=1e-8 * float(laws.strength[0]))


@EVERY
def test_they_follow_what_is_wanted_as_differences_say(name: str) -> None:
    laws = laws_of(name, N)
    fields, closing = fields_of(laws), random_closing(laws.shapes, N, 8)
    d = closing / np.linalg.norm(closing, axis=1)[:, None]
    size = float(laws.strength[0])
    wanted, everywhere = fields.carried(d)[0] + 0.5 * size * d, np.ones(N, dtype=bool)
    _, follows, _ = nearest_stress(fields, wanted, everywhere, d)
    for axis in range(3):
        step = 1e-5 * size * np.eye(3)[axis]
        pair = [nearest_stress(fields, wanted + sign * step, everywhere, d)[0] for sign in (1.0, -1.0)]
        off = np.abs(follows[:, :, axis] - (pair[0] - pair[1]) / (2e-5 * size)).max(axis=1)
        assert np.median(off) < 1e-6
        assert np.quantile(off, 0.9) < 1e-3
