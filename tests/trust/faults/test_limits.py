"""Disks that are full and memory that does not suffice, at many sizes: exit status 6 or 7, one line, files whole."""

from __future__ import annotations

import resource
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.faults.commands import (
    Commands,
    Ended,
    content,
    hidden,
    is_one_plain_line,
    restored,
    without_partial,
    written,
)
from tests.trust.faults.mounts import small_disk

CLAIM = (
    "`mbla run` where the disk, a file or memory is too small: exit status 6 or 7, one line, no crash, and the earlier "
    "result byte for byte"
)
DISKS, FILES, MEMORIES = 50, 50, 20
MEGABYTE = 1 << 20
PAGE = 4096
WORDS = 400
"""bytes that the error itself takes, which goes to a file as well"""


class Limited:
    """A deck, and its earlier result."""

    def __init__(self, commands: Commands, folder: Path) -> None:
        self.commands = commands
        self.deck = written(folder / "block.yaml")
        self.out = folder / "block.out"
        assert commands.run("run", self.deck, "--set", "parameters.mu=0.3", "-q").status == 0
        self.earlier = content(self.out)

    def ended_well(self, ended: Ended, out: Path, told: object) -> bool:
        """Whether the limit was met; all as it was then."""
        assert ended.status in (0, 6, 7), (told, ended)
        if ended.status == 0:
            return False
        assert is_one_plain_line(ended.said), (told, ended)
        assert without_partial(content(out)) == self.earlier, (told, ended.said, sorted(content(out)))
        assert hidden(out) == []
        return True

    def with_files_up_to(self, size: int) -> bool:
        """No file may be larger [bytes]; whether one would have been."""
        restored(self.out, self.earlier)
        ended = self.commands.run("run", self.deck, "-q", "--force", limits={"RLIMIT_FSIZE": size})
        met = self.ended_well(ended, self.out, size)
        assert not met or ended.status == 6, ended
        return met

    def with_memory(self, size: int) -> bool:
        """No more address space than that [bytes] above what the process has at its beginning."""
        restored(self.out, self.earlier)
        ended = self.commands.run("run", self.deck, "-q", "--force", limits={"RLIMIT_AS": size})
        met = self.ended_well(ended, self.out, size)
        assert not met or ended.status == 7, ended
        return met

    def memory(self) -> int:
        """What suffices, to a megabyte, above what the process has at its beginning [bytes]."""
        low, high = 0, 1024
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self.with_memory(middle * MEGABYTE) else (low, middle)
        return high * MEGABYTE

    def on_a_disk_of(self, room: int, folder: Path) -> bool:
        """A file system with so much room beside the earlier result [bytes]; whether it was too small."""
        used = sum(-(-len(data) // PAGE) * PAGE for data in self.earlier.values())
        with small_disk(folder, used + room):
            out = folder / "block.out"
            restored(out, self.earlier)
            ended = self.commands.run("run", self.deck, "-q", "--force", "-o", out)
            met = self.ended_well(ended, out, room)
            assert not met or ended.status == 6, ended
            return met


@pytest.fixture(scope="module")
def limited(commands: Commands, tmp_path_factory: pytest.TempPathFactory) -> Limited:
    return Limited(commands, tmp_path_factory.mktemp("limited"))


def test_files_too_large(limited: Limited) -> None:
    assert limited.with_files_up_to(WORDS)
    assert limited.with_files_up_to(max(map(len, limited.earlier.values())) - 2000)


def test_memory_that_does_not_suffice(limited: Limited) -> None:
    assert limited.with_memory(MEGABYTE)


def test_a_full_disk(limited: Limited, tmp_path: Path) -> None:
    assert limited.on_a_disk_of(PAGE * 4, tmp_path / "disk")


@pytest.mark.trust
def test_disks_files_and_memories_of_many_sizes(limited: Limited, tmp_path: Path) -> None:
    largest = max(map(len, limited.earlier.values()))
    step = (largest - WORDS) // (FILES + 2)
    files = sum(limited.with_files_up_to(WORDS + step * part) for part in range(FILES))
    assert files == FILES
    room = sum(-(-len(data) // PAGE) * PAGE for data in limited.earlier.values())
    sizes = range(0, room, max(PAGE, room // (DISKS + 2)))
    disks = sum(limited.on_a_disk_of(size, tmp_path / "disk") for size in sizes)
    step = (limited.memory() - MEGABYTE) // MEMORIES
    memories = sum(limited.with_memory(step * part) for part in range(MEMORIES))
    assert memories == MEMORIES
    record_counts(
        "faults-limits",
        53,
        CLAIM,
        {"sizes of files": files, "sizes of disks": disks, "memory limits": memories},
    )


def test_limits_are_of_this_system() -> None:
    assert resource.getrlimit(resource.RLIMIT_FSIZE)[1] == resource.RLIM_INFINITY
