"""What the rivals are asked is the same program: small walls and arches whose load factor is known; rows and table."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from mbla.program import assemble
from tests.performance.rivals import coupled_blocks, cvxpy_models, linear_programs
from tests.performance.rivals.linear_programs import friction_sides
from tests.performance.rivals.statement import Statement, statement_of
from tests.performance.rivals.structure import Structure, compared, structure_of

EIGHT_SIDES = np.cos(np.pi / 8)


@cache
def structure(name: str, *overrides: str) -> Structure:
    standard, planar = compared()[name]
    return structure_of(standard, overrides, planar=planar)


def statement(name: str, *overrides: str) -> Statement:
    found = structure(name, *overrides)
    return statement_of(found.model, found.contacts, found.load_case, planar=found.planar)


SMALL = {
    "wall, planar, 5 x 5": (("parameters.m=3", "parameters.n=2"), 0.65),
    "wall, spatial, 5 x 5": (("parameters.m=3", "parameters.n=2"), 0.65),
    "arch, planar, 20 voussoirs": ((), 0.14935017),
}
"""The load factors that the decks themselves expect: a low wall slides, the arch is a linear program of its own."""


@pytest.mark.parametrize("name", SMALL)
@pytest.mark.parametrize("solve", [linear_programs.by_default, linear_programs.interior])
def test_linear_programs(name: str, solve: object) -> None:
    """The wall is pushed along a tangent, where the polyhedron in space touches the cone."""
    overrides, expected = SMALL[name]
    assert callable(solve)
    answer = solve(statement(name, *overrides))
    assert answer.status == "optimal"
    assert answer.load_factor == pytest.approx(expected, rel=1e-6)
    assert answer.residual < 1e-7


@pytest.mark.parametrize("name", SMALL)
@pytest.mark.parametrize("solve", [cvxpy_models.plain, cvxpy_models.scaled])
def test_cvxpy(name: str, solve: object) -> None:
    pytest.importorskip("cvxpy")
    overrides, expected = SMALL[name]
    assert callable(solve)
    answer = solve(statement(name, *overrides))
    assert answer.status == "optimal"
    assert answer.load_factor == pytest.approx(expected, rel=1e-5)
    assert answer.residual is None or answer.residual < 1e-6


@pytest.mark.parametrize("solve", [coupled_blocks.rbe, coupled_blocks.cra])
def test_compas_cra(solve: object) -> None:
    pytest.importorskip("compas_cra")
    assert callable(solve)
    answer = solve(structure("wall, spatial, 5 x 5", *SMALL["wall, spatial, 5 x 5"][0]))
    assert answer.status == "stands"


def test_the_statement_is_that_of_the_program() -> None:
    """Written apart from it, in other units and another order of the unknowns; the same equations."""
    name, overrides = "wall, spatial, 5 x 5", SMALL["wall, spatial, 5 x 5"][0]
    found, written = structure(name, *overrides), statement(name, *overrides)
    program = assemble(found.model, found.contacts, found.load_case)
    factor = program.scaling.row[:, None]
    order = np.arange(3 * program.n_points).reshape(-1, 3).T.ravel()
    ours = program.equilibrium_matrix.toarray()[:, order] / (factor * program.scaling.force)
    assert written.matrix.toarray() == pytest.approx(ours, abs=1e-12)
    assert written.dead == pytest.approx(program.dead_load / program.scaling.row)
    assert written.live == pytest.approx(program.live_load / (program.scaling.row * program.scaling.live))


def test_the_polyhedron_lies_inside_the_cone_and_touches_it_along_the_tangents() -> None:
    one = Statement(
        statement("wall, spatial, 5 x 5").matrix[:, :0], np.zeros(0), np.zeros(0), np.array([0.5]), 3, np.ones(1)
    )
    sides = friction_sides(one)
    angles = np.linspace(0, 2 * np.pi, 161)
    shear = np.array([1.0 / (sides[:, 1:] @ [np.cos(a), np.sin(a)]).max() for a in angles])
    reach = shear * 0.5 * EIGHT_SIDES  # where F (1, t) reaches 0
    assert reach.max() == pytest.approx(0.5)
    assert reach.min() == pytest.approx(0.5 * EIGHT_SIDES, rel=1e-3)
    assert reach[0] == reach[40] == pytest.approx(0.5)
