"""What rivals get and what they answer: walls and arches of the standard set, in their plane and in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mbla.assembly import build_assembly
from mbla.contacts import Contacts
from mbla.deck import Deck, read_deck
from mbla.model import Model, build_model
from mbla.model.model import LoadCase, select_cases
from tests.performance.standard_set import SPATIAL, STANDARD_SET
from tests.performance.standard_set import Structure as Standard

WALLS = (5, 10, 20)
ARCHES = (20, 50, 100)


@dataclass(frozen=True)
class Structure:
    """Everything that is there before anyone begins: the blocks, their contacts and loads."""

    deck: Deck
    model: Model
    contacts: Contacts
    load_case: LoadCase
    planar: bool


@dataclass(frozen=True)
class Answer:
    """Of one run from the contacts on.

    status       : in the rival's own words
    load_factor  : None where it gives none
    residual     : largest lack of balance or excess over friction of its forces, over the mean block weight; None where
                   it is not asked
    bounds       : proved static and kinematic bound; None where the rival proves nothing
    """

    status: str
    load_factor: float | None = None
    residual: float | None = None
    bounds: tuple[float, float] | None = None


def compared() -> dict[str, tuple[Standard, bool]]:
    """Structures of the standard set by name, and whether they are taken as planar."""
    standard = {structure.name: structure for structure in STANDARD_SET}
    chosen: dict[str, tuple[Standard, bool]] = {}
    for way in ("planar", "spatial"):
        for n in WALLS:
            chosen[f"wall, {way}, {n} x {n}"] = standard[f"wall, {way}, {n} x {n}"], way == "planar"
    for way, more in (("planar", ()), ("spatial", SPATIAL)):
        for n in ARCHES:
            arch = standard[f"arch, {n} voussoirs"]
            chosen[f"arch, {way}, {n} voussoirs"] = replace(arch, overrides=(*arch.overrides, *more)), way == "planar"
    return chosen


def structure_of(standard: Standard, overrides: Sequence[str] = (), *, planar: bool) -> Structure:
    """Read, build and find the contacts, under associative flow."""
    deck = read_deck(standard.deck, (*standard.overrides, "analysis.flow_rule=associative", *overrides))
    model = build_model(deck)
    (load_case,) = select_cases(model, [standard.load_case])
    return Structure(deck, model, build_assembly(deck, model).contacts, load_case, planar)
