"""Files in the forms that COMPAS 1.17 and 2.15, compas_assembly and compas_dem write."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from mbla.model.geometry.compas_json import read_compas_json
from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.repair import repair
from tests.model.shapes import box, build_raw


def mesh(name: str | None = None, at: float = 0.0, version: int = 2) -> dict[str, Any]:
    vertices, faces = box((0, 0, at), (1, 1, at + 1))
    content: dict[str, Any] = {
        "attributes": {"name": name} if name and version == 1 else {},
        "vertex": {str(10 * i): dict(zip("xyz", point, strict=True)) for i, point in enumerate(vertices)},
        "face": {str(i): [10 * corner for corner in face] for i, face in enumerate(faces)},
        "facedata": {},
        "edgedata": {},
        "max_vertex": 70,
    }
    entry = {"dtype": "compas.datastructures/Mesh", "data" if version == 2 else "value": content, "guid": "x"}
    return entry | ({"name": name} if name and version == 2 else {})


def translation(*offset: float) -> dict[str, Any]:
    matrix = [[float(i == j) for j in range(3)] + [offset[i]] for i in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
    return {"dtype": "compas.geometry/Translation", "data": {"matrix": matrix}}


def read(folder: Path, document: Any) -> Geometry:
    path = folder / "blocks.json"
    path.write_text(json.dumps(document))
    return read_compas_json(path)


def heights(geometry: Geometry) -> list[float]:
    built = build_raw(repair(geometry, 1e-3).polyhedra)
    assert built.defects == ()
    assert built.notices == ()
    assert built.blocks.volumes == pytest.approx(1)
    return [float(z) for z in built.blocks.centroids[:, 2]]


@pytest.mark.parametrize("version", [1, 2])
def test_meshes_alone_in_lists_and_in_mappings(tmp_path: Path, version: int) -> None:
    one, two = mesh("a", 0, version), mesh(None, 1, version)
    assert heights(read(tmp_path, one)) == [0.5]
    assert heights(read(tmp_path, [one, two])) == [0.5, 1.5]
    assert heights(read(tmp_path, {"blocks": [one, two], "remark": "two"})) == [0.5, 1.5]
    assert read(tmp_path, [one, two]).names == ("a", "")


def test_a_mesh_as_to_json_of_version_1_writes_it(tmp_path: Path) -> None:
    assert heights(read(tmp_path, mesh("a", 0, 1)["value"])) == [0.5]


def test_assembly_of_version_1_with_supports(tmp_path: Path) -> None:
    nodes = {str(i): {"block": mesh(f"b{i}", i, 1), "is_support": i == 0} for i in range(3)}
    edge = {"0": {"1": {"interfaces": [mesh("surface", 0, 1)]}}}
    graph = {"attributes": {}, "node": nodes, "edge": edge, "adjacency": {}}
    assembly = {"dtype": "compas_assembly.datastructures/Assembly", "value": {"attributes": {}, "graph": graph}}
    geometry = read(tmp_path, assembly)
    assert heights(geometry) == [0.5, 1.5, 2.5]
    assert geometry.names == ("support", "b1", "b2")
    assert [notice.identifier for notice in geometry.notices] == ["mesh-supports-marked"]


def test_assembly_of_version_2(tmp_path: Path) -> None:
    parts = {
        str(i): {"part": {"dtype": "compas.datastructures/Part", "data": {"attributes": {"shape": mesh(f"p{i}", i)}}}}
        for i in range(2)
    }
    assembly = {"dtype": "compas.datastructures/Assembly", "data": {"graph": {"node": parts, "edge": {}}}}
    geometry = read(tmp_path, assembly)
    assert heights(geometry) == [0.5, 1.5]
    assert geometry.names == ("p0", "p1")


def test_model_with_groups_and_transformations(tmp_path: Path) -> None:
    def element(kind: str, **keys: Any) -> dict[str, Any]:
        return {"dtype": f"compas_dem.elements/{kind}", "data": {"transformation": None, "name": kind} | keys}

    elements = {
        "g": element("Group", transformation=translation(0, 0, 10)),
        "a": element("Block", geometry=mesh("stone"), transformation=translation(0, 0, 2)),
        "b": element("Block", geometry=mesh("stone"), is_support=True),
    }
    tree = {"root": {"children": [{"element": "g", "children": [{"element": "a"}]}, {"element": "b"}]}}
    model = {
        "dtype": "compas_dem.models/BlockModel",
        "data": {"elements": elements, "tree": tree, "graph": {"node": {"0": {"element": "a"}}}},
    }
    geometry = read(tmp_path, model)
    assert heights(geometry) == [12.5, 0.5]
    assert geometry.names == ("stone", "support")


def test_polyhedron(tmp_path: Path) -> None:
    vertices, faces = box()
    shape = {"dtype": "compas.geometry/Polyhedron", "data": {"vertices": vertices, "faces": faces}}
    assert heights(read(tmp_path, shape)) == [0.5]


def test_solids_without_faces(tmp_path: Path) -> None:
    solid = {"dtype": "compas.geometry/Box", "data": {"xsize": 1.0}}
    with pytest.raises(GeometryFileError, match="holds no mesh, but objects of type Box: convert them"):
        read(tmp_path, [solid])
    geometry = read(tmp_path, [mesh(), solid])
    assert [notice.message for notice in geometry.notices] == ["1 object was left out, of type Box: no meshes"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"face": {"0": [0, 10, 999]}}, "face 0 names vertex 999, which does not exist"),
        ({"face": {"0": [0, 10]}}, "a face has fewer than three corners"),
        ({"vertex": {"0": {"x": "a"}}}, "vertex 0 has no number as x"),
        ({"vertex": {"0": 3}}, "unsupported operand"),
    ],
)
def test_malformed(tmp_path: Path, change: dict[str, Any], message: str) -> None:
    entry = mesh()
    entry["data"] |= change
    with pytest.raises(GeometryFileError, match=message):
        read(tmp_path, entry)


def test_transformations_of_an_object_and_of_what_it_is_in_apply_in_turn(tmp_path: Path) -> None:
    inner = mesh()
    inner["data"]["transformation"] = translation(0, 0, 2)
    outer = {"data": {"transformation": translation(0, 0, 5), "geometry": inner}, "dtype": "x/Element"}
    assert heights(read(tmp_path, outer)) == [7.5]


def test_elements_that_a_model_lists_are_placed_by_those_above_them(tmp_path: Path) -> None:
    elements = [
        {"guid": "pier", "data": {"transformation": translation(0, 0, 5)}},
        {"guid": "stone", "data": {"transformation": translation(0, 0, 2), "geometry": mesh()}},
    ]
    tree = {"root": {"element": "pier", "children": [{"element": "stone"}]}}
    assert heights(read(tmp_path, {"data": {"elements": elements, "tree": tree}, "dtype": "m/Model"})) == [7.5]
