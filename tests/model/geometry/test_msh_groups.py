"""Names that a Gmsh file gives to its physical groups."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.model.geometry import read_geometry
from tests.trust.geometry.formats import FORMATS
from tests.trust.geometry.stones import arch


@pytest.mark.parametrize("kind", ["msh", "msh cells"])
def test_groups_name_their_blocks(tmp_path: Path, kind: str) -> None:
    stones = arch()
    ((name, content),) = FORMATS[kind].write(stones).items()
    path = tmp_path / name
    path.write_bytes(content)
    assert read_geometry(path).names == tuple(stone.name for stone in stones)


def test_groups_without_names_name_nothing(tmp_path: Path) -> None:
    ((name, content),) = FORMATS["msh cells"].write(arch()).items()
    before, _, rest = content.partition(b"$PhysicalNames")
    path = tmp_path / name
    path.write_bytes(before + rest.partition(b"$EndPhysicalNames\n")[2])
    assert read_geometry(path).names == ()


def test_groups_of_cells_of_two_shapes(tmp_path: Path) -> None:
    text = (
        '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 "foot"\n3 2 "cap"\n$EndPhysicalNames\n'
        "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 0\n6 0 0 -1\n$EndNodes\n"
        "$Elements\n2\n1 4 2 2 1 1 2 3 4\n2 7 2 1 1 1 2 5 3 6\n$EndElements\n"
    )
    path = tmp_path / "stones.msh"
    path.write_text(text)
    assert read_geometry(path).names == ("cap", "foot")


def test_groups_of_faces_beside_cells_name_no_block(tmp_path: Path) -> None:
    text = (
        '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 "foot"\n3 2 "stone"\n$EndPhysicalNames\n'
        "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
        "$Elements\n2\n1 2 2 1 1 1 2 3\n2 4 2 2 1 1 2 3 4\n$EndElements\n"
    )
    path = tmp_path / "stone.msh"
    path.write_text(text)
    assert read_geometry(path).names == ("stone",)
