"""The type of a complete deck: the source of the schema, of the checks on single values and of the key reference.

Numbers are in the deck's own units; a string with a unit (``"18 kN/m^3"``) is converted while it is read.
Sections stand in ``sections`` with their rules, kinds of items of `blocks` in ``mbla.model.blocks``; here are `units`,
`output` and `expected`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from graphlib import CycleError, TopologicalSorter
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from mbla.deck.kinds.load_key import NAMED
from mbla.deck.quantities import Integer, Line, Name, Number, ParameterName, Switch
from mbla.deck.section import Section, rule
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.sections.blocks import BlockItem
from mbla.deck.sections.contacts import ContactsSection
from mbla.deck.sections.expected import Expectation as Expectation
from mbla.deck.sections.expected import expectations_of_kinds
from mbla.deck.sections.fill import Fill
from mbla.deck.sections.find import FindSection
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.sections.loads import AddedMass, Load
from mbla.deck.sections.materials import JointLaw, Material
from mbla.deck.sections.selectors import Selector
from mbla.deck.sections.soil import SOIL
from mbla.deck.sections.strengthen import StrengthenSection
from mbla.deck.sections.supports import Support, SymmetryPlane
from mbla.deck.sections.ties import TieSection
from mbla.deck.sections.vehicles import Vehicle
from mbla.deck.text.include import MAX_FILES
from mbla.errors import Finding, KeyPath


def no_boolean(value: Any) -> Any:
    """Python takes True for 1; a deck does not."""
    return str(value) if isinstance(value, bool) else value


class UnitsSection(Section):
    """Units of the numbers in the deck, and of the results."""

    length: Literal["m", "mm", "cm", "ft", "in"] = Field("m", description="unit of length")
    force: Literal["N", "kN", "MN", "lbf", "kip"] = Field("N", description="unit of force")
    mass: Literal["kg", "t", "lb"] = Field("kg", description="unit of mass")


class OutputSection(Section):
    """Which result files are written."""

    vtu: Switch = Field(True, description="VTU and PVD files for ParaView")
    frames: Annotated[int, Integer(ge=2, le=1000)] = Field(11, description="frames of the animation of the mechanism")
    plots: Switch = Field(
        False, description="pictures of model, mechanisms and forces beside the results, as `mbla plot` draws them"
    )
    positions: Literal["worst", "all"] = Field(
        "worst", description="positions of a travelling load that have files, pictures and a section of the listing"
    )


class DeckContent(Section):
    """A complete deck."""

    mbla: Annotated[Literal[1], BeforeValidator(no_boolean)] = Field(description="version of the deck format")
    title: Line = Field("", description="shown in every result")
    units: UnitsSection = Field(default_factory=UnitsSection, description="units of numbers in deck and results")
    parameters: dict[ParameterName, Number] = Field(default_factory=dict, description='names for "=..." expressions')
    include: Annotated[list[str], Field(max_length=MAX_FILES)] = Field(
        default_factory=list,
        description="decks merged into this one, relative to it; at most 100 are read, with all that these include",
    )
    materials: dict[Name, Material] = Field(min_length=1, description="materials by name")
    joints: dict[Name, JointLaw] = Field(
        default_factory=dict, description="joint laws by name; frictionless, glued and open need no entry"
    )
    blocks: list[BlockItem] = Field(min_length=1, description="the structure, item by item")
    groups: dict[Name, Selector] = Field(
        default_factory=dict,
        description="named selectors, beside the groups of the items: a name stands for its selector, by itself or "
        "in a list, wherever blocks are chosen",
    )
    contacts: ContactsSection = Field(description="joint law and tolerance of contacts")
    supports: list[Support] = Field(default_factory=list, description="what holds the structure")
    ties: list[TieSection] = Field(
        default_factory=list, description="ties, rings, struts and strips: forces between blocks, or to the ground"
    )
    masses: list[AddedMass] = Field(default_factory=list, description="masses that rest on blocks, such as floors")
    fill: dict[Name, Fill] = Field(default_factory=dict, description="soil above arches and vaults, by name")
    vehicles: dict[Name, Vehicle] = Field(default_factory=dict, description="vehicles by name")
    loads: dict[Name, Annotated[list[Load], Field(min_length=1)]] = Field(
        default_factory=dict, description="loads by name, for several load cases"
    )
    symmetry: Annotated[list[SymmetryPlane], Field(max_length=3)] = Field(
        default_factory=list, description="planes that mirror what the deck gives, one after the other"
    )
    load_cases: dict[Name, LoadCaseSection] = Field(min_length=1, description="load cases by name")
    analysis: AnalysisSection = Field(default_factory=AnalysisSection, description="how the load factor is computed")
    find: FindSection | None = Field(None, description="question of `mbla find`")
    strengthen: StrengthenSection | None = Field(
        None, description="question of `mbla strengthen`: ties that may be added, load factors that are required"
    )
    output: OutputSection = Field(default_factory=OutputSection, description="which files are written")
    expected: dict[Name, Expectation] = Field(
        default_factory=dict, description="figures that `mbla run --expected` compares"
    )


@rule(DeckContent)
def convex_outlines(deck: DeckContent) -> Iterator[Finding]:
    """Interface resultants need the outlines as they are."""
    if deck.analysis.contact_model == "convex":
        for key in ("inset", "rounding"):
            if getattr(deck.contacts.points, key) > 0:
                yield Finding(
                    "key-of-another-choice", "applies to contact_model: concave only: use 0", "contacts", "points", key
                )


@rule(DeckContent)
def prescribed_interfaces_and_symmetry(deck: DeckContent) -> Iterator[Finding]:
    """Interfaces on the plane of symmetry are found among the images, which a table of the half does not know."""
    if deck.contacts.table is not None and deck.symmetry:
        words = (
            "does not go with symmetry, which has interfaces with images: give the whole structure, or leave "
            "contacts to be found"
        )
        yield Finding("symmetry-broken", words, "contacts", "table")
    if deck.contacts.joint_thickness is not None and deck.symmetry:
        words = (
            "does not go with symmetry, for the joints at the plane have no other side yet: give the whole structure, "
            "or leave this out"
        )
        yield Finding("symmetry-broken", words, "contacts", "joint_thickness")


def soils_of(deck: DeckContent) -> Iterator[tuple[KeyPath, Any]]:
    """Items `soil`, then fills with cells, with their key paths."""
    yield from (
        (("blocks", number, SOIL), entry.item) for number, entry in enumerate(deck.blocks) if entry.kind == SOIL
    )
    yield from ((("fill", name), fill) for name, fill in deck.fill.items() if fill.cells is not None)


def with_flow_rule(deck: DeckContent) -> DeckContent:
    """With the flow rule that holds by default: of soil of cells associative, whose load factor two bounds prove."""
    if "flow_rule" in deck.analysis.model_fields_set or not any(soils_of(deck)):
        return deck
    return deck.model_copy(update={"analysis": deck.analysis.model_copy(update={"flow_rule": "associative"})})


@rule(DeckContent)
def soil_of_cells(deck: DeckContent) -> Iterator[Finding]:
    """Contacts of cells are found, and cells fit the blocks of the whole structure."""
    for place, soil in soils_of(deck):
        path = (*place, "cells") if isinstance(soil, Fill) else place
        if deck.symmetry:
            yield Finding("symmetry-broken", "does not go with symmetry: give the whole structure", *path)
        if deck.contacts.table is not None:
            words = "does not go with contacts.table, in which its cells are not: leave contacts to be found"
            yield Finding("key-of-another-choice", words, *path)
    if any(soils_of(deck)):
        yield from _followed(deck)


def _followed(deck: DeckContent) -> Iterator[Finding]:
    """What is followed beyond the first movement, in which cells of soil would jam as soon as others meet."""
    words = "does not go with soil of cells, which jam where they meet others after the first movement: leave it out"
    for name, case in deck.load_cases.items():
        if case.pushover is not None:
            yield Finding("key-of-another-choice", words, "load_cases", name, "pushover")
        given = case.settlement
        for number, settlement in enumerate(given if isinstance(given, list) else [given]):
            if settlement is not None and settlement.amount is not None:
                place = (number,) if isinstance(given, list) else ()
                yield Finding("key-of-another-choice", words, "load_cases", name, "settlement", *place, "amount")


@rule(DeckContent)
def soil_in_time(deck: DeckContent) -> Iterator[Finding]:
    """In a time history what slides does not lift; joint laws are judged where it is known which are used."""
    name = next((name for name, case in deck.load_cases.items() if case.time_history is not None), None)
    for path, soil in soils_of(deck) if name is not None else ():
        if soil.dilatancy > 0.0:
            words = f"must be 0: load case {name} has a time_history, in which soil slides without dilatancy"
            yield Finding("time-history-not-possible", words, *path, "dilatancy")


@rule(DeckContent)
def loads_on_cells(deck: DeckContent) -> Iterator[Finding]:
    """Loads spread through a fill that is a mass on blocks; cells carry them."""
    lists: list[tuple[KeyPath, Sequence[Load]]] = [(("loads", name), loads) for name, loads in deck.loads.items()]
    for name, case in deck.load_cases.items():
        lists += [(("load_cases", name, key), getattr(case, key) or ()) for key in ("dead", "live")]
    for path, loads in lists:
        for number, load in enumerate(loads):
            fill = deck.fill.get(load.through or "")
            if fill is not None and fill.cells is not None:
                words = f"{load.through} is soil of cells, which carry the load themselves: leave it out"
                yield Finding("key-of-another-choice", words, *path, number, "through")


MOST_LOADS = 100_000
"""loads that a named one may stand for, with all that it names"""


@rule(DeckContent)
def named_loads(deck: DeckContent) -> Iterator[Finding]:
    """Named loads can be added up: none travels or tilts, and none comes back to itself."""
    for name, loads in deck.loads.items():
        for number, load in enumerate(loads):
            if load.facts.live_only:
                words = "must stand in the live loads of a load case itself"
                yield Finding("load-misplaced", words, "loads", name, number, load.kind)
    below = {name: [load.chosen for load in loads if load.kind == NAMED] for name, loads in deck.loads.items()}
    try:
        TopologicalSorter(below).prepare()
    except CycleError as error:
        chain = error.args[1][::-1]
        yield Finding("load-misplaced", f"contains itself: {' > '.join(chain)}", "loads", chain[0])
        return
    counts = dict[str, int]()
    for name in TopologicalSorter(below).static_order():
        counts[name] = len(deck.loads.get(name, ())) + sum(counts[other] for other in below.get(name, ()))
        if counts[name] > MOST_LOADS and not any(counts[other] > MOST_LOADS for other in below[name]):
            words = f"is {min(counts[name], 10**300):.0e} loads with those that it names; at most {MOST_LOADS:,} can be"
            yield Finding("too-many-loads", f"{words} handled: use factor in place of repeating", "loads", name)


rule(DeckContent)(expectations_of_kinds)
