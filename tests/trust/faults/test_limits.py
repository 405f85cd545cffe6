"""Disks, files and memory that are too small, and folders that are none: exit status 6 or 7, one line, files whole."""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from mbla.results.disk import PREFIX
from tests.trust.counts import record_counts
from tests.trust.faults.scene import Scene, content, is_one_plain_line, restored, without_partial
from tests.trust.processes import Ended

CLAIM = (
    "`mbla run` where the disk, a file or memory is too small: exit status 6 or 7, one line, no crash, and the earlier "
    "result byte for byte"
)
DISKS, FILES, MEMORIES = 50, 50, 20
MEGABYTE, PAGE = 1 << 20, 4096
WORDS = 400
"""bytes that the error itself takes, which goes to a file as well"""
MS_RDONLY, MS_REMOUNT = 1, 32


@contextlib.contextmanager
def small_disk(folder: Path, size: int) -> Iterator[None]:
    """A file system in memory of that size [bytes]; the test is skipped where none may be mounted."""
    library = ctypes.CDLL(None, use_errno=True)
    folder.mkdir(exist_ok=True)
    options = f"size={size}".encode()
    if sys.platform != "linux" or library.mount(b"tmpfs", os.fsencode(folder), b"tmpfs", 0, options):
        pytest.skip(f"no small file system can be mounted: {os.strerror(ctypes.get_errno())}")
    try:
        yield
    finally:
        library.umount2(os.fsencode(folder), 0)


def met(scene: Scene, ended: Ended, out: Path, status: int) -> bool:
    """Whether the limit was met: the run ended with that status, and all is as it was."""
    if ended.status == 0:
        return False
    assert ended.status == status, ended
    assert is_one_plain_line(ended.err), ended
    assert without_partial(content(out)) == scene.earlier, (ended, sorted(content(out)))
    assert not [name for name in content(out) if name.startswith((PREFIX, "."))]
    return True


def with_limit(scene: Scene, name: str, size: int) -> bool:
    """No file may be larger, or no more memory taken above that at the beginning [bytes]; whether it was too little."""
    ended = scene.over_the_earlier(limits={name: size})
    return met(scene, ended, scene.out, 6 if name == "RLIMIT_FSIZE" else 7)


def on_a_disk_of(scene: Scene, room: int, folder: Path) -> bool:
    """A file system with so much room beside the earlier result [bytes]; whether it was too small."""
    used = sum(-(-len(data) // PAGE) * PAGE for data in scene.earlier.values())
    with small_disk(folder, used + room):
        out = folder / "block.out"
        restored(out, scene.earlier)
        return met(scene, scene.run("--force", "-o", out), out, 6)


def memory_that_suffices(scene: Scene) -> int:
    """To a megabyte, above what the process has at its beginning [bytes]."""
    low, high = 0, 1024
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if with_limit(scene, "RLIMIT_AS", middle * MEGABYTE) else (low, middle)
    return high * MEGABYTE


@pytest.mark.long
def test_too_little_of_each(scene: Scene, tmp_path: Path) -> None:
    assert with_limit(scene, "RLIMIT_FSIZE", max(map(len, scene.earlier.values())) - 2000)
    assert with_limit(scene, "RLIMIT_AS", MEGABYTE)
    assert on_a_disk_of(scene, PAGE * 4, tmp_path / "disk")


@pytest.mark.trust
def test_disks_files_and_memories_of_many_sizes(scene: Scene, tmp_path: Path) -> None:
    step = (max(map(len, scene.earlier.values())) - WORDS) // (FILES + 2)
    files = sum(with_limit(scene, "RLIMIT_FSIZE", WORDS + step * part) for part in range(FILES))
    assert files == FILES
    room = sum(-(-len(data) // PAGE) * PAGE for data in scene.earlier.values())
    sizes = range(0, room, max(PAGE, room // (DISKS + 2)))
    disks = sum(on_a_disk_of(scene, size, tmp_path / "disk") for size in sizes)
    step = (memory_that_suffices(scene) - MEGABYTE) // MEMORIES
    memories = sum(with_limit(scene, "RLIMIT_AS", step * part) for part in range(MEMORIES))
    assert memories == MEMORIES
    counts = {"sizes of files": files, "sizes of disks": disks, "memory limits": memories}
    record_counts("faults-limits", 53, CLAIM, counts)


def refused(scene: Scene, out: Path, *options: str) -> str:
    """What a run says that cannot write into a folder."""
    ended = scene.run("-o", out, *options)
    assert ended.status == 6, ended
    assert is_one_plain_line(ended.err)
    return ended.err


@pytest.mark.long
def test_a_read_only_folder(scene: Scene, tmp_path: Path) -> None:
    """Of a file system that is mounted so: the administrator may write to every other one."""
    disk = tmp_path / "disk"
    with small_disk(disk, MEGABYTE):
        restored(disk / "block.out", {"block.h5": b"earlier"})
        library = ctypes.CDLL(None, use_errno=True)
        assert library.mount(b"none", os.fsencode(disk), b"tmpfs", MS_RDONLY | MS_REMOUNT, None) == 0
        for out, options in ((disk / "block.out", ["--force"]), (disk / "more" / "block.out", [])):
            assert refused(scene, out, *options) == f"mbla: {out}: Read-only file system  [file-not-written]\n"
        assert content(disk / "block.out") == {"block.h5": b"earlier"}


@pytest.mark.long
def test_folders_are_made_where_no_file_stands_in_the_way(scene: Scene, tmp_path: Path) -> None:
    assert scene.run("-o", tmp_path / "a" / "b").status == 0
    assert "block.h5" in content(tmp_path / "a" / "b")
    (tmp_path / "mine").write_text("mine")
    for out in (tmp_path / "mine", tmp_path / "mine" / "more" / "more"):
        assert str(out) in refused(scene, out)
    assert (tmp_path / "mine").read_text() == "mine"


@pytest.mark.long
@pytest.mark.parametrize("suffix", ["h5", "json"])
def test_a_folder_where_a_file_should_be(scene: Scene, tmp_path: Path, suffix: str) -> None:
    folder = tmp_path / "out" / f"block.{suffix}"
    folder.mkdir(parents=True)
    assert refused(scene, folder.parent, "--force") == f"mbla: {folder}: is a folder  [folder-given]\n"
    assert list(folder.parent.iterdir()) == [folder]


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("block_check_blocks.vtu", ("check", "{deck}", "--vtu", "--force", "-o", "{out}")),
        ("block_cases.csv", ("export", "{result}", "--csv", "--force", "-o", "{out}")),
        ("a.svg", ("plot", "{result}", "--kind", "forces", "--size", "300x200", "-o", "{out}/a.svg")),
        ("a.html", ("report", "{result}", "--no-3d", "-o", "{out}/a.html")),
        ("a.yaml", ("new", "{out}/a.yaml", "--force")),
    ],
)
def test_what_other_commands_wrote_before_stays(
    scene: Scene, tmp_path: Path, name: str, arguments: tuple[str, ...]
) -> None:
    restored(scene.out, scene.new)
    out = tmp_path / "out"
    restored(out, {name: b"earlier"})
    places = {"deck": scene.deck, "result": scene.out / "block.h5", "out": out}
    ended = scene.commands.run(*(each.format(**places) for each in arguments), limits={"RLIMIT_FSIZE": 2 * WORDS})
    assert ended.status == 6, ended
    assert is_one_plain_line(ended.err), ended
    assert content(out) == {name: b"earlier"}
