from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.model.geometry.cells import join_cells
from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.inp import read_inp
from mbla.model.geometry.repair import repair
from mbla.model.solids.polyhedra import cuboids
from tests.model.shapes import box, build_raw

LOW = "*NODE\n" + "".join(f"{i + 1}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(box()[0]))
HIGH = "*Node, NSET=top\n" + "".join(f"{i + 9}, {x}, {y}, {z + 1}.\n" for i, (x, y, z) in enumerate(box()[0][4:]))
TWO = "*ELEMENT, TYPE=C3D8I, ELSET=Eall\n1, 1,2,3,4, 5,6,7,8\n2, 5,6,7,8,\n 9,10,11,12\n"


def read(folder: Path, text: str) -> Geometry:
    path = folder / "mesh.inp"
    path.write_text(text)
    return read_inp(path)


def volumes(geometry: Geometry) -> list[float]:
    built = build_raw(repair(geometry, 1e-3).polyhedra)
    assert built.defects == ()
    return [float(volume) for volume in built.blocks.volumes]


def test_several_node_cards_and_elements_over_several_lines(tmp_path: Path) -> None:
    geometry = read(tmp_path, f"*HEADING\nwall\n** comment\n{LOW}{HIGH}{TWO}*MATERIAL, NAME=stone\n*DENSITY\n2000.\n")
    assert volumes(geometry) == [1, 1]
    assert geometry.names == ("Eall", "Eall")


def test_the_smallest_set_names_an_element(tmp_path: Path) -> None:
    sets = "*ELSET, ELSET=upper\n2,\n*Elset, elset=both, generate\n1, 2\n*ELSET,ELSET=again\nboth\n"
    assert read(tmp_path, LOW + HIGH + TWO + sets).names == ("again", "upper")


@pytest.mark.parametrize(("kind", "nodes"), [("C3D20R", 20), ("C3D10", 10), ("C3D15", 15), ("C3D4", 4), ("C3D6", 6)])
def test_types_and_second_order(tmp_path: Path, kind: str, nodes: int) -> None:
    shapes = {8: 1.0, 4: 1 / 6, 6: 0.5}
    corners = {20: 8, 10: 4, 15: 6, 4: 4, 6: 6}[nodes]
    points = {
        8: box()[0],
        4: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        6: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
    }[corners]
    every = [*points, *([9.0, 9.0, i] for i in range(nodes - corners))]
    text = "*NODE\n" + "".join(f"{i + 1},{x},{y},{z}\n" for i, (x, y, z) in enumerate(every))
    numbers = ",".join(str(i) for i in range(1, nodes + 1))
    assert volumes(read(tmp_path, f"{text}*ELEMENT,TYPE={kind}\n7,{numbers}\n")) == pytest.approx([shapes[corners]])


def test_shells_of_the_sides_of_a_block(tmp_path: Path) -> None:
    cards = "".join(
        f"*ELEMENT, TYPE=S4R, ELSET=side{i}\n{i + 1}, {', '.join(str(corner + 1) for corner in face)}\n"
        for i, face in enumerate(box()[1])
    )
    assert volumes(read(tmp_path, LOW + cards)) == [1]


def test_other_elements_are_left_out_with_a_notice(tmp_path: Path) -> None:
    geometry = read(tmp_path, f"{LOW}{HIGH}{TWO}*ELEMENT, TYPE=B31\n3, 1, 2\n*ELEMENT, TYPE=S4\n4, 1, 2, 3, 4\n")
    assert [notice.message for notice in geometry.notices] == [
        "cells were left out: 1 of type B31, 1 of type S4; in files with volume cells only these become blocks"
    ]


def test_cells_of_a_set_joined(tmp_path: Path) -> None:
    geometry = join_cells(read(tmp_path, LOW + HIGH + TWO))
    assert volumes(geometry) == pytest.approx([2])
    apart = join_cells(read(tmp_path, LOW + HIGH + TWO + "*ELSET, ELSET=upper\n2\n"))
    assert volumes(apart) == pytest.approx([1, 1])
    assert repair(apart, 1e-3).names == ("Eall", "upper")


def test_cells_joined_to_a_ring_keep_its_hole(tmp_path: Path) -> None:
    least = np.array([[x, 0, z] for x in range(3) for z in range(3) if (x, z) != (1, 1)], dtype=float)
    geometry = join_cells(Geometry(cuboids(least, least + 1), cells=True))
    assert volumes(geometry) == pytest.approx([8])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("*NODE\n1, 0, 0, x\n", "line 2 cannot be read: could not convert string to float: 'x'"),
        (LOW + "*ELEMENT, TYPE=C3D8\n1, 1, 2, 3\n", "line 10: the last element has fewer than the 8 nodes of a C3D8"),
        (LOW + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 99\n", "an element names node 99, which does not exist"),
        (LOW + "*INCLUDE, INPUT=/etc/passwd\n", "line 10: *INCLUDE is not followed: put the mesh into one file"),
        (LOW + "*INSTANCE, NAME=a\n", "line 10: *INSTANCE is not followed: write the input without parts"),
        ("nothing\n", "is not a well-formed Abaqus or CalculiX .inp file: it has no nodes"),
    ],
)
def test_malformed(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(GeometryFileError) as caught:
        read(tmp_path, text)
    assert str(caught.value).startswith(message)


def test_a_set_made_of_several_ranges(tmp_path: Path) -> None:
    apart = "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,7,8\n2, 5,6,7,8,9,10,11,12\n9, 1,2,3,4,9,10,11,12\n"
    sets = "*ELSET, ELSET=both, GENERATE\n1, 1\n8, 10\n"
    assert read(tmp_path, LOW + HIGH + apart + sets).names == ("both", "", "both")


def test_cells_of_no_set_are_joined_beside_those_of_one() -> None:
    least = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 2]], dtype=float)
    joined = join_cells(Geometry(cuboids(least, least + 1), names=("", "top", ""), cells=True))
    assert joined.names == ("", "top")
    assert volumes(joined) == pytest.approx([1, 1, 1])


def test_cells_of_one_set_that_lie_apart_are_blocks_of_their_own() -> None:
    least = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 5]], dtype=float)
    joined = join_cells(Geometry(cuboids(least, least + 1), cells=True))
    assert len(joined.polyhedra) == 1
    assert volumes(joined) == pytest.approx([2, 1])


def test_a_range_far_beyond_the_elements_names_those_there_are(tmp_path: Path) -> None:
    geometry = read(tmp_path, LOW + HIGH + TWO + "*ELSET, ELSET=upper, GENERATE\n2, 1000000000\n")
    assert geometry.names == ("Eall", "upper")
