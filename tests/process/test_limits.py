"""Limits of this process: threads, and memory that leaves no room for the libraries."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

import mbla
from mbla.cli import main
from mbla.process.limits import VARIABLES, limited
from tests.line import BLOCK

ASK = """
import os, sys
from mbla.cli import main
assert "numpy" not in sys.modules
main(sys.argv[1:])
print("|", *(os.environ[name] for name in {names!r}))
"""


@pytest.mark.parametrize(
    ("arguments", "given", "expected"),
    [
        (["run", "missing.yaml"], {}, "1 1 1"),
        (["run", "missing.yaml", "--threads", "2"], {}, "2 2 2"),
        (["run", "missing.yaml", "--threads", "2"], {"OMP_NUM_THREADS": "3"}, "2 3 2"),
    ],
)
def test_one_thread_unless_more_are_asked_for(arguments: list[str], given: dict[str, str], expected: str) -> None:
    surroundings = {name: value for name, value in os.environ.items() if name not in VARIABLES} | given
    command = [sys.executable, "-c", ASK.format(names=VARIABLES), *arguments]
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=True)
    assert done.stdout.split("|")[-1].strip() == expected


def test_threads_that_cannot_be_used_are_not_passed_over(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in VARIABLES:
        monkeypatch.setenv(name, "1")
    deck = tmp_path / "block.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    assert main(["run", str(deck), "--threads", "2", "--json"]) == 0
    words = "1; factorisations by qdldl are serial"
    assert capsys.readouterr().err.splitlines()[-1] == f"mbla: threads: {words}"
    assert mbla.read_results(tmp_path / "block.out" / "block.h5").records.settings["threads"] == words


def test_in_python_they_are_asked_for_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in VARIABLES:
        monkeypatch.setenv(name, "")
        monkeypatch.delenv(name)
    deck = tmp_path / "block.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    mbla.run(deck)
    assert VARIABLES[0] not in os.environ
    mbla.run(deck, threads=2)
    assert {os.environ[name] for name in VARIABLES} == {"2"}


pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits of Linux")


@pytest.mark.parametrize(
    ("limit", "mib", "words", "least"),
    [
        ("RLIMIT_AS", 100, "address space (ulimit -v)", 400),
        ("RLIMIT_AS", 200, "address space (ulimit -v)", 400),
        ("RLIMIT_DATA", 100, "data (ulimit -d)", 256),
    ],
)
def test_a_limit_that_is_too_low(limit: str, mib: int, words: str, least: int) -> None:
    program = (
        f"import resource, sys; resource.setrlimit(resource.{limit}, ({mib << 20}, {mib << 20})); "
        "from mbla.cli import main; sys.exit(main(['run', 'none.yaml']))"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 7
    assert ended.stderr == (
        f"mbla: out of memory: the limit of {mib} MiB on {words} is below the {least} MiB that the program itself "
        "takes; raise the limit  [out-of-memory]\n"
    )


def test_without_a_limit_there_is_none_in_the_block() -> None:
    before = resource.getrlimit(resource.RLIMIT_DATA)
    with limited(None):
        assert resource.getrlimit(resource.RLIMIT_DATA) == before
    with limited(1e12):
        assert resource.getrlimit(resource.RLIMIT_DATA)[0] == 10**12
    assert resource.getrlimit(resource.RLIMIT_DATA) == before
