"""What a plane figure draws at joints, found among the artists of its sheet."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.results.pictures.page import SLIDE, rgb
from mbla.results.pictures.plane.marks import LARGE, draw_joint_marks
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import Scene, scene_of
from mbla.solution.solution import ContactMode
from tests.line import BLOCK, case_of, line_of
from tests.results.pictures.plane.sheets import OPTIONS, drawn_alone
from tests.results.synthetic import tower_mechanics, tower_results

FALLS = 1
"""place of the case without equilibrium"""
SLIP = 0.65
"""lift over slip of an associative joint of the tower"""


def moving(motion: list[float], modes: Sequence[int]) -> Scene:
    """The tower in a mechanism of its own, with the modes of the four corners of its joint."""
    results = tower_results()
    mechanism, of_points = np.zeros((3, 6)), np.zeros(8, dtype=np.int64)
    mechanism[1], of_points[:4] = motion, modes
    mechanics = replace(tower_mechanics(), mechanism=mechanism, modes=of_points)
    velocities = np.zeros((8, 3))
    arms = results.contacts.points[:4] - results.model.blocks.centroids[1]
    speeds = mechanism[1, :3] + np.cross(mechanism[1, 3:], arms)
    velocities[:4] = speeds[:, [2, 0, 1]]
    solution = replace(results.cases[0].solution, mechanics=replace(mechanics, contact_velocities=velocities))
    return scene_of(results, replace(results.cases[0], solution=solution), OPTIONS, "mechanism")


def falling(motion: list[float]) -> Scene:
    """The tower in a motion that shows a lack of equilibrium."""
    results = tower_results()
    certificate = np.zeros((3, 6))
    certificate[1] = motion
    case = results.cases[FALLS]
    case = replace(case, solution=replace(case.solution, certificate=certificate))
    return scene_of(results, case, OPTIONS, "mechanism")


def sliding_arrows(sheet: Sheet) -> list[tuple[FloatArray, FloatArray]]:
    """Tip and step of each arrow that is drawn, from its head: the first corner is the tip."""
    heads = [each for each in sheet.axes.collections if each.get_zorder() == 5 and not len(each.get_edgecolor())]
    corners: list[Any] = [path.vertices for each in heads for path in each.get_paths()]
    return [(each[0], each[0] - (each[1] + each[2]) / 2) for each in corners]


@pytest.mark.parametrize("push", [1, -1])
def test_a_block_that_slides_has_an_arrow_above_the_joint_and_the_ground_one_below(tmp_path: Path, push: int) -> None:
    text = BLOCK.replace("acceleration: [1,", f"acceleration: [{push},").replace("associative", "non_associative")
    model, case = case_of(text, "parameters.mu=0.2")
    results = replace(tower_results(), model=model, contacts=line_of(text).contacts, cases=(case,))
    with drawn_alone(tmp_path, scene_of(results, case, OPTIONS, "mechanism"), draw_joint_marks) as sheet:
        assert list(sheet.handles) == ["sliding"]
        arrows = sliding_arrows(sheet)
        assert [np.sign(tip[1]) * np.sign(step[0]) for tip, step in arrows] == [push, push]
        assert sorted(np.sign(tip[1]) for tip, _ in arrows) == [-1, 1]
        joint = sheet.axes.collections[0]
        assert joint.get_colors()[0][:3] == pytest.approx(rgb(SLIDE))
        across = joint.get_segments()[0]
        assert np.ptp(across[:, 0]) == pytest.approx(1.0)


def test_without_equilibrium_what_slides_is_marked_alike(tmp_path: Path) -> None:
    """The tower slides up the slope of its friction: no failure is told, and every sliding joint has its arrows."""
    scene = falling([1, 0, SLIP, 0, 0, 0])
    assert scene.failure is None
    with drawn_alone(tmp_path, scene, draw_joint_marks) as sheet:
        assert list(sheet.handles) == ["sliding"]
        assert len(sliding_arrows(sheet)) == 2


def test_without_equilibrium_hinges_are_large(tmp_path: Path) -> None:
    """The tower turns about its edge at (1, 1): no listing tells which hinges matter."""
    with drawn_alone(tmp_path, falling([1, 0, 0.5, 0, 1, 0]), draw_joint_marks) as sheet:
        assert list(sheet.handles) == ["opening", "hinge"]
        (dots,) = (each for each in sheet.axes.collections if each.get_zorder() == 6)
        assert dots.get_offsets().tolist() == [pytest.approx([1.0, 1.0], abs=0.02)]
        assert dots.get_sizes() == pytest.approx([(LARGE * sheet.page.scale) ** 2])


def test_a_joint_that_opens_at_one_end_and_crushes_at_the_other_shows_both(tmp_path: Path) -> None:
    """The tower turns about the middle of its joint: one triangle opens, one overlaps, and they meet there."""
    closed, opens = ContactMode.STICK, ContactMode.OPEN
    with drawn_alone(tmp_path, moving([1, 0, 0, 0, 1, 0], [opens, closed, closed, opens]), draw_joint_marks) as sheet:
        assert {"opening", "crushing"} <= set(sheet.handles)
        gap, overlap = (each for each in sheet.axes.collections if each.get_zorder() == 3)
        assert (gap.get_hatch(), overlap.get_hatch()) == ("xxxx", "....")
        (opening,), (crushing,) = ([path.vertices[:3] for path in each.get_paths()] for each in (gap, overlap))
        assert opening[:, 0].max() == pytest.approx(0.5, abs=0.02)
        assert crushing[:, 0].min() == pytest.approx(0.5, abs=0.02)
        assert opening[:, 0].min() < 0.05
        assert crushing[:, 0].max() > 0.95


def test_a_joint_that_slides_and_tilts_shows_what_overlaps_and_no_opening(tmp_path: Path) -> None:
    """Its mode is sliding, whatever its other end does."""
    with drawn_alone(tmp_path, moving([3, 0, 0, 0, 1, 0], 4 * [ContactMode.SLIDE]), draw_joint_marks) as sheet:
        assert set(sheet.handles) == {"crushing", "sliding"}
