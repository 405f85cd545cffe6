"""Tests next to a module notice mutants of it: of a toy in seconds, of the modules that figures rest on in hours.

The driver is our own: tools (mutmut, cosmic-ray) change the sources that one works on. Here a copy of the project is
made wrong in one place, and the tests next to that place run on it until one fails.
"""

from __future__ import annotations

import logging
import random
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.decks.folder import ROOT
from tests.trust.counts import record_counts
from tests.trust.mutants import Mutant, mutants_of

LOG = logging.getLogger(__name__)
SAMPLE, SEED = 60, 1
"""mutants of each group, and the seed that picks them"""
SCORE = 0.85
"""Share of the mutants of a group that its tests must notice."""
PATIENCE = 1200.0
"""seconds of the tests of a group, after which a mutant hangs"""
CLAIM = (
    "Where one thing in the code is made wrong, at random, the tests next to it notice in at least 85 % of the cases"
)
COPIED = ("mbla", "tests", "decks", "schemas", "README.md", "pyproject.toml")
GROUPS = {
    "verify": (
        ("mbla/solution/verification/*.py", "mbla/solution/associative/bounds.py"),
        ("tests/solution/verification", "tests/solution/associative/test_bounds.py", "tests/test_verify_file.py"),
    ),
    "geometry": (
        ("mbla/model/geometry/*.py", "mbla/model/solids/*.py", "mbla/model/transform.py"),
        ("tests/model/solids", "tests/model/geometry"),
    ),
    "contacts": (("mbla/contacts/*.py",), ("tests/contacts",)),
    "program": (
        ("mbla/program/**/*.py",),
        ("tests/program", "tests/analytic/test_planar_programs.py", "tests/analytic/test_closed_forms.py"),
    ),
}
"""modules, and the tests next to them, by what they are for"""
TOY = '''
LIMIT = 0.5


def slides(tangent: float, friction: float) -> bool:
    """Whether a block slides."""
    return tangent > friction and friction < LIMIT
'''
TESTS = """
import toy

def test_two():
    assert toy.slides(0.4, 0.3)
    assert not toy.slides(0.7, 0.6)
"""


def modules(group: str) -> list[Path]:
    """In the order of their names."""
    return sorted({path for pattern in GROUPS[group][0] for path in ROOT.glob(pattern)})


def noticed(mutant: Mutant, root: Path, copy: Path, tests: Sequence[str]) -> bool:
    """Whether a test fails on the copy of a project in which the mutant is."""
    place = copy / mutant.path.relative_to(root)
    place.write_text(mutant.text(), encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    try:
        done = subprocess.run(command, cwd=copy, capture_output=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return True
    finally:
        shutil.copy(mutant.path, place)
    return done.returncode != 0


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    folder = tmp_path / "toy"
    folder.mkdir()
    (folder / "toy.py").write_text(TOY, encoding="utf-8")
    (folder / "test_toy.py").write_text(TESTS, encoding="utf-8")
    (folder / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    return folder / "toy.py"


def test_mutants_of_a_text(toy: Path) -> None:
    assert [(one.line, one.change) for one in mutants_of(toy)] == [
        (2, "0.5 -> 1.5"),
        (7, "return tangent > friction and friction < LIMIT -> return None"),
        (7, "tangent > friction and friction < LIMIT -> tangent > friction or friction < LIMIT"),
        (7, "tangent > friction -> tangent >= friction"),
        (7, "tangent > friction -> tangent <= friction"),
        (7, "friction < LIMIT -> friction <= LIMIT"),
        (7, "friction < LIMIT -> friction >= LIMIT"),
    ]


def test_what_tests_notice_is_told_from_what_they_do_not(toy: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(toy.parent, tmp_path / "copy")
    found = {one.change: noticed(one, toy.parent, copy, ["test_toy.py"]) for one in mutants_of(toy)[:4:3]}
    assert found == {"0.5 -> 1.5": True, "tangent > friction -> tangent >= friction": False}
    assert (copy / "toy.py").read_text(encoding="utf-8") == TOY


@pytest.mark.parametrize("group", GROUPS)
def test_every_group_has_modules_with_mutants_and_tests(group: str) -> None:
    assert any(mutants_of(path) for path in modules(group))
    assert all((ROOT / test).exists() for test in GROUPS[group][1])


@pytest.mark.trust
def test_mutants_of_the_modules_that_figures_rest_on(tmp_path: Path) -> None:
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__", "*.out"))
        else:
            shutil.copy(source, tmp_path / name)
    counts = {"modules": sum(len(modules(group)) for group in GROUPS)}
    for group, (_, tests) in GROUPS.items():
        everything = [mutant for path in modules(group) for mutant in mutants_of(path)]
        survivors = []
        for mutant in random.Random(SEED).sample(everything, SAMPLE):
            if not noticed(mutant, ROOT, tmp_path, tests):
                survivors.append(f"{mutant.path.relative_to(ROOT)}:{mutant.line} {mutant.change}")
                LOG.info("noticed by no test: %s", survivors[-1])
        assert SAMPLE - len(survivors) >= SCORE * SAMPLE, (group, survivors)
        counts |= {f"mutants of {group}": SAMPLE, f"noticed in {group}": SAMPLE - len(survivors)}
    record_counts("mutation", 100, CLAIM, counts)
