"""What the items of a deck generate, put together: polyhedra, names, densities, supports; and their faults in words."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.deck.deck import Deck
from mbla.deck.kinds.positions import COPY
from mbla.deck.sections.blocks import BlockItem
from mbla.deck.sections.materials import Material
from mbla.deck.units import Units
from mbla.errors import DeckError, Fault, Finding, KeyPath, Message, Notice
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart, ItemRefused
from mbla.model.geometry.sheets import sheets
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks, join_labels, labels_of
from mbla.model.solids.build import Labels
from mbla.model.solids.defects import Defect
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, take_polyhedra
from mbla.model.solids.surface import GroundSurface
from mbla.model.transform import build_transform, copies_of, repetitions, transform_item

MOST = 2_000_000
"""units, or facets of round blocks, that all items together may make, some GB of memory: an error in the units of
length asks for far more than is meant"""


@dataclass(frozen=True)
class CollectedItems:
    """Everything that the items of a deck give, in their order.

    labels  : names, densities and strengths of the blocks
    items   : (n_blocks,) which item of the deck each belongs to
    fixed   : (n_blocks,) blocks that items bring along as supports
    grounds : planes that items bring along, under blocks of their own
    surfaces : surfaces that support, those of each copy of an item together: its key path, its joint law, and they
    partial : groups of items that could not be built
    """

    polyhedra: Polyhedra
    labels: Labels
    items: IntArray
    fixed: BoolArray
    grounds: tuple[Ground, ...]
    surfaces: tuple[tuple[KeyPath, str, tuple[GroundSurface, ...]], ...]
    notices: tuple[Notice, ...]
    partial: frozenset[str]


def collect_items(deck: Deck, faults: list[Fault]) -> CollectedItems:
    """Raw polyhedra of all items with what they bring along.

    Adds to ``faults``: items that cannot be built; their groups are partial.

    Raises DeckError with all faults, where no item can be built; where all of them together make too much.
    """
    _refuse_amounts(deck)
    parts: list[ItemPart] = []
    numbers: list[int] = []
    grounds: list[Ground] = []
    surfaces: list[tuple[KeyPath, str, tuple[GroundSurface, ...]]] = []
    notices: list[Notice] = []
    partial: set[str] = set()
    for number, block_item in enumerate(deck.content.blocks):
        kind, item = block_item.facts, block_item.item
        path: KeyPath = ("blocks", number, kind.name)
        group = item.group or kind.name
        n_blocks = sum(len(part.polyhedra) for part in parts)
        try:
            copies = _copies(deck, block_item, path, n_blocks)
        except (ItemRefused, DeckError) as refused:
            if isinstance(refused, DeckError):
                faults += refused.faults
            else:
                faults += [deck.fault_at(*finding.below(*path)) for finding in refused.findings]
            partial |= {group, *(group + side.suffix for side in kind.groups)}
            continue
        notices += copies[0].notices
        for own in copies:
            for each in own.grounds:
                joint = each.joint or deck.contacts.joint
                grounds.append(Ground(each.point, each.normal, joint, n_blocks + each.blocks, "ground"))
            if own.surfaces:
                law = getattr(item, "joint", None) or deck.contacts.joint
                surfaces.append((path, law, own.surfaces))
            parts += [replace(part, suffix=group + part.suffix) for part in own.parts]
            numbers += [number] * len(own.parts)
            n_blocks += sum(len(part.polyhedra) for part in own.parts)
    if not parts and faults:
        raise DeckError(faults)
    labels = _labels(deck, parts)
    counts = [len(part.polyhedra) for part in parts]
    return CollectedItems(
        polyhedra=join_polyhedra([part.polyhedra for part in parts]),
        labels=labels,
        items=np.repeat(np.array(numbers, dtype=np.int64), counts),
        fixed=np.repeat(np.array([part.fixed for part in parts], dtype=bool), counts),
        grounds=tuple(_named(ground, labels) for ground in grounds),
        surfaces=tuple(surfaces),
        notices=tuple(notices),
        partial=frozenset(partial),
    )


def _copies(deck: Deck, block_item: BlockItem, path: KeyPath, n_blocks: int) -> list[Generated]:
    """What an item and its copies make, in the coordinates of the deck; ``n_blocks`` come before them."""
    generated, item = _generate(deck, block_item, path), block_item.item
    onwards = repetitions(item.repeat)
    made = n_blocks + len(onwards) * sum(len(part.polyhedra) for part in generated.parts)
    if made > MOST:
        raise ItemRefused(Finding("too-many-units", f"makes {too_many(made)}"))
    copies = []
    for copy, transform in enumerate(onwards):
        own, parts = transform_item(generated, transform) if copy else generated, []
        for part in own.parts:
            labels = dict(part.labels)
            if len(onwards) > 1:
                labels[COPY.name] = np.full(len(part.polyhedra), copy)
            parts.append(replace(part, material=part.material or item.material, labels=labels))
        copies.append(replace(own, parts=tuple(parts)))
    return copies


def _labels(deck: Deck, parts: Sequence[ItemPart]) -> Labels:
    """Names, densities and strengths of the blocks of parts, whose suffix is the name of their group in full."""
    materials = deck.content.materials
    densities = {name: density_of(material, deck.units) for name, material in materials.items()}
    strengths = {name: strengths_of(material) for name, material in materials.items()}
    counts = [len(part.polyhedra) for part in parts]
    given = any(np.isfinite(pair).any() for pair in strengths.values())
    return Labels(
        tuple(np.repeat(np.array([part.suffix for part in parts], dtype=object), counts).tolist()),
        np.repeat([densities[part.material or ""] for part in parts], counts),
        join_labels([labels_of(len(part.polyhedra), part.member, part.labels) for part in parts]),
        np.repeat([strengths[part.material or ""] for part in parts], counts, axis=0) if given else None,
    )


def strengths_of(material: Material) -> tuple[float, float]:
    """Tensile and compressive strength, infinite where none is given."""
    tensile, compressive = (
        math.inf if strength is None else strength
        for strength in (material.tensile_strength, material.compressive_strength)
    )
    return tensile, compressive


def density_of(material: Material, units: Units) -> float:
    """Mass per volume; a unit weight is one under standard gravity."""
    if material.density is not None:
        return material.density
    assert material.unit_weight is not None  # a rule of the deck: one of density and unit weight
    return material.unit_weight / (units.standard_gravity * units.force_per_mass_acceleration)


def _generate(deck: Deck, block_item: BlockItem, path: KeyPath) -> Generated:
    """An item in the coordinates of the deck."""
    item = block_item.item
    context = ItemContext(
        deck.contacts.tolerance, lambda below, name: deck.resolve_file((*path, *below), name), deck.units.length
    )
    with np.errstate(over="ignore", invalid="ignore"):  # coordinates that are not finite are refused by block
        kind = block_item.facts
        generated = kind.generate(item, context)
        given = {name for part in generated.parts for name in part.labels}
        assert given <= {position.name for position in kind.positions}, f"{kind.name} gives {given}"
        transform = build_transform(item.transform)
        return generated if transform is None else transform_item(generated, transform)


def _refuse_amounts(deck: Deck) -> None:
    """DeckError where items make more than can be handled, each or together, before any of them is made."""
    faults, together = [], 0.0
    for number, block_item in enumerate(deck.content.blocks):
        units, key = block_item.facts.amount(block_item.item)
        units *= min(copies_of(block_item.item.repeat), 10 * MOST)
        if units > MOST:
            path: KeyPath = ("blocks", number, block_item.kind, *((key,) if key else ()))
            faults.append(deck.fault_at(path, Message("too-many-units", f"makes {too_many(units)}")))
        else:
            together += units
    if together > MOST:
        faults.append(deck.fault_at(("blocks",), Message("too-many-units", f"the items make {too_many(together)}")))
    if faults:
        raise DeckError(faults)


def too_many(units: float) -> str:
    """Message on an item, or all of them, that makes more than can be handled."""
    return f"about {min(units, 1e300):.0e} units; at most {MOST:,} can be handled"


def _named(ground: Ground, labels: Labels) -> Ground:
    """``ground under arch[0]``, ``ground under dome[0] and 7 more``."""
    assert ground.blocks is not None  # an item's ground carries blocks of its own
    more = f" and {len(ground.blocks) - 1} more" if len(ground.blocks) > 1 else ""
    return replace(ground, label=f"ground under {labels.name(int(ground.blocks[0]))}{more}")


MOST_FAULTS_PER_ITEM = 10
"""defects of blocks of one item that are reported one by one; a mesh in the wrong format has one in every block"""


def defects_in_words(deck: Deck, defects: Sequence[Defect], item_of_block: IntArray, blocks: Blocks) -> list[Fault]:
    """A fault for each defect; many of one item are counted only.

    item_of_block : (n_blocks,) item of the deck that each block comes from
    """
    faults = []
    counts: Counter[int] = Counter()
    for defect in _flat_faces(deck, defects, item_of_block, blocks):
        number = int(item_of_block[defect.block])
        counts[number] += 1
        if counts[number] <= MOST_FAULTS_PER_ITEM:
            path = _path(deck, defect.face, number)
            faults.append(
                deck.fault_at(
                    path, defect.message.around(before=f"block {_called(deck, blocks, defect.block, number)}: ")
                )
            )
    for number, count in counts.items():
        if count > MOST_FAULTS_PER_ITEM:
            message = f"{count - MOST_FAULTS_PER_ITEM} more blocks of this item are refused"
            faults.append(deck.fault_at(_path(deck, None, number), Message("more-faults", message)))
    return faults


def _flat_faces(deck: Deck, defects: Sequence[Defect], item_of_block: IntArray, blocks: Blocks) -> list[Defect]:
    """The same defects, of blocks from files that are one flat face with what to do; of several once for each item."""
    flat: dict[int, list[Defect]] = {}
    others = []
    for defect in defects:
        number = int(item_of_block[defect.block])
        from_file = deck.content.blocks[number].facts.files
        if from_file and sheets(take_polyhedra(blocks, np.array([defect.block])))[1][0]:
            flat.setdefault(number, []).append(defect)
        else:
            others.append(defect)
    for number, found in flat.items():
        remedy_for = deck.content.blocks[number].facts.flat_face
        assert remedy_for is not None  # of kinds with files
        remedy = remedy_for(blocks.labels.members[found[0].block], len(found) > 1)
        several = f", and so are {len(found) - 1} more" if len(found) > 1 else ""
        others.append(Defect(found[0].block, Message("flat-face", f"is a flat face, no block{several}: {remedy}")))
    return sorted(others, key=lambda defect: defect.block)


def _called(deck: Deck, blocks: Blocks, block: int, number: int) -> str:
    """Name of a block, with its name in a geometry file: ``vault[17] (key_stone)``."""
    member = blocks.labels.members[block] if deck.content.blocks[number].facts.files else ""
    return f"{blocks.name(block)}{f' ({member})' if member else ''}"


def _path(deck: Deck, face: int | None, number: int) -> KeyPath:
    """Where a defect of a block of an item, or of a face of it, is told."""
    kind = deck.content.blocks[number].facts
    return ("blocks", number, kind.name, *kind.place(face))
