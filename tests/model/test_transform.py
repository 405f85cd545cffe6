from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck.sections.placement import Repetition, TransformStep
from mbla.model.blocks.arch import ArchItem, generate
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart
from mbla.model.transform import AffineMap, build_transform, repetitions, transform_item
from tests.model.shapes import L_OUTLINE, build_raw, prism, raw


def transform(*steps: dict[str, Any]) -> AffineMap:
    found = build_transform([TransformStep.model_validate(step) for step in steps])
    assert found is not None
    return found


def images(*steps: dict[str, Any]) -> Any:
    return transform(*steps).points(np.array([[1.0, 2.0, 3.0]]))[0]


def test_nothing_to_do() -> None:
    assert build_transform([]) is None


def test_translate() -> None:
    assert images({"translate": (10, 20, 30)}) == pytest.approx([11, 22, 33])


def test_scale_is_about_the_origin() -> None:
    assert images({"scale": 0.5}) == pytest.approx([0.5, 1, 1.5])


@pytest.mark.parametrize(
    ("axis", "image"),
    [((0, 0, 1), (-2, 1, 3)), ((0, 0, -7), (2, -1, 3)), ((1, 0, 0), (1, -3, 2)), ((1, 1, 1), (3, 1, 2))],
)
def test_rotation_is_right_handed(axis: tuple[float, ...], image: tuple[float, ...]) -> None:
    angle = 120 if axis == (1, 1, 1) else 90
    assert images({"rotate": {"axis": axis, "angle": angle}}) == pytest.approx(image)


def repeated(*steps: dict[str, Any]) -> Any:
    maps = repetitions([Repetition.model_validate(step) for step in steps])
    return np.array([each.points(np.array([1.0, 0.0, 0.0])) for each in maps])


def test_nothing_repeated_is_there_once() -> None:
    assert repeated().tolist() == [[1, 0, 0]]


def test_repetition_along_a_line() -> None:
    assert repeated({"count": 3, "translate": (0.1, 0, 2)}) == pytest.approx(
        np.array([[1, 0, 0], [1.1, 0, 2], [1.2, 0, 4]])
    )


def test_repetition_around_an_axis_comes_back_exactly() -> None:
    around = repeated({"count": 4, "rotate": {"axis": (0, 0, 1), "angle": 90}})
    assert around.tolist() == [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]


def test_of_two_repetitions_the_last_varies_slowest() -> None:
    grid = repeated({"count": 2, "translate": (1, 0, 0)}, {"count": 3, "translate": (0, 10, 0)})
    assert grid[:, :2].tolist() == [[1, 0], [2, 0], [1, 10], [2, 10], [1, 20], [2, 20]]


def test_rotation_about_a_point() -> None:
    assert images({"rotate": {"axis": (0, 0, 1), "angle": 180, "about": (1, 1, 0)}}) == pytest.approx([1, 0, 3])


@pytest.mark.parametrize("angle", [90, 180, 270, -90, 450])
def test_right_angles_are_exact(angle: float) -> None:
    matrix = transform({"rotate": {"axis": (0, 0, 3), "angle": angle}}).matrix
    assert set(np.unique(matrix)) <= {-1.0, 0.0, 1.0}


def test_mirror() -> None:
    assert images({"mirror": {"normal": (2, 0, 0), "point": (5, 0, 0)}}) == pytest.approx([9, 2, 3])


def test_steps_are_applied_in_order() -> None:
    shift, turn = {"translate": (1, 0, 0)}, {"rotate": {"axis": (0, 0, 1), "angle": 90}}
    assert images(shift, turn) == pytest.approx([-2, 2, 3])
    assert images(turn, shift) == pytest.approx([-1, 1, 3])


@pytest.mark.parametrize("mirrors", [0, 1, 2])
def test_faces_stay_outwards_without_a_notice(mirrors: int) -> None:
    steps = [{"mirror": {"normal": (1, 2, 3), "point": (1, 1, 0)}}] * mirrors + [{"scale": 3.0}]
    moved = transform_item(Generated((ItemPart(raw(prism(L_OUTLINE))),)), transform(*steps))
    built = build_raw(moved.parts[0].polyhedra)
    assert built.notices == ()
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([81.0])


def test_grounds_of_springers_move_along() -> None:
    item = ArchItem(
        material="stone", shape="semicircular", span=4.0, thickness=0.3, width=1.0, voussoirs=9, springers="ground"
    )
    made = generate(item, ItemContext(1e-3, lambda path, name: Path(name)))
    steps: list[dict[str, Any]] = [
        {"rotate": {"axis": (1, 1, 0), "angle": 35}},
        {"mirror": {"normal": (1, 2, 3)}},
        {"scale": 2.0},
        {"translate": (1, 2, 3)},
    ]
    moved = transform_item(made, transform(*steps))
    corners = moved.parts[0].polyhedra.vertices.reshape(-1, 8, 3)
    for ground in moved.grounds:
        assert np.linalg.norm(ground.normal) == pytest.approx(1)
        heights = np.sort((corners[ground.blocks[0]] - ground.point) @ ground.normal)
        assert heights[:4] == pytest.approx([0] * 4, abs=1e-12)
        assert heights[4] > 0.1
