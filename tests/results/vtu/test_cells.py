from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.geometry.meshio_files import write_mesh
from mbla.results.vtu.vtu import block_cells
from tests.results.reading import vtk_volumes
from tests.results.shapes import BRICK, PYRAMID, TETRA, WEDGE, blocks_of

CORNERS_OF_A_CELL = {
    # rows: three edges from the first node of each cell, right-handed when the cell is listed as VTK wants it
    "tetra": [0, 1, 2, 3],
    "hexahedron": [0, 1, 3, 4],
    "wedge": [0, 2, 1, 3],
}


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(
    ("shapes", "cells"),
    [
        ([BRICK, BRICK], ["hexahedron"]),
        ([TETRA, BRICK, WEDGE, BRICK, TETRA], ["tetra", "wedge", "hexahedron"]),
        ([BRICK, PYRAMID, TETRA], ["polyhedron"]),
    ],
)
def test_cells_have_the_volumes_of_their_blocks(tmp_path: Path, shapes: Any, cells: list[str], seed: int) -> None:
    blocks = blocks_of(shapes, seed)
    found = block_cells(blocks)
    assert [cell for cell, _ in found.cells] == cells
    assert sorted(np.concatenate(found.rows)) == list(range(len(blocks)))
    path = tmp_path / "blocks.vtu"
    write_mesh(path, blocks.vertices, found.cells, cell_data={"block": list(found.rows)})
    assert vtk_volumes(path) == pytest.approx(blocks.volumes[np.concatenate(found.rows)], rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_cells_are_listed_right_handed(seed: int) -> None:
    """VTK takes a cell listed inside out without a word and gives it inward normals."""
    blocks = blocks_of([TETRA, BRICK, WEDGE], seed)
    for cell, connectivity in block_cells(blocks).cells:
        nodes = blocks.vertices[connectivity[:, CORNERS_OF_A_CELL[cell]]]
        edges = nodes[:, 1:] - nodes[:, :1]
        assert (np.linalg.det(edges) > 0).all()


def test_block_that_only_counts_like_a_brick_is_a_polyhedron() -> None:
    """Eight vertices and six faces, but two of the faces have three corners and two have five."""
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
    faces = [[3, 0, 4, 7], [0, 3, 2, 1], [4, 5, 6], [4, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6]]
    blocks = blocks_of([(corners, faces, 1.0)])
    assert block_cells(blocks).cells[0][0] == "polyhedron"
