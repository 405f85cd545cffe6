"""Sections that have exactly one of several keys."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import exactly_one
from mbla.deck.section import Finding, Section, rule

EXACTLY_ONE: dict[type[Section], tuple[str, ...]] = {
    types.Material: ("density", "unit_weight"),
    types.JointLaw: ("friction", "friction_angle"),
    types.BlockItem: tuple(types.BlockItem.model_fields),
    types.TransformStep: tuple(types.TransformStep.model_fields),
    types.SelectorTerm: ("group", "box"),
    types.GroundPlane: ("x", "y", "z", "point"),
    types.LoadCaseSection: ("live", "settlement"),
    types.SettlementSection: ("direction", "turn"),
    types.Load: ("gravity", "acceleration", "force"),
}
"""Keys of which a section has exactly one; the schema says so too."""


def _register_exactly_one(section: type[Section], keys: tuple[str, ...]) -> None:
    @rule(section)
    def one_key(item: Section) -> Iterator[Finding]:
        yield from exactly_one(item, keys)


for _section, _keys in EXACTLY_ONE.items():
    _register_exactly_one(_section, _keys)
