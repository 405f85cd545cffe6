"""Rules on contacts: conditions of overrides, and places of contact points."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import given, is_zero, least_below_greatest
from mbla.deck.section import Finding, rule
from mbla.deck.suggestions import listed
from mbla.errors import Message

CONDITIONS = ("between", "orientation", "box")


@rule(types.ContactOverride)
def override_conditions(override: types.ContactOverride) -> Iterator[Finding]:
    """An override without condition would be the joint of the section."""
    if not given(override, CONDITIONS):
        yield (
            (),
            Message("missing-key", f"needs one of {listed(CONDITIONS)}: the joint of all contacts is contacts.joint"),
        )
    if override.box is not None:
        for (key, axis), message in least_below_greatest(*override.box, "box", "xyz"):
            yield (key, 1, axis), message


@rule(types.AboutNormal)
def normal_with_direction(orientation: types.AboutNormal) -> Iterator[Finding]:
    """A normal has a direction."""
    if is_zero(orientation.normal):
        yield ("normal",), Message("zero-vector", "must not be the zero vector")


@rule(types.ContactPoints)
def one_way_each(points: types.ContactPoints) -> Iterator[Finding]:
    """One measure of the density of points, one of their distance from the edge."""
    if points.per_edge is not None and points.spacing is not None:
        yield ("spacing",), Message("one-of-several", "only one of per_edge or spacing may be given")
    if points.inset > 0 and points.rounding > 0:
        yield ("rounding",), Message("one-of-several", "only one of inset or rounding may be given")


@rule(types.DeckContent)
def convex_outlines(deck: types.DeckContent) -> Iterator[Finding]:
    """Interface resultants need the outlines as they are."""
    if deck.analysis.contact_model == "convex":
        for key in ("inset", "rounding"):
            if getattr(deck.contacts.points, key) > 0:
                yield (
                    ("contacts", "points", key),
                    Message("key-of-another-choice", "applies to contact_model: concave only: use 0"),
                )


@rule(types.DeckContent)
def given_interfaces_of_the_whole(deck: types.DeckContent) -> Iterator[Finding]:
    """Interfaces on the plane of symmetry are found among the images, which a table of the half does not know."""
    if deck.contacts.table is not None and deck.symmetry:
        yield (
            ("contacts", "table"),
            Message(
                "symmetry-broken",
                "does not go with symmetry, which has interfaces with images: give the whole structure, or leave "
                "contacts to be found",
            ),
        )
