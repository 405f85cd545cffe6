"""Declarations of quantities: all of them are found, told apart and explained, and say only what they can."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import pytest

from mbla.arrays import FloatArray
from mbla.results import quantities
from mbla.results.quantities import registry
from mbla.results.quantities.group import DECLARED, Field, Group
from mbla.results.quantities.quantity import UNITS
from mbla.results.quantities.registry import STORED

OTHERS = {"__init__", "group", "quantity", "registry"}
"""files of the package that declare nothing"""


def test_every_file_of_the_package_is_asked_for_its_quantities() -> None:
    files = {path.stem for path in Path(str(quantities.__file__)).parent.glob("*.py")}
    assert files - OTHERS <= vars(registry).keys()


def test_quantities_are_told_apart_and_explained() -> None:
    paths = Counter(each.path for each in STORED)
    columns = Counter((each.table, each.name) for each in DECLARED if each.table)
    assert max(paths.values()) == max(columns.values()) == 1
    for each in DECLARED:
        assert each.unit in UNITS, each
        assert all((each.words, each.group or each.table)), each
        assert bool(each.table) == bool(each.files), each


@dataclass(frozen=True)
class Stone:
    mass: float


def test_what_is_no_field_of_a_dataclass_is_refused() -> None:
    group = Group[Stone](lambda stone: stone)
    with pytest.raises(KeyError, match="weight"):
        group.fields(Stone, weight=Field("weight"))


def test_a_type_that_files_cannot_hold_is_refused() -> None:
    group = Group[Stone](lambda stone: stone, file="stones")

    def masses(stone: Stone) -> dict[str, float]:
        """Masses by name."""
        return {"stone": stone.mass}

    with pytest.raises(TypeError, match="masses: dict"):
        group.quantity()(masses)


def test_a_quantity_is_what_its_function_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mbla.results.quantities.group.DECLARED", [])
    group = Group[Stone](lambda stone: stone, file="stones", table="stones", part="found")

    @group.quantity("table", unit="mass", dims="stone", rule="open")
    def masses(stone: Stone) -> FloatArray | None:
        """Masses of stones,
        in the unit of the deck.
        """
        return None

    (quantity,) = group.quantities
    assert (quantity.name, quantity.kind, quantity.unit) == ("masses", "float", "mass")
    assert quantity.words == "masses of stones, in the unit of the deck"
    assert (quantity.path, quantity.dims, quantity.part, quantity.open) == ("stones/masses", ("stone",), "found", True)
    assert masses(Stone(1.0)) is None
