"""What of a file becomes no block is told, or is a reason to refuse it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.model.geometry import read_geometry
from mbla.model.geometry.geometry import Geometry, GeometryFileError, parse_json
from mbla.model.geometry.repair import repair
from mbla.model.solids.polyhedra import join_polyhedra
from tests.model.shapes import box, build_raw, raw
from tests.trust.geometry.formats import FORMATS
from tests.trust.geometry.shapes import no_faces
from tests.trust.geometry.stones import arch


@pytest.mark.parametrize("kind", ["obj", "stl", "gltf", "compas"])
def test_an_object_without_faces_is_named(tmp_path: Path, kind: str) -> None:
    stones = arch()
    stones[3] = no_faces(stones[3], np.random.default_rng(0))
    files = FORMATS[kind].write(stones)
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    told = {notice.identifier: notice.message for notice in read_geometry(tmp_path / next(iter(files))).notices}
    assert told["objects-empty"] == "1 object was left out, without faces: voussoir 3"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.rpartition("f ")[0].rpartition("o ")[0] + "o last\nv 0 0 9\n", "it ends with 1 vertex"),
        (lambda text: text.replace("\nf ", "\nF ", 1), "line 11 cannot be read: 'F' is no keyword of OBJ"),
    ],
)
def test_obj_refused(tmp_path: Path, change: object, message: str) -> None:
    (content,) = FORMATS["obj"].write(arch()).values()
    path = tmp_path / "x.obj"
    assert callable(change)
    path.write_text(change(content.decode()), encoding="utf-8")
    with pytest.raises(GeometryFileError, match=message):
        read_geometry(path)


@pytest.mark.parametrize(
    ("one", "other", "message"),
    [
        ("\n72, ", "\n71, ", "node 71 lies elsewhere in an earlier line"),
        ("\n9, 65", "\n8, 65", "element 8 has other nodes in an earlier line"),
        ("\n9, 65", "\n9, 1, 65", "a C3D8 has 8 nodes, here are 9"),
        ("*ELEMENT", "*ELEMNET", "is no card; did you mean"),
    ],
)
def test_inp_refused(tmp_path: Path, one: str, other: str, message: str) -> None:
    (content,) = FORMATS["inp cells"].write(arch()).values()
    path = tmp_path / "x.inp"
    path.write_text(content.decode().replace(one, other, 1), encoding="utf-8")
    with pytest.raises(GeometryFileError, match=message):
        read_geometry(path)


def test_a_key_that_is_there_twice_is_refused() -> None:
    assert parse_json(b'{"a": {"b": 1}}') == {"a": {"b": 1}}
    with pytest.raises(ValueError, match="an object has the key 'b' twice"):
        parse_json(b'{"a": {"b": 1, "b": 2}}')


@pytest.mark.parametrize(
    ("flat", "message"),
    [
        (box((2, 0, 0), (2, 0, 0)), "lie at the same place"),
        (box((2, 0, 0), (3, 0, 0)), "lie at the same place"),
        (box((2, 0, 0), (2 + 1e-60, 1e-60, 1e-60)), "measures 1.0e-60 only"),
        (box((0, 0, 0), (1e-60, 1e-60, 1e-60)), "measures 1.0e-60 only"),
    ],
)
def test_an_object_of_which_nothing_is_left_is_refused_by_name(flat: object, message: str) -> None:
    surfaces = [raw(box()), raw(flat), raw(box((0, 3, 0), (1, 4, 1)))]  # type: ignore[arg-type]
    geometry = repair(Geometry(join_polyhedra(surfaces), names=("a", "flat", "b")), 1e-3)
    assert geometry.names == ("a", "flat", "b")
    (defect,) = build_raw(geometry.polyhedra).defects
    assert defect.block == 1
    assert message in defect.message


@pytest.mark.parametrize(
    ("key", "called"), [("b", "'b'"), ("k" * 40 + "rest", "'" + "k" * 40 + "'")], ids=["short", "long"]
)
def test_of_several_keys_the_one_that_is_there_twice_is_named(key: str, called: str) -> None:
    with pytest.raises(ValueError, match=f"^an object has the key {called} twice$"):
        parse_json(f'{{"a": 1, "{key}": 1, "c": 3, "{key}": 2}}'.encode())
