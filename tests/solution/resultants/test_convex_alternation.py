"""The alternation of the convex contact model, where its programs or its pairs end early; fields of full stress."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.resultants import ConvexProgram, assemble_convex
from mbla.solution.nonassociative import alternation
from mbla.solution.resultants import convex_alternation
from mbla.solution.resultants.convex_alternation import solve_by_alternation
from mbla.solution.resultants.convex_associative import ConvexAssociative, solve_convex_associative
from mbla.solution.resultants.stress_fields import StressFields
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import WALL, line_of
from tests.solution.failing_solver import said
from tests.solution.outlines import OUTLINES, STRENGTH, full_stress, laws_of, random_closing

SETTINGS = SolverSettings(1e-8)

Wall = tuple[ConvexProgram, ConvexAssociative]


@pytest.fixture(scope="module")
def wall() -> Wall:
    line = line_of(WALL.replace("[1, 0, 0]", "[1, 0.3, 0]"), "parameters.n=2")
    convex = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    return convex, replace(solve_convex_associative(convex, SETTINGS, lambda record: None), programs=())


@pytest.mark.parametrize(
    ("said_to_be", "status", "after"),
    [
        (Status.UNBOUNDED, Status.NOT_VERIFIED, 0),
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED, 1),
        (Status.TIME_LIMIT, Status.TIME_LIMIT, 0),
        (Status.TIME_LIMIT, Status.TIME_LIMIT, 15),
    ],
)
def test_a_program_without_a_solution_ends_the_scheme(
    after: int, said_to_be: Status, status: Status, wall: Wall, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is said of a program is not said of the structure; a state of an earlier pair is kept.

    A start that ends early is followed by the next, but where time is up.
    """
    monkeypatch.setattr(convex_alternation, "EXACT", 0.0)
    monkeypatch.setattr(convex_alternation, "EXACT_RESIDUAL", 0.0)
    monkeypatch.setattr(alternation, "cone_solver", said(said_to_be, after))
    result = solve_by_alternation(*wall, replace(SETTINGS, residual=0.0), lambda record: None)
    assert result.status is status
    assert f"ended without a solution (clarabel: said {said_to_be})" in result.reason
    assert (result.state is None) is (after < 2 * (len(convex_alternation.TILTS) + 1))
    starts = 1 if status is Status.TIME_LIMIT or result.state else 3 + convex_alternation.HOPS
    assert [record.kind for record in result.programs].count("gravity") == 1
    assert len(result.programs) == 1 + after + starts


def test_pairs_that_may_not_go_on_say_how_far_they_came(wall: Wall, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_alternation, "EXACT_RESIDUAL", 0.0)
    monkeypatch.setattr(convex_alternation, "MOST_PAIRS", 1)
    monkeypatch.setattr(convex_alternation, "HOPS", 0)
    result = solve_by_alternation(*wall, replace(SETTINGS, residual=0.0), lambda record: None)
    assert "did not converge in 3 iterations" in " ".join([result.reason, *map(str, result.remarks)])
    assert result.state is not None
    assert result.state.residual < 1e-8


@pytest.mark.parametrize("name", OUTLINES)
def test_full_stress_is_that_of_the_part_that_closes(name: str) -> None:
    laws = laws_of(name, 60)
    fields = StressFields.of(laws.shapes, np.arange(60), laws.strength)
    closing = random_closing(laws.shapes, 60, 1)
    expected = STRENGTH * np.array([full_stress(laws.shapes, q) for q in closing])
    found = fields.carried(closing / fields.scale)  # dual to forces
    assert found / fields.scale == pytest.approx(expected, abs=1e-11 * float(laws.strength[0]))
