"""Marks on the forces of a plane figure."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.results.pictures.page import THRUST, rgb
from mbla.results.pictures.plane.draw import draw_forces
from mbla.results.pictures.scene import OUTSIDE_WORDS, Scene, scene_of
from tests.results.pictures.plane.sheets import OPTIONS, drawn_alone
from tests.results.pictures.rows_and_columns import column_of_blocks, row_of_blocks

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


def test_blocks_without_a_chain_have_none(tmp_path: Path) -> None:
    with drawn_alone(tmp_path, pressed(0.5), draw_forces) as sheet:
        assert "line of thrust" not in sheet.handles
