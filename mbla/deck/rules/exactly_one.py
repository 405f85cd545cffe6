"""Sections that have exactly one, or at least one, of several keys."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import exactly_one, given
from mbla.deck.section import Finding, Section, rule
from mbla.deck.suggestions import listed
from mbla.errors import Message

EXACTLY_ONE: dict[type[Section], tuple[str, ...]] = {
    types.Material: ("density", "unit_weight"),
    types.JointLaw: ("friction", "friction_angle"),
    types.BlockItem: tuple(types.BlockItem.model_fields),
    types.TransformStep: tuple(types.TransformStep.model_fields),
    types.ColumnEnd: ("side", "radius"),
    types.Repetition: ("translate", "rotate"),
    types.GroundPlane: ("x", "y", "z", "point"),
    types.SymmetryPlane: ("x", "y", "z", "point"),
    types.LoadCaseSection: ("live", "settlement"),
    types.SettlementSection: ("direction", "turn"),
    types.Load: ("gravity", "acceleration", "force", "moment", "line", "pressure", "table", "loads", "travel", "tilt"),
}
"""Keys of which a section has exactly one; the schema says so too."""

KINDS: dict[type[Section], str] = {types.BlockItem: "kind of item", types.Load: "kind of load"}
"""What the keys are where they are too many for one line; messages then leave the list to the key reference."""

AT_LEAST_ONE: dict[type[Section], tuple[str, ...]] = {
    types.SelectorTerm: ("group", "box"),
}
"""Keys of which a section has one or more; the schema says so too."""


def _register_at_least_one(section: type[Section], keys: tuple[str, ...]) -> None:
    @rule(section)
    def one_key(item: Section) -> Iterator[Finding]:
        if not given(item, keys):
            yield (), Message("missing-key", f"needs one of {listed(keys)}")


def _register_exactly_one(section: type[Section], keys: tuple[str, ...]) -> None:
    @rule(section)
    def one_key(item: Section) -> Iterator[Finding]:
        yield from exactly_one(item, keys, kind=KINDS.get(section, ""))


for _section, _keys in EXACTLY_ONE.items():
    _register_exactly_one(_section, _keys)
for _section, _keys in AT_LEAST_ONE.items():
    _register_at_least_one(_section, _keys)
