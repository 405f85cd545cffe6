"""Arrows and rings of loads in space, and what the legend says of them."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase, Settlement
from mbla.results.pictures.load_marks import LONGEST, OFF
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import CASES, DEAD_LOAD, LIVE_LOAD
from mbla.results.pictures.scene import Scene, scene_of
from mbla.results.pictures.space.loads import SHARE_OF_BLOCK, load_shapes
from mbla.results.pictures.space.shapes import Faces, Shape, rgb
from tests.results.synthetic import tower_results

BRICK = 2


def scene(*load_cases: LoadCase) -> Scene:
    """The model of the tower with these load cases, all of them shown."""
    results = tower_results()
    cases = tuple(replace(results.cases[0], load_case=each) for each in load_cases)
    results = replace(results, model=replace(results.model, load_cases=load_cases), cases=cases)
    return scene_of(results, cases[0], PictureOptions(), "model")


def case(**changes: Any) -> LoadCase:
    return replace(tower_results().model.load_cases[0], **changes)


def on_brick(*load: float) -> FloatArray:
    """A load on the brick about its centroid, (3, 6)."""
    loads = np.zeros((3, 6))
    loads[BRICK] = load
    return loads


def settlement(motion: list[float]) -> Settlement:
    return Settlement(np.array([BRICK]), np.array([motion], float), False, "settlement of 1 block", 0.0, 0.0)


def only(shapes: list[Shape], colour: str) -> FloatArray:
    """Points of the only shape, which is of that colour."""
    (shape,) = shapes
    assert isinstance(shape, Faces)
    assert (shape.colours == rgb(colour)).all()
    return shape.points


def test_a_dead_load_is_an_arrow_for_gravity_and_one_for_each_force() -> None:
    """A force of 3 N on top of the brick, and its weight."""
    plain = case(live_load=np.zeros((3, 6)), live_words=())
    loads = plain.dead_load + on_brick(0, 0, -3, 0, 0, 0)
    loaded = replace(plain, dead_load=loads, dead_words=(*plain.dead_words, "force (0, 0, -3) N on brick[0]"))
    (force, gravity), entries = load_shapes(scene(loaded), "model")
    ((name, colour),) = entries
    assert (" ".join(name.split()), colour) == (
        "dead load: gravity (0, 0, -9.81) m/s2; force (0, 0, -3) N on brick[0]", DEAD_LOAD,
    )  # fmt: skip
    points, size = only([force], DEAD_LOAD), scene(loaded).size
    assert points[:, 2].min() == pytest.approx(0.5), "the tip is where the force enters the brick"
    assert points[:, 2].max() == pytest.approx(0.5 + LONGEST * size)
    assert points[:, :2].mean(axis=0) == pytest.approx([4.5, 0.5])
    assert only([gravity], DEAD_LOAD)[:, 2].min() > 3.0


def test_every_case_has_its_colour_and_its_words() -> None:
    pushes = [
        case(name=name, live_load=on_brick(push, 0, 0, 0, 0, 0), live_words=(f"push {push}",))
        for name, push in (("east", 1.0), ("west", -1.0))
    ]
    (_, *shapes), (_, *entries) = load_shapes(scene(*pushes), "model")
    assert entries == [("live load east: push 1.0", CASES[0]), ("live load west: push -1.0", CASES[1])]
    east, west = (only([shape], colour) for shape, colour in zip(shapes, CASES, strict=False))
    assert east[:, 0].max() == pytest.approx(4.0)
    assert west[:, 0].min() == pytest.approx(5.0)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_moment_is_a_ring_about_the_centroid_that_turns_its_way(sense: float) -> None:
    """About z: the ring lies level and its head, thicker than the rest, is at its end."""
    turned = case(live_load=on_brick(0, 0, 0, 0, 0, 7 * sense), live_words=("moment on brick[0]",))
    a_scene = scene(turned)
    shapes, entries = load_shapes(a_scene, "mechanism")
    assert [name for name, _ in entries] == ["live load: moment on brick[0]"]
    points = only(shapes, entries[0][1])
    arms = points - a_scene.model.blocks.centroids[BRICK]
    reach = min(SHARE_OF_BLOCK * float(a_scene.model.blocks.sizes[BRICK]), LONGEST * a_scene.size)
    away = np.hypot(arms[:, 0], arms[:, 1])
    assert np.median(away) == pytest.approx(reach, rel=0.05)
    assert np.abs(arms[:, 2]).max() < 0.2 * reach
    angle = np.unwrap(np.arctan2(arms[:, 1], arms[:, 0]).reshape(-1, 12).mean(axis=1))
    assert sense * (angle[-1] - angle[0]) > 0.0


def test_a_settlement_is_an_arrow_from_what_gives_way() -> None:
    """Down from below the brick."""
    sinks = case(settlement=settlement([0, 0, -2, 0, 0, 0]))
    shapes, entries = load_shapes(scene(sinks), "mechanism")
    assert entries == [("settlement of 1 block", LIVE_LOAD)]
    points, size = only(shapes, LIVE_LOAD), scene(sinks).size
    assert points[:, 2].max() == pytest.approx(-OFF * size)
    assert points[:, 2].min() == pytest.approx(-(OFF + LONGEST) * size)
    assert points[:, :2].mean(axis=0) == pytest.approx([4.5, 0.5])


def test_a_settlement_that_only_turns_is_a_ring() -> None:
    """About y, through the middle of the brick."""
    turns = case(settlement=settlement([0, 0, 0, 0, 3, 0]))
    a_scene = scene(turns)
    shapes, entries = load_shapes(a_scene, "mechanism")
    assert len(entries) == 1
    arms = only(shapes, LIVE_LOAD) - a_scene.model.blocks.centroids[BRICK]
    reach = SHARE_OF_BLOCK * float(a_scene.model.blocks.sizes[BRICK])
    assert np.median(np.hypot(arms[:, 0], arms[:, 2])) == pytest.approx(reach, rel=0.05)
    assert np.abs(arms[:, 1]).max() < 0.2 * reach


def test_a_settlement_without_motion_is_not_in_the_legend() -> None:
    assert load_shapes(scene(case(settlement=settlement([0, 0, 0, 0, 0, 0]))), "mechanism") == ([], [])
