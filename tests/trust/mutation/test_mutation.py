"""Tests next to a module notice mutants of it: of a toy in seconds, of the modules that figures rest on in hours."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.mutation.groups import GROUPS, ROOT
from tests.trust.mutation.mutants import mutants_of
from tests.trust.mutation.sampling import SAMPLE, Judged, read, sampled

SCORE = 0.85
"""Share of the mutants of a group that its tests must kill."""
CLAIM = (
    "Where one thing in the code is made wrong, at random, the tests next to it notice in at least 85 % of the cases"
)

TOY = '''
LIMIT = 0.5


def slides(tangent: float, friction: float) -> bool:
    """Whether a block slides."""
    return tangent > friction and friction < LIMIT
'''
TESTS = """
import toy

def test_a_steep_one():
    assert toy.slides(0.4, 0.3)

def test_a_rough_one(tmp_path):
    (tmp_path / "made").mkdir()  # refused where the folder of another run is still there
    assert not toy.slides(0.7, 0.6)
"""
FAILING = """
import toy

def test_that_fails():
    assert not toy.slides(0.4, 0.3)
"""


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    (tmp_path / "toy.py").write_text(TOY, encoding="utf-8")
    (tmp_path / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    return tmp_path


def survivors(folder: Path, tests: str) -> list[str]:
    """Changes to the toy that its tests do not notice."""
    (folder / "test_toy.py").write_text(tests, encoding="utf-8")
    code = (
        "import sys; sys.path.insert(0, '.'); import pytest, toy\n"
        "from pathlib import Path\n"
        "from tests.trust.mutation.forks import Forks\n"
        "from tests.trust.mutation.mutants import mutants_of\n"
        "path = Path('toy.py').resolve()\n"
        "forks = Forks(mutants_of(path, path.read_text()), 5.0)\n"
        "for forks.last_turn in (False, True):\n"
        "    pytest.main(['-q', '-p', 'no:cacheprovider', 'test_toy.py'], plugins=[forks])\n"
        "print(*(one.change for one in forks.alive), sep='\\n', file=sys.stderr)\n"
    )
    ended = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True)
    return ended.stderr.splitlines()


def test_mutants_of_a_text() -> None:
    assert [(one.line, one.change) for one in mutants_of(Path("toy.py"), TOY)] == [
        (2, "0.5 -> 1.5"),
        (7, "return tangent > friction and friction < LIMIT -> return None"),
        (7, "tangent > friction and friction < LIMIT -> tangent > friction or friction < LIMIT"),
        (7, "tangent > friction -> tangent >= friction"),
        (7, "tangent > friction -> tangent <= friction"),
        (7, "friction < LIMIT -> friction <= LIMIT"),
        (7, "friction < LIMIT -> friction >= LIMIT"),
    ]


def test_what_tests_notice_is_killed_and_the_rest_survives(toy: Path) -> None:
    at_the_limit = ["tangent > friction -> tangent >= friction", "friction < LIMIT -> friction <= LIMIT"]
    assert survivors(toy, TESTS) == at_the_limit


def test_a_test_that_fails_by_itself_kills_nothing(toy: Path) -> None:
    assert len(survivors(toy, FAILING)) == len(mutants_of(Path("toy.py"), TOY))


def test_every_module_of_the_groups_has_mutants_and_tests() -> None:
    for group in GROUPS.values():
        assert group.test_files()
        with_mutants = {one.path for one in sampled(group, 1, 1)}
        assert len(with_mutants) > 0.8 * len(group.files()), "a few hold types or tables only"


@pytest.mark.trust
def test_mutants_of_the_modules_that_figures_rest_on(tmp_path: Path) -> None:
    found = {name: _run(name, tmp_path) for name in GROUPS}
    counts = {"modules": sum(one.modules for one in found.values())}
    for name, one in found.items():
        assert one.whole, name
        assert one.killed >= SCORE * one.mutants, (name, one.survivors)
        counts |= {f"mutants of {name}": one.mutants, f"noticed in {name}": one.killed}
    record_counts("mutation", 100, CLAIM, counts)


def _run(name: str, folder: Path) -> Judged:
    command = [sys.executable, "-m", "tests.trust.mutation", name, "--sample", str(SAMPLE), "--output", str(folder)]
    subprocess.run(command, cwd=ROOT, check=False, stdout=subprocess.DEVNULL)
    return read(folder / f"{name}.json")
