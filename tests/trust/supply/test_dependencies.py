"""The README names every direct dependency with licence and reason, and lists what comes with them."""

from __future__ import annotations

import re

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.trust.supply.dependencies import installed, listed, project, reasons

DIRECT = sorted({canonicalize_name(Requirement(text).name) for texts in project().values() for text in texts})
LINES = [[cell.strip() for cell in line.split("|")[1:-1]] for line in reasons().splitlines() if line.startswith("| ")]
ROWS = [row for row in LINES if len(row) == len(LINES[0])]
"""package, licence, why, imported by; the table of times has other columns"""


@pytest.mark.parametrize("name", DIRECT)
def test_a_direct_dependency_has_licence_and_reason_and_is_listed(name: str) -> None:
    rows = [row for row in ROWS if re.search(rf"(?<![\w-]){re.escape(name)}(?![\w])", row[0])]
    assert rows, f"{name} is not in the README's table of dependencies"
    assert all(all(row) for row in rows)
    assert "mbla" in listed()[name]


def test_the_list_says_who_asks_for_the_direct_ones() -> None:
    found = {package.name: package.asked_by for package in installed()}
    for name in DIRECT:
        of_project = [asker for asker in found[name] if asker.startswith("mbla")]
        assert [asker for asker in listed()[name].split(", ") if asker.startswith("mbla")] == of_project
