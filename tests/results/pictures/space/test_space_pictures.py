"""What is on the pictures, found in their pixels."""

from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.results.collapse.force_freedom import ForceFreedom
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import HINGE, OPEN, SLIDE, WARNING, group_colours
from mbla.results.pictures.scene import Scene, scene_of, tint_of_part
from mbla.results.pictures.space import drawings
from mbla.results.pictures.space.camera import Panel, fitted
from mbla.results.pictures.space.drawings import (
    PARTS,
    mechanism_drawing,
    model_drawing,
    resultant_rods,
)
from mbla.results.pictures.space.joints import joint_marks
from mbla.results.pictures.space.picture import draw_in_space, images_of, view_of_case
from mbla.results.pictures.space.renderer import Renderer
from mbla.results.pictures.space.shapes import Faces, Lines, painted, rgb
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.line import BLOCK, case_of, line_of
from tests.results.opengl import needs_opengl
from tests.results.synthetic import tower_results

SMALL = PictureOptions(size=(400, 250), view=(-60.0, 25.0))


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def scene(results: Results, kind: str, case: int = 0) -> Scene:
    return scene_of(results, results.cases[case], SMALL, kind)


def near(image: Any, colour: Any, distance: float = 0.12) -> int:
    """How many pixels, 0 to 1, are about of this colour."""
    return int((np.abs(image - colour).max(axis=2) < distance).sum())


def picture(path: Path, a_scene: Scene, kind: str) -> Any:
    from PIL import Image

    draw_in_space(path, a_scene, kind, SMALL)
    with Image.open(path) as image:
        return np.asarray(image)[..., :3] / 255


def square(x: float, size: float, colour: str) -> Faces:
    """Across x, unlit."""
    points = np.array([[x, -size, -size], [x, size, -size], [x, size, size], [x, -size, size]])
    return painted(points, np.array([0, 4]), np.arange(4), colour, lit=False)


@needs_opengl
@pytest.mark.parametrize(("shine", "share"), [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0)])
def test_hidden_marks_shine_through_by_the_strength_asked_for(shine: float, share: float) -> None:
    with Renderer([square(1.0, 1.0, "#0000FF")], [square(0.0, 0.5, "#FF0000")]) as renderer:
        camera = fitted(np.array([[0.0, -1, -1], [1.0, 1, 1]]), 0.0, 0.0, 1.0)
        image = renderer.image(camera, 60, 60, shine)
    middle = image[30, 30]
    assert middle == pytest.approx([share, 0.0, 1 - share], abs=0.01)


@needs_opengl
def test_each_image_is_of_its_own_camera() -> None:
    """The second is taken along the square, which is a line from there."""
    with Renderer([square(0.0, 1.0, "#0000FF")], ()) as renderer:
        extent = np.array([[-1.0, -1, -1], [1.0, 1, 1]])
        seen = [near(renderer.image(fitted(extent, azimuth, 0.0, 1.0), 60, 60, 0.0), [0, 0, 1]) for azimuth in (0, 90)]
    assert seen[0] > 800
    assert seen[1] < 150


def test_the_rod_of_a_hinge_lies_on_its_axis(results: Results) -> None:
    """The tower turns about the edge x = 1, z = 1, from y = 0 to y = 1, and that edge does not move."""
    drawing = mechanism_drawing(scene(results, "mechanism"))
    vermilion = [mark for mark in drawing.marks if isinstance(mark, Faces) and (mark.colours == rgb(HINGE)).all()]
    assert len(vermilion) == 1
    points = vermilion[0].points
    assert points[:, [0, 2]].mean(axis=0) == pytest.approx([1.0, 1.0])
    assert points[:, 1].min() == pytest.approx(0.0, abs=1e-9)
    assert points[:, 1].max() == pytest.approx(1.0, abs=1e-9)


def test_what_is_told_in_the_legend_is_what_there_is(results: Results) -> None:
    names = [name for name, _ in mechanism_drawing(scene(results, "mechanism")).legend]
    assert names[:2] == ["hinge", "opening"]
    assert "sliding" not in names
    assert names[-3:] == ["at rest", "before", "support"]
    falling = [name for name, _ in mechanism_drawing(scene(results, "mechanism", 1)).legend]
    assert "hinge" not in falling
    assert "before" in falling
    still = replace(scene(results, "mechanism"), drawn=np.zeros((3, 6)))
    assert not {"before", "hinge"} & {name for name, _ in mechanism_drawing(still).legend}


def test_of_many_parts_those_that_touch_have_different_tints(results: Results) -> None:
    """Parts 1, 2 and one beyond the number of tints; the first touches both others, which touch nothing else."""
    tower = scene(results, "mechanism")
    neighbours = replace(tower.contacts, bodies=np.array([[0, 1], [0, 2]]))
    apart = replace(tower, contacts=neighbours)
    tints = tint_of_part(apart, np.array([1, 2, len(PARTS) + 1]), len(PARTS))
    assert tints[1] != tints[2]
    assert tints[1] != tints[len(PARTS) + 1]
    assert tints[2] == tints[len(PARTS) + 1]


def test_joints_of_the_listing_stand_out_the_others_are_thin(results: Results) -> None:
    """The hinge of the tower is the only one; where the failure does not tell it, it is a thin line."""
    tower = scene(results, "mechanism")
    _, marks, _, notes = joint_marks(tower, tower, tower.moved)
    assert not any(isinstance(mark, Lines) for mark in marks)
    assert not notes
    assert tower.failure is not None
    untold = replace(tower)
    vars(untold)["failure"] = replace(tower.failure, hinge_lines=())
    _, marks, legend, notes = joint_marks(untold, untold, tower.moved)
    assert [type(mark) for mark in marks] == [Lines]
    assert ("hinge", HINGE) in legend
    assert notes == ("thin: 1 hinge within a part or of little motion",)


@pytest.mark.parametrize("push", [1, -1])
def test_the_arrow_of_a_block_that_slides_points_where_it_goes(results: Results, push: int) -> None:
    """The head, which is thicker than the shaft, is at the front; the ground is the second body of the interface."""
    text = BLOCK.replace("acceleration: [1,", f"acceleration: [{push},").replace("associative", "non_associative")
    model, case = case_of(text, "parameters.mu=0.2")
    sliding = replace(results, model=model, contacts=line_of(text).contacts, cases=(case,))
    shown = scene(sliding, "mechanism")
    _, marks, legend, _ = joint_marks(shown, shown, shown.moved)
    assert legend == [("sliding", SLIDE)]
    (arrow,) = (mark for mark in marks if isinstance(mark, Faces))
    middle = np.ptp(arrow.points[:, 0]) / 2 + arrow.points[:, 0].min()
    reach = np.abs(arrow.points[:, 1] - arrow.points[:, 1].mean())
    widest = arrow.points[reach > 0.9 * reach.max(), 0]
    assert (push * (widest - middle) > 0).all()


def test_only_the_largest_resultants_are_drawn_and_the_rest_is_told(
    results: Results, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The tower has two; one is let through."""
    monkeypatch.setattr(drawings, "MOST_RODS", 1)
    at_rest = scene(results, "forces")
    assert at_rest.thrust is not None
    sizes = np.linalg.norm(at_rest.thrust.forces, axis=1)
    assert drawings.drawn_resultants(at_rest.thrust).tolist() == [int(np.argmax(sizes))]
    share = 100 * sizes.min() / sizes.max()
    assert f"1 force up to {share:.2g} % of it not drawn" in drawings.forces_drawing(at_rest).notes[0]


def test_forces_that_are_not_unique_are_said_to_be_one_state(results: Results) -> None:
    at_rest = scene(results, "forces")
    for degree, told in ((0, False), (3, True)):
        vars(at_rest)["force_freedom"] = ForceFreedom(degree, np.array([True, False]))
        notes = " ".join(at_rest.words_of("forces"))
        assert ("one possible state" in notes) is told
    assert "up to 3 ways, 1 of 2 resultants are unique" in notes


def test_an_enlarged_panel_has_no_loads(results: Results) -> None:
    """An arrow over the middle of the whole would be cut by the edge of the part."""
    drawing = mechanism_drawing(scene(results, "mechanism"))
    assert drawing.loads
    assert not set(map(id, drawing.loads)) & set(map(id, drawing.marks))
    asked: list[bool] = []

    class Asked:
        def image(self, camera: object, width: int, height: int, shine: float, *, loads: bool) -> FloatArray:
            asked.append(loads)
            return np.zeros((height, width, 3))

    camera = fitted(drawing.extent, -60.0, 25.0, 1.6)
    panels = [Panel(camera, (0.0, 0.4)), Panel(camera, (0.4, 1.0), gain=2.0)]
    images_of(cast(Renderer, Asked()), panels, drawing, (100, 50))
    assert asked == [True, False]


def test_words_of_loads_are_told_in_full(results: Results) -> None:
    """Two forces of a couple, both with their places; what applies twice is told once."""
    case = results.cases[0]
    words = (
        "force (0, 9810, 0) N on block[0] at (1, 0.5, 0.25) m",
        "force (0, -9810, 0) N on block[0] at (0, 0.5, 0.25) m",
    )
    changed = replace(case, load_case=replace(case.load_case, live_words=(*words, words[1])))
    legend = dict(mechanism_drawing(scene(replace(results, cases=(changed,)), "mechanism")).legend)
    (name,) = (name.replace("\n", " ") for name in legend if name.startswith("live load"))
    assert name == f"live load: {words[0]}; 2 times {words[1]}"


@needs_opengl
def test_the_view_of_a_case_is_found_once(results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    found: list[Scene] = []

    def counted_view(asked: Scene) -> tuple[float, float]:
        found.append(asked)
        return 1.0, 2.0

    monkeypatch.setattr("mbla.results.pictures.space.picture.best_view", counted_view)
    case = replace(results.cases[0])
    of_its_own = replace(results, cases=(case,))
    views = [view_of_case(scene(of_its_own, kind)) for kind in ("model", "mechanism", "forces")]
    assert views == 3 * [(1.0, 2.0)]
    assert len(found) == 1
    view_of_case(scene(replace(results, cases=(replace(case),)), "model"))
    assert len(found) == 2


def test_the_ground_does_not_hide_the_structure_from_below(results: Results) -> None:
    """Its outline stays."""
    model, case = case_of(BLOCK)
    on_ground = replace(results, model=model, contacts=line_of(BLOCK).contacts, cases=(case,))
    drawing = model_drawing(scene(on_ground, "model"))
    above, below = drawing.solid_from(25.0), drawing.solid_from(-30.0)
    assert above == drawing.solid
    assert len(below) == len(above) - 1
    assert [shape.ground for shape in below if isinstance(shape, Faces)] == [False]


def test_sections_of_rods_are_in_proportion_to_forces(results: Results) -> None:
    at_rest = scene(results, "forces")
    thrust = at_rest.thrust
    assert thrust is not None
    rods = resultant_rods(at_rest, thrust, plain=True)
    sizes = np.linalg.norm(thrust.forces, axis=1)
    per_rod = len(rods.points) // 2
    radii = []
    for row in range(2):
        points = rods.points[row * per_rod : (row + 1) * per_rod]
        unit = thrust.forces[row] / sizes[row]
        arms = points - thrust.points[row]
        radii.append(float(np.linalg.norm(arms - (arms @ unit)[:, None] * unit, axis=1).max()))
    assert radii[0] ** 2 / radii[1] ** 2 == pytest.approx(sizes[0] / sizes[1], rel=1e-9)


@needs_opengl
def test_the_view_faces_the_side_towards_which_the_tower_falls(results: Results) -> None:
    """It falls towards +x: the eye stands there, above it."""
    azimuth, elevation = view_of_case(scene(results, "model"))
    assert np.cos(np.deg2rad(azimuth)) > 0
    assert elevation > 0


@needs_opengl
def test_pictures_show_hinge_gap_and_tinted_part(tmp_path: Path, results: Results) -> None:
    image = picture(tmp_path / "a.png", scene(results, "mechanism"), "mechanism")
    assert image.shape == (250, 400, 3)
    assert near(image, rgb(HINGE)) > 20
    assert near(image, rgb(OPEN)) > 20
    assert int((image[..., 2] - image[..., 0] > 0.1).sum()) > 300  # the first tint is blue, in light and in shade
    still = picture(tmp_path / "b.png", scene(results, "model"), "model")
    red, _, blue = rgb(group_colours(results.model.blocks.groups)["tower"])
    of_tower = np.sign(blue - red) * (still[..., 2] - still[..., 0])
    assert int((of_tower > 0.1).sum()) > 300
    assert near(still, rgb(OPEN)) < 5


@needs_opengl
def test_figures_that_are_no_result_are_framed_in_red(tmp_path: Path, results: Results) -> None:
    case = replace(results.cases[0], status=Status.NOT_VERIFIED)
    doubtful = scene_of(results, case, SMALL, "mechanism")
    image = picture(tmp_path / "a.png", doubtful, "mechanism")
    assert near(image[:, :2], rgb(WARNING)) > 300
    good = picture(tmp_path / "b.png", scene(results, "mechanism"), "mechanism")
    assert near(good[:, :2], rgb(WARNING)) == 0


@needs_opengl
def test_the_structure_is_the_same_size_in_every_unit(results: Results, tmp_path: Path) -> None:
    """The same picture of a tower a thousand times as large and far away, but for the words."""
    blocks, contacts = results.model.blocks, results.contacts
    far = np.array([2e6, -1e6, 0.0])
    large = replace(
        blocks,
        vertices=1e3 * blocks.vertices + far,
        centroids=1e3 * blocks.centroids + far,
        volumes=1e9 * blocks.volumes,
    )
    moved = replace(contacts, points=1e3 * contacts.points + far, centroids=1e3 * contacts.centroids + far)
    grown = replace(results, model=replace(results.model, blocks=large), contacts=moved)
    images = []
    for each in (results, grown):
        drawing = model_drawing(scene(each, "model"))
        shapes = [shape for shape in drawing.solid if isinstance(shape, Faces)][-1]
        with Renderer([shapes], ()) as renderer:
            images.append(renderer.image(fitted(shapes.points, -60.0, 25.0, 1.6), 160, 100, 0.0))
    assert np.abs(images[0] - images[1]).mean() < 0.005
