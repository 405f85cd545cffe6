"""A structure cut along the path of a travelling load."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from mbla.deck import read_deck
from mbla.model.build import build_model
from mbla.model.fill.fill import columns
from mbla.model.model import Model
from mbla.questions.travel_position import TravelPosition
from mbla.results.pictures.section import SectionPlane, cut_blocks, cut_fill, lines_along, plane_along, rings_around
from tests.decks.folder import DECKS

ALONG_X = SectionPlane(np.array([1.0, 2.0, 0.0]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))


def standing(points: list[list[float]], distances: list[float]) -> list[TravelPosition]:
    forces, blocks = np.array([[0.0, 0.0, -1.0]]), np.zeros(1, dtype=np.int64)
    return [
        TravelPosition("axle", number, len(points), np.array([point]), np.array([distance]), forces, blocks)
        for number, (point, distance) in enumerate(zip(points, distances, strict=True), start=1)
    ]


def area(outlines: list[np.ndarray]) -> float:
    return float(sum(shapely.Polygon(outline).area for outline in outlines))


@pytest.fixture(scope="module")
def bridge() -> Model:
    return build_model(read_deck(DECKS / "structures/filled_bridge.yaml"))


def test_a_section_has_the_area_of_volume_over_width(bridge: Model) -> None:
    """Barrel, backing and abutments are as wide as the bridge; the fill between spandrels of 0.4 m is 3.2 m wide."""
    blocks = bridge.blocks
    found = cut_blocks(blocks, ALONG_X)
    cut = np.unique([block for block, _ in found])
    for block in cut:
        own = [outline for each, outline in found if each == block]
        width = np.ptp(blocks.vertices[blocks.block_of_vertex == block, 1])
        assert area(own) == pytest.approx(blocks.volumes[block] / width, rel=1e-9)
    assert bridge.fill is not None
    body = bridge.fill.bodies["road"]
    volume = columns(body, blocks).volumes.sum()
    assert area(cut_fill(body, ALONG_X)) == pytest.approx(volume / 3.2, rel=1e-5)
    assert min(outline[:, 0].min() for _, outline in found) == pytest.approx(-3.0)  # the abutment, from x = 1


def test_a_path_along_a_joint_cuts_one_of_the_blocks_beside_it(bridge: Model) -> None:
    """At the inner side of a spandrel, y = 0.4, the plane passes the barrel just inside."""
    inside = SectionPlane(np.array([0.0, 0.4, 0.0]), ALONG_X.along, ALONG_X.across)
    assert len(cut_blocks(bridge.blocks, inside)) == len(cut_blocks(bridge.blocks, ALONG_X))
    beside = SectionPlane(np.array([0.0, 9.0, 0.0]), ALONG_X.along, ALONG_X.across)
    assert cut_blocks(bridge.blocks, beside) == []
    assert bridge.fill is not None
    assert cut_fill(bridge.fill.bodies["road"], beside) == []


def test_a_straight_path_has_a_plane() -> None:
    plane = plane_along(standing([[2, 1, 5], [2, 3, 5], [2, 7, 5]], [1.0, 3.0, 7.0]))
    assert plane is not None
    assert plane.origin[:2] == pytest.approx([2, 0])
    assert plane.places(np.array([0.0, 4.0, 9.0])) == pytest.approx([4.0, 9.0])


@pytest.mark.parametrize(
    ("points", "distances"),
    [
        ([[0, 0, 0], [4, 4, 0], [8, 0, 0]], [0.0, 5.66, 11.3]),  # round a corner
        ([[0, 0, 0], [1, 0, 1], [2, 0, 2]], [0.0, 1.41, 2.83]),  # up a stair
        ([[1, 1, 0]], [0.0]),
    ],
)
def test_no_other_path_has_one(points: list[list[float]], distances: list[float]) -> None:
    assert plane_along(standing(points, distances)) is None


def test_rings_around_cells_leave_out_seams() -> None:
    """Four quarters of a square ring: one around them, one around the hole."""
    corners = np.array([[0, 0], [3, 0], [3, 3], [0, 3]], dtype=float)
    inner = np.array([[1, 1], [2, 1], [2, 2], [1, 2]], dtype=float)
    cells = [np.array([corners[i], corners[i - 3], inner[i - 3], inner[i]]) for i in range(4)]
    cells[1] = cells[1] + 1e-9
    found = rings_around(cells, 4.0)
    assert sorted(shapely.Polygon(ring).area for ring in found) == pytest.approx([1.0, 9.0], rel=1e-5)


def test_lines_along_the_plane() -> None:
    lines = np.array([[[1.0, 9, 0], [2, 9, 1]], [[1, 0, 0], [1, 4, 0]]])
    assert lines_along(lines, ALONG_X).tolist() == [[[0.0, 0.0], [1.0, 1.0]]]
