"""Environments with mbla from its wheel, what is run in them without a network, and how that ended."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

from tests.decks.folder import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OF_USERS = ("cholmod", "pictures", "report", "tables", "dask")
"""extras; the others are for tests and benchmarks"""
GUARD = Path(__file__).parent / "guard"
BESIDE = ("tests", "decks", "schemas", "README.md", "pyproject.toml")
"""what tests need beside mbla itself"""
OF_SOURCES = (
    "tests/test_layering.py::test_every_folder_of_the_package_is_a_stage",
    "tests/test_layering.py::test_top_level_of_the_project",
    "tests/trust/test_coverage.py::test_lines_that_a_child_runs_are_counted",
    "tests/trust/test_mutation.py::test_every_group_has_modules_with_mutants_and_tests",
    "tests/deck/test_schema.py::test_file_is_up_to_date",
    "tests/sweeps/file/test_schema.py::test_file_is_up_to_date",
    "tests/sweeps/file/test_schema.py::test_readme_is_up_to_date",
)
"""tests that are about the folder of sources"""
OLD = ("DeprecationWarning", "PendingDeprecationWarning", "FutureWarning")
"""warnings that the lowest versions of libraries give of one another"""


def requirements(extras: Sequence[str]) -> list[str]:
    """Of mbla and of its extras, as ``pyproject.toml`` has them."""
    listed = [text for extra in extras for text in PROJECT["optional-dependencies"][extra]]
    return [text for text in (*PROJECT["dependencies"], *listed) if not text.startswith("mbla[")]


def uv(*arguments: str | Path) -> str:
    """What uv prints, which makes wheels and environments."""
    done = subprocess.run([sys.executable, "-m", "uv", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def wheel(folder: Path) -> Path:
    """The wheel, built from the sources into a folder."""
    uv("build", "--wheel", "--quiet", "--out-dir", folder, ROOT)
    (built,) = folder.glob("mbla-*.whl")
    return built


def environment(folder: Path, built: Path, resolution: str) -> Path:
    """A new environment with the wheel and what it and its tests ask for, and nothing else; its Python.

    What the wheel asks for is named beside it: only versions of what is named are chosen low.
    """
    uv("venv", "--quiet", "--python", sys.executable, folder)
    python, named, extras = folder / "bin" / "python", folder / "named.txt", (*OF_USERS, "test")
    wanted = [f"mbla[{','.join(extras)}] @ {built.as_uri()}", *requirements(extras)]
    named.write_text("\n".join(wanted) + "\n", encoding="utf-8")
    install = ("pip", "install", "--quiet", "--python", python, "--resolution", resolution)
    uv(*install, "--only-binary", ":all:", "--requirement", named)
    return python


def guarded(
    python: Path, arguments: Sequence[str], folder: Path, variables: Mapping[str, str]
) -> subprocess.CompletedProcess[str]:
    """Run Python in a folder, with every way to another machine refused and written to ``attempts.txt``."""
    paths = [str(GUARD), *filter(None, [variables.get("PYTHONPATH")])]
    guard = {"PYTHONPATH": os.pathsep.join(paths), "MBLA_ATTEMPTS": str(folder / "attempts.txt"), "MPLBACKEND": "agg"}
    everything = os.environ | dict(variables) | guard
    return subprocess.run([python, *arguments], cwd=folder, env=everything, capture_output=True, text=True, check=False)


def attempts_in(folder: Path) -> list[str]:
    """What was refused."""
    path = folder / "attempts.txt"
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def own_tests(python: Path, folder: Path, *, old: bool) -> tuple[int, int, list[str]]:
    """How many tests of the project passed and were skipped on an installed mbla, and names of those that failed.

    old : libraries, which may warn of one another
    """
    folder.mkdir(parents=True)
    for name in BESIDE:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", "*.out"))
        else:
            shutil.copy(ROOT / name, folder / name)
    options = [part for name in OF_SOURCES for part in ("--deselect", name)]
    options += [part for kind in OLD if old for part in ("-W", f"ignore::{kind}")]
    words = ["-m", "pytest", "-p", "no:cacheprovider", "-n", "auto", "--dist", "loadfile", *options]
    subprocess.run(
        [python, *words, "--junitxml=tests.xml", "tests"], cwd=folder, stdout=subprocess.DEVNULL, check=False
    )
    return ends(folder / "tests.xml")


def ends(path: Path) -> tuple[int, int, list[str]]:
    """Passed, skipped and failed, of what pytest wrote as JUnit XML."""
    cases = list(ElementTree.parse(path).getroot().iter("testcase"))
    failed = [case for case in cases if case.find("failure") is not None or case.find("error") is not None]
    skipped = sum(case.find("skipped") is not None for case in cases)
    names = [f"{case.get('classname')}::{case.get('name')}" for case in failed]
    return len(cases) - len(failed) - skipped, skipped, names
