"""The static form against the kinematic one: the same load factor from forces as from velocities."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.kinematic import friction_polygon
from mbla.program.program import Program
from mbla.program.static import associative_static_form, polygon_sides
from mbla.solution.associative.associative_form import FORMS, in_forces
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from tests.line import BLOCK, WALL, line_of
from tests.solution.planar import planar_program

COHESIVE = BLOCK.replace("tensile_strength", "compressive_strength: 5.0e+5, tensile_strength")
SMOOTH = BLOCK.replace("{ground: {z: 0}}", "{ground: {z: 0}, joint: ice}").replace(
    'joints: {dry: {friction: "=mu", cohesion: "=c", tensile_strength: "=ft"}}',
    "joints: {dry: {friction: 0.5}, ice: {friction: 0, cohesion: 1000}}",
)


def factor(program: Program, form: str, facets: FloatArray | None = None) -> tuple[Status, float, float]:
    """Status, load factor and residual."""
    read: list[IterationRecord] = []
    made = FORMS[form](program, facets)
    result = solve_associative(program, SolverSettings(1e-8), read.append, form=made)
    if result.state is None:
        return result.status, np.nan, np.nan
    assert read[-1].program == 2
    return result.status, result.state.load_factor, result.state.residual


@pytest.mark.parametrize(
    ("text", "overrides"),
    [
        (WALL, ()),
        (BLOCK, ("parameters.c=4000", "parameters.ft=2000")),
        (COHESIVE, ("parameters.c=4000", "parameters.ft=2000")),
        (SMOOTH, ()),
    ],
    ids=["wall", "cohesive block", "block that crushes", "cohesion without friction"],
)
def test_forces_and_velocities_give_the_same_factor(text: str, overrides: tuple[str, ...]) -> None:
    program = line_of(text, *overrides).program
    kinematic, static = factor(program, "kinematic"), factor(program, "static")
    assert kinematic[0] is static[0] is Status.SOLVED
    assert static[1] == pytest.approx(kinematic[1], rel=2e-7)
    assert max(kinematic[2], static[2]) < 2e-6


@pytest.mark.parametrize("sides", [3, 4, 8, 9])
@pytest.mark.parametrize("circumscribed", [False, True])
def test_the_same_with_a_polyhedron(sides: int, circumscribed: bool) -> None:
    """With an odd number of sides this shows too that shear opposes sliding: the polygon is not its own image."""
    program = line_of(BLOCK, "parameters.h=0.5", "load_cases.push.live=[{acceleration: [0.8, 0.6, 0]}]").program
    facets = friction_polygon(sides, circumscribed)
    assert factor(program, "static", facets)[1] == pytest.approx(factor(program, "kinematic", facets)[1], rel=1e-7)


def test_the_same_in_a_plane() -> None:
    line = line_of(WALL)
    planar = planar_program(line)
    assert factor(planar, "static")[1] == pytest.approx(factor(planar, "kinematic")[1], rel=2e-7)
    assert factor(planar, "static")[1] == pytest.approx(factor(line.program, "static")[1], rel=2e-7)


@pytest.mark.parametrize("form", ["kinematic", "static"])
def test_verdicts_are_the_same(form: str) -> None:
    into_the_ground = line_of(WALL, "load_cases.push.live=[{acceleration: [0, 0, -1]}]").program
    assert factor(into_the_ground, form)[0] is Status.UNBOUNDED
    steep = line_of(WALL, "load_cases.push.dead=[{gravity: [9.81, 0, -9.81]}]").program
    result = solve_associative(steep, SolverSettings(1e-8), lambda _: None, form=FORMS[form](steep, None))
    assert result.status is Status.NO_EQUILIBRIUM
    assert result.certificate is not None
    assert steep.dead_load @ result.certificate > 0
    helped = line_of(
        WALL,
        "load_cases.push.dead=[{gravity: [9.81, 0, -9.81]}]",
        "load_cases.push.live=[{acceleration: [0, 1, 0]}]",
    ).program
    assert factor(helped, form)[0] is Status.NO_EQUILIBRIUM


def test_sides_of_polygons() -> None:
    square = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    np.testing.assert_allclose(polygon_sides(square), [[1, 1], [-1, 1], [-1, -1], [1, -1]])
    np.testing.assert_allclose(polygon_sides(np.array([[2.0], [-4.0]])), [[0.5], [-0.25]])
    hull = friction_polygon(7, circumscribed=True)
    np.testing.assert_allclose(np.linalg.norm(polygon_sides(hull), axis=1), 1.0)


def test_shear_where_a_joint_carries_none_is_no_unknown() -> None:
    program = line_of(BLOCK, "parameters.mu=0").program
    form = in_forces(program)
    assert form.cone_program.n_cones == 0
    assert form.cone_program.matrix.shape[1] == program.n_points + 1


@pytest.mark.parametrize("facets", [None, friction_polygon(4, circumscribed=False)], ids=["cones", "polygon"])
def test_cohesion_without_friction_stores_no_zeros(facets: FloatArray | None) -> None:
    """Zeros that are stored fill the factors of the solver."""
    form = associative_static_form(line_of(SMOOTH).program, facets)
    assert form.cone_program.n_cones + form.cone_program.n_half_lines > 0
    assert form.cone_program.matrix.data.all()
    assert form.cone_program.matrix.has_canonical_format
