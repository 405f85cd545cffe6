"""From the deck to the model: generate, transform, check blocks, then supports and loads on them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.deck.deck import Deck
from mbla.deck.joints import FRICTIONLESS
from mbla.deck.tree import KeyPath
from mbla.deck.types import BlockItem, Item, JointLaw, LoadCaseSection, Material
from mbla.deck.units import Units
from mbla.errors import DeckError, Fault, Notice
from mbla.model.added_masses import with_added_masses
from mbla.model.build_blocks import BuiltBlocks, Labels, build_blocks, indices_in_groups
from mbla.model.generators import GENERATORS
from mbla.model.generators.generator import Generated, ItemRefused, Site
from mbla.model.interfaces import COLUMNS, given_interfaces
from mbla.model.labels import NONE, BlockLabels, join_labels, labels_of
from mbla.model.loads import LoadSite, build_load_cases
from mbla.model.model import GivenInterfaces, Ground, Joint, LoadCase, Model
from mbla.model.overrides import check_overrides
from mbla.model.polyhedra import Polyhedra, join_polyhedra
from mbla.model.selectors import Roster, build_roster
from mbla.model.settlement import build_settlement
from mbla.model.supports import Supports, build_supports, does_nothing
from mbla.model.symmetry import symmetry_faults, with_images
from mbla.model.tables import TableRefused, read_table
from mbla.model.transform import build_transform, repetitions, transform_item

FROM_FILES = ("mesh", "table")
"""kinds of items whose blocks have names of their own"""
MOST_FAULTS_PER_ITEM = 10
"""defects of blocks of one item that are told one by one; a mesh in the wrong format has one in every block"""


@dataclass
class _Collected:
    """What the items gave so far, one entry per part; ``first_block`` is the number of the next block."""

    polyhedra: list[Polyhedra] = field(default_factory=list)
    groups: list[str] = field(default_factory=list)
    densities: list[float] = field(default_factory=list)
    items: list[int] = field(default_factory=list)
    fixed: list[bool] = field(default_factory=list)
    grounds: list[tuple[int, Ground]] = field(default_factory=list)
    notices: list[Notice] = field(default_factory=list)
    partial: set[str] = field(default_factory=set)
    labels: list[BlockLabels] = field(default_factory=list)
    first_block: int = 0


@dataclass(frozen=True)
class _Entry:
    """What all blocks of an item share: its number in the deck, group, material, and the deck's default joint law.

    densities : by the name of each material
    """

    number: int
    group: str
    material: str
    joint: str
    densities: Mapping[str, float]


def build_model(deck: Deck) -> Model:
    """The model that a checked deck describes.

    Raises
    ------
    DeckError
        with every fault found: items that cannot be built, blocks that are no blocks, selectors without blocks,
        supports and loads that do nothing
    """
    faults: list[Fault] = []
    notices: list[Notice] = []
    items = _generate_items(deck, faults)
    if not items.polyhedra:
        raise DeckError(faults)
    counts = np.array([len(polyhedra) for polyhedra in items.polyhedra])
    built = build_blocks(join_polyhedra(items.polyhedra), _labels(items, counts), deck.contacts.tolerance)
    item_of_block = np.repeat(items.items, counts)
    faults += _defects_in_words(deck, built, item_of_block.tolist())
    partial = items.partial | {built.blocks.groups[defect.block] for defect in built.defects}
    roster = build_roster(built.blocks, frozenset(partial), deck.fault_at)
    grounds = tuple(_named(ground, block, built) for block, ground in items.grounds)
    brought_along = Supports(np.repeat(np.array(items.fixed, dtype=bool), counts), grounds)
    tolerance, joint = deck.contacts.tolerance, deck.contacts.joint
    supports = build_supports(deck.content.supports, joint, brought_along, roster, tolerance, faults)
    check_overrides(deck.contacts.overrides, roster, faults)
    given = _given_interfaces(deck, roster, supports, faults)
    if deck.content.masses:
        roster = replace(roster, blocks=with_added_masses(deck.content.masses, roster, supports.fixed, faults, notices))
    site = LoadSite(
        roster=roster,
        fixed=supports.fixed,
        units=deck.units,
        resolve_file=deck.resolve_file,
        grounds=supports.grounds,
        named=deck.content.loads,
        tolerance=tolerance,
        faults=faults,
        notices=notices,
    )
    sections = deck.content.load_cases.items()
    load_cases = tuple(case for name, section in sections for case in _load_cases(name, section, site, supports))
    if faults:
        raise DeckError(faults)
    model = Model(
        title=deck.content.title,
        units=deck.units,
        blocks=roster.blocks,
        fixed=supports.fixed,
        grounds=supports.grounds,
        joints=_joints(deck, supports.grounds),
        load_cases=load_cases,
        notices=(*items.notices, *built.notices, *notices),
        guides=supports.guides,
        interfaces=given,
    )
    faults += symmetry_faults(deck, model)
    if faults:
        raise DeckError(faults)
    return with_images(deck, model)


def _given_interfaces(deck: Deck, roster: Roster, supports: Supports, faults: list[Fault]) -> GivenInterfaces | None:
    """Interfaces of the deck's table; None where it has none, or where it is at fault."""
    path: KeyPath = ("contacts", "table")
    if deck.contacts.table is None or roster.partial:
        return None
    try:
        table = read_table(deck.resolve_file(path, deck.contacts.table), COLUMNS)
        return given_interfaces(table, roster.blocks, roster.members, supports.grounds, deck.contacts.tolerance)
    except DeckError as error:
        faults += error.faults
    except TableRefused as refused:
        faults += [deck.fault_at(path, fault) for fault in refused.faults]
    return None


def _joints(deck: Deck, grounds: Sequence[Ground]) -> dict[str, Joint]:
    """Joint laws of the deck, and that without friction where it is asked for by its name."""
    laws = {name: build_joint(name, law) for name, law in deck.content.joints.items()}
    used = {deck.contacts.joint, *(override.joint for override in deck.contacts.overrides)}
    if FRICTIONLESS in used | {ground.joint for ground in grounds}:
        laws[FRICTIONLESS] = Joint(FRICTIONLESS, 0.0)
    return laws


def _load_cases(name: str, section: LoadCaseSection, site: LoadSite, supports: Supports) -> Sequence[LoadCase]:
    """Loads of one case, or of one for each position of a load that travels; or a support that gives way."""
    load_cases = build_load_cases(name, section, site)
    path: KeyPath = ("load_cases", name)
    if section.settlement is not None:
        settles = (*path, "settlement")
        return [
            build_settlement(section.settlement, settles, load_case, supports, site.roster, site.faults)
            for load_case in load_cases
        ]
    for load_case in load_cases:
        if not site.faults and does_nothing(load_case.live_load, supports):
            where = "" if load_case.travel is None else f" at position {load_case.travel.number}"
            site.refuse(
                (*path, "live"),
                f"the supports take every live load{where}, for they act on guided blocks across what these may do",
            )
    return load_cases


def build_joint(name: str, law: JointLaw) -> Joint:
    """Joint law with tangents for angles, and an unlimited compressive strength unless given."""
    friction = law.friction
    if friction is None:
        assert law.friction_angle is not None  # a rule of the deck: one of friction and friction angle
        friction = math.tan(math.radians(law.friction_angle))
    return Joint(
        name=name,
        friction=friction,
        cohesion=law.cohesion,
        tensile_strength=law.tensile_strength,
        compressive_strength=math.inf if law.compressive_strength is None else law.compressive_strength,
        dilatancy=math.tan(math.radians(law.dilatancy)),
    )


def density_of(material: Material, units: Units) -> float:
    """Mass per volume; a unit weight is one under standard gravity."""
    if material.density is not None:
        return material.density
    assert material.unit_weight is not None  # a rule of the deck: one of density and unit weight
    return material.unit_weight / (units.standard_gravity * units.force_per_mass_acceleration)


# --- items --------------------------------------------------------------------------------------------------------


def _generate_items(deck: Deck, faults: list[Fault]) -> _Collected:
    """Raw polyhedra of all items; items that cannot be built leave a fault, and their groups are partial."""
    collected = _Collected()
    densities = {name: density_of(material, deck.units) for name, material in deck.content.materials.items()}
    for number, block_item in enumerate(deck.content.blocks):
        kind, item = _kind(block_item)
        path: KeyPath = ("blocks", number, kind)
        group = item.group or kind
        try:
            generated = _generate(deck, kind, item, path)
        except ItemRefused as refused:
            faults += [deck.fault_at((*path, *below), message) for below, message in refused.findings]
        except DeckError as error:
            faults += error.faults
        else:
            entry = _Entry(number, group, item.material, deck.contacts.joint, densities)
            _collect_copies(collected, generated, item, entry)
            collected.notices += generated.notices
            continue
        collected.partial |= {group, f"{group}_springers"}
    return collected


def _collect_copies(collected: _Collected, generated: Generated, item: Item, entry: _Entry) -> None:
    """An item as often as it is repeated."""
    copies = repetitions(item.repeat)
    if len(copies) == 1:
        return _collect(collected, generated, entry, NONE)
    for copy, onwards in enumerate(copies):
        _collect(collected, transform_item(generated, onwards) if copy else generated, entry, copy)
    return None


def _kind(entry: BlockItem) -> tuple[str, Item]:
    """Key and content of an item of the deck."""
    return next((kind, item) for kind in GENERATORS if (item := getattr(entry, kind)) is not None)


def _generate(deck: Deck, kind: str, item: Item, path: KeyPath) -> Generated:
    site = Site(
        deck.contacts.tolerance, lambda below, name: deck.resolve_file((*path, *below), name), deck.units.length
    )
    with np.errstate(over="ignore", invalid="ignore"):  # coordinates that are not finite are refused by block
        generated = GENERATORS[kind](item, site)
        transform = build_transform(item.transform)
        return generated if transform is None else transform_item(generated, transform)


def _collect(collected: _Collected, generated: Generated, entry: _Entry, copy: int) -> None:
    """Add one copy of an item; ``copy`` is -1 where there is but one."""
    for ground in generated.grounds:
        block = collected.first_block + ground.block
        carried = np.array([block], dtype=np.int64)
        plane = Ground(ground.point, ground.normal, ground.joint or entry.joint, carried, "ground")
        collected.grounds.append((block, plane))
    for part in generated.parts:
        collected.polyhedra.append(part.polyhedra)
        collected.groups.append(entry.group + part.suffix)
        collected.densities.append(entry.densities[part.material or entry.material])
        collected.items.append(entry.number)
        collected.fixed.append(part.fixed)
        collected.labels.append(labels_of(len(part.polyhedra), part.member, part.labels, copy))
        collected.first_block += len(part.polyhedra)


def _labels(items: _Collected, counts: Sequence[int] | np.typing.NDArray[np.int64]) -> Labels:
    groups = tuple(group for group, count in zip(items.groups, counts, strict=True) for _ in range(int(count)))
    return Labels(
        groups, indices_in_groups(groups), np.repeat(np.array(items.densities), counts), join_labels(items.labels)
    )


def _named(ground: Ground, block: int, built: BuiltBlocks) -> Ground:
    label = f"ground under {built.blocks.name(block)}"
    return Ground(ground.point, ground.normal, ground.joint, ground.blocks, label)


def _defects_in_words(deck: Deck, built: BuiltBlocks, item_of_block: Sequence[int]) -> list[Fault]:
    """Faults at the items, or at the faces, of blocks that are none; many of one item are counted only."""
    faults = []
    told: Counter[int] = Counter()
    for defect in built.defects:
        number = item_of_block[defect.block]
        told[number] += 1
        if told[number] <= MOST_FAULTS_PER_ITEM:
            path = _path_of_defect(deck, defect.face, number)
            faults.append(deck.fault_at(path, f"block {_called(deck, built, defect.block, number)}: {defect.message}"))
    for number, count in told.items():
        if count > MOST_FAULTS_PER_ITEM:
            message = f"{count - MOST_FAULTS_PER_ITEM} more blocks of this item are refused"
            faults.append(deck.fault_at(_path_of_defect(deck, None, number), message))
    return faults


def _called(deck: Deck, built: BuiltBlocks, block: int, number: int) -> str:
    """Name of a block; with that which its file gives it, where it comes from one: ``vault[17] (key_stone)``."""
    member = built.blocks.labels.members[block] if _kind(deck.content.blocks[number])[0] in FROM_FILES else ""
    return f"{built.blocks.name(block)}{f' ({member})' if member else ''}"


def _path_of_defect(deck: Deck, face: int | None, number: int) -> KeyPath:
    kind, _ = _kind(deck.content.blocks[number])
    if kind == "polyhedron" and face is not None:
        return ("blocks", number, kind, "faces", face)
    return ("blocks", number, kind, "file") if kind == "mesh" else ("blocks", number, kind)
