"""Pictures as a whole: their words, legends and pixels, in the plane and in space."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.results.pictures.camera import axes_of, fitted, view_of_case
from mbla.results.pictures.drawing import draw_on, drawing_of, extent_of
from mbla.results.pictures.marks.marks import segments
from mbla.results.pictures.options import VIEWS, PictureOptions
from mbla.results.pictures.page import GROUPS, HINGE, OPEN, SLAB, WARNING, group_colours, open_page, rgb, round_length
from mbla.results.pictures.plane import HATCH
from mbla.results.pictures.plot import draw_picture
from mbla.results.pictures.renderer import SHINE, can_draw, image_of
from mbla.results.pictures.scene import MOST_GROUPS, PictureScene, scene_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status
from tests.results.opengl import needs_opengl
from tests.results.pictures.rows_and_columns import row_of_blocks
from tests.results.synthetic import full_model, tower_results

NAMED = "{http://www.w3.org/2000/svg}"
ISO = PictureOptions(size=(400, 250), view=(-60.0, 25.0))


def scene(results: Results | None = None, kind: str = "mechanism", case: int = 0, **options: Any) -> PictureScene:
    results = results or tower_results()
    return scene_of(results, results.cases[case], PictureOptions(**options), kind)


def mechanics_of(results: Results) -> Mechanics:
    mechanics = results.cases[0].solution.mechanics
    assert mechanics is not None
    return mechanics


def drawn(
    tmp_path: Path, kind: str, results: Results | None = None, case: CaseResult | None = None, **options: Any
) -> tuple[list[str], str]:
    """Texts of a figure, and the whole of it."""
    results = results or tower_results()
    path, chosen = tmp_path / "figure.svg", PictureOptions(**options)
    draw_picture(path, scene_of(results, case or results.cases[0], chosen, kind), kind, chosen)
    tree = ElementTree.parse(path)
    return [" ".join("".join(node.itertext()).split()) for node in tree.iter(f"{NAMED}text")], path.read_text()


@pytest.mark.parametrize(
    ("kind", "named"),
    [
        ("model", {"ground", "fixed", "tower", "brick", "dead load: gravity (0, 0, -9.81) m/s2"}),
        ("mechanism", {"hinge", "opening", "part 1", "at rest", "before it moves"}),
        ("forces", {"at the edge of the joint", "live load: acceleration (1, 0, 0) g on all blocks"}),
    ],
)
def test_a_plane_figure_is_made_of_lines_and_names_what_it_shows(tmp_path: Path, kind: str, named: set[str]) -> None:
    texts, svg = drawn(tmp_path, kind)
    assert "<image" not in svg
    assert texts[0] == "Tower and brick"
    assert named | {"x", "y", "z", "1 m"} <= set(texts)
    if kind == "mechanism":
        assert "sliding" not in texts
        assert "load case push_x: collapses at 0.5 g, verified" in texts
        assert HINGE.lower() in svg.lower()
        assert OPEN.lower() in svg.lower()
    if kind == "forces":
        assert any("largest 11.1803 N" in text for text in texts), "weight 10 N and push 5 N"


@pytest.mark.parametrize("view", [None, pytest.param((30.0, 20.0), marks=needs_opengl)])
def test_the_legend_shows_things_as_they_are_drawn(tmp_path: Path, view: tuple[float, float] | None) -> None:
    """Dashed outlines and hatched areas in the plane, lines and plain areas in space."""
    seen = scene(view=view)
    with open_page(tmp_path / "figure.svg", PictureOptions(view=view)) as page:
        drawing = drawing_of(seen, "mechanism", view)
        draw_on(page, seen, drawing, "mechanism", extent_of([seen], drawing))
        (legend,) = page.figure.legends
        texts = [text.get_text() for text in legend.get_texts()]
        shown = dict(zip(texts, legend.legend_handles, strict=True))
    assert shown["before it moves"].is_dashed() == (view is None)
    assert shown["opening"].get_hatch() == (HATCH if view is None else None)


def test_nothing_moves_at_scale_zero(tmp_path: Path) -> None:
    texts, _ = drawn(tmp_path, "mechanism", scale=0.0)
    assert not {"before it moves", "opening"} & set(texts)


def test_without_equilibrium_the_motion_is_told_as_such(tmp_path: Path) -> None:
    results = tower_results()
    texts, _ = drawn(tmp_path, "mechanism", results, results.cases[1])
    assert "drawn: the motion in which the dead load does more work than the joints take" in texts
    assert "before it moves" in texts
    texts, _ = drawn(tmp_path, "forces", results, results.cases[1])
    assert "no contact forces to draw: none were found that carry the loads" in texts
    still = replace(results.cases[1], solution=replace(results.cases[1].solution, certificate=None))
    texts, _ = drawn(tmp_path, "mechanism", results, still)
    assert "drawn at rest: there is no mechanism" in texts
    assert not {"before it moves", "hinge", "opening", "part 1"} & set(texts)


@pytest.mark.every(5)
@pytest.mark.parametrize(
    ("status", "words"),
    [
        (Status.NOT_VERIFIED, "NOT VERIFIED: no result, the best iterate"),
        (Status.TIME_LIMIT, "NOT VERIFIED: no result, the best iterate"),
        (Status.APPROXIMATE, "APPROXIMATE: residuals are larger than for a solved case"),
        (Status.SOLVED, ""),
    ],
)
@pytest.mark.parametrize("kind", ["mechanism", "forces", "history"])
def test_what_is_no_result_looks_so(tmp_path: Path, kind: str, status: Status, words: str) -> None:
    results = tower_results()
    texts, svg = drawn(tmp_path, kind, results, replace(results.cases[0], status=status))
    assert (words in texts) if words else not any("VERIFIED" in text or "APPROXIMATE" in text for text in texts)
    assert ("#b00020" in svg) == bool(words), "red frame"


def test_settlement_and_guides(tmp_path: Path) -> None:
    results = tower_results()
    model = full_model(results.model)
    results = replace(
        results,
        assembly=replace(results.assembly, model=model),
        cases=(replace(results.cases[0], load_case=model.load_cases[0]),),
    )
    texts, _ = drawn(tmp_path, "mechanism", results)
    assert {"guided", "settlement of 1 block"} <= set(texts)


def moved(factor: float, shift: float) -> Results:
    """The tower in another unit of length and at another place."""
    results = tower_results()
    model, contacts, case = results.model, results.contacts, results.cases[0]
    offset = np.array([shift, 0, shift])
    blocks = replace(
        model.blocks,
        vertices=factor * model.blocks.vertices + offset,
        centroids=factor * model.blocks.centroids + offset,
        added_mass_points=factor * model.blocks.added_mass_points + offset,
        volumes=factor**3 * model.blocks.volumes,
        densities=model.blocks.densities / factor**3,
    )
    grounds = tuple(replace(each, point=factor * each.point + offset) for each in model.grounds)
    mechanism = mechanics_of(results).mechanism * np.repeat([factor, 1.0], 3)
    solution = replace(case.solution, mechanics=replace(mechanics_of(results), mechanism=mechanism))
    contacts = replace(
        contacts, points=factor * contacts.points + offset, centroids=factor * contacts.centroids + offset
    )
    model = replace(model, blocks=blocks, grounds=grounds)
    return replace(results, assembly=Assembly(model, contacts), cases=(replace(case, solution=solution),))


def test_far_from_the_origin_and_in_other_units_the_figure_is_the_same(tmp_path: Path) -> None:
    plain, far = (drawn(tmp_path, "mechanism", moved(*each))[0] for each in ((1.0, 0.0), (1000.0, 1e6)))
    assert [text for text in far if not text.endswith(" m")] == [text for text in plain if not text.endswith(" m")]
    assert "1000 m" in far
    assert "1 m" in plain


@pytest.mark.parametrize(("length", "bar"), [(1.0, 1.0), (1.99, 1.0), (4.9, 2.0), (7.0, 5.0), (0.03, 0.02), (1e4, 1e4)])
def test_the_scale_bar_has_a_round_length(length: float, bar: float) -> None:
    assert round_length(length) == pytest.approx(bar)


@pytest.mark.parametrize("count", [2, len(GROUPS) + 1])
def test_few_parts_and_groups_are_named_by_their_colours(count: int) -> None:
    """Of many groups the first are named and the others counted."""
    results = row_of_blocks(count)
    parts = [name for name, _ in drawing_of(scene(results), "mechanism").legend if name.startswith("part")]
    assert parts == [f"part {row + 1}" for row in range(count)] * (count <= len(GROUPS))
    groups = [name for name, _ in drawing_of(scene(row_of_blocks(MOST_GROUPS + 2)), "model").legend]
    assert "and 2 more groups" in groups
    assert f"group {MOST_GROUPS + 1}" not in groups


def test_ground_is_drawn_and_named_where_something_stands_on_it() -> None:
    results = tower_results()
    assert ("ground", SLAB) in drawing_of(scene(results), "mechanism").legend
    model = replace(results.model, grounds=results.model.grounds[:0])
    contacts = replace(results.contacts, bodies=np.minimum(results.contacts.bodies, 2))
    bare = replace(results, assembly=Assembly(model, contacts))
    assert ("ground", SLAB) not in drawing_of(scene(bare), "model").legend


# --- From where it is looked at -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "right", "up"),
    [("front", [1, 0, 0], [0, 0, 1]), ("right", [0, 1, 0], [0, 0, 1]), ("top", [1, 0, 0], [0, 1, 0])],
)
def test_front_right_and_top_are_those_of_drawings(name: str, right: list[float], up: list[float]) -> None:
    _, across, along = axes_of(*VIEWS[name])
    assert across == pytest.approx(right, abs=1e-12)
    assert along == pytest.approx(up, abs=1e-12)


@pytest.mark.parametrize("shift", [0.0, 1e6])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_everything_lies_in_its_room_and_fills_it_in_one_direction(shift: float, scale: float) -> None:
    points = shift + scale * np.random.default_rng(1).random((50, 3))
    camera = fitted(points, (-60.0, 25.0), 1.6, ((0.1, 0.9), (0.2, 0.8)))
    places = camera.project(points) / [1.6, 1.0]
    low, high = places.min(axis=0), places.max(axis=0)
    assert (low >= np.array([0.1, 0.2]) - 1e-6).all()
    assert (high <= np.array([0.9, 0.8]) + 1e-6).all()
    assert min(0.8 - (high - low)[0], 0.6 - (high - low)[1]) == pytest.approx(0.0, abs=1e-6)


def test_a_single_point_is_no_division_by_nothing() -> None:
    camera = fitted(np.ones((1, 3)), (0.0, 0.0), 1.0, ((0.1, 0.9), (0.1, 0.9)))
    assert camera.project(np.ones((1, 3))) == pytest.approx(np.array([[0.5, 0.5]]))


@pytest.mark.parametrize(("push", "side"), [(1.0, 1), (-1.0, -1)])
def test_the_view_faces_the_side_towards_which_the_structure_goes(push: float, side: int) -> None:
    """What is thin is seen from the front."""
    results = tower_results()
    mechanism = np.zeros((3, 6))
    mechanism[1, :2] = [push, -1.0]
    vertices = results.model.blocks.vertices * [1, 5, 1]
    blocks = replace(results.model.blocks, vertices=vertices, centroids=results.model.blocks.centroids * [1, 5, 1])
    solution = replace(results.cases[0].solution, mechanics=replace(mechanics_of(results), mechanism=mechanism))
    case = replace(results.cases[0], solution=solution)
    wide = replace(
        results, assembly=replace(results.assembly, model=replace(results.model, blocks=blocks)), cases=(case,)
    )
    azimuth, elevation = view_of_case(scene(wide))
    assert elevation > 0
    assert np.sign(np.cos(np.deg2rad(azimuth))) == side
    thin = replace(blocks, vertices=blocks.vertices * [1, 0.01, 1], centroids=blocks.centroids * [1, 0.01, 1])
    slim = tower_results()
    slim = replace(slim, assembly=replace(slim.assembly, model=replace(slim.model, blocks=thin)))
    assert view_of_case(scene(slim)) == (-90.0, 0.0)


# --- Pixels ---------------------------------------------------------------------------------------------------------


def near(image: Any, colour: str, distance: float = 0.12) -> int:
    """How many pixels, 0 to 1, are about of this colour."""
    return int((np.abs(image - rgb(colour)).max(axis=2) < distance).sum())


def picture(path: Path, kind: str, results: Results | None = None) -> Any:
    from PIL import Image

    draw_picture(path, scene(results, kind), kind, ISO)
    with Image.open(path) as image:
        return np.asarray(image)[..., :3] / 255


@pytest.mark.long
@needs_opengl
def test_pictures_in_space_show_hinge_gap_and_groups(tmp_path: Path) -> None:
    image = picture(tmp_path / "mechanism.png", "mechanism")
    assert image.shape == (250, 400, 3)
    assert near(image, HINGE, 0.25) > 20
    assert near(image, OPEN, 0.2) > 20
    model = picture(tmp_path / "model.png", "model")
    assert near(model, group_colours(tower_results().model.blocks.groups)["tower"], 0.2) > 20


@pytest.mark.long
@needs_opengl
def test_figures_that_are_no_result_are_framed_in_red(tmp_path: Path) -> None:
    results = tower_results()
    wrong = replace(results, cases=(replace(results.cases[0], status=Status.NOT_VERIFIED),))
    image = picture(tmp_path / "wrong.png", "mechanism", wrong)
    assert near(image[:3], WARNING) > 300
    assert near(picture(tmp_path / "right.png", "mechanism")[:3], WARNING) == 0


def image(shown: PictureScene, points: FloatArray, view: tuple[float, float] = (-60.0, 25.0), slabs: Any = ()) -> Any:
    """Of the structure with a red mark from one point to another."""
    mark = segments("", "#FF0000", points[None], np.full((1, 2), -1), [""])
    extent = np.vstack([shown.model.blocks.vertices, points])
    camera = fitted(extent, view, 1.6, ((0.1, 0.9), (0.1, 0.9)))
    colours = ["#0000FF"] * len(shown.model.blocks)
    return image_of(shown, colours, [(mark, points)], slabs, np.zeros((0, 2), dtype=int), camera, (160, 100))


@needs_opengl
def test_a_hidden_mark_shines_through() -> None:
    """Within the tower its red is mixed with blue, beside it there is none of that."""
    hidden = image(scene(kind="model"), np.array([[0.5, 0.5, 1.2], [0.5, 0.5, 2.8]]))
    mixed = (hidden[..., 0] > 0.4) & (hidden[..., 2] > 0.05) & (hidden[..., 1] < 0.3)
    assert mixed.sum() > 20
    assert hidden[mixed][:, 2].max() < 1 - SHINE + 0.1
    free = image(scene(kind="model"), np.array([[0.5, -2.5, 1.2], [0.5, -2.5, 2.8]]))
    assert ((free[..., 0] > 0.4) & (free[..., 1] < 0.2) & (free[..., 2] < 0.02)).sum() > 20


@pytest.mark.parametrize(
    ("system", "libraries", "display", "able"),
    [
        ("linux", ["libEGL.so.1"], "", True),
        ("linux", ["libOSMesa.so.8"], "", True),
        ("linux", ["libGL.so.1"], "", False),
        ("linux", ["libGL.so.1"], ":0", True),
        ("linux", [], ":0", False),
        ("darwin", [], "", True),
    ],
)
def test_a_machine_draws_with_the_libraries_it_has(
    monkeypatch: pytest.MonkeyPatch, system: str, libraries: list[str], display: str, able: bool
) -> None:
    def load(name: str) -> None:
        if name not in libraries:
            raise OSError(name)

    monkeypatch.setattr("sys.platform", system)
    monkeypatch.setattr("ctypes.CDLL", load)
    monkeypatch.setenv("DISPLAY", display)
    assert can_draw() == able
