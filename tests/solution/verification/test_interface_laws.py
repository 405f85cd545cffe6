"""The closed forms of the verification against brute force: points sampled from the sets that they describe."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.resultants.stress_blocks import pieces_in_space, with_conditions
from mbla.solution.law.crushing_interfaces import StressBlockBounds
from mbla.solution.verification.interface_laws import (
    InterfaceLaws,
    crushing_excess,
    crushing_power,
    interface_laws,
    shear_strength,
    sliding_power,
    torsion_excess,
    torsion_power,
)
from tests.line import HEAD, line_of
from tests.program.resultants.polygons import points_inside
from tests.program.resultants.test_shapes import shapes_of
from tests.solution.outlines import OUTLINES, PIECES, STRENGTH, area_of, full_stress, laws_of, random_closing

ONE = (
    HEAD
    + """\
joints: {dry: {friction: 0.5, cohesion: 3000, tensile_strength: 1000, compressive_strength: 50000}}
blocks:
  - polyhedron: {group: block, material: stone, vertices: VERTICES, faces: FACES}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
SHAPES: dict[str, list[tuple[float, float]]] = {
    "rectangle": [(0, 0), (1.2, 0), (1.2, 0.7), (0, 0.7)],
    "turned": [(0, 0), (0.8, 0.6), (0.5, 1.0), (-0.3, 0.4)],
    "pentagon": [(0, 0), (1, 0), (1.3, 0.6), (0.6, 1.1), (-0.2, 0.5)],
}


def laws_of_shape(name: str) -> InterfaceLaws:
    outline = SHAPES[name]
    n = len(outline)
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    text = ONE.replace("VERTICES", str(vertices)).replace("FACES", str(faces))
    whole = line_of(text, "joints.dry={friction: 0.5}").contacts  # a joint that can crush is in pieces
    return interface_laws(line_of(text).model, whole, "convex")


def many(laws: InterfaceLaws, n: int) -> InterfaceLaws:
    """The same interface n times."""
    start = np.append(np.tile(laws.shapes.start[:-1], 1), len(laws.shapes.corners))
    count = int(start[1])
    shapes = laws.shapes.__class__(
        corners=np.tile(laws.shapes.corners, (n, 1)),
        start=count * np.arange(n + 1),
        **{
            name: np.repeat(getattr(laws.shapes, name), n, axis=0)
            for name in ("convex", "rectangles", "sides", "axes", "radii", "thetas")
        },
    )
    rest = ("friction", "cohesion", "tension", "strength", "torsional", "crushable")
    return InterfaceLaws(shapes, **{name: np.repeat(getattr(laws, name), n) for name in rest})


def beyond_outline(laws: InterfaceLaws, r: FloatArray) -> FloatArray:
    """Positive where the force point of N + f_t A lies outside of the outline."""
    moment = np.column_stack([-r[:, 5], r[:, 4]])
    of_edge = (laws.shapes.edge_slopes() * moment[laws.shapes.interface_of_corner]).sum(axis=1)
    return np.asarray(of_edge.reshape(len(r), -1).max(axis=1) - r[:, 0] - laws.tension)


def admissible(laws: InterfaceLaws, n: int) -> FloatArray:
    """Random resultants at the border of torsion, or of the strength: directions from a point well inside."""
    rng = np.random.default_rng(7)
    size = float(laws.strength[0])
    arm = float(laws.shapes.radii[0])
    scale = size * np.array([0.3, 0.2, 0.2, 0.2 * arm, 0.3 * arm, 0.3 * arm])
    centre = np.array([0.3 * size, 0, 0, 0, 0, 0])
    direction = rng.normal(size=(n, 6)) * scale
    low, high = np.zeros(n), np.full(n, 20.0)
    laws = many(laws, n)
    for _ in range(60):
        middle = 0.5 * (low + high)
        r = centre + middle[:, None] * direction
        inside = (torsion_excess(laws, r) <= 0) & (r[:, 0] <= size) & (beyond_outline(laws, r) <= 0)
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    return np.asarray(centre + low[:, None] * direction)


@pytest.mark.parametrize("name", SHAPES)
def test_torsion_dissipates_at_most_what_is_said(name: str) -> None:
    laws = laws_of_shape(name)
    rng = np.random.default_rng(2)
    r = admissible(laws, 3000)
    for motion in rng.normal(size=(40, 6)) * np.array([0.2, 1, 1, 3, 0.3, 0.3]):
        power, lack = torsion_power(laws, motion[None])
        motion[0] += max(float(lack[0]), 0.0)  # opens just enough
        power, lack = torsion_power(laws, motion[None])
        assert lack[0] <= 1e-12
        assert (-(r @ motion)).max() <= power[0] * (1 + 1e-9)
        # with any less opening some pressure, taken often enough, dissipates without bound
        lacking = motion - 1e-3 * np.eye(6)[0]
        assert torsion_power(laws, lacking[None])[1][0] > 0


def test_sliding_without_dilatancy_is_the_support_of_the_section() -> None:
    laws = laws_of_shape("rectangle")
    r = np.array([20000.0, 0, 0, 0, 900.0, -700.0])
    rng = np.random.default_rng(3)
    direction = rng.normal(size=(8000, 3)) * [1, 1, 0.3]
    low, high = np.zeros(8000), np.full(8000, 1e6)
    repeated = many(laws, 8000)
    for _ in range(60):
        middle = 0.5 * (low + high)
        at = np.tile(r, (8000, 1))
        at[:, 1:4] = middle[:, None] * direction
        inside = torsion_excess(repeated, at) <= 0
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    border = low[:, None] * direction
    for motion in rng.normal(size=(20, 3)) * [1, 1, 3]:
        found = float(sliding_power(laws, r[None], np.array([[0, *motion, 0, 0]]))[0])
        most = (-(border @ motion)).max()
        assert most <= found * (1 + 1e-9)
        assert most >= 0.98 * found


# Crushing of interfaces against full stress over parts that are cut out of their outlines.


TENSION = 3.0
"""f_t A."""
N_CUTS = 40


def at_the_border(name: str, tension: float = 0.0) -> FloatArray:
    """Resultants of full stress over random parts, (n, 6)."""
    shapes = laws_of(name, 1).shapes
    strength = STRENGTH + tension / area_of(shapes)
    carried = np.array([full_stress(shapes, q) for q in random_closing(shapes, N_CUTS, 5)]) * strength
    resultants = np.zeros((N_CUTS, 6))
    resultants[:, [0, 4, 5]] = carried
    resultants[:, 0] -= tension
    return resultants


def with_moment(resultants: FloatArray, share: float) -> FloatArray:
    changed = resultants.copy()
    changed[:, 4:] *= share
    return changed


@pytest.mark.long
@pytest.mark.parametrize("tension", [0.0, TENSION])
@pytest.mark.parametrize("name", OUTLINES)
def test_full_stress_over_any_part_is_at_the_border(name: str, tension: float) -> None:
    laws, border = laws_of(name, N_CUTS, tension), at_the_border(name, tension)
    assert crushing_excess(laws, border) == pytest.approx(np.zeros(N_CUTS), abs=1e-9 * laws.strength[0])
    assert np.all(crushing_excess(laws, with_moment(border, 1.001)) > 0)
    assert np.all(crushing_excess(laws, with_moment(border, 0.999)) < 0)


def beyond_pieces(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """How far resultants, (n, 6), are beyond the conditions of the program, (n,): parallelograms or triangles."""
    shapes, n = laws.shapes, len(resultants)
    outlines = np.split(shapes.corners, shapes.start[1:-1])
    plates = pieces_in_space(shapes, outlines, np.arange(n), np.ones(n))
    kind = int(len(plates[1].owner) > 0)
    pieces = with_conditions(plates[kind], ("parallelogram", "triangle")[kind], laws.strength, laws.tension)
    of_pieces = np.stack([resultants[:, 0], -resultants[:, 5], resultants[:, 4]])
    return np.asarray(-StressBlockBounds(pieces, sp.csr_array((n, 1)), 1.0).values(of_pieces, np.zeros(0)).min(axis=0))


@pytest.mark.parametrize("tension", [0.0, TENSION])
@pytest.mark.parametrize("name", PIECES)
def test_the_conditions_of_the_program_have_the_same_border(name: str, tension: float) -> None:
    laws, border = laws_of(name, N_CUTS, tension), at_the_border(name, tension)
    assert beyond_pieces(laws, border) == pytest.approx(np.zeros(N_CUTS), abs=1e-9 * laws.strength[0])
    assert np.all(beyond_pieces(laws, with_moment(border, 1.001)) > 0)
    assert np.all(beyond_pieces(laws, with_moment(border, 0.999)) < 0)


@pytest.mark.long
@pytest.mark.parametrize("name", PIECES)
def test_both_agree_anywhere(name: str) -> None:
    """Random forces: pressed too much, pulled, beside the middle, within."""
    laws, draw = laws_of(name, 400), np.random.default_rng(4)
    size, arm = float(laws.strength[0]), float(laws.shapes.radii[0])
    resultants = np.zeros((400, 6))
    resultants[:, 0] = draw.uniform(-0.2, 1.2, 400) * size
    resultants[:, 4:] = draw.normal(scale=0.2 * size * arm, size=(400, 2))
    excess = crushing_excess(laws, resultants)
    violation = beyond_pieces(laws, resultants)
    clear = np.abs(excess) > 1e-9 * size
    assert np.array_equal(excess[clear] > 0, violation[clear] > 0)
    assert set((excess > 0).tolist()) == {False, True}


def test_no_more_than_the_strength_and_no_tension() -> None:
    laws = laws_of("trapezium", 4)
    size = float(laws.strength[0])
    resultants = np.zeros((4, 6))
    resultants[:, 0] = (size, 0.0, 1.25 * size, -0.25 * size)
    expected = (0.0, 0.0, 0.25 * size, 0.25 * size)
    assert crushing_excess(laws, resultants) == pytest.approx(expected, abs=1e-9 * size)


@pytest.mark.parametrize("name", OUTLINES)
def test_power_is_that_of_full_stress_where_it_closes(name: str) -> None:
    """Against Gauss points over the whole area; what opens takes the tensile strength."""
    laws = laws_of(name, N_CUTS, TENSION)
    closing = random_closing(laws.shapes, N_CUTS, 6)
    motions = np.zeros((N_CUTS, 6))
    motions[:, [0, 4, 5]] = -closing
    motions[:, 1:4] = 7.0  # slip and twist crush nothing
    points, weights = points_inside(laws.shapes.corners[: laws.shapes.start[1]], 240)
    at_points = closing[:, :1] + closing[:, 1:2] * points[:, 1] - closing[:, 2:] * points[:, 0]
    expected = laws.strength[0] * (np.maximum(at_points, 0.0) @ weights) - TENSION * closing[:, 0]
    largest = np.abs(at_points).max(axis=1)
    assert np.abs(crushing_power(laws, motions) - expected).max() < 1e-4 * (laws.strength[0] * largest).max()
    assert crushing_power(laws, motions) == pytest.approx(expected, abs=2e-4 * float((laws.strength * largest).min()))
    border = with_moment(at_the_border(name, TENSION), 1.0)
    found = crushing_power(laws, motions)
    assert np.all(-(border @ (motions * [1, 0, 0, 0, 1, 1]).T) <= found * (1 + 1e-12) + 1e-12)


def test_what_cannot_crush_takes_any_power_or_none() -> None:
    laws = laws_of("rectangle", 2)
    laws = type(laws)(**{**vars(laws), "crushable": np.array([False, False])})
    motions = np.zeros((2, 6))
    motions[1, 0] = -1e-9
    assert crushing_power(laws, motions).tolist() == [0.0, np.inf]
    assert np.all(crushing_excess(laws, 1e9 * np.ones((2, 6))) == -np.inf)


TRIANGLE = ((0.0, 0.0), (1.0, 0.0), (0.25, 0.75))


def triangle(friction: float = 0.5, cohesion: float = 0.0) -> InterfaceLaws:
    return InterfaceLaws(
        shapes=shapes_of(*TRIANGLE),
        friction=np.array([friction]),
        cohesion=np.array([cohesion]),
        tension=np.zeros(1),
        strength=np.array([np.inf]),
        torsional=np.array([friction > 0.0 or cohesion > 0.0]),
        crushable=np.array([False]),
    )


def pressed_at(place: FloatArray, normal: float = 2.0) -> FloatArray:
    """Resultants of a normal force at a place of the interface, from its centroid."""
    return np.array([[normal, 0.0, 0.0, 0.0, place[1] * normal, -place[0] * normal]])


@pytest.mark.parametrize("cohesion", [0.0, 0.25])
def test_what_acts_over_the_whole_area_falls_to_the_corners_and_edges(cohesion: float) -> None:
    """R = μ N (1 - t) + c A with the force on the way t from the centroid to the outline."""
    laws = triangle(cohesion=cohesion)
    corners = laws.shapes.corners
    for place in (*corners, *(0.5 * (corners + np.roll(corners, -1, axis=0)))):
        for t in (0.0, 0.25, 1.0):
            total, share = shear_strength(laws, pressed_at(t * place))
            assert total == pytest.approx(0.5 * 2.0 + cohesion)
            assert share == pytest.approx((1 - t) * 0.5 * 2.0 + cohesion, abs=1e-12)


def test_the_rest_of_torsion_is_what_no_twist_needs() -> None:
    """All of R at rest, none where the limit is reached, and less than none beyond."""
    laws, r = triangle(), pressed_at(np.zeros(2))
    for twist, left in ((0.0, 1.0), (0.25, 0.75), (1.0, 0.0), (2.0, -1.0)):  # μ N = 1: m of the curve of this size
        r[0, 3] = twist * laws.shapes.radii[0]
        assert -torsion_excess(laws, r) == pytest.approx(left, abs=1e-12)
    assert np.isneginf(torsion_excess(triangle(0.0), r)).all()
