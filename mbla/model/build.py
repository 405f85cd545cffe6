"""From the deck to the model: items, blocks, soil, supports, masses, joints, loads, images, in this order.

The structure (blocks, supports, prescribed interfaces) depends on no load, joint law or setting of the analysis.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from mbla.arrays import BoolArray
from mbla.deck.deck import Deck
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.sections.loads import AddedMass
from mbla.deck.sections.materials import FRICTIONLESS, JointLaw
from mbla.deck.units import Units
from mbla.errors import DeckError, Fault, Finding, KeyPath, Message, Notice
from mbla.model.applied_load import AppliedLoad
from mbla.model.block_sizes import unusual_sizes
from mbla.model.drawn_joints import close_joints, joints_in_words
from mbla.model.fill.fill import CarriedFill, build_fill
from mbla.model.fill.restraint import fill_struts
from mbla.model.interfaces import read_interfaces
from mbla.model.items import CollectedItems, collect_items, defects_in_words, density_of
from mbla.model.load_cases import build_load_cases
from mbla.model.loads.load_kind import LoadSite
from mbla.model.model import SHEAR_RATIO, Ground, Joint, LoadCase, Model, PrescribedInterfaces
from mbla.model.objective import build_objective
from mbla.model.outside import outside
from mbla.model.selectors import BlockSelection, check_overrides, select_blocks
from mbla.model.settlement import build_settlement
from mbla.model.soil.build import Soils, build_soils
from mbla.model.soil.soil_mesh import SoilCorners
from mbla.model.soil.water import ground_water
from mbla.model.solids.blocks import PointMasses, joined_masses
from mbla.model.solids.build import BuiltBlocks, build_blocks
from mbla.model.solids.defects import far_away
from mbla.model.solids.facets import BentFaces
from mbla.model.supports.supports import Supports, build_supports, does_nothing
from mbla.model.symmetry.symmetry import with_images
from mbla.model.ties.build import build_ties
from mbla.model.ties.ties import Ties, joined_ties
from mbla.model.wording import named, vector


def build_model(deck: Deck, soil: Mapping[str, SoilCorners] = MappingProxyType({})) -> Model:
    """The model that a checked deck describes.

    soil : by name of a soil of cells, corners of these in the place of those that are made for their size

    Raises DeckError with every fault found: items that cannot be built, blocks that are no blocks, selectors without
    blocks, supports and loads that do nothing.
    """
    structure = structure_of(deck, soil)
    selection, supports, interfaces = structure.selection, structure.supports, structure.interfaces
    site = LoadSite(
        selection=selection,
        fixed=supports.fixed,
        units=deck.units,
        resolve_file=deck.resolve_file,
        grounds=supports.grounds,
        named=deck.content.loads,
        tolerance=deck.contacts.tolerance,
        overlap=deck.contacts.depth_allowed,
        fill=structure.fill.bodies if structure.fill else {},
        vehicles=deck.content.vehicles,
        masses=structure.masses,
        water=structure.water,
        soils=structure.soils.meshes,
    )
    ties = build_ties(deck.content.ties, selection, supports.fixed, deck.contacts.tolerance)
    if structure.fill is not None:
        ties = joined_ties([ties, *fill_struts(structure.fill.bodies.values(), selection, supports.fixed)])
    sections = deck.content.load_cases.items()
    load_cases = tuple(case for name, section in sections for case in _load_cases(name, section, site, supports, ties))
    if selection.faults:
        raise DeckError(selection.faults)
    model = Model(
        title=deck.content.title,
        units=deck.units,
        blocks=selection.blocks,
        fixed=supports.fixed,
        grounds=supports.grounds,
        joints=build_joints(deck, supports.grounds, interfaces) | {law.name: law for law in structure.soils.joints},
        load_cases=load_cases,
        notices=(*structure.first_notices, *selection.notices),
        guides=supports.guides,
        interfaces=interfaces,
        ties=ties,
        bent=structure.bent,
        fill=structure.fill,
        soils=structure.soils.meshes,
    )
    return with_images(deck, model)


def _load_cases(
    name: str, section: LoadCaseSection, site: LoadSite, supports: Supports, ties: Ties
) -> Sequence[LoadCase]:
    """Loads of one case, or of one for each position of a load that travels, or for each end of a force that is sought;
    or a settling support.
    """
    load_cases = build_load_cases(name, section, site)
    path: KeyPath = ("load_cases", name)
    if section.objective is not None:
        guides = supports.guides
        return [end for each in load_cases for end in build_objective(section, path, each, site, guides, ties)]
    if section.settlement is not None:
        return [build_settlement(section, path, load_case, supports, site.selection) for load_case in load_cases]
    for load_case in load_cases if section.live is not None else ():
        if not site.selection.faults and does_nothing(load_case.live_load, supports):
            place = load_case.question.place
            where = f" at position {place.number}" if place.count else ""
            words = f"the supports take every live load{where}, for they act on guided blocks across what these may do"
            site.refuse(Finding("live-load-without-effect", words, *path, "live"))
    return load_cases


@dataclass(frozen=True)
class BuiltStructure:
    """Blocks by name, with the masses that rest on them, and what holds them; faults go to the selection.

    bent          : faces that were split
    fill          : soil on the blocks, None for none
    masses        : of it and of the deck, each by itself
    soils         : of cells, which are among the blocks
    water         : in it, that acts in every load case
    first_notices : before those on joint laws
    """

    selection: BlockSelection
    supports: Supports
    interfaces: PrescribedInterfaces | None
    bent: BentFaces
    fill: CarriedFill | None
    masses: PointMasses
    soils: Soils
    water: tuple[AppliedLoad, ...]
    first_notices: tuple[Notice, ...]


def structure_of(deck: Deck, soil: Mapping[str, SoilCorners] = MappingProxyType({})) -> BuiltStructure:
    """What the deck describes besides loads and joint laws; ``soil`` as of ``build_model``."""
    faults: list[Fault] = []
    items = collect_items(deck, faults)
    built = build_blocks(items.polyhedra, items.labels, deck.contacts.tolerance)
    built = _with_closed_joints(deck, built, items, faults)
    far = far_away(items.polyhedra, items.labels.name, deck.contacts.tolerance)
    if isinstance(far, Message):
        faults.append(deck.fault_at(("blocks",), far))
    else:
        faults += defects_in_words(deck, built.defects, items.items, built.blocks)
    partial = items.partial | {built.blocks.groups[defect.block] for defect in built.defects}
    soils = build_soils(deck, BlockSelection(built.blocks, partial, deck.fault_at, faults), soil)
    selection = BlockSelection(soils.blocks, partial | soils.partial, deck.fault_at, faults)
    fixed = np.append(items.fixed, np.zeros(len(soils.blocks) - len(items.fixed), dtype=bool))
    supports = build_supports(deck, Supports(fixed, (*items.grounds, *soils.grounds)), items.surfaces, selection)
    if not deck.content.symmetry:  # else images count among what they choose
        check_overrides(deck.contacts.overrides, selection)
    interfaces = read_interfaces(deck, selection, supports.grounds)
    water = ground_water(deck, soils, selection)
    masses = [point_masses(deck.content.masses, selection, supports.fixed, deck.units), water.masses]
    densities = {name: density_of(material, deck.units) for name, material in deck.content.materials.items()}
    masses_on = {name: each for name, each in deck.content.fill.items() if each.cells is None}
    fill = build_fill(masses_on, densities, selection, supports.fixed, deck.units, deck.contacts.tolerance)
    if fill is not None:
        masses.append(fill.parts)
    carried = joined_masses(masses)
    selection = replace(selection, blocks=carried.added_to(selection.blocks))
    sizes = () if faults else unusual_sizes(selection.blocks, supports.fixed, deck.units)
    first = (*items.notices, *built.notices, *([far] if isinstance(far, Notice) else []), *sizes)
    bent = replace(built.bent, items=items.items[built.bent.blocks])
    return BuiltStructure(selection, supports, interfaces, bent, fill, carried, soils, water.loads, first)


def _with_closed_joints(deck: Deck, built: BuiltBlocks, items: CollectedItems, faults: list[Fault]) -> BuiltBlocks:
    """The blocks grown to the middle of the joints that are drawn as gaps; adds a fault where they cannot."""
    thickness = deck.contacts.joint_thickness
    if thickness is None or built.defects:
        return built
    path = ("contacts", "joint_thickness")
    # which ground carries which blocks, with a record of its own: the grown blocks are checked against it after
    supports = build_supports(
        deck, Supports(items.fixed, items.grounds), (), BlockSelection(built.blocks, items.partial, deck.fault_at)
    )
    planes = tuple(ground for ground in supports.grounds if ground.outline is None)  # surfaces are where they are
    closed = close_joints(built.blocks, planes, thickness, deck.contacts.tolerance)
    if isinstance(closed, Message):
        faults.append(deck.fault_at(path, closed))
        return built
    grown = build_blocks(closed.polyhedra, items.labels, deck.contacts.tolerance)
    if grown.defects:
        which = named(np.array([defect.block for defect in grown.defects]), built.blocks.name)
        words = f"makes blocks that are none of those beside joints: {which}"
        faults.append(deck.fault_at(path, Message("joint-not-closed", words)))
        return built
    notice = joints_in_words(closed, built.blocks, grown.blocks, thickness, deck.units.length)
    return replace(grown, notices=(*built.notices, notice), bent=built.bent)


UNLIMITED = 1e6
"""Greatest friction coefficient and tangent of the dilatancy angle, 0.2 seconds of arc from a right angle: what is
steeper is taken for this. A load factor changes by a millionth between here and no limit; the power of sliding, which
is rounding times friction, would be the entire answer at 1e15."""


def build_joints(deck: Deck, grounds: Sequence[Ground], interfaces: PrescribedInterfaces | None) -> dict[str, Joint]:
    """Joint laws of the deck, and that without friction where it is asked for by its name."""
    laws = {name: build_joint(name, law) for name, law in deck.content.joints.items()}
    used = {deck.contacts.joint, *(override.joint for override in deck.contacts.overrides)}
    used |= {ground.joint for ground in grounds}
    if FRICTIONLESS in used.union(interfaces.joints if interfaces else ()):
        laws[FRICTIONLESS] = Joint(FRICTIONLESS, 0.0)
    return laws


def build_joint(name: str, law: JointLaw) -> Joint:
    """Joint law with tangents for angles, and by default an unlimited compressive strength."""
    friction = law.friction
    if friction is None:
        assert law.friction_angle is not None  # a rule of the deck: one of friction and friction angle
        friction = math.tan(math.radians(law.friction_angle))
    return Joint(
        name=name,
        friction=min(friction, UNLIMITED),
        cohesion=law.cohesion,
        tensile_strength=law.tensile_strength,
        compressive_strength=math.inf if law.compressive_strength is None else law.compressive_strength,
        dilatancy=min(math.tan(math.radians(law.dilatancy)), UNLIMITED),
        normal_stiffness=math.nan if law.stiffness is None else law.stiffness.across,
        shear_ratio=SHEAR_RATIO if law.stiffness is None else law.stiffness.ratio,
    )


def point_masses(masses: Sequence[AddedMass], selection: BlockSelection, fixed: BoolArray, units: Units) -> PointMasses:
    """The masses of the deck, shared in proportion to the volumes of the blocks selected.

    Each share is at the centroid of its block; that of a mass on one block is where the deck says. Refuses points
    for several blocks, and remarks on masses that do nothing or lie far off.

    fixed : (n_blocks,) blocks that do not move
    """
    blocks = selection.blocks
    found = []
    for number, added in enumerate(masses):
        path: KeyPath = ("masses", number)
        chosen = select_blocks(added.on, (*path, "on"), selection)
        if chosen is None:
            continue
        if added.at is not None and len(chosen) != 1:
            message = f"applies to a mass on one block, {len(chosen)} are selected: give an index, or one mass for each"
            selection.refuse(Finding("one-block-only", message, *path, "at"))
            continue
        shares = added.mass * blocks.volumes[chosen] / (blocks.volumes[chosen].sum() or 1.0)
        points = blocks.centroids[chosen] if added.at is None else np.array([added.at])
        found.append(PointMasses(chosen, shares, points))
        if added.at is not None:
            off = outside(np.array(added.at), int(chosen[0]), selection.blocks, units)
            if off is not None:
                where = f"{vector(added.at)} {units.length} on {blocks.name(int(chosen[0]))}"
                words = f"the mass of {added.mass:g} {units.mass} at {where} lies {off.words}; it moves with the block"
                selection.remark(Notice("warning" if off.far else "notice", "mass-outside-block", words))
        if fixed[chosen].all() and not fixed.all():
            where = f"{added.mass:g} {units.mass} on {named(chosen, blocks.name)}"
            words = f"the mass of {where} has no effect: nothing of it moves"
            selection.remark(Notice("warning", "mass-on-support", words))
    return joined_masses(found)
