"""Load factors of a few scenes under every transformation of the table; of all of them under ``-m long``."""

from __future__ import annotations

import pytest

from tests.properties.metamorphic import checked, names, unexplained
from tests.properties.transformations import TABLE

FEW = ("benchmarks/two_piers", "benchmarks/groove", "benchmarks/mortar_joint")


@pytest.mark.parametrize("name", FEW)
def test_a_few_scenes(name: str) -> None:
    _, found, _ = checked(name)
    assert len(found) >= len(TABLE)
    assert unexplained(found) == []


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_every_scene(name: str) -> None:
    _, found, _ = checked(name)
    assert unexplained(found) == []
