"""Folders that cannot be written to or are none, and two runs into one folder at once."""

from __future__ import annotations

import ctypes
import json
import os
import random
import time
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.faults.commands import Commands, content, is_one_plain_line, restored, written
from tests.trust.faults.mounts import small_disk
from tests.trust.faults.test_limits import MEGABYTE

CLAIM = (
    "Two runs of one deck into one folder at once: each ends with its whole result or is refused, and the files in the "
    "folder are of one run"
)
PAIRS = 50
MS_RDONLY, MS_REMOUNT = 1, 32


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    return written(tmp_path / "block.yaml")


def refused(commands: Commands, deck: Path, *options: str | Path) -> str:
    """What a run says that ends with exit status 6."""
    ended = commands.run("run", deck, "-q", *options)
    assert ended.status == 6, ended
    assert is_one_plain_line(ended.said)
    return ended.said


def test_a_read_only_folder(commands: Commands, deck: Path, tmp_path: Path) -> None:
    """Of a file system that is mounted so: the administrator may write to every other one."""
    disk = tmp_path / "disk"
    with small_disk(disk, MEGABYTE):
        restored(disk / "block.out", {"block.h5": b"earlier"})
        library = ctypes.CDLL(None, use_errno=True)
        assert library.mount(b"none", os.fsencode(disk), b"tmpfs", MS_RDONLY | MS_REMOUNT, None) == 0
        said = refused(commands, deck, "-o", disk / "block.out", "--force")
        assert said == f"mbla: {disk / 'block.out'}: Read-only file system  [file-not-written]\n"
        said = refused(commands, deck, "-o", disk / "more" / "block.out")
        assert said == f"mbla: {disk / 'more' / 'block.out'}: Read-only file system  [file-not-written]\n"
        assert content(disk / "block.out") == {"block.h5": b"earlier"}


def test_missing_folders_are_made(commands: Commands, deck: Path, tmp_path: Path) -> None:
    assert commands.run("run", deck, "-q", "-o", tmp_path / "a" / "b" / "c").status == 0
    assert "block.h5" in content(tmp_path / "a" / "b" / "c")


@pytest.mark.parametrize("below", ["", "more", "more/more"])
def test_a_file_where_the_folder_should_be(commands: Commands, deck: Path, tmp_path: Path, below: str) -> None:
    (tmp_path / "mine").write_text("mine")
    out = tmp_path / "mine" / below
    assert str(out) in refused(commands, deck, "-o", out)
    assert content(tmp_path)["mine"] == b"mine"


@pytest.mark.parametrize("suffix", ["h5", "sta", "json", "lst"])
def test_a_folder_where_a_file_should_be(commands: Commands, deck: Path, suffix: str) -> None:
    folder = deck.parent / "block.out" / f"block.{suffix}"
    folder.mkdir(parents=True)
    assert refused(commands, deck, "--force") == f"mbla: {folder}: is a folder  [folder-given]\n"
    assert list(folder.parent.iterdir()) == [folder]


@pytest.mark.trust
def test_two_runs_at_once(commands: Commands, deck: Path, tmp_path: Path) -> None:
    draw = random.Random(3)
    out = deck.parent / "block.out"
    begun = time.monotonic()
    assert commands.run("run", deck, "-q").status == 0
    lasts = time.monotonic() - begun
    refusals = whole = 0
    (tmp_path / "second").mkdir()
    with Commands(tmp_path / "second") as others:
        for pair in range(PAIRS):
            first = commands.begin("run", deck, "-q", "--force", "--set", "parameters.mu=0.3")
            time.sleep(draw.random() * lasts * (pair % 2))  # the others at the same time, to write at the same time
            second = others.begin("run", deck, "-q", "--force", "--set", "parameters.mu=0.4")
            ends = [first.end(), second.end()]
            assert {ended.status for ended in ends} <= {0, 6}, ends
            assert 0 in {ended.status for ended in ends}
            for ended in ends:
                assert ended.status == 0 or "is at work on it" in ended.said, ends
            refusals += any(ended.status for ended in ends)
            whole += 1
            _is_of_one_run(out, {0.3: ends[0].status, 0.4: ends[1].status})
    assert refusals
    record_counts("faults-pairs", 54, CLAIM, {"pairs of runs": whole, "of them with one refused": refusals})


def _is_of_one_run(out: Path, statuses: dict[float, int]) -> None:
    """Every file is of a run that ended well: the load factor of the block is its friction."""
    files = content(out)
    record = json.loads(files["block.json"])
    assert sorted(files) == sorted(record["files"])
    factor = round(record["cases"][0]["load_factor"], 4)
    assert statuses[factor] == 0
    assert f"{factor:.6g}" in files["block.lst"].decode()
    rows = [line.split() for line in files["block.sta"].decode().splitlines() if not line.startswith("#")]
    last = [row for row in rows if row[1] == "1"][-1]  # later programs are of the range
    assert float(last[3]) == pytest.approx(factor, abs=1e-3)
