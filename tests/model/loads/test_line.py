"""Line loads: the resultant and the moment of what is laid on are those of the whole line, whatever the blocks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model import build_model
from mbla.model.model import LoadCase, Model
from tests.model.shapes import deck

WALL = "wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 2.0, courses: 3}"
ARCH = (
    "arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.4, width: 1, voussoirs: 15, "
    "springers: ground}"
)
TWO_STOREYS = [
    "box: {group: lower, material: stone, min: [0, 0, 0], max: [3, 1, 1]}",
    "box: {group: post, material: stone, min: [0, 0, 1], max: [1, 1, 3]}",
    "box: {group: post, material: stone, min: [2, 0, 1], max: [3, 1, 3]}",
    "box: {group: upper, material: stone, min: [0, 0, 3], max: [3, 1, 4]}",
]


def model(folder: Path, line: str, blocks: list[str], more: str = "", supports: str = "[{ground: {z: 0}}]") -> Model:
    loads = f"dead: [{{gravity: none}}, {{line: {{{line}}}{more}}}], live: [{{acceleration: [1, 0, 0]}}]"
    return build_model(deck(folder, blocks, supports, loads))


def resultant(model: Model, load: FloatArray) -> FloatArray:
    """Force and moment about the origin."""
    moments = load[:, 3:] + np.cross(model.blocks.centroids, load[:, :3])
    return np.concatenate([load[:, :3].sum(axis=0), moments.sum(axis=0)])


def closed_form(begin: FloatArray, end: FloatArray, q: FloatArray) -> FloatArray:
    force = q * np.linalg.norm(end - begin)
    return np.concatenate([force, np.cross((begin + end) / 2, force)])


def case_of(model: Model) -> LoadCase:
    return model.load_cases[0]


@pytest.mark.parametrize(
    ("begin", "end", "q", "blocks", "supports"),
    [
        ([0, 0.1, 0.6], [2, 0.1, 0.6], [0, 0, -3], [WALL], "[{ground: {z: 0}}]"),
        ([0.13, 0.03, 0.9], [1.77, 0.17, 0.6], [0.5, -1, -3], [WALL], "[{ground: {z: 0}}]"),
        ([0.1, 0.5, 2.6], [3.3, 0.2, 3.5], [0, 0, -7], [ARCH], "[]"),
        ([0.8, 0.5, 2.2], [3.2, 0.5, 2.2], [0, 0, -7], [ARCH], "[]"),
    ],
)
def test_resultant_and_moment_are_those_of_the_line(
    tmp_path: Path, begin: list[float], end: list[float], q: list[float], blocks: list[str], supports: str
) -> None:
    found = model(tmp_path, f"from: {begin}, to: {end}, force_per_length: {q}", blocks, supports=supports)
    load = case_of(found).dead_load
    expected = closed_form(np.array(begin), np.array(end), np.array(q))
    assert resultant(found, load) == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())


def test_each_block_of_the_top_course_gets_its_length(tmp_path: Path) -> None:
    found = model(tmp_path, "from: [0.1, 0.1, 0.6], to: [2, 0.1, 0.6], force_per_length: [0, 0, -10]", [WALL])
    load = case_of(found).dead_load
    top = found.blocks.centroids[:, 2] > 0.4
    assert load[top, 2] == pytest.approx([-3, -4, -4, -4, -4])
    assert not load[~top].any()
    assert case_of(found).dead_words == (
        "no gravity",
        "line load (0, 0, -10) N/m from (0.1, 0.1, 0.6) to (2, 0.1, 0.6) m on 5 blocks",
    )


def test_the_floor_is_loaded_under_the_roof(tmp_path: Path) -> None:
    """The line begins where it is drawn: what lies above it does not catch it."""
    line = "from: [1, 0.5, {z}], to: [2, 0.5, {z}], force_per_length: [0, 0, -1]"
    for z, block in ((1, 0), (2, 0), (3.5, 3), (4, 3), (9, 3)):
        load = case_of(model(tmp_path, line.format(z=z), TWO_STOREYS)).dead_load
        assert np.flatnonzero(load[:, 2]).tolist() == [block], z


def test_on_looks_past_other_blocks(tmp_path: Path) -> None:
    line = "from: [0, 0.5, 5], to: [3, 0.5, 5], force_per_length: [0, 0, -1]"
    load = case_of(model(tmp_path, line, TWO_STOREYS, ", on: lower")).dead_load
    assert load[:, 2].tolist() == [-3, 0, 0, 0]


def test_along_a_joint_both_sides_carry_half(tmp_path: Path) -> None:
    blocks = [f"box: {{group: leaf, material: stone, min: [0, {y}, 0], max: [2, {y + 1}, 1]}}" for y in (0, 1)]
    found = model(tmp_path, "from: [0, 1, 1], to: [2, 1, 1], force_per_length: [0, 0, -4]", blocks)
    assert case_of(found).dead_load[:, 2].tolist() == [-4, -4]


def test_along_an_edge_the_only_block_carries_all(tmp_path: Path) -> None:
    for y in (0.0, 0.2):
        found = model(tmp_path, f"from: [0, {y}, 0.6], to: [2, {y}, 0.6], force_per_length: [0, 0, -1]", [WALL])
        assert case_of(found).dead_load[:, 2].sum() == pytest.approx(-2, rel=1e-12)


def test_sideways(tmp_path: Path) -> None:
    """Wind along a vertical line: the blocks lie in another direction than below."""
    line = "from: [0, 0.1, 0], to: [0, 0.1, 0.6], force_per_length: [5, 0, 0], towards: [1, 0, 0]"
    found = model(tmp_path, line, [WALL])
    assert case_of(found).dead_load[:, 0].sum() == pytest.approx(3, rel=1e-12)
    assert (case_of(found).dead_load[:, 0] > 0).sum() == 3


def test_an_open_joint_narrower_than_the_tolerance_loses_nothing(tmp_path: Path) -> None:
    blocks = [
        "box: {material: stone, min: [0, 0, 0], max: [1, 1, 1]}",
        "box: {material: stone, min: [1.0005, 0, 0], max: [2, 1, 1]}",
    ]
    found = model(tmp_path, "from: [0, 0.5, 1], to: [2, 0.5, 1], force_per_length: [0, 0, -1]", blocks)
    assert case_of(found).dead_load[:, 2] == pytest.approx([-1.0005, -0.9995])


def test_rigid_motion_far_from_the_origin(tmp_path: Path) -> None:
    """A slanting line over an arch, turned and moved by 1e3 m: the same share on each voussoir."""
    line = "from: {a}, to: {b}, force_per_length: {q}, towards: {d}"
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    move = np.array([1e3, -2e3, 5e2])
    a, b, q, d = np.array([0.2, 0.3, 3.0]), np.array([3.7, 0.6, 4.0]), np.array([0, 0, -1.0]), np.array([0, 0, -1.0])
    plain = model(tmp_path, line.format(a=a.tolist(), b=b.tolist(), q=q.tolist(), d=d.tolist()), [ARCH], "", "[]")
    moved = (
        ARCH.removesuffix("}")
        + f", transform: [{{rotate: {{axis: [0, 0, 1], angle: 90}}}}, {{translate: {move.tolist()}}}]}}"
    )
    points = [(turn @ point + move).tolist() for point in (a, b)]
    other = model(tmp_path, line.format(a=points[0], b=points[1], q=q.tolist(), d=d.tolist()), [moved], "", "[]")
    assert case_of(other).dead_load[:, 2] == pytest.approx(case_of(plain).dead_load[:, 2], abs=1e-9)
    assert np.count_nonzero(case_of(plain).dead_load[:, 2]) == 9
