from __future__ import annotations

from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.geometry.dxf import enclosed_fields, read_dxf
from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.repair import repair
from tests.model.shapes import build_raw

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def drawing(version: str = "R2010") -> tuple[Any, Any]:
    document = ezdxf.new(version)  # type: ignore[attr-defined]
    return document, document.modelspace()


def read(document: Any, folder: Path) -> Geometry:
    path = folder / "plan.dxf"
    document.saveas(path)
    return read_dxf(path)


def areas(geometry: Geometry) -> list[float]:
    """Of the outlines: volumes of prisms of thickness 1."""
    built = build_raw(repair(geometry, 1e-3).polyhedra)
    assert built.defects == ()
    assert built.notices == ()
    return [float(volume) for volume in built.blocks.volumes]


@pytest.mark.parametrize("version", ["R2000", "R2018"])
@pytest.mark.parametrize("sense", [1, -1])
def test_closed_polylines_by_layer(tmp_path: Path, version: str, sense: int) -> None:
    document, space = drawing(version)
    space.add_lwpolyline(SQUARE[::sense], close=True, dxfattribs={"layer": "stones"})
    space.add_lwpolyline([(2, 0), (4, 0), (4, 1), (3, 1), (3, 2), (2, 2)], close=True, dxfattribs={"layer": "key"})
    space.add_polyline2d([(5, 0), (6, 0), (6, 3)], close=True)
    space.add_lwpolyline([*((x + 7, y) for x, y in SQUARE), (7, 0)])  # closed by its last point alone
    geometry = read(document, tmp_path)
    assert areas(geometry) == pytest.approx([1, 3, 1.5, 1])
    assert geometry.names == ("stones", "key", "0", "0")
    assert geometry.planar


@pytest.mark.parametrize(("code", "unit"), [(0, None), (1, "in"), (4, "mm"), (6, "m"), (10, None)])
def test_unit_of_the_header(tmp_path: Path, code: int, unit: str | None) -> None:
    document, space = drawing()
    document.header["$INSUNITS"] = code
    space.add_lwpolyline(SQUARE, close=True)
    assert read(document, tmp_path).unit == unit


def test_y_of_the_drawing_is_z_of_the_deck(tmp_path: Path) -> None:
    document, space = drawing()
    space.add_lwpolyline([(1, 5), (2, 5), (2, 6)], close=True)
    vertices = read(document, tmp_path).polyhedra.vertices
    assert vertices.min(axis=0).tolist() == [1, 0, 5]
    assert vertices.max(axis=0).tolist() == [2, 1, 6]


def test_arcs_become_chords(tmp_path: Path) -> None:
    document, space = drawing()
    space.add_circle((0, 0), 1.0)
    space.add_lwpolyline([(3, 0, 0, 0, 1), (3, 2, 0, 0, 0)], close=True)  # a half disc by its bulge
    circle, half = areas(read(document, tmp_path))
    assert circle == pytest.approx(np.pi, rel=1e-3)
    assert half == pytest.approx(np.pi / 2, rel=1e-3)
    assert circle < np.pi


def test_an_arc_alone_encloses_nothing(tmp_path: Path) -> None:
    document, space = drawing()
    space.add_lwpolyline(SQUARE, close=True)
    space.add_arc((5, 5), 1.0, 0, 270)
    geometry = read(document, tmp_path)
    assert areas(geometry) == pytest.approx([1.0])
    assert [notice.identifier for notice in geometry.notices] != []


def test_blocks_are_inserted_where_they_are_referenced(tmp_path: Path) -> None:
    document, space = drawing()
    unit = document.blocks.new("unit")
    unit.add_lwpolyline(SQUARE, close=True)
    space.add_blockref("unit", (0, 0), dxfattribs={"layer": "low"})
    space.add_blockref("unit", (0, 1), dxfattribs={"layer": "high", "xscale": 2})
    geometry = read(document, tmp_path)
    assert areas(geometry) == pytest.approx([1, 2])
    assert geometry.names == ("low", "high")


def test_fields_between_lines(tmp_path: Path) -> None:
    """A wall drawn joint by joint: bed joints run through, head joints end on them; one line dangles."""
    document, space = drawing()
    for z in range(3):
        space.add_line((0, z), (4, z))
    for z, xs in enumerate(((0, 2, 4), (0, 1, 3, 4))):
        for x in xs:
            space.add_line((x, z), (x, z + 1))
    space.add_line((4, 2), (5, 3))
    geometry = read(document, tmp_path)
    assert areas(geometry) == pytest.approx([2, 2, 1, 2, 1])
    assert [notice.message for notice in geometry.notices] == [
        "5 fields were taken as outlines between lines of layer 0",
        "1 line was left out of layer 0: no field is enclosed",
    ]


def test_what_is_no_outline_is_left_out_with_a_warning(tmp_path: Path) -> None:
    document, space = drawing()
    space.add_lwpolyline(SQUARE, close=True)
    space.add_text("plan")
    space.add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 1)])
    document.layers.add("hidden").off()
    space.add_lwpolyline(SQUARE, close=True, dxfattribs={"layer": "hidden"})
    geometry = read(document, tmp_path)
    assert areas(geometry) == [1]
    assert [notice.message for notice in geometry.notices] == [
        "entities were left out: 1 of type 3DFACE; no outlines",
        "1 outline or line was left out of layer hidden, which is off or frozen",
    ]


def test_an_outline_off_the_plane_is_refused(tmp_path: Path) -> None:
    document, space = drawing()
    space.add_polyline3d([(0, 0, 0), (1, 0, 0), (1, 1, 1)], close=True, dxfattribs={"layer": "slope"})
    with pytest.raises(GeometryFileError, match="a POLYLINE on layer slope does not lie in the drawing's x-y plane"):
        read(document, tmp_path)


def test_lines_that_meet_without_end_are_refused() -> None:
    at = np.arange(400.0)
    across = [np.array([[x, -1.0], [x, 400.0]]) for x in at]
    along = [np.array([[-1.0, y], [400.0, y]]) for y in at]
    assert len(enclosed_fields(across[:50] + along[:50])[0]) == 49 * 49
    with pytest.raises(GeometryFileError) as caught:
        enclosed_fields(across + along)
    assert caught.value.message.identifier == "geometry-too-large"
    assert str(caught.value) == "has lines that meet each other more than 100,000 times"


@pytest.mark.parametrize("points", [[(2, 3)], [(2, 3), (2, 3)], [(2, 3), (3, 4)]])
def test_a_closed_outline_without_area_is_refused(tmp_path: Path, points: list[tuple[float, float]]) -> None:
    document, space = drawing()
    space.add_lwpolyline(SQUARE, close=True)
    space.add_lwpolyline(points, close=True, dxfattribs={"layer": "lost"})
    with pytest.raises(GeometryFileError, match="a LWPOLYLINE on layer lost has no area: it is closed"):
        read(document, tmp_path)


def test_a_million_copies_of_a_block_are_refused(tmp_path: Path) -> None:
    document, space = drawing()
    document.blocks.new("stone").add_lwpolyline(SQUARE, close=True)
    reference = space.add_blockref("stone", (0, 0))
    reference.grid(size=(1000, 1000), spacing=(2, 2))
    with pytest.raises(GeometryFileError) as caught:
        read(document, tmp_path)
    assert caught.value.message.identifier == "geometry-too-large"
    assert str(caught.value) == "inserts blocks more than 20000 times"


def lines(*places: list[tuple[float, float]]) -> list[FloatArray]:
    return [np.array(each, dtype=float) for each in places]


def corners(outlines: list[FloatArray]) -> list[list[tuple[float, float]]]:
    """Corners of each outline, sorted."""
    return [sorted((float(x), float(z)) for x, z in outline) for outline in outlines]


def test_open_polylines_bound_fields_as_lines_do() -> None:
    fields, loose = enclosed_fields(lines([(0, 0), (2, 0), (2, 1), (0, 1)], [(0, 1), (0, 0)], [(1, -1), (1, 2)]))
    assert corners(fields) == [[(0, 0), (0, 1), (1, 0), (1, 1)], [(1, 0), (1, 1), (2, 0), (2, 1)]]
    assert loose == 2


@pytest.mark.parametrize("far", [0.0, 1e6])
def test_ends_meet_by_the_size_of_the_drawing_wherever_it_lies(far: float) -> None:
    def triangle(gap: float) -> list[FloatArray]:
        return lines([(far, 0), (far + 1, 0)], [(far + 1, 0), (far + 1, 1)], [(far + 1, 1), (far, gap)])

    fields, loose = enclosed_fields(triangle(5e-7))
    assert corners(fields) == [[(far, 0), (far + 1, 0), (far + 1, 1)]]
    assert loose == 0
    assert enclosed_fields(triangle(5e-6)) == ([], 3)
