"""The page of dependencies names every direct one with licence and reason."""

from __future__ import annotations

import re

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.trust.supply.dependencies import PAGE, project

DIRECT = sorted({canonicalize_name(Requirement(text).name) for texts in project().values() for text in texts})
LINES = [
    [cell.strip() for cell in line.split("|")[1:-1]]
    for line in PAGE.read_text("utf-8").splitlines()
    if line.startswith("| ")
]
ROWS = [row for row in LINES if len(row) == len(LINES[0])]
"""package, licence, why, imported by; the table of times has other columns"""


@pytest.mark.parametrize("name", DIRECT)
def test_a_direct_dependency_has_licence_and_reason(name: str) -> None:
    rows = [row for row in ROWS if re.search(rf"(?<![\w-]){re.escape(name)}(?![\w])", row[0])]
    assert rows, f"{name} is not in schemas/dependencies.md"
    assert all(all(row) for row in rows)
