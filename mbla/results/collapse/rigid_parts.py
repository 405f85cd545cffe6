"""Rigid parts of a mechanism: blocks that move together, and how each part moves.

Two blocks belong to one part where they are glued, or touch and hardly move against each other, measured by the fastest
contact (:func:`mbla.results.collapse.interface_modes.moves_together`). Supports and blocks at rest form part 0; the
others are numbered from the heaviest on. A part moves as one rigid body, v + ω × (x − c): it turns about an axis, or,
where the rotation over its own size is small against the travel, it moves along a direction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.assembly.lift import motions_of_bodies
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.measures import connected_labels
from mbla.results.collapse.interface_modes import TOGETHER, fastest_tie, moves_together
from mbla.solution.verification.statics import contact_velocities

TURNS = 0.01
"""rotation times the radius of a part over its travel from which it is said to turn: below, its axis lies a hundred
times its size away"""
GLOBAL, LOCAL = 0.5, 0.1
"""shares of the weight of the free blocks that move from which, and up to which, a mechanism is global or local"""


@dataclass(frozen=True)
class PartMotion:
    """A part that moves.

    number      : from 1, the heaviest first
    blocks      : (n,) in order
    weight      : under standard gravity, in the deck's unit
    centroid    : (3,) m, of its volume
    velocity    : (3,) there, scaled as the mechanism
    rotation    : (3,) angular velocity
    turns       : about an axis; else it moves along a direction
    axis_point  : (3,) m, the point of the axis nearest to the centroid; nan where it does not turn
    direction   : (3,) unit, of the axis by the right hand, or of the travel
    """

    number: int
    blocks: IntArray
    weight: float
    centroid: FloatArray
    velocity: FloatArray
    rotation: FloatArray
    turns: bool
    axis_point: FloatArray
    direction: FloatArray


def rigid_parts(model: Model, bodies: RigidBodies, motion: FloatArray, together: float = TOGETHER) -> IntArray:
    """Number of the part of each block, (n_blocks,), 0 at rest, from a motion, (n_blocks, 6).

    bodies   : that glue makes of its blocks
    together : share of the largest speed up to which blocks move as one
    """
    fastest, of_bodies = fastest_tie(model, motion), motions_of_bodies(bodies, motion)
    return _parts_of_bodies(bodies.model, bodies.contacts, of_bodies, together, fastest)[bodies.label]


def _parts_of_bodies(model: Model, contacts: Contacts, motion: FloatArray, together: float, fastest: float) -> IntArray:
    n_blocks, velocities = len(model.blocks), contact_velocities(model, contacts, motion)
    blocks = np.where(resting_blocks(model, motion, together), n_blocks, np.arange(n_blocks))  # what rests is one node
    node = np.append(blocks, np.full(len(model.grounds), n_blocks))
    pairs = node[contacts.bodies[moves_together(contacts, velocities, together, fastest)]]
    label = connected_labels(pairs, n_blocks + 1)
    return numbered(model, label[blocks], int(label[n_blocks]))


ONE_TWIST = 1e-6
"""share of the mean speed, by weight, up to which the motion of a block is that of its part: a load factor of the parts
as blocks is off by as much at most, as powers go by weight; what solvers leave to rounding is often half of it"""
LEAST_TOGETHER = 1e-10
"""of the largest speed, below which all is rounding"""


def parts_of_one_twist(model: Model, bodies: RigidBodies, motion: FloatArray) -> IntArray:
    """Rigid parts, (n_blocks,), so fine that each moves by one twist, from a motion, (n_blocks, 6).

    Contacts that hardly move add up along a part: one that its common twist does not reproduce is divided where its
    contacts move ten times less, and so on.
    """
    free, together = model.free, TOGETHER
    parts = rigid_parts(model, bodies, motion)
    if not len(free):
        return parts
    mean = float(np.average(block_speeds(model, motion)[free], weights=model.blocks.masses[free]))
    while together > LEAST_TOGETHER:
        left = motion.copy()
        for part in part_motions(model, parts, motion):
            arms = model.blocks.centroids[part.blocks] - part.centroid
            left[part.blocks, :3] -= part.velocity + np.cross(part.rotation, arms)
            left[part.blocks, 3:] -= part.rotation
        differs = ~model.fixed & (block_speeds(model, left) > ONE_TWIST * mean)
        divided = np.isin(parts, parts[differs])
        if not divided.any():
            break
        together /= 10.0
        finer = rigid_parts(model, bodies, motion, together)
        parts = numbered(model, np.where(divided & (finer > 0), len(parts) + finer, parts), 0)
    return parts


def numbered(model: Model, label: IntArray, at_rest: int) -> IntArray:
    """Parts, (n_blocks,), numbered by falling weight, then by their first block; 0 at rest, whether any is or not."""
    labels, first, row = np.unique(label, return_index=True, return_inverse=True)
    weights = np.bincount(row, weights=model.blocks.masses, minlength=len(labels))
    rests = labels == at_rest
    largest = float(weights.max(initial=0.0)) or 1.0
    order = np.lexsort((first, -np.round(weights / largest, 9), ~rests))  # equal ones differ by rounding
    number = np.empty(len(labels), dtype=np.int64)
    number[order] = np.arange(len(labels)) + (0 if rests.any() else 1)
    return np.asarray(number[row], dtype=np.int64)


def block_speeds(model: Model, motion: FloatArray) -> FloatArray:
    """Speed of each block, rotations with half the block size as arm, (n_blocks,)."""
    return np.asarray(
        np.linalg.norm(motion[:, :3], axis=1) + np.linalg.norm(motion[:, 3:], axis=1) * model.blocks.sizes / 2
    )


def resting_blocks(model: Model, motion: FloatArray, together: float = TOGETHER) -> BoolArray:
    """Blocks that do not move, measured by the fastest, (n_blocks,)."""
    speeds = block_speeds(model, motion)
    return np.asarray(model.fixed | (speeds <= together * speeds.max(initial=0.0)))


def part_motions(model: Model, parts: IntArray, motion: FloatArray) -> tuple[PartMotion, ...]:
    """How each part that moves does it, the heaviest first: the mean by volume of the motions of its blocks.

    parts  : (n_blocks,) part of each block, 0 at rest
    motion : (n_blocks, 6) velocity and angular velocity about the centroid
    """
    count = int(parts.max(initial=0)) + 1
    blocks = model.blocks
    volume = _sums(parts, blocks.volumes, count)
    centroid = _sums(parts, blocks.volumes[:, None] * blocks.centroids, count) / volume[:, None]
    rotation = _sums(parts, blocks.volumes[:, None] * motion[:, 3:], count) / volume[:, None]
    arms = centroid[parts] - blocks.centroids
    there = motion[:, :3] + np.cross(motion[:, 3:], arms)
    velocity = _sums(parts, blocks.volumes[:, None] * there, count) / volume[:, None]
    radius = np.zeros(count)
    np.maximum.at(radius, parts, np.linalg.norm(arms, axis=1) + blocks.sizes / 2)
    weight = _sums(parts, model.weights, count)
    members = np.split(np.argsort(parts, kind="stable"), np.cumsum(np.bincount(parts, minlength=count))[:-1])
    turns, arms, directions = _axes(radius, velocity, rotation)
    return tuple(
        PartMotion(
            i,
            members[i],
            float(weight[i]),
            centroid[i],
            velocity[i],
            rotation[i],
            bool(turns[i]),
            centroid[i] + arms[i],
            directions[i],
        )
        for i in range(1, count)
    )


def _sums(parts: IntArray, values: FloatArray, count: int) -> FloatArray:
    """Sum over the blocks of each part; an empty part counts as one block of volume 1, to divide by."""
    total = summed(parts, values, count)
    return np.where((np.bincount(parts, minlength=count) == 0).reshape(-1, *[1] * (values.ndim - 1)), 1.0, total)


def _axes(radius: FloatArray, velocity: FloatArray, rotation: FloatArray) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Axes or directions of rigid motions, velocity + rotation × (x − centroid), of parts of a radius.

    Returns whether each turns, (n,), the arm from its centroid to the axis, (n, 3), nan where it does not, and the
    direction, (n, 3).
    """
    spin, travel = np.linalg.norm(rotation, axis=1)[:, None], np.linalg.norm(velocity, axis=1)[:, None]
    turns = spin * radius[:, None] > TURNS * travel
    with np.errstate(divide="ignore", invalid="ignore"):
        arms = np.where(turns, np.cross(rotation, velocity) / spin**2, np.nan)
        directions = np.where(turns, rotation / spin, velocity / np.where(travel > 0, travel, 1.0))
    return turns[:, 0], arms, directions


def moving_blocks(model: Model, parts: IntArray) -> int:
    """How many free blocks move, from the part of each, (n_blocks,); cells of soil are none."""
    return int(np.sum(~model.fixed & (parts > 0) & (model.soil_of_block < 0)))


def moving_cells(model: Model, parts: IntArray) -> int:
    """How many cells of soil do."""
    return int(np.sum(~model.fixed & (parts > 0) & (model.soil_of_block >= 0)))


def moving_share(model: Model, parts: IntArray) -> float:
    """Share of the weight of the free blocks that moves, 0 to 1; of their number where they weigh nothing.

    parts : (n_blocks,) part of each block, 0 at rest
    """
    free = ~model.fixed
    sizes = model.blocks.masses if model.blocks.masses[free].any() else np.ones(len(model.blocks))
    total = float(sizes[free].sum())
    return float(sizes[free & (parts > 0)].sum()) / total if total > 0 else 0.0


def reach(share: float) -> str:
    """``local``, ``partial`` or ``global``, by the share of the weight of the free blocks that moves."""
    return "global" if share >= GLOBAL else "local" if share <= LOCAL else "partial"
