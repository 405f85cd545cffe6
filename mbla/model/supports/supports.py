"""All supports of a deck: ground planes, blocks that do not move, blocks that move in given ways only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.deck.deck import Deck
from mbla.deck.sections.contacts import ContactsSection
from mbla.deck.sections.supports import Plane, Surface
from mbla.errors import DeckError, Finding, KeyPath
from mbla.model.blocks.files.members import placed_vertices, read_members, surfaces_of_sheets
from mbla.model.blocks.generated import ItemRefused
from mbla.model.geometry.sheets import sheets
from mbla.model.model import Ground
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.soil.names import is_cell, named_with_soil
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.solids.ragged import row_maxima
from mbla.model.solids.surface import GroundSurface
from mbla.model.supports.guides import NO_GUIDES, Guides, guides_of, is_guide, joined
from mbla.model.supports.surfaces import (
    FACING,
    Carried,
    allowed_blocks,
    grounds_of_surfaces,
    surface_of_polygon,
    touching_only,
)
from mbla.model.wording import named, vector


@dataclass(frozen=True)
class Supports:
    """What holds the structure.

    fixed   : (n_blocks,) blocks that do not move
    grounds : in the order of the deck, those of arches first
    guides  : blocks that move in given ways only
    """

    fixed: BoolArray
    grounds: tuple[Ground, ...]
    guides: Guides = NO_GUIDES


def build_supports(
    deck: Deck,
    brought_along: Supports,
    surfaces: Sequence[tuple[KeyPath, str, Sequence[GroundSurface]]],
    selection: BlockSelection,
) -> Supports:
    """Supports of the deck, with those that items bring along.

    brought_along : fixed blocks and grounds of items, such as the springers of arches
    surfaces      : of items, with the key path and the joint law of each item

    Refuses grounds with blocks below them or without a face on them, blocks held in two ways, structures
    without support, and structures in which nothing can move.
    """
    fixed = brought_along.fixed.copy()
    grounds: list[tuple[KeyPath, Ground]] = []
    guides: list[tuple[KeyPath, Guides]] = []
    sheets: list[tuple[KeyPath, str, Sequence[GroundSurface], IntArray | None]] = [(*each, None) for each in surfaces]
    complete = not selection.partial
    for number, support in enumerate(deck.content.supports):
        path: KeyPath = ("supports", number)
        chosen = None
        if support.blocks is not None:
            chosen = select_blocks(support.blocks, (*path, "blocks"), selection)
            if chosen is None:
                complete = False
                continue
        joint = support.joint or deck.contacts.joint
        if support.surface is not None:
            found = _surfaces_of(support.surface, (*path, "surface"), deck, selection)
            complete &= bool(found)
            sheets.append(((*path, "surface"), joint, found, chosen))
        elif support.ground is not None:
            point, normal, place = plane_of(support.ground)
            label = f"ground {place or f'at {vector(point)} with normal {vector(normal)}'}"
            grounds.append(((*path, "ground"), Ground(point, normal, joint, chosen, label)))
        elif chosen is not None and is_guide(support):
            guides.append((path, guides_of(support, chosen, selection.blocks)))
        else:
            fixed[chosen] = True
    everything_guided = _joined_guides(guides, fixed, selection)
    for path, ground in grounds:
        check_ground(ground, path, fixed, selection, deck.contacts)
    flat = []
    for path, joint, own, chosen in sheets:
        carried = Carried(selection.blocks, allowed_blocks(selection, fixed, chosen), deck.contacts)
        flat += grounds_of_surfaces(own, path, joint, chosen, carried, selection)
    supports = Supports(fixed, (*brought_along.grounds, *(ground for _, ground in grounds), *flat), everything_guided)
    if complete and (flat or not sheets):
        _check_hold(supports, selection)
    return supports


def _check_hold(supports: Supports, selection: BlockSelection) -> None:
    """Something holds the structure, and something can move."""
    if not supports.fixed.any() and not supports.grounds and not len(supports.guides):
        selection.refuse(Finding("no-support", "nothing holds the structure: give ground or fixed blocks", "supports"))
    if supports.fixed.all():
        selection.refuse(Finding("nothing-can-move", "every block is fixed: nothing can move", "supports"))


def _joined_guides(guides: Sequence[tuple[KeyPath, Guides]], fixed: BoolArray, selection: BlockSelection) -> Guides:
    """All guides; a block that is fixed as well, or guided twice, is a fault of the later item."""
    result, held = NO_GUIDES, np.zeros_like(fixed)
    for path, own in guides:
        for other, words in ((fixed, "fixed by another item of supports"), (held, "guided by an earlier item")):
            twice: IntArray = own.blocks[other[own.blocks]]
            if len(twice):
                message = f"{words}: {named(twice, selection.blocks.name)}; say how a block is held in one item"
                selection.refuse(Finding("support-held-twice", message, *path, "blocks"))
        held[own.blocks] = True
        result = joined(result, own)
    return result


UNMOVED = 1e-12
"""work of the live loads in the ways of a guide, relative to the loads, at which they move nothing"""


def does_nothing(load: FloatArray, supports: Supports) -> bool:
    """Whether a load, (n_blocks, 6), acts on guided and fixed blocks alone, and does no work in any of their ways."""
    guides = supports.guides
    elsewhere = ~supports.fixed
    elsewhere[guides.blocks] = False
    if np.any(load[elsewhere]) or not len(guides) or not np.any(load[guides.blocks]):
        return False
    own = load[guides.blocks]
    each = np.einsum("mij,mi->mj", guides.motions, own), np.einsum("mij,mi->mj", np.abs(guides.motions), np.abs(own))
    work, gross = (summed(guides.bodies, values, guides.n_bodies) for values in each)
    return bool(np.all(np.abs(work) <= UNMOVED * gross))


def plane_of(section: Plane) -> tuple[FloatArray, FloatArray, str]:
    """Point (3,) and unit normal (3,) of a plane, and ``z = 0``; nothing for one by point and normal."""
    for axis, key in enumerate("xyz"):
        coordinate = getattr(section, key)
        if coordinate is not None:
            normal = np.eye(3)[axis]
            return coordinate * normal, normal, f"{key} = {coordinate:g}"
    assert section.point is not None and section.normal is not None  # noqa: PT018 - one rule of the deck
    return np.array(section.point), unit(section.normal), ""


def check_ground(
    ground: Ground, path: KeyPath, fixed: BoolArray, selection: BlockSelection, contacts: ContactsSection
) -> None:
    """Blocks it may carry must not reach below it, and one of their faces must lie on it.

    fixed    : (n_blocks,) blocks that cannot move
    contacts : with the tolerances
    """
    blocks = selection.blocks
    may_carry = allowed_blocks(selection, fixed, ground.blocks)
    heights = (blocks.vertices - ground.point) @ ground.normal
    depths = row_maxima(-heights, blocks.vertex_start)
    sunk = np.flatnonzero(may_carry & (depths > contacts.depth_allowed * blocks.sizes))
    if len(sunk):
        kind = "blocks or soil" if is_cell(blocks)[sunk].any() else "blocks"
        words = (
            f"{kind} reach below it, by up to {depths[sunk].max():.4g}: {named_with_soil(sunk, blocks)}; move the "
            "plane, or list the blocks that stand on it under the key blocks"
        )
        selection.refuse(Finding("ground-misplaced", words, *path))
    elif not _faces_on(ground, heights, may_carry, blocks, contacts) and not selection.partial:
        lowest = -depths[may_carry].max() if may_carry.any() else np.nan
        touching = touching_only(ground.point, ground.normal, Carried(blocks, may_carry, contacts))
        soil = bool(is_cell(blocks)[may_carry].all() and may_carry.any())
        carried, which = ("the soil", "it") if soil else ("a block that can move", "the nearest block")
        nearest = touching or (f"; {which} begins {lowest:.4g} above it" if lowest > 0 else "")
        selection.refuse(Finding("ground-misplaced", f"no face of {carried} lies on it{nearest}", *path))


def _faces_on(
    ground: Ground, heights: FloatArray, may_carry: BoolArray, blocks: Blocks, contacts: ContactsSection
) -> bool:
    """Whether a face of one of the blocks lies on the ground, looking down at it."""
    size = blocks.sizes[blocks.block_of_face]
    above, below = (row_maxima(sign * heights[blocks.loops], blocks.loop_start) for sign in (1.0, -1.0))
    near = (above <= contacts.tolerance * size) & (below <= contacts.depth_allowed * size)
    facing = blocks.face_normals @ ground.normal < -FACING
    return bool((facing & near & may_carry[blocks.block_of_face]).any())


def _surfaces_of(section: Surface, path: KeyPath, deck: Deck, selection: BlockSelection) -> tuple[GroundSurface, ...]:
    """The surfaces that an item of `supports` describes; faults go to the selection, and then there is none."""
    tolerance = deck.contacts.tolerance
    if section.polygon is not None:
        found = surface_of_polygon(section.polygon, (*path, "polygon"), tolerance)
        if isinstance(found, GroundSurface):
            return (found,)
        selection.refuse(found)
        return ()
    assert section.file is not None  # a rule of the deck: one of polygon and file
    try:
        geometry = read_members(deck.resolve_file((*path, "file"), section.file), section)
        if geometry.planar or geometry.cells:
            kind = "outlines" if geometry.planar else "volume cells"
            raise ItemRefused(Finding("surface-unfit", f"holds {kind}, no surfaces", "file"))
        placed = placed_vertices(geometry, section, deck.units.length)
        geometry = replace(geometry, polyhedra=replace(geometry.polyhedra, vertices=placed))
        closed = np.flatnonzero(~sheets(geometry.polyhedra)[0])
        if len(closed):
            name = geometry.names[closed[0]] if geometry.names else "what it holds"
            words = f"{name} is a closed solid, no surface: name the surfaces with members, or fix a block"
            raise ItemRefused(Finding("surface-unfit", words, "file"))
        return surfaces_of_sheets(geometry, "file", tolerance)
    except ItemRefused as refused:
        for finding in refused.findings:
            selection.refuse(finding.below(*path))
    except DeckError as error:
        selection.faults.extend(fault for fault in error.faults if fault not in selection.faults)
    return ()
