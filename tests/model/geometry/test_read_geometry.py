"""What holds for geometry files of every kind before a reader sees them: their size, and the memory they may take."""

from __future__ import annotations

import contextlib
import errno
from collections.abc import Iterator
from pathlib import Path

import pytest

from mbla.model import geometry
from mbla.model.geometry import LEAST_MEMORY, MEMORY_PER_BYTE, READERS, read_geometry
from mbla.model.geometry.geometry import Geometry, GeometryFileError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
MIB = 1024**2


def limits_while_reading(path: Path, monkeypatch: pytest.MonkeyPatch, can_limit: bool) -> list[float | None]:
    """The limits on memory that are set, in a process that holds 1 GB."""
    limits: list[float | None] = []

    @contextlib.contextmanager
    def limited(most: float | None) -> Iterator[None]:
        limits.append(most)
        yield

    monkeypatch.setattr(geometry, "can_limit", lambda: can_limit)
    monkeypatch.setattr(geometry, "written", lambda: 1e9)
    monkeypatch.setattr(geometry, "limited", limited)
    read_geometry(path)
    return limits


def test_memory_is_in_proportion_to_the_file_and_above_what_is_held(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "x.obj"
    path.write_text(TRIANGLE)
    most = 1e9 + LEAST_MEMORY + MEMORY_PER_BYTE * len(TRIANGLE)
    assert limits_while_reading(path, monkeypatch, can_limit=True) == [most]


def test_there_is_no_limit_where_the_system_knows_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.obj"
    path.write_text(TRIANGLE)
    assert limits_while_reading(path, monkeypatch, can_limit=False) == [None]


def test_a_file_that_takes_more_memory_than_it_may_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def reader(path: Path) -> Geometry:
        raise MemoryError

    monkeypatch.setitem(geometry.READERS, ".obj", reader)
    path = tmp_path / "x.obj"
    path.write_text(TRIANGLE)
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert caught.value.message.identifier == "geometry-too-large"
    assert str(caught.value) == (
        f"needs far more memory than its {len(TRIANGLE)} bytes can hold blocks for: damaged or packed; export it anew"
    )


def test_a_file_beyond_the_largest_size_is_refused_unread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(geometry, "LARGEST_FILE", 2 * MIB)
    path = tmp_path / "x.obj"
    with path.open("wb") as file:
        file.truncate(2 * MIB + 1)
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert caught.value.message.identifier == "geometry-too-large"
    assert str(caught.value) == "is larger than 2 MB: divide it into several files"


def test_a_file_of_the_largest_size_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.obj"
    path.write_text(TRIANGLE)
    monkeypatch.setattr(geometry, "LARGEST_FILE", len(TRIANGLE))
    assert len(read_geometry(path).polyhedra) == 1
    monkeypatch.setattr(geometry, "LARGEST_FILE", len(TRIANGLE) - 1)
    with pytest.raises(GeometryFileError, match="is larger than 0 MB"):
        read_geometry(path)


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


@pytest.mark.skipif(not Path("/proc/self/mem").exists(), reason="no file that can be opened and not read")
@pytest.mark.parametrize("suffix", READERS)
def test_a_file_that_can_be_opened_and_not_read(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"blocks{suffix}"
    path.symlink_to("/proc/self/mem")
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert str(caught.value) == "cannot be read: Input/output error"
    assert caught.value.message.identifier == "file-unreadable"


@pytest.mark.parametrize("suffix", READERS)
def test_a_file_without_permission(tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever runs the tests may read it, so the system's answer is put in its place."""

    def refuse(path: Path, *_: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied", str(path))

    path = tmp_path / f"blocks{suffix}"
    path.write_bytes(b"")
    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert str(caught.value) == "cannot be read: Permission denied"
