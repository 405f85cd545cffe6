"""The shapes that drawings in space are made of, and their legends; what needs pixels is drawn small."""

from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import PURPLE, SLIDE, THRUST
from mbla.results.pictures.scene import OUTSIDE_WORDS, Scene, scene_of
from mbla.results.pictures.space import can_draw
from mbla.results.pictures.space.camera import fitted
from mbla.results.pictures.space.drawings import forces_drawing, mechanism_drawing, model_drawing
from mbla.results.pictures.space.joints import joint_marks
from mbla.results.pictures.space.picture import USUAL, best_view, draw_in_space
from mbla.results.pictures.space.renderer import Renderer
from mbla.results.pictures.space.shapes import MANY, Faces, ghost_lines, grounds, painted, rgb
from mbla.results.results import Results
from mbla.solution.solution import ContactMode
from tests.results.opengl import needs_opengl
from tests.results.pictures.rows_and_columns import column_of_blocks, row_of_blocks
from tests.results.synthetic import cuboids, tower_results

SMALL = PictureOptions(size=(400, 250), view=(-60.0, 25.0))


def scene(results: Results, kind: str) -> Scene:
    return scene_of(results, results.cases[0], SMALL, kind)


def with_mechanics(results: Results, **changes: Any) -> Results:
    """The same with something of its only mechanism changed."""
    case = results.cases[0]
    assert case.solution.mechanics is not None
    solution = replace(case.solution, mechanics=replace(case.solution.mechanics, **changes))
    return replace(results, cases=(replace(case, solution=solution),))


def sliding(*motion: float) -> Results:
    """One block on the ground that slides at all its corners."""
    points = row_of_blocks(1).contacts.points - np.array([0.5, 0.5, 1.0])
    speeds = np.array(motion[:3]) + np.cross(motion[3:], points)
    return with_mechanics(
        row_of_blocks(1),
        mechanism=np.array([motion]),
        contact_velocities=speeds[:, [2, 0, 1]],
        modes=np.full(4, ContactMode.SLIDE, dtype=np.int64),
    )


def of_colour(shapes: Any, colour: str) -> list[Faces]:
    """Shapes that are all of one colour."""
    return [each for each in shapes if isinstance(each, Faces) and (each.colours == rgb(colour)).all()]


def test_a_chain_of_blocks_has_a_tube_along_its_line_of_thrust() -> None:
    """Three joints with their forces at x = 0.5, 0.6 and 0.8: two tubes between them."""
    drawing = forces_drawing(scene(column_of_blocks(0.5, 0.6, 0.8), "forces"))
    assert ("line of thrust", THRUST) in drawing.legend
    (tubes,) = of_colour(drawing.marks, THRUST)
    ends = tubes.points.reshape(2, 4, 12, 3).mean(axis=2)[:, 1:3]
    assert ends == pytest.approx(np.array([[[0.5, 0.5, 1], [0.6, 0.5, 2]], [[0.6, 0.5, 2], [0.8, 0.5, 3]]]))


def test_a_force_outside_its_joint_is_drawn_at_the_edge() -> None:
    """The second acts at x = 3, two widths off; rods and line of thrust stay within the column."""
    drawing = forces_drawing(scene(column_of_blocks(0.5, 3.0, 0.5), "forces"))
    assert (OUTSIDE_WORDS, PURPLE) in drawing.legend
    (tubes,) = of_colour(drawing.marks, THRUST)
    assert tubes.points.reshape(2, 4, 12, 3).mean(axis=2)[0, 2] == pytest.approx([1, 0.5, 2])
    (rod,) = (each for each in drawing.marks if isinstance(each, Faces) and (each.colours == rgb(PURPLE)).any())
    assert rod.points[:, 0].max() < 1.2


@pytest.mark.parametrize("kind", ["model", "mechanism", "forces"])
def test_supports_and_ground_are_named_where_there_are_any(kind: str) -> None:
    """A column on a fixed block, blocks on the ground, and the tower, which has both."""
    make = {"model": model_drawing, "mechanism": mechanism_drawing, "forces": forces_drawing}[kind]
    named = [
        {name for name, _ in make(scene(results, kind)).legend}
        for results in (column_of_blocks(0.5, 0.5), row_of_blocks(2), tower_results())
    ]
    support = "fixed blocks" if kind == "model" else "support"
    assert [support in names for names in named] == [True, False, True]
    if kind == "model":
        assert ["ground" in names for names in named] == [False, True, True]


def test_without_ground_there_is_no_slab() -> None:
    assert grounds(scene(column_of_blocks(0.5), "model")) == ()
    faces, lines = grounds(scene(row_of_blocks(1), "model"))
    assert isinstance(faces, Faces)
    assert faces.ground
    assert lines.points[:, 2].max() == pytest.approx(0.0)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_block_that_twists_has_an_arrow_about_the_normal_its_way(sense: float) -> None:
    shown = scene(sliding(0, 0, 0, 0, 0, sense), "mechanism")
    _, marks, legend, _ = joint_marks(shown, shown, shown.moved)
    assert legend == [("sliding", SLIDE)]
    (ring,) = of_colour(marks, SLIDE)
    arms = ring.points - np.array([0.5, 0.5, 0.0])
    assert np.median(np.hypot(arms[:, 0], arms[:, 1])) == pytest.approx(0.35, rel=0.05)
    angle = np.unwrap(np.arctan2(arms[:, 1], arms[:, 0]).reshape(-1, 12).mean(axis=1)[:20])
    assert sense * (angle[-1] - angle[0]) > 0.0


def test_sliding_that_the_listing_does_not_tell_has_a_colour_and_no_arrow() -> None:
    shown = scene(sliding(1, 0, 0, 0, 0, 0), "mechanism")
    assert shown.failure is not None
    assert len(joint_marks(shown, shown, shown.moved)[1]) == 2
    vars(shown)["failure"] = replace(shown.failure, sliding_planes=())
    faces, marks, legend, _ = joint_marks(shown, shown, shown.moved)
    assert len(of_colour(faces, SLIDE)) == 1
    assert not marks
    assert legend == [("sliding", SLIDE)]


@pytest.mark.parametrize(("count", "told"), [(1, "coloured as one part"), (2, "coloured as 2 parts")])
def test_parts_taken_for_one_are_said_to_be(count: int, told: str) -> None:
    shown = scene(row_of_blocks(count), "mechanism")
    assert shown.failure is not None
    assert mechanism_drawing(shown).notes == ()
    vars(shown)["failure"] = replace(shown.failure, merged=0.05)
    (note,) = mechanism_drawing(shown).notes
    assert note == f"{told}: less than 5 % of the fastest contact counts as no motion, as in the listing"


@pytest.mark.parametrize("count", [MANY, MANY + 1])
def test_of_many_blocks_the_ghost_is_an_outline(count: int) -> None:
    """Cubes side by side in a bar: of many only its long edges, piece by piece, and those of both its ends."""
    tower = scene(tower_results(), "mechanism")
    lower = np.array([[float(i), 0, 0] for i in range(count)])
    blocks = cuboids(lower, lower + 1, ["bar"] * count)
    shown = replace(tower, model=replace(tower.model, blocks=blocks))
    lines = ghost_lines(shown, np.ones(count, dtype=bool))
    assert len(lines.pairs) == (12 * count if count <= MANY else 4 * count + 8)


def flattened(axis: int) -> Scene:
    """Two blocks in a row along x or y, thin across it, that rock in their plane."""
    shown = scene(row_of_blocks(2), "mechanism")
    vertices: FloatArray = shown.model.blocks.vertices * np.array([1.0, 0.05, 1.0])
    motion = shown.motion
    if axis == 1:
        vertices, motion = vertices[:, [1, 0, 2]], motion[:, [1, 0, 2, 4, 3, 5]] * np.array([1, 1, 1, -1, -1, 1])
    model = shown.model
    turned = replace(model, blocks=replace(model.blocks, vertices=vertices))
    return replace(shown, model=turned, drawn=motion)


@pytest.mark.parametrize(("axis", "view"), [(0, (-90.0, 0.0)), (1, (0.0, 0.0))])
def test_what_is_thin_is_seen_from_the_front(axis: int, view: tuple[float, float]) -> None:
    assert best_view(flattened(axis)) == view


def test_what_does_not_move_is_seen_as_usual() -> None:
    still = replace(scene(tower_results(), "mechanism"), drawn=np.zeros((3, 6)))
    assert best_view(still) == USUAL


@needs_opengl
def test_a_face_that_is_not_convex_does_not_cover_its_notch() -> None:
    """An L across x: white where its arm is missing."""
    corners = [[0, 0, 0], [0, 2, 0], [0, 2, 1], [0, 1, 1], [0, 1, 2], [0, 0, 2]]
    points = np.array(corners, float)
    with Renderer([painted(points, np.array([0, 6]), np.arange(6), "#0000FF", lit=False)], ()) as window:
        camera = fitted(points, 0.0, 0.0, 1.0, ((0.0, 1.0), (0.0, 1.0)))
        image = window.image(camera, 40, 40, 0.0)
    assert image[10, 30] == pytest.approx([1.0, 1.0, 1.0])
    for row, column in ((30, 10), (30, 30), (10, 10)):
        assert image[row, column] == pytest.approx([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("platform", "libraries", "display", "draws"),
    [
        ("darwin", (), "", True),
        ("linux", (), "", False),
        ("linux", ("libEGL.so.1",), "", True),
        ("linux", ("libOSMesa.so.6",), "", True),
        ("linux", ("libGL.so.1",), "", False),
        ("linux", ("libGL.so.1",), ":0", True),
        ("linux", (), ":0", False),
    ],
)
def test_a_machine_draws_with_the_libraries_it_has(
    monkeypatch: pytest.MonkeyPatch, platform: str, libraries: tuple[str, ...], display: str, draws: bool
) -> None:
    def load(name: str) -> None:
        if name not in libraries:
            raise OSError(name)

    monkeypatch.setattr("sys.platform", platform)
    monkeypatch.setattr("ctypes.CDLL", load)
    monkeypatch.setenv("DISPLAY", display)
    assert can_draw() is draws


@needs_opengl
@pytest.mark.parametrize("zoom", [True, False])
def test_a_small_part_that_moves_is_enlarged_unless_it_is_not_wanted(tmp_path: Path, zoom: bool) -> None:
    """The first of eight blocks in a row turns, the others stay."""
    results = row_of_blocks(8)
    mechanism = np.zeros((8, 6))
    mechanism[0] = [1, 0, 0.5, 0, 1, 0]
    velocities = np.zeros((32, 3))
    velocities[[0, 3], 0] = 1.0
    modes = np.zeros(32, dtype=np.int64)
    modes[[0, 3]] = ContactMode.OPEN
    results = with_mechanics(results, mechanism=mechanism, contact_velocities=velocities, modes=modes)
    options = replace(SMALL, zoom=zoom)
    draw_in_space(tmp_path / "a.svg", scene_of(results, results.cases[0], options, "mechanism"), "mechanism", options)
    tree = ElementTree.parse(tmp_path / "a.svg")
    texts = ["".join(node.itertext()) for node in tree.iter("{http://www.w3.org/2000/svg}text")]
    assert any("what moves, enlarged" in text for text in texts) is zoom
    images = list(tree.iter("{http://www.w3.org/2000/svg}image"))
    assert len(images) == 1 + zoom
