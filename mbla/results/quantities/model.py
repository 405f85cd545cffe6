"""The model beside its blocks: title, units, joint laws, grounds, guides, fill."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.model.fill.fill import CarriedFill
from mbla.model.model import Ground, Joint, Model
from mbla.model.soil.soil_mesh import SoilMesh
from mbla.model.supports.guides import Guides
from mbla.results.quantities.group import Field, Group

MODEL = Group[Model](lambda scene: scene.model, file="model")
JOINTS = Group[list[Joint]](lambda scene: list(scene.model.joints.values()), file="model", rows="joint")
GROUNDS = Group[tuple[Ground, ...]](lambda scene: scene.model.grounds, file="model", rows="ground")
GUIDES = Group[Guides](
    lambda scene: scene.model.guides if len(scene.model.guides) else None, file="model", part="guides"
)
SOILS = Group[tuple[SoilMesh, ...]](lambda scene: scene.model.soils or None, file="model", rows="soil", part="soil")
SOIL = Group[tuple[SoilMesh, ...]](lambda scene: scene.model.soils or None, file="model", part="soil")
FILL = Group[CarriedFill](lambda scene: scene.model.fill, file="model", part="fill")

MODEL.fields(Model, title=Field("title of the deck"))


@MODEL.quantity(dims="unit")
def units(model: Model) -> list[str]:
    """Units of length, force, mass."""
    return [model.units.length, model.units.force, model.units.mass]


@MODEL.quantity(dims="load_case")
def load_cases(model: Model) -> list[str]:
    """Names of the load cases in the order of the deck."""
    return [case.name for case in model.load_cases]


JOINTS.fields(
    Joint,
    joint_names=Field("names of the joint laws", attribute="name"),
    friction=Field("friction coefficient"),
    cohesion=Field("cohesion", unit="stress"),
    tensile_strength=Field("tensile strength", unit="stress"),
    compressive_strength=Field("compressive strength, inf: unlimited", unit="stress", rule="open"),
    dilatancy=Field("tangent of the dilatancy angle"),
)
GROUNDS.fields(
    Ground,
    ground_labels=Field("ground planes and surfaces; body number = blocks + row", attribute="label"),
    ground_joints=Field("joint law on the plane", attribute="joint"),
)


@MODEL.quantity(dims="ground axis", unit="length")
def ground_points(model: Model) -> FloatArray:
    """A point on the plane."""
    return np.array([ground.point for ground in model.grounds], dtype=float).reshape(-1, 3)


@MODEL.quantity(dims="ground axis")
def ground_normals(model: Model) -> FloatArray:
    """Unit normal towards the structure."""
    return np.array([ground.normal for ground in model.grounds], dtype=float).reshape(-1, 3)


@MODEL.quantity(dims="ground")
def ground_selective(model: Model) -> list[bool]:
    """1 where the plane carries only the blocks listed."""
    return [ground.blocks is not None for ground in model.grounds]


@MODEL.quantity(dims="ground_bound", rule="start of ground_block")
def ground_start(model: Model) -> IntArray:
    """First listed block."""
    return starts(np.array([0 if g.blocks is None else len(g.blocks) for g in model.grounds], dtype=np.int64))


@MODEL.quantity(dims="ground_block", rule="index of block")
def ground_blocks(model: Model) -> IntArray:
    """Blocks that it may carry."""
    return joined(ground.blocks for ground in model.grounds if ground.blocks is not None)


def joined(rows: Iterable[IntArray]) -> IntArray:
    """Index arrays one after the other."""
    return np.concatenate([np.zeros(0, dtype=np.int64), *(np.asarray(row, dtype=np.int64) for row in rows)])


def _outlines(model: Model) -> list[FloatArray] | None:
    """Corners of each ground, none of a plane without an end; None where all are such."""
    if all(ground.outline is None for ground in model.grounds):
        return None
    return [np.zeros((0, 3)) if ground.outline is None else ground.outline for ground in model.grounds]


@MODEL.quantity(dims="ground_bound", rule="start of ground_corner", part="surfaces")
def ground_outline_start(model: Model) -> IntArray | None:
    """First corner of the outline; none of a plane without an end."""
    found = _outlines(model)
    return None if found is None else starts(np.array([len(outline) for outline in found], dtype=np.int64))


@MODEL.quantity(dims="ground_corner axis", unit="length", part="surfaces")
def ground_outlines(model: Model) -> FloatArray | None:
    """Corners of surfaces that end, counter-clockwise about the normal."""
    found = _outlines(model)
    return None if found is None else np.concatenate(found)


GUIDES.fields(
    Guides,
    guided_blocks=Field(
        "blocks that move in given ways only", "guided_block", rule="index of block", attribute="blocks"
    ),
    guided_bodies=Field("rigid body that each belongs to", "guided_block", attribute="bodies"),
    guide_motions=Field(
        "velocity and angular velocity in each way to move of its body; zero beyond",
        "guided_block component way",
        unit="motion",
        attribute="motions",
    ),
    guide_words=Field("guides in words", "guide", attribute="words"),
)
FILL.fields(
    CarriedFill,
    fill_masses=Field("mass of the fill on the block, part of added_masses", "block", unit="mass", attribute="masses"),
    fill_points=Field("centroid of that mass", "block axis", unit="length", attribute="points"),
    fill_words=Field("fills in words", "fill", attribute="words"),
)
SOILS.fields(
    SoilMesh,
    soil_names=Field("soils of cells, as their groups", attribute="name"),
    soil_sizes=Field("size that their cells are divided to", unit="length", attribute="size"),
    soil_moved=Field("1 where corners of cells were moved to where the soil slips", attribute="moved"),
)


@SOIL.quantity(dims="soil_bound", rule="start of soil_corner")
def soil_start(soils: tuple[SoilMesh, ...]) -> IntArray:
    """First corner of its cells."""
    return starts(np.array([len(soil.points) for soil in soils], dtype=np.int64))


@SOIL.quantity(dims="soil_corner plane", unit="length")
def soil_corners(soils: tuple[SoilMesh, ...]) -> FloatArray:
    """Corners of cells in the plane of the soil, level and up."""
    return np.concatenate([soil.points for soil in soils])
