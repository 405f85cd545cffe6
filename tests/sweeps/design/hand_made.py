"""Designs from sweep files written as dicts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mbla.deck.text.tree import key_text
from mbla.errors import Fault, KeyPath, Message, Place
from mbla.sweeps.design.build import design_of
from mbla.sweeps.design.design import Design, Sources, TurnedVector
from mbla.sweeps.file import rules
from mbla.sweeps.file.content import SweepContent

CHECKED_BY = (rules,)
"""register the checks of sweep files, so that what is made here is what a file could hold"""


def content_of(parameters: Mapping[str, Any], **keys: Any) -> SweepContent:
    """Content of a sweep file with these parameters and further keys."""
    return SweepContent.model_validate({"mbla_sweep": 1, "deck": "deck.yaml", "parameters": parameters, **keys})


def fault_at(path: KeyPath, message: Message) -> Fault:
    return Fault(Place("sweep.yaml", 1, 1), key_text(path), message)


def design(
    parameters: Mapping[str, Any],
    *,
    vectors: Mapping[str, TurnedVector] | None = None,
    units: Mapping[str, str] | None = None,
    known: Mapping[str, object] | None = None,
    **keys: Any,
) -> Design:
    """The design of such a sweep over a deck with these vectors, units and parameters."""
    return design_of(Sources(content_of(parameters, **keys), vectors or {}, units or {}, known or {}, fault_at))


def column(design: Design, name: str) -> list[Any]:
    """Values of a column at all points."""
    place = [column.name for column in design.columns].index(name)
    return [point.values[place] for point in design.points]


def drawn(parameter: Mapping[str, Any], points: int = 2000, kind: str = "random", **keys: Any) -> Design:
    """One parameter ``x`` drawn alone."""
    vectors = {"x": (3.0, 4.0, -12.0)}
    return design({"x": {"key": "a.x", **parameter}}, design=[{kind: {"points": points, **keys}}], vectors=vectors)
