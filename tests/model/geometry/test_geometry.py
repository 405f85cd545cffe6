"""What holds for geometry files of every kind before a reader sees them: their size, and the memory they may take.

What of a file becomes no block is told, or is a reason to refuse it.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from mbla.model.geometry import readers
from mbla.model.geometry.geometry import Geometry, GeometryFileError, member_name, parse_json
from mbla.model.geometry.readers import LEAST_MEMORY, MEMORY_PER_BYTE, READERS, read_geometry
from mbla.model.geometry.repair import repair
from mbla.model.solids.polyhedra import join_polyhedra
from tests.model.shapes import box, build_raw, raw
from tests.trust.geometry.formats import FORMATS
from tests.trust.geometry.shapes import no_faces
from tests.trust.geometry.stones import arch

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
MIB = 1024**2


def limits_while_reading(path: Path, monkeypatch: pytest.MonkeyPatch, can_limit: bool) -> list[float | None]:
    """The limits on memory that are set, in a process that holds 1 GB."""
    limits: list[float | None] = []

    @contextlib.contextmanager
    def limited(most: float | None) -> Iterator[None]:
        limits.append(most)
        yield

    monkeypatch.setattr(readers, "can_limit", lambda: can_limit)
    monkeypatch.setattr(readers, "written", lambda: 1e9)
    monkeypatch.setattr(readers, "limited", limited)
    read_geometry(path)
    return limits


def test_memory_is_in_proportion_to_the_file_and_above_what_is_held(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "x.obj"
    path.write_text(TRIANGLE)
    most = 1e9 + LEAST_MEMORY + MEMORY_PER_BYTE * len(TRIANGLE)
    assert limits_while_reading(path, monkeypatch, can_limit=True) == [most]


def test_a_file_that_takes_more_memory_than_it_may_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def reader(path: Path) -> Geometry:
        raise MemoryError

    monkeypatch.setitem(readers.READERS, ".obj", reader)
    path = tmp_path / "x.obj"
    path.write_text(TRIANGLE)
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert caught.value.message.identifier == "geometry-too-large"
    assert str(caught.value) == (
        f"needs far more memory than its {len(TRIANGLE)} bytes can hold blocks for: damaged or packed; export it anew"
    )


def test_a_file_beyond_the_largest_size_is_refused_unread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(readers, "LARGEST_FILE", 2 * MIB)
    path = tmp_path / "x.obj"
    with path.open("wb") as file:
        file.truncate(2 * MIB + 1)
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert caught.value.message.identifier == "geometry-too-large"
    assert str(caught.value) == "is larger than 2 MB: divide it into several files"


def test_a_missing_file_is_told_as_such(tmp_path: Path) -> None:
    with pytest.raises(GeometryFileError, match="cannot be read: No such file or directory"):
        read_geometry(tmp_path / "none.obj")


@pytest.mark.parametrize("suffix", READERS)
def test_a_folder_by_the_name_of_a_file_cannot_be_read(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"blocks{suffix}"
    path.mkdir()
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert str(caught.value) == "cannot be read: Is a directory"
    assert caught.value.message.identifier == "file-unreadable"


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("stone_1.a-b", "stone_1.a-b"),
        (" Gewölbe  1 ", "Gewolbe_1"),
        (".x", "_.x"),
        ("-7", "_-7"),
        ("a.x", "a.x"),
        ("石", "_"),
        ("", ""),
        ("  ", ""),
    ],
)
def test_names_as_a_deck_can_write_them(text: str, name: str) -> None:
    assert member_name(text) == name


@pytest.mark.parametrize("kind", ["obj", "stl", "compas"])
def test_an_object_without_faces_is_named(tmp_path: Path, kind: str) -> None:
    stones = arch()
    stones[3] = no_faces(stones[3], np.random.default_rng(0))
    files = FORMATS[kind].write(stones)
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    told = {notice.identifier: notice.message for notice in read_geometry(tmp_path / next(iter(files))).notices}
    assert told["objects-empty"] == "1 object was left out, without faces: voussoir 3"


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
