"""The tests of the project run against an installed mbla, beside which there are no sources."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from tests.decks.folder import ROOT

BESIDE = ("tests", "decks", "schemas", "README.md", "pyproject.toml")
"""what tests need beside mbla itself"""
OF_SOURCES = (
    "tests/test_layering.py::test_every_folder_of_the_package_is_a_stage",
    "tests/test_layering.py::test_top_level_of_the_project",
    "tests/trust/coverage/test_coverage.py::test_lines_that_a_child_runs_are_counted",
    "tests/trust/mutation/test_mutation.py::test_every_module_of_the_groups_has_mutants_and_tests",
    "tests/trust/mutation/test_mutation.py::test_what_is_explained_is_still_there",
    "tests/deck/test_schema.py::test_file_is_up_to_date",
    "tests/sweeps/file/test_schema.py::test_file_is_up_to_date",
    "tests/sweeps/file/test_schema.py::test_readme_is_up_to_date",
)
"""tests that are about the folder of sources"""
AT_ONCE = ("-n", "auto", "--dist", "loadfile")
OLD = ("DeprecationWarning", "PendingDeprecationWarning", "FutureWarning")
"""warnings that the lowest versions of libraries give of one another"""


@dataclass(frozen=True)
class Tested:
    """How tests ended; ``failed`` by name."""

    passed: int
    skipped: int
    failed: tuple[str, ...]


def own_tests(python: Path, folder: Path, *, old: bool) -> Tested:
    """Run all tests but the long ones in a folder of their own; ``old`` libraries may warn of one another."""
    folder.mkdir(parents=True)
    for name in BESIDE:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__", "*.out"))
        else:
            shutil.copy(source, folder / name)
    options = [part for name in OF_SOURCES for part in ("--deselect", name)]
    options += [part for kind in OLD if old for part in ("-W", f"ignore::{kind}")]
    said = folder / "tests.xml"
    subprocess.run(
        [python, "-m", "pytest", "-p", "no:cacheprovider", *AT_ONCE, *options, f"--junitxml={said}", "tests"],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        check=False,
    )
    return read_ends(said)


def read_ends(path: Path) -> Tested:
    """What pytest wrote as JUnit XML."""
    cases = list(ElementTree.parse(path).getroot().iter("testcase"))
    failed = [case for case in cases if case.find("failure") is not None or case.find("error") is not None]
    skipped = [case for case in cases if case.find("skipped") is not None]
    names = tuple(f"{case.get('classname')}::{case.get('name')}" for case in failed)
    return Tested(len(cases) - len(failed) - len(skipped), len(skipped), names)
