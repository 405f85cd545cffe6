"""Every byte of a VTU file is that of meshio, which is not asked, but for the line that names the program."""

import zlib
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import meshio
import numpy as np
import pytest
from meshio.vtu import _vtu

import mbla
from mbla.errors import FileError
from mbla.model.polyhedra import HEXAHEDRON
from mbla.results.paraview.vtu_file import BLOCK_BYTES, COMPRESSION, write_mesh
from tests.results.reading import read_vtk

RANDOM = np.random.default_rng(3)
CUBES = np.arange(80).reshape(10, 8)
MANY = BLOCK_BYTES // 8  # numbers that fill a block of compression

MIXED: list[tuple[str, Any]] = [
    ("tetra", np.arange(8).reshape(2, 4)),
    ("wedge", np.arange(8, 26).reshape(3, 6)),
    ("hexahedron", np.arange(26, 34).reshape(1, 8)),
]
CELLS: dict[str, list[tuple[str, Any]]] = {
    "volumes": MIXED,
    "polygons": [("polygon", np.arange(10).reshape(2, 5)), ("polygon", np.arange(10, 22).reshape(2, 6))],
    "lines": [("line", np.arange(12).reshape(6, 2)), ("vertex", np.arange(12, 20)[:, None])],
    "polyhedra": [("polyhedron", [[corners[face] for face in np.array(HEXAHEDRON)] for corners in CUBES])],
    "whole blocks": [("vertex", np.arange(2 * MANY)[:, None])],
    "a bit more": [("vertex", np.arange(2 * MANY + 1)[:, None])],
}


def data_on(cells: list[tuple[str, Any]], n_points: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Of every type and shape that the files hold."""
    on_points = {"displacement": RANDOM.standard_normal((n_points, 3)), "mode": np.arange(n_points, dtype=np.int8)}
    on_cells = {
        "block": [np.arange(len(block)) for _, block in cells],
        "velocity": [RANDOM.standard_normal((len(block), 3)) for _, block in cells],
        "nothing": [np.full(len(block), np.nan) for _, block in cells],
    }
    return on_points, on_cells


@pytest.mark.parametrize("name", CELLS)
def test_the_bytes_are_those_of_meshio(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    compress = partial(zlib.compress, level=COMPRESSION)
    monkeypatch.setattr(_vtu, "zlib", SimpleNamespace(compress=compress))
    cells = CELLS[name]
    points = RANDOM.standard_normal((2 * MANY + 1, 3))
    on_points, on_cells = data_on(cells, len(points))
    write_mesh(tmp_path / "own.vtu", points, cells, on_points, on_cells)
    meshio.write(tmp_path / "its.vtu", meshio.Mesh(points, cells, on_points, on_cells), file_format="vtu")
    own, its = (tmp_path / "own.vtu").read_text("ascii"), (tmp_path / "its.vtu").read_text("ascii")
    assert own == its.replace(f"meshio v{meshio.__version__}", f"mbla {mbla.__version__}")


def test_arrays_that_differ_in_type_alone_are_not_taken_for_each_other(tmp_path: Path) -> None:
    """Sixteen zeros of one byte have the bytes of two of eight: these are kept encoded, the name of the type is not."""
    points, cells = np.zeros((16, 3)), [("vertex", np.arange(16)[:, None])]
    on_points: dict[str, Any] = {"small": np.zeros(16, dtype=np.int8), "large": np.zeros(16, dtype=np.int64)}
    write_mesh(tmp_path / "file.vtu", points, cells, on_points, {})
    found = meshio.read(tmp_path / "file.vtu").point_data
    assert [found[name].dtype for name in on_points] == [np.int8, np.int64]
    assert read_vtk(tmp_path / "file.vtu").GetNumberOfCells() == 16


@pytest.mark.parametrize("wrong", ["points", "cells"])
def test_data_of_another_length_is_refused(tmp_path: Path, wrong: str) -> None:
    points, cells = np.zeros((4, 3)), [("vertex", np.arange(4)[:, None])]
    on_points = {"force": np.zeros(3 if wrong == "points" else 4)}
    on_cells = {"block": [np.zeros(5 if wrong == "cells" else 4)]}
    with pytest.raises(ValueError, match=f"rows for 4 {wrong}"):
        write_mesh(tmp_path / "file.vtu", points, cells, on_points, on_cells)


@pytest.mark.parametrize("turned", [False, True])
def test_polyhedra_among_other_cells_are_refused(tmp_path: Path, turned: bool) -> None:
    body: list[tuple[str, Any]] = [
        ("polyhedron", [[np.array(face) for face in HEXAHEDRON]]),
        ("vertex", np.array([[0]])),
    ]
    with pytest.raises(ValueError, match="cannot be mixed"):
        write_mesh(tmp_path / "file.vtu", np.zeros((8, 3)), body[::-1] if turned else body, {}, {})


def test_a_place_that_does_not_exist(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"nowhere/file\.vtu: cannot be written: No such file"):
        write_mesh(tmp_path / "nowhere" / "file.vtu", np.zeros((1, 3)), [("vertex", np.array([[0]]))], {}, {})
