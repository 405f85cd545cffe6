"""Blocks: geometry, masses, loads, and how each moves."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import BlockLabels, Blocks
from mbla.results.demand.demand import Demand, demand_of
from mbla.results.demand.demand import strength_use as strengths_used
from mbla.results.quantities.answers import OWN, claimed_collapse
from mbla.results.quantities.group import Field, Group
from mbla.results.quantities.points import declare_figures
from mbla.results.record.scene import Scene, Values, as_text

SCENE = Group[Scene](lambda scene: scene, table="blocks")
MODEL = Group[Model](lambda scene: scene.model, file="model", table="blocks")
BLOCKS = Group[Blocks](lambda scene: scene.model.blocks, file="model", table="blocks")
LABELS = Group[BlockLabels](lambda scene: scene.model.blocks.labels, file="model", table="blocks")


def names_of(texts: tuple[str, ...]) -> list[str]:
    """Names in the order of their numbers, as the result file has them."""
    return sorted(set(texts))


def numbers_of(texts: tuple[str, ...]) -> IntArray:
    """The number of each item's name."""
    row = {name: number for number, name in enumerate(names_of(texts))}
    return np.array([row[name] for name in texts], dtype=np.int64)


def _group_names(scene: Scene) -> list[str]:
    return names_of(scene.model.blocks.groups)


def _member_names(scene: Scene) -> list[str]:
    return names_of(scene.model.blocks.labels.members)


BLOCKS.fields(
    Blocks,
    vertices=Field("corners of the blocks; blocks share none", "vertex axis", unit="length"),
    vertex_start=Field("first vertex of each block", "block_bound", rule="start of vertex"),
    loops=Field(
        "vertex at each corner of each face, counter-clockwise seen from outside", "corner", rule="index of vertex"
    ),
    loop_start=Field("first corner of each face", "face_bound", rule="start of corner"),
    face_start=Field("first face of each block", "block_bound", rule="start of face"),
    facet_of_face=Field("faces of one block in one plane carry one number", "face"),
    face_normals=Field("unit normal, outwards", "face axis"),
    convex=Field("1 where the block is convex", "block"),
    added_mass_points=Field("centroid of that mass", "block axis", unit="length"),
)


@SCENE.quantity("table blocks frames", dims="block")
def block(scene: Scene) -> IntArray:
    """Number of the block, from 0."""
    return np.arange(len(scene.model.blocks))


@SCENE.quantity("table", dims="block")
def block_name(scene: Scene) -> Values:
    """Group and index, as selectors write it."""
    return as_text([scene.model.blocks.name(block) for block in range(len(scene.model.blocks))])


@BLOCKS.quantity(dims="group")
def group_names(blocks: Blocks) -> list[str]:
    """Names of the groups of blocks, sorted."""
    return names_of(blocks.groups)


@BLOCKS.quantity("table blocks frames", dims="block", rule="index of group", names=_group_names)
def groups(blocks: Blocks) -> IntArray:
    """Group, as row of group_names."""
    return numbers_of(blocks.groups)


BLOCKS.fields(Blocks, group_indices=Field("position of the block in its group", "block", files="table"))


@LABELS.quantity(dims="member")
def member_names(labels: BlockLabels) -> list[str]:
    """Names of the parts of composite items, sorted."""
    return names_of(labels.members)


@LABELS.quantity("table blocks frames", dims="block", rule="index of member", names=_member_names)
def members(labels: BlockLabels) -> IntArray:
    """Part of a composite item."""
    return numbers_of(labels.members)


@LABELS.quantity(dims="position")
def position_names(_: BlockLabels) -> list[str]:
    """Names of the positions that items give their blocks."""
    return list(POSITIONS)


LABELS.fields(BlockLabels, positions=Field("course, voussoir and so on, from 0; -1: none", "block position"))


def _declare_position(name: str) -> None:
    def position(labels: BlockLabels) -> IntArray | None:
        numbers = np.ma.masked_equal(labels.position(name), -1)
        return None if np.ma.getmaskarray(numbers).all() else numbers

    position.__doc__ = f"number of the {name} in its item, from 0; none: empty, in meshes -1"
    group = Group[BlockLabels](lambda scene: scene.model.blocks.labels, table="blocks")
    group.quantity("table blocks frames", dims="block", name=name)(position)


for _name in POSITIONS:
    _declare_position(_name)

BLOCKS.fields(
    Blocks,
    centroids=Field("centroid", "block axis", unit="length", files="table"),
    volumes=Field("volume", "block", unit="volume", files="table"),
    densities=Field("mass per volume", "block", unit="density", files="table"),
    added_masses=Field("mass that the block carries along beside its own", "block", unit="mass", files="table"),
)


MODEL.fields(
    Model,
    weights=Field("weight under standard gravity, 9.81 m/s2", "block", unit="force", files="table blocks"),
    fixed=Field("1 where the block does not move", "block", files="table blocks frames"),
)


@SCENE.quantity("table blocks", dims="block")
def guided(scene: Scene) -> BoolArray:
    """1 where it moves in given ways only, as in a settling support."""
    return np.isin(np.arange(len(scene.model.blocks)), scene.model.guides.blocks)


@SCENE.quantity("table", dims="block")
def settles(scene: Scene) -> BoolArray:
    """1 where it belongs to the settling support."""
    count, load_case = len(scene.model.blocks), scene.load_case
    if load_case is None:
        return np.zeros(count, dtype=bool)
    return np.isin(np.arange(count), load_case.question.giving_way)


Group[Contacts](lambda scene: scene.contacts, file="contacts", table="blocks").fields(
    Contacts,
    solid_of_block=Field(
        "rigid body that the block is glued into, by first blocks; missing where none is glued",
        "block",
        part="glue",
        files="table",
    ),
)
Group[LoadCase](lambda scene: scene.load_case, file="cases/*", asked=True, table="blocks").fields(
    LoadCase,
    dead_load=Field("dead force and moment about the centroid", "block component", unit="load", files="table"),
    live_load=Field("live force and moment about the centroid", "block component", unit="load", files="table"),
)


declare_figures(SCENE, "table", "block", lambda scene: scene.model.blocks.volumes)


@SCENE.quantity("table", like=OWN["mechanism"])
def mechanism(scene: Scene) -> FloatArray | None:
    """Of the result or the best iterate."""
    return None if scene.mechanics is None else scene.mechanics.mechanism


def _claimed_parts(scene: Scene) -> IntArray | None:
    collapse = claimed_collapse(scene)
    return None if collapse is None else collapse.parts


PARTS = Group[IntArray](
    lambda scene: scene.parts if scene.case is None or scene.moves else None,
    claim=_claimed_parts,
    file="cases/*",
    table="blocks",
    part="mechanics",
)


@PARTS.quantity("table blocks frames", dims="block")
def parts(parts: IntArray) -> IntArray:
    """Rigid part of each block, 0 at rest, 1 the heaviest; follows from the mechanism."""
    return parts


def _claimed_demand(scene: Scene) -> Demand | None:
    mechanics = scene.solved.solution.mechanics
    return None if mechanics is None else demand_of(scene.assembly, scene.solved.load_case, mechanics)


Group[Demand](
    lambda scene: scene.demand,
    claim=_claimed_demand,
    file="cases/*/units",
    table="blocks",
    part="stress in units",
    files="table blocks",
).fields(
    Demand,
    bending_tension=Field(
        "greatest tension of the unit by bending, 0 without any; nan: fixed, guided, glued to others, or of soil",
        "block",
        unit="stress",
        rule="open",
        attribute="bending",
    ),
    splitting_tension=Field(
        "greatest tension across its struts, likewise", "block", unit="stress", rule="open", attribute="splitting"
    ),
    joint_pressure=Field(
        "greatest even pressure on its joints, likewise; of one that does not crush over a tenth of it at least",
        "block",
        unit="stress",
        rule="open",
        attribute="pressure",
    ),
)


@SCENE.quantity("table blocks", dims="block")
def strength_use(scene: Scene) -> FloatArray | None:
    """Greatest of these over the strength of the material; none where none is given."""
    return None if scene.demand is None else strengths_used(scene.assembly, scene.demand)


CERTIFICATE = Group[FloatArray](
    lambda scene: scene.certificate,
    claim=lambda scene: scene.solved.solution.certificate,
    file="cases/*",
    table="blocks",
    part="certificate",
)


@CERTIFICATE.quantity("table", dims="block component", unit="motion")
def certificate(certificate: FloatArray) -> FloatArray:
    """No equilibrium: motion in which the dead load does work and no joint resists."""
    return certificate


@SCENE.quantity("blocks", dims="block axis", unit="length")
def drawn_displacements(scene: Scene) -> FloatArray:
    """Displacement of the centroid as drawn."""
    return scene.motion[:, :3]


@SCENE.quantity("blocks", dims="block axis", unit="radian")
def drawn_rotations(scene: Scene) -> FloatArray:
    """Rotation vector as drawn."""
    return scene.motion[:, 3:]


@SCENE.quantity("blocks", dims="block")
def largest_eccentricity(scene: Scene) -> FloatArray | None:
    """Largest eccentricity of the resultants of the interfaces of the block."""
    return None if scene.thrust is None else _largest(scene, scene.thrust.eccentricity)


@SCENE.quantity("blocks", dims="block")
def largest_friction_use(scene: Scene) -> FloatArray | None:
    """Largest use of friction and cohesion by shear of the interfaces of the block."""
    return None if scene.thrust is None else _largest(scene, scene.thrust.friction_use)


@SCENE.quantity("blocks", dims="block")
def largest_torsion_use(scene: Scene) -> FloatArray | None:
    """Largest use of friction and cohesion by shear and torsion of the interfaces of the block."""
    return None if scene.torsion_use is None else _largest(scene, scene.torsion_use)


def _largest(scene: Scene, found: FloatArray) -> FloatArray:
    """Largest value over the interfaces of each block, (n_blocks,); nan where none has one."""
    largest = np.full(len(scene.model.blocks) + len(scene.model.grounds), -np.inf)
    known = ~np.isnan(found)
    for side in (0, 1):
        np.maximum.at(largest, scene.contacts.bodies[known, side], found[known])
    return np.where(np.isneginf(largest), np.nan, largest)[: len(scene.model.blocks)]
