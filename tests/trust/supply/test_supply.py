"""No network; the wheel alone, in an empty environment, in the lowest versions that are allowed and in the newest."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.decks.folder import DECKS, ROOT
from tests.line import BLOCK
from tests.trust.counts import record_counts
from tests.trust.supply.environments import LOWEST, NEWEST, environment, wheel
from tests.trust.supply.exercise import SWEEP, attempts_in, exercise, guarded
from tests.trust.supply.own_tests import own_tests, read_ends

CLAIM = (
    "mbla works from its wheel alone, without its sources and without a network, in the lowest versions of its "
    "dependencies that it allows and in the newest: decks with their expected load factors, pictures, report, tables, "
    "a sweep in two processes, and the tests of the project"
)
LOADS = r"""<(?:script|img|iframe|source|video|embed)[^>]*\ssrc\s*=\s*["']?\s*(?:https?:)?//|<link[^>]*\shref\s*=\s*["']?(?!data:)[^"'\s]"""  # noqa: E501
"""elements of a page that fetch something; a link that a reader may follow is none"""
SOURCES = {"PYTHONPATH": str(ROOT)}
AT_LEAST = 9000
"""tests that there are, at least"""


def loads_of(page: str) -> list[str]:
    """What a page would fetch, outside of its scripts."""
    markup = re.sub(r"(<script[^>]*>).*?</script>", r"\1", page, flags=re.DOTALL)
    return re.findall(LOADS, markup) + re.findall(r"url\(\s*[\"']?(?:https?:)?//|@import", markup)


def test_pages_that_fetch_something_are_found() -> None:
    assert loads_of('<a href="https://example.org">source</a><script>"<img src=//x>"</script>') == []
    for page in (
        '<script src="https://example.org/a.js"></script>',
        "<img alt='' src='//example.org/a.png'>",
        '<link rel="stylesheet" href="https://example.org/a.css">',
        "<style>p {background: url(https://example.org/a.png)}</style>",
    ):
        assert loads_of(page), page


def test_ways_to_other_machines_are_refused_and_written_down(tmp_path: Path) -> None:
    """192.0.2.1 is an address for documentation, which nobody has."""
    program = "import socket\ntry: socket.create_connection(('192.0.2.1', 9), 1)\nexcept OSError as e: print(e)"
    done = guarded(Path(sys.executable), ("-c", program), tmp_path, {})
    assert done.stdout.startswith("no network"), done.stderr
    assert attempts_in(tmp_path) == ("socket.getaddrinfo 192.0.2.1",)


@pytest.mark.long
def test_a_run_and_its_report_need_no_network(tmp_path: Path) -> None:
    (tmp_path / "block.yaml").write_text(BLOCK, encoding="utf-8")
    for arguments in (("run", "block.yaml", "-q"), ("report", "block.out/block.h5", "-o", "block.html")):
        done = guarded(Path(sys.executable), ("-m", "mbla", *arguments), tmp_path, SOURCES)
        assert done.returncode == 0, done.stderr
    assert attempts_in(tmp_path) == ()
    assert loads_of((tmp_path / "block.html").read_text(encoding="utf-8")) == []


@pytest.mark.long
def test_a_sweep_in_two_processes_needs_no_network(tmp_path: Path) -> None:
    """Dask asks for the way to a well-known machine to find the address of its own, unless it is told."""
    (tmp_path / "block.yaml").write_text(BLOCK, encoding="utf-8")
    (tmp_path / "sweep.yaml").write_text(SWEEP.replace("decks/tutorials/block.yaml", "block.yaml"), encoding="utf-8")
    done = guarded(Path(sys.executable), ("-m", "mbla", "sweep", "sweep.yaml", "-j", "2", "-q"), tmp_path, SOURCES)
    assert (done.returncode, done.stderr) == (0, "")
    assert attempts_in(tmp_path) == ()


def test_tests_that_fail_are_found(tmp_path: Path) -> None:
    (tmp_path / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    (tmp_path / "test_three.py").write_text(
        "import pytest\n\ndef test_one(): pass\n\ndef test_two(): assert False\n\n"
        "def test_three(): pytest.skip('none')\n\n@pytest.fixture\ndef broken(): raise KeyError\n\n"
        "def test_four(broken): pass\n",
        encoding="utf-8",
    )
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--junitxml=tests.xml", "."]
    subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    found = read_ends(tmp_path / "tests.xml")
    assert (found.passed, found.skipped) == (1, 1)
    assert found.failed == ("test_three::test_two", "test_three::test_four")


@pytest.mark.trust
def test_the_wheel_alone_in_lowest_and_newest_versions_without_a_network(tmp_path: Path) -> None:
    built = wheel(tmp_path)
    commands = packages = passed = skipped = 0
    failed: dict[str, tuple[str, ...]] = {}
    for resolution in (LOWEST, NEWEST):
        python = environment(tmp_path / resolution / "environment", built, resolution)
        folder = tmp_path / resolution / "work"
        shutil.copytree(DECKS, folder / "decks")
        where = guarded(python, ("-c", "import mbla; print(mbla.__file__)"), folder, {})
        assert where.stdout.startswith(str(tmp_path / resolution / "environment")), where.stdout + where.stderr
        done = exercise(python, folder, {})
        failed[f"commands, {resolution}"] = done.failed
        failed[f"attempts, {resolution}"] = done.attempts
        assert loads_of((folder / "out/wall.html").read_text(encoding="utf-8")) == []
        commands += done.commands
        own = own_tests(python, tmp_path / resolution / "project", old=resolution == LOWEST)
        failed[f"tests, {resolution}"] = own.failed
        assert own.passed > AT_LEAST
        passed, skipped = passed + own.passed, skipped + own.skipped
        listed = subprocess.run(
            [sys.executable, "-m", "uv", "pip", "list", "--quiet", "--format", "freeze", "--python", python],
            capture_output=True,
            text=True,
            check=True,
        )
        packages += len(listed.stdout.splitlines())
    assert {what: names for what, names in failed.items() if names} == {}
    counts = {
        "environments": 2,
        "packages in them": packages,
        "commands": commands,
        "commands that failed": 0,
        "attempts to reach another machine": 0,
        "tests that passed": passed,
        "tests skipped, for want of a browser or an extra": skipped,
    }
    record_counts("supply", 100, CLAIM, counts)
