"""The part of the record that the result file holds, from which everything else follows."""

from __future__ import annotations

from mbla.results.record.of_case import OF_CASE
from mbla.results.record.of_model import OF_MODEL
from mbla.results.record.quantity import Quantity

STORED: tuple[Quantity, ...] = (*OF_MODEL, *OF_CASE)
"""in the order of writing"""
STORED_BY_PATH: dict[str, Quantity] = {each.path: each for each in STORED}


def stored(kind: type, place: str) -> tuple[str, ...]:
    """Fields of a dataclass that the result file holds at a place, by the name that both have."""
    names = kind.__dataclass_fields__  # type: ignore[attr-defined]
    return tuple(name for name in names if f"{place}/{name}" in STORED_BY_PATH)
