"""The rows of torsion and crushing allow the resultants that the formulas of these modules allow, and no others.

The unknowns and cones that they add to a program.
"""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.kinematic import ConeProgram
from mbla.program.resultants.conditions import M1, M2, MN, ConditionRows, N
from mbla.program.resultants.conditions_of import with_conditions_of
from mbla.program.resultants.crushing_cones import crushing_conditions
from mbla.program.resultants.interface_motions import CrushingInterfaces, CrushingOfProgram
from mbla.program.resultants.shapes import InterfaceShapes
from mbla.program.resultants.stress_blocks import Pieces, pieces_in_space, with_conditions
from mbla.program.resultants.torsion import TorsionLimits, torsion_limits, torsion_rows
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.settings import solver_settings
from mbla.solution.verification.interface_laws import InterfaceLaws, crushing_excess
from tests.line import BLOCK, WALL, line_of
from tests.program.resultants.test_shapes import shapes_of
from tests.program.resultants.test_stress_blocks import copies

RECTANGLE = shapes_of((0, 0), (1.25, 0), (1.25, 0.75), (0, 0.75))
TRIANGLE = shapes_of((0, 0), (1.0, 0), (0.25, 0.75))
PARALLELOGRAM = shapes_of((0, 0), (1.25, 0), (1.75, 0.75), (0.5, 0.75))
PENTAGON = shapes_of((0, 0), (1.0, 0), (1.25, 0.5), (0.5, 1.0), (-0.25, 0.5))
FORMS = pytest.mark.parametrize("shapes", [RECTANGLE, TRIANGLE], ids=["rectangle", "triangle"])


def least_powers(rows: ConditionRows, resultants: FloatArray) -> FloatArray:
    """Least of r·(motion) + cost for every r, (n, 6), over multipliers in their cones, as large as 1 at most, (n,).

    0 where r is allowed. One program of independent ones.
    """
    power = np.asarray(resultants @ rows.motion.toarray() + rows.cost)
    n, count = power.shape
    order = np.argsort(rows.cone_sizes > 1, kind="stable")
    first = np.cumsum(rows.cone_sizes) - rows.cone_sizes
    heads, n_lines = rows.cones[first].sum(axis=0), int((rows.cone_sizes == 1).sum())
    lines = rows.cones[first[order[:n_lines]]]
    cones = rows.cones[np.concatenate([np.arange(first[k], first[k] + rows.cone_sizes[k]) for k in order[n_lines:]])]
    every = sp.eye_array(n)
    parts = [sp.kron(every, part) for part in (heads[None, :], -lines, -cones)]
    matrix = sp.csc_array(sp.vstack(parts))
    program = ConeProgram(
        cost=power.ravel(),
        matrix=matrix,
        rhs=np.concatenate([np.ones(n), np.zeros(matrix.shape[0] - n)]),
        n_half_lines=n * (n_lines + 1),
        n_cones=0,
        n_equations=0,
        further_cones=n * tuple(int(size) for size in rows.cone_sizes[order][n_lines:]),
    )
    found = ClarabelProgram(program, solver_settings(AnalysisSection()), lambda *_: None).solve(1, 1.0)
    return np.asarray((power * found.x.reshape(n, count)).sum(axis=1))


def torsion_allowed(limits: TorsionLimits, shapes: InterfaceShapes, r: FloatArray) -> bool:
    """t² ≤ (R − m)(R + (1 − θ) m), m ≤ R, with the most that R may be."""
    friction, cohesion, theta = limits.friction[0], limits.cohesion[0], limits.thetas[0]
    moments = np.array([-r[M2], r[M1]])
    slopes = shapes.edge_slopes()
    if shapes.rectangles[0]:
        reach = np.abs(limits.corners[:2] @ shapes.axes[0].T).max(axis=0)
        ways = np.array([(one, two) for one in (1, -1) for two in (1, -1)]) / reach
        slopes = ways @ shapes.axes[0]
    share = min(friction * (r[N] - slope @ moments) + cohesion for slope in slopes)
    strength = friction * r[N] + cohesion
    share, twist = min(share, strength), abs(r[MN]) / limits.radii[0]
    beyond = max(np.hypot(r[1], r[2]) - strength + share, 0.0)
    return bool(share >= 0 and twist <= share and beyond**2 <= (share - twist) * (share + (1 - theta) * twist))


def random_resultants(draw: np.random.Generator, normal: float, size: float) -> FloatArray:
    return np.concatenate([[normal], draw.uniform(-size, size, 3), 0.3 * draw.uniform(-size, size, 2)])


def agree(rows: ConditionRows, resultants: list[FloatArray], allowed: list[bool]) -> None:
    least = least_powers(rows, np.array(resultants))
    assert set(allowed) == {False, True}
    for r, value, within in zip(resultants, least, allowed, strict=True):
        assert value > -1e-7 if within else value < -1e-12, (r, within)


@FORMS
@pytest.mark.parametrize(("friction", "cohesion"), [(0.5, 0.0), (0.5, 0.25), (0.0, 0.5)])
def test_torsion(shapes: InterfaceShapes, friction: float, cohesion: float) -> None:
    limits = torsion_limits(shapes, np.array([friction]), np.array([cohesion]))
    rows = torsion_rows(limits, 1)
    draw = np.random.default_rng(1)
    drawn = [random_resultants(draw, draw.uniform(0.25, 2.0), 0.5) for _ in range(60)]
    for r in drawn:
        r[MN] *= limits.radii[0]
    agree(rows, drawn, [torsion_allowed(limits, shapes, r) for r in drawn])


def pieces_of(shapes: InterfaceShapes, strength: float, tension: float) -> Pieces:
    """Of one interface, in the unit of length of its shape."""
    outlines = [shapes.corners[shapes.start[0] : shapes.start[1]]]
    plates = pieces_in_space(shapes, outlines, np.array([0]), np.ones(1))
    kind = int(len(plates[1].owner) > 0)
    total = np.array([strength + tension])
    return with_conditions(plates[kind], ("parallelogram", "triangle")[kind], total, np.array([tension]))


@pytest.mark.parametrize(
    "shapes",
    [RECTANGLE, PARALLELOGRAM, TRIANGLE, PENTAGON],
    ids=["rectangle", "parallelogram", "triangle", "pentagon, of five triangles"],
)
@pytest.mark.parametrize("tension", [0.0, 0.25])
def test_crushing(shapes: InterfaceShapes, tension: float) -> None:
    """As the verification has it: what a stress between nothing and the strength carries."""
    none = np.zeros(60)
    every = copies(shapes, len(none))
    laws = InterfaceLaws(every, none, none, none + tension, none + 2.0 + tension, none > 0.0, none == 0.0)
    # r = (N, Σ n x_1, Σ n x_2) from the resultants
    places = (np.array([1.0, -1.0, 1.0]), ([0, 1, 2], [N, M2, M1]))
    map_ = sp.csr_array(sp.coo_array(places, shape=(3, 6)))
    found = CrushingOfProgram(map_, sp.csr_array(map_.T), (pieces_of(shapes, 2.0, tension),), np.ones(2, dtype=bool))
    of_program = crushing_conditions(found)
    rows = ConditionRows(of_program.velocities, of_program.cost, of_program.cones, of_program.cone_sizes)
    draw = np.random.default_rng(2)
    drawn = [random_resultants(draw, draw.uniform(-0.5, 2.5), 0.75) for _ in none]
    allowed = (crushing_excess(laws, np.array(drawn)) <= 0.0).tolist()
    agree(rows, drawn, allowed)
    for reserves in of_program.reserves:
        assert [bool(reserves.of(r).min() >= 0.0) for r in drawn] == allowed


@pytest.mark.parametrize(
    ("text", "strength", "of_each"),
    [(WALL, (), (8, 2)), (BLOCK, (), (8, 2)), (BLOCK, ("joints.dry.compressive_strength=1e6",), (8 + 72, 2 + 28))],
    ids=["wall", "block", "block that can crush"],
)
def test_every_interface_adds_the_unknowns_and_cones_of_its_conditions(
    text: str, strength: tuple[str, ...], of_each: tuple[int, int]
) -> None:
    """Torsion: 8 unknowns, 2 cones.

    Crushing of a rectangle: at its 4 corners, and of what is left of full stress, 5 unknowns and one for each of 2
    bounds, 3 cones; 4 of each of 4 edges, one cone.
    """
    line = line_of(text, *strength)
    twisting = TwistingInterfaces.of(line.model, line.contacts)
    conditions = with_conditions_of(line.program, CrushingInterfaces.of(line.model, line.contacts), twisting).conditions
    assert conditions is not None
    n = len(line.contacts)
    assert len(conditions.cost) == of_each[0] * n
    assert int((conditions.cone_sizes > 1).sum()) == of_each[1] * n
