"""The command as a process of its own: signals, streams that end, names and folders that are none."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from tests.line import BLOCK, WALL


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    return written(tmp_path / "block.yaml", BLOCK)


def written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def mbla(*arguments: str | Path, **options: Any) -> subprocess.CompletedProcess[bytes]:
    """The program in a process of its own."""
    command = [sys.executable, "-m", "mbla", *map(str, arguments)]
    return subprocess.run(command, stderr=subprocess.PIPE, check=False, **options)


def test_a_run_in_the_background_of_a_script_is_not_interrupted(tmp_path: Path) -> None:
    """Shells start such with SIGINT ignored, and so it stays, as under nohup."""
    deck = written(tmp_path / "wall.yaml", WALL)
    process = subprocess.Popen(
        [sys.executable, "-m", "mbla", "run", str(deck), "-q"],
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),
    )
    deadline = time.monotonic() + 60
    while not (tmp_path / "wall.out" / "wall.sta").exists():
        assert time.monotonic() < deadline
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    assert process.wait(60) == 0


@pytest.mark.long
def test_names_and_titles_in_any_script_whatever_the_terminal_speaks(tmp_path: Path) -> None:
    title = "Bögen – 拱"
    deck = written(tmp_path / "wänd 墙.yaml", f"title: {title}\n" + BLOCK)
    environment = {"PATH": os.environ["PATH"], "LC_ALL": "C", "PYTHONIOENCODING": "ascii"}
    done = mbla("run", deck, stdout=subprocess.PIPE, env=environment)
    assert done.returncode == 0
    assert b"w\\xe4nd" in done.stdout
    done = mbla("run", deck, "--force", "--json", stdout=subprocess.PIPE, env=environment)
    assert json.loads(done.stdout)["deck"] == deck.name
    listing = mbla("show", tmp_path / "wänd 墙.out" / "wänd 墙.h5", stdout=subprocess.PIPE).stdout.decode()
    assert title in listing


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_standard_output_that_takes_nothing(deck: Path) -> None:
    main(["run", str(deck), "-q"])
    for arguments in (("show", deck.with_suffix(".out") / "block.h5"), ("check", deck)):
        with Path("/dev/full").open("w") as full:
            done = mbla(*arguments, stdout=full)
        assert done.returncode == 6
        assert b"standard output: No space left on device" in done.stderr
        assert b"Exception" not in done.stderr


def test_a_reader_that_goes_away_is_no_error_of_ours(deck: Path) -> None:
    read_end, write_end = os.pipe()
    os.close(read_end)
    done = mbla("check", deck, stdout=write_end)
    os.close(write_end)
    assert done.returncode == 6
    assert done.stderr == b""
