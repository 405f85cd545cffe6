"""A measurement in a process of its own, with what may become of it."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.performance import child
from tests.performance.child import answer_as_child, in_child


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A module whose measurement does what it is told."""
    (tmp_path / "told.py").write_text(
        "import os, sys\n"
        "from tests.performance.child import answer_as_child\n"
        "def do(what):\n"
        "    if what == 'fail':\n"
        "        raise ValueError('no such thing')\n"
        "    while what == 'hang':\n"
        "        pass\n"
        "    print('a line of the library')\n"
        "    return {'status': what, 'threads': os.environ['OMP_NUM_THREADS']}\n"
        "answer_as_child(sys.argv[1:], do)\n"
    )
    paths = [str(tmp_path), str(Path(child.__file__).parents[2])]
    monkeypatch.setenv("PYTHONPATH", ":".join(paths))
    return "told"


def test_figures_come_back_from_one_thread(module: str) -> None:
    assert in_child(module, ["well"], 60) == {"status": "well", "threads": "1"}


def test_a_fault_is_told_in_one_line(module: str) -> None:
    assert in_child(module, ["fail"], 60) == {"status": "failed: ValueError: no such thing"}


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on the processor there")
def test_what_takes_longer_than_its_limit_is_stopped(module: str) -> None:
    assert in_child(module, ["hang"], 1) == {"status": "stopped after 1 s"}


def test_other_arguments_are_not_for_a_child() -> None:
    assert not answer_as_child(["--limit", "3"], dict)
