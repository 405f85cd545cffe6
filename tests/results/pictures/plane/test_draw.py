"""Plane pictures as a whole, and their forces."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from mbla.model.model import Settlement
from mbla.results.pictures.key import round_length
from mbla.results.pictures.options import VIEWS, PictureOptions
from mbla.results.pictures.page import CASES, HINGE, LIVE_LOAD, OPEN, THRUST, rgb
from mbla.results.pictures.plane.draw import draw_forces
from mbla.results.pictures.plot import draw_picture
from mbla.results.pictures.scene import OUTSIDE_WORDS, Scene, scene_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status
from tests.results.pictures.plane.sheets import OPTIONS, drawn_alone
from tests.results.pictures.rows_and_columns import column_of_blocks, row_of_blocks
from tests.results.synthetic import full_model, tower_results

NAMED = "{http://www.w3.org/2000/svg}"


def mechanics_of(results: Results) -> Mechanics:
    mechanics = results.cases[0].solution.mechanics
    assert mechanics is not None
    return mechanics


def scene(results: Results, case: CaseResult, kind: str, **options: Any) -> Scene:
    return scene_of(results, case, PictureOptions(**options), kind)


def drawn(
    tmp_path: Path, kind: str, results: Results | None = None, case: CaseResult | None = None, **options: Any
) -> Any:
    """Texts and the tree of a figure."""
    results = results or tower_results()
    path = tmp_path / "figure.svg"
    draw_picture(path, scene(results, case or results.cases[0], kind, **options), kind, PictureOptions(**options))
    tree = ElementTree.parse(path)
    return [" ".join("".join(node.itertext()).split()) for node in tree.iter(f"{NAMED}text")], path.read_text()


@pytest.mark.parametrize("kind", ["model", "mechanism", "forces"])
def test_a_plane_figure_is_made_of_lines_and_words(tmp_path: Path, kind: str) -> None:
    texts, svg = drawn(tmp_path, kind)
    assert "<image" not in svg
    assert texts[0] == "Tower and brick"
    assert any(text.endswith(" m") for text in texts), "scale bar with its unit"


def test_model_names_groups_supports_and_loads(tmp_path: Path) -> None:
    texts, _ = drawn(tmp_path, "model", case=None)
    expected = {"ground", "fixed", "base", "tower", "brick", "x", "z", "dead load: gravity (0, 0, -9.81) m/s2"}
    assert expected <= set(texts)
    assert "live load push_x: acceleration (1, 0, 0) g on all blocks" in texts
    assert "live load fall: acceleration (1, 0, 0) g on all blocks" in texts


def test_loads_across_the_page_say_which_way(tmp_path: Path) -> None:
    """Seen against y; forces that cancel push nowhere and have no place of their own."""
    marks = {}
    for pushes, told in (
        ((1, 1), "away from the viewer"),
        ((-1, -1), "towards the viewer"),
        ((1, -1), "across the page"),
    ):
        results = tower_results()
        live = np.zeros((3, 6))
        live[1:, 1] = pushes
        case = replace(results.model.load_cases[0], live_load=live, live_words=("push",))
        model = replace(results.model, load_cases=(case,))
        results = replace(results, model=model, cases=(replace(results.cases[0], load_case=case),))
        texts, svg = drawn(tmp_path, "model", results)
        assert f"live load push_x: push ({told})" in texts or f"live load: push ({told})" in texts
        marks[told] = svg.lower().count(CASES[0].lower())
    assert marks["towards the viewer"] == marks["away from the viewer"] > marks["across the page"]


def test_mechanism_marks_the_hinge_and_what_opens(tmp_path: Path) -> None:
    texts, svg = drawn(tmp_path, "mechanism")
    assert {"hinge", "opening", "part 1", "before it moves"} <= set(texts)
    assert "sliding" not in texts
    assert "load case push_x: collapses at 0.5 g, verified" in texts
    assert HINGE.lower() in svg.lower()
    assert OPEN.lower() in svg.lower()


def test_nothing_moves_at_scale_zero(tmp_path: Path) -> None:
    texts, _ = drawn(tmp_path, "mechanism", scale=0.0)
    assert "before it moves" not in texts
    assert "opening" not in texts


def test_without_equilibrium_the_motion_is_told_as_such(tmp_path: Path) -> None:
    results = tower_results()
    texts, _ = drawn(tmp_path, "mechanism", results, results.cases[1])
    assert "drawn: the motion in which the dead load does more work than the joints take" in texts
    assert "before it moves" in texts
    texts, _ = drawn(tmp_path, "forces", results, results.cases[1])
    assert "no contact forces to draw: none were found that carry the loads" in texts


def test_forces_have_a_key(tmp_path: Path) -> None:
    """The largest resultant of the tower stands on its edge: weight 10 N and push 5 N, 11.2 N together."""
    texts, _ = drawn(tmp_path, "forces")
    assert {"11.2 N", "5.59 N", "1.12 N"} <= set(texts)
    assert "at the edge of the joint" in texts


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (Status.NOT_VERIFIED, "NOT VERIFIED: no result, the best that was reached"),
        (Status.TIME_LIMIT, "NOT VERIFIED: no result, the best that was reached"),
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
    results = replace(results, model=model, cases=(replace(results.cases[0], load_case=model.load_cases[0]),))
    texts, _ = drawn(tmp_path, "mechanism", results)
    assert {"guided", "settlement of 1 block"} <= set(texts)


def test_far_from_the_origin_and_in_other_units_the_figure_is_the_same(tmp_path: Path) -> None:
    def moved(factor: float, shift: float) -> Any:
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
        mechanics = mechanics_of(results)
        mechanism = mechanics.mechanism * np.repeat([factor, 1.0], 3)
        solution = replace(case.solution, mechanics=replace(mechanics, mechanism=mechanism))
        contacts = replace(
            contacts, points=factor * contacts.points + offset, centroids=factor * contacts.centroids + offset
        )
        case = replace(case, solution=solution)
        results = replace(
            results, model=replace(model, blocks=blocks, grounds=grounds), contacts=contacts, cases=(case,)
        )
        return drawn(tmp_path, "mechanism", results)[0]

    plain = moved(1.0, 0.0)
    assert [text for text in moved(1000.0, 1e6) if not text.endswith(" m")] == [
        text for text in plain if not text.endswith(" m")
    ]
    assert "1000 m" in moved(1000.0, 1e6)
    assert "1 m" in plain


@pytest.mark.parametrize(("length", "bar"), [(1.0, 1.0), (1.99, 1.0), (4.9, 2.0), (7.0, 5.0), (0.03, 0.02), (1e4, 1e4)])
def test_the_scale_bar_has_a_round_length(length: float, bar: float) -> None:
    assert round_length(length) == pytest.approx(bar)


def test_what_crushes_is_no_opening(tmp_path: Path) -> None:
    """The tower sinks straight into its base: nothing opens, and the overlap is told."""
    results = tower_results()
    mechanism = np.zeros((3, 6))
    mechanism[1, 2] = -1.0
    found = replace(mechanics_of(results), mechanism=mechanism)
    case = replace(results.cases[0], solution=replace(results.cases[0].solution, mechanics=found))
    texts, _ = drawn(tmp_path, "mechanism", results, case)
    assert "crushing" in texts
    whole, _ = drawn(tmp_path, "mechanism")
    assert "crushing" not in whole


def turned(results: Results, angle: float) -> Results:
    """The same structure, and its loads, turned about the vertical by an angle in degrees."""
    cosine, sine = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    turn = np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])  # of rows
    blocks, contacts, case = results.model.blocks, results.contacts, results.cases[0]
    blocks = replace(
        blocks,
        vertices=blocks.vertices @ turn,
        centroids=blocks.centroids @ turn,
        added_mass_points=blocks.added_mass_points @ turn,
        face_normals=blocks.face_normals @ turn,
    )
    contacts = replace(
        contacts,
        points=contacts.points @ turn,
        centroids=contacts.centroids @ turn,
        frames=contacts.frames @ turn,
    )
    live = case.load_case.live_load.reshape(-1, 2, 3) @ turn
    load_case = replace(case.load_case, live_load=live.reshape(-1, 6))
    mechanics = mechanics_of(results)
    motion = (mechanics.mechanism.reshape(-1, 2, 3) @ turn).reshape(-1, 6)
    case = replace(
        case, load_case=load_case, solution=replace(case.solution, mechanics=replace(mechanics, mechanism=motion))
    )
    model = replace(results.model, blocks=blocks, load_cases=(load_case,))
    return replace(results, model=model, contacts=contacts, cases=(case,))


@pytest.mark.parametrize(
    ("angle", "view", "name"),
    [
        (0, None, "x"),
        (0, "back", "-x"),
        (90, "right", "y"),
        (90, "left", "-y"),
        (30, None, "(0.866, 0.5, 0)"),
    ],
)
def test_the_axis_across_the_page_has_its_name_or_its_numbers(
    tmp_path: Path, angle: float, view: str | None, name: str
) -> None:
    options: dict[str, Any] = {} if view is None else {"view": VIEWS[view]}
    texts, svg = drawn(tmp_path, "model", turned(row_of_blocks(2), angle), **options)
    assert "<image" not in svg
    assert texts[texts.index("z") - 1] == name


@pytest.mark.parametrize(("motion", "arrow"), [([0, 0, -1, 0, 0, 0], True), ([0, 0, 0, 0, 1, 0], False)])
def test_a_support_that_gives_way_is_named_and_has_an_arrow_where_it_moves(
    tmp_path: Path, motion: list[float], arrow: bool
) -> None:
    """The entry of the legend takes the colour twice; one that only turns has no direction to show."""
    results = tower_results()
    given = Settlement(np.array([2]), np.array([motion], float), False, "settlement of brick[0]", 1.0, 1.0)
    load_case = replace(results.model.load_cases[0], settlement=given)
    results = replace(results, cases=(replace(results.cases[0], load_case=load_case),))
    texts, svg = drawn(tmp_path, "forces", results)
    assert "settlement of brick[0]" in texts
    uses = svg.lower().count(LIVE_LOAD.lower())
    without = svg.lower().split('<g id="legend_1">')[1].count(LIVE_LOAD.lower())
    assert (uses > without) == arrow


def test_without_mechanism_and_motion_the_figure_says_that_it_is_at_rest(tmp_path: Path) -> None:
    results = tower_results()
    case = results.cases[1]
    still = replace(case, solution=replace(case.solution, certificate=None))
    texts, _ = drawn(tmp_path, "mechanism", results, still)
    assert "drawn at rest: there is no mechanism" in texts
    assert not {"before it moves", "hinge", "opening", "part 1"} & set(texts)


# --- Marks on the forces of a plane figure --------------------------------------------------------------------------


FRICTION = 0.65


def pressed(right: float, shear: float = 0.0) -> Scene:
    """One block of which the right edge carries a share of 4 N; shear along x, as a share of what friction gives."""
    results = row_of_blocks(1)
    case = results.cases[0]
    mechanics = case.solution.mechanics
    assert mechanics is not None
    normal = 2.0 * np.array([1 - right, right, right, 1 - right])
    drawn = np.column_stack([normal, shear * FRICTION * normal, 0 * normal])
    case = replace(case, solution=replace(case.solution, mechanics=replace(mechanics, contact_forces=drawn)))
    return scene_of(replace(results, cases=(case,)), case, OPTIONS, "forces")


@pytest.mark.parametrize(
    ("right", "mark"),
    [(0.5, ""), (0.6, ""), (0.8, "outside the middle third"), (1.0, "at the edge of the joint")],
)
def test_eccentric_forces_are_marked_where_they_act(tmp_path: Path, right: float, mark: str) -> None:
    """The joint reaches from x = 0 to 1, so that the force acts at x = its share on the right."""
    with drawn_alone(tmp_path, pressed(right), draw_forces) as sheet:
        marks = [name for name in sheet.handles if not name.endswith(" N")]
        assert marks == [mark] * bool(mark)
        dots = [each.get_offsets().tolist() for each in sheet.axes.collections[1:]]
        assert dots == [[pytest.approx([right, 0.0])]] * bool(mark)


def test_a_force_outside_its_joint_is_drawn_at_the_edge(tmp_path: Path) -> None:
    """12 N on the right edge less 8 N of tension on the left act at x = 3, two widths off: so far the sheet must not
    reach, and the mark is another than that of a force at the edge."""
    with drawn_alone(tmp_path, pressed(3.0), draw_forces) as sheet:
        assert [name for name in sheet.handles if not name.endswith(" N")] == [OUTSIDE_WORDS]
        (dots,) = [each.get_offsets().tolist() for each in sheet.axes.collections[1:]]
        assert dots == [pytest.approx([1.0, 0.0])]
        assert np.vstack(sheet.drawn)[:, 0].max() == pytest.approx(1.0)


@pytest.mark.parametrize(("shear", "used"), [(0.99, False), (1.0, True)])
def test_a_joint_at_the_limit_of_friction_is_marked(tmp_path: Path, shear: float, used: bool) -> None:
    with drawn_alone(tmp_path, pressed(0.5, shear), draw_forces) as sheet:
        assert ("all friction used" in sheet.handles) == used


def test_the_key_tells_the_forces_by_their_widths(tmp_path: Path) -> None:
    with drawn_alone(tmp_path, pressed(0.5), draw_forces) as sheet:
        assert list(sheet.handles) == ["4 N", "2 N", "0.4 N"]
        widths = [sheet.handles[name].get_linewidth() for name in ("4 N", "2 N", "0.4 N")]
        assert widths[1] / widths[0] == pytest.approx(0.5**0.5)
        assert widths[2] / widths[0] == pytest.approx(0.1**0.5)


def test_a_chain_of_blocks_has_a_line_of_thrust(tmp_path: Path) -> None:
    """Three joints with their forces at x = 0.5, 0.6 and 0.8, from the lowest up."""
    results = column_of_blocks(0.5, 0.6, 0.8)
    with drawn_alone(tmp_path, scene_of(results, results.cases[0], OPTIONS, "forces"), draw_forces) as sheet:
        assert list(sheet.handles)[:2] == ["line of thrust", "outside the middle third"]
        lines = [each for each in sheet.axes.collections if hasattr(each, "get_segments")]
        (drawn,) = (each for each in lines if tuple(each.get_colors()[0][:3]) == rgb(THRUST))
        (points,) = drawn.get_segments()
        assert points[np.argsort(points[:, 1])] == pytest.approx(np.array([[0.5, 1], [0.6, 2], [0.8, 3]]))
