"""Joints drawn as gaps: the blocks on both sides grow to the middle of the joint.

Facets that face each other across no more than the thickness of a joint are moved to one plane. Facets that are linked
by such pairs, as those along a bed joint, make one joint, whatever its bond: its plane lies midway between the farthest
of the one side and the farthest of the other, square to the mean of all normals; so the two sides of a wedge of mortar
meet in the plane that bisects it. Where some of these facets touch already, or a ground plane is one side, the other
side grows all the way. Free faces stay where they are.

The grown blocks have the density of their stone: the mortar weighs as much.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.errors import Message, Notice
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.facing_facets import OPPOSITE, FacetPlanes, FacingPairs, facet_planes, facing_pairs
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.moved_facets import moved_facets
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.wording import counted, named

UP_TO = 1e-6
"""relative: by so much more than the thickness a facet may grow, of rounding"""


@dataclass(frozen=True)
class ClosedJoints:
    """What was closed.

    polyhedra : the blocks as they are now, in their order
    joints    : number of pairs of faces that a gap lay between
    widest    : greatest gap, m
    grown     : (n,) blocks that are larger now
    """

    polyhedra: Polyhedra
    joints: int
    widest: float
    grown: IntArray


@dataclass(frozen=True)
class _Joints:
    """Planes of joints, and what lies along them.

    facets  : (n,) of blocks
    labels  : (n,) joint of each, from 0
    """

    facets: IntArray
    labels: IntArray


def close_joints(
    blocks: Blocks, grounds: Sequence[Ground], thickness: float, tolerance: float
) -> ClosedJoints | Message:
    """Blocks grown to the middle of the joints between them, or why they cannot be.

    thickness : m, greatest gap that is a joint
    tolerance : relative to block size, of gaps that are none
    """
    planes = facet_planes(blocks)
    pairs = facing_pairs(blocks, planes, thickness, tolerance)
    ground_of, gaps = _on_grounds(blocks, planes, grounds, thickness, tolerance)
    on_ground = np.flatnonzero(ground_of >= 0)
    size = blocks.sizes[planes.blocks]
    open_pairs = pairs.greatest > tolerance * np.minimum(*size[pairs.facets].T)
    open_grounds = gaps[on_ground] > tolerance * size[on_ground]
    joints = _joints(pairs, open_pairs, on_ground[open_grounds], ground_of, len(size))
    if (message := _swallowed_blocks(blocks, planes, joints, thickness)) is not None:
        return message
    targets = FacetPlanes(planes.points[joints.facets], planes.normals[joints.facets], planes.blocks[joints.facets])
    for label in range(int(joints.labels.max(initial=-1)) + 1):
        rows = np.flatnonzero(joints.labels == label)
        found = _plane(blocks, planes, joints.facets[rows], pairs, (grounds, ground_of), tolerance)
        if isinstance(found, Message):
            return found
        point, normal = found
        side = np.sign(planes.normals[joints.facets[rows]] @ normal)
        targets.points[rows], targets.normals[rows] = point, side[:, None] * normal
        message = _too_far(blocks, planes, joints.facets[rows], (point, normal), thickness, tolerance)
        if message is not None:
            return message
    moved = moved_facets(blocks, planes, joints.facets, targets, tolerance)
    if len(moved.swallowed):
        why = "so thick that it would swallow a block, of which an edge would be left of no length"
        return Message("block-swallowed", _about(blocks, moved.swallowed, why))
    if len(moved.split):
        why = "would move a face at a corner of more than three faces, which would be several corners then"
        return Message("joint-not-closed", _about(blocks, moved.split, why))
    widest = max(pairs.greatest[open_pairs].max(initial=0.0), gaps[on_ground[open_grounds]].max(initial=0.0))
    return ClosedJoints(
        polyhedra=Polyhedra(moved.vertices, blocks.vertex_start, blocks.loops, blocks.loop_start, blocks.face_start),
        joints=int(open_pairs.sum() + open_grounds.sum()),
        widest=float(widest),
        grown=np.unique(planes.blocks[joints.facets]),
    )


def joints_in_words(closed: ClosedJoints, before: Blocks, after: Blocks, thickness: float, unit: str) -> Notice:
    """How many joints were closed, and by how much the blocks grew; a warning where there were none."""
    if not closed.joints:
        words = f"no two faces face each other across a gap of up to {thickness:g} {unit}: no joint was closed"
        return Notice("warning", "no-joint-closed", words)
    more = float(after.volumes.sum() - before.volumes.sum())
    words = (
        f"{counted(closed.joints, 'pair')} of faces with a joint drawn between them, up to {closed.widest:.3g} {unit} "
        f"wide, moved to its middle: {counted(len(closed.grown), 'block')} grow by {more:.3g} {unit}3 in all, "
        f"{100 * more / float(before.volumes.sum()):.2g} % of the volume of all blocks, with the density of their "
        "material"
    )
    return Notice("notice", "joints-closed", words)


def _about(blocks: Blocks, which: IntArray, why: str) -> str:
    return f"{why}: {named(which, blocks.name)}"


def _on_grounds(
    blocks: Blocks, planes: FacetPlanes, grounds: Sequence[Ground], thickness: float, tolerance: float
) -> tuple[IntArray, FloatArray]:
    """The ground that each facet faces within the thickness, -1 for none, and its greatest height over it, m."""
    n = len(planes.blocks)
    ground_of, gaps = np.full(n, -1), np.zeros(n)
    for number, ground in enumerate(grounds):
        least, greatest = _heights(blocks, ground.point, ground.normal, n)
        faces = (planes.normals @ ground.normal < -OPPOSITE) & (least >= -tolerance * blocks.sizes[planes.blocks])
        faces &= (greatest <= thickness * (1 + 1e-9)) & (ground_of < 0)
        if ground.blocks is not None:
            faces &= np.isin(planes.blocks, ground.blocks)
        ground_of[faces], gaps[faces] = number, greatest[faces]
    return ground_of, gaps


def _heights(blocks: Blocks, point: FloatArray, normal: FloatArray, n_facets: int) -> tuple[FloatArray, FloatArray]:
    """Least and greatest height of the corners of each facet over a plane, (n_facets,) m."""
    height = (blocks.vertices[blocks.loops] - point) @ normal
    facet = blocks.facet_of_face[blocks.face_of_corner]
    least, greatest = np.full(n_facets, np.inf), np.full(n_facets, -np.inf)
    np.minimum.at(least, facet, height)
    np.maximum.at(greatest, facet, height)
    return least, greatest


def _joints(pairs: FacingPairs, open_pairs: BoolArray, open_grounds: IntArray, ground_of: IntArray, n: int) -> _Joints:
    """Facets linked by pairs, or by the ground that they face, of joints that are open somewhere."""
    n_grounds = int(ground_of.max(initial=-1)) + 1
    on_ground = np.flatnonzero(ground_of >= 0)
    links = np.vstack([pairs.facets, np.column_stack([on_ground, n + ground_of[on_ground]])])
    label = connected_labels(links, n + n_grounds)
    chosen = np.unique(np.concatenate([label[pairs.facets[open_pairs, 0]], label[open_grounds]]))
    facets = np.flatnonzero(np.isin(label[:n], chosen) & np.isin(np.arange(n), links))
    return _Joints(facets, np.unique(label[facets], return_inverse=True)[1].reshape(-1))


def _swallowed_blocks(blocks: Blocks, planes: FacetPlanes, joints: _Joints, thickness: float) -> Message | None:
    """Blocks that lie within a joint: two of their facets, opposite to each other, belong to it."""
    key = joints.labels * len(blocks) + planes.blocks[joints.facets]
    order = np.argsort(key, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(key[order])) + 1):
        normals = planes.normals[joints.facets[rows]]
        if len(rows) > 1 and (normals @ normals.T).min() < 0.0:
            which = planes.blocks[joints.facets[rows[:1]]]
            why = "so thick that it would swallow a block, which lies within one joint"
            return Message("block-swallowed", _about(blocks, which, why))
    return None


def _plane(
    blocks: Blocks,
    planes: FacetPlanes,
    facets: IntArray,
    pairs: FacingPairs,
    grounds: tuple[Sequence[Ground], IntArray],
    tolerance: float,
) -> tuple[FloatArray, FloatArray] | Message:
    """A point and the normal of the plane of one joint, or why there is none."""
    carried = facets[grounds[1][facets] >= 0]
    if len(carried):
        ground = grounds[0][int(grounds[1][carried[0]])]
        return ground.point, ground.normal
    own = np.flatnonzero(np.isin(pairs.facets[:, 0], facets))
    side = np.sign(planes.normals[facets] @ planes.normals[facets[0]])
    mean = planes.normals[facets[side > 0]].mean(axis=0) - planes.normals[facets[side < 0]].mean(axis=0)
    normal = mean / np.linalg.norm(mean)
    if np.abs(planes.normals[facets] @ normal).min() < OPPOSITE:
        return Message(
            "joint-not-closed", f"{_joint_of(blocks, planes, facets)} turns round a curve: no one plane lies in it"
        )
    below, above = -np.inf, np.inf
    for pair in own.tolist():
        for facet in pairs.facets[pair].tolist():
            lead = planes.normals[facet] @ (planes.points[facet] - pairs.middles[pair])
            height = float(normal @ pairs.middles[pair] + lead / (planes.normals[facet] @ normal))
            if planes.normals[facet] @ normal > 0.0:
                below = max(below, height)
            else:
                above = min(above, height)
    size = float(blocks.sizes[planes.blocks[facets]].min())
    if below > above + tolerance * size:
        words = f"{_joint_of(blocks, planes, facets)} goes up or down in steps: no one plane lies between its two sides"
        return Message("joint-not-closed", words)
    middle = pairs.middles[own[0]]
    return middle + ((below + above) / 2 - normal @ middle) * normal, normal


def _joint_of(blocks: Blocks, planes: FacetPlanes, facets: IntArray) -> str:
    which = np.unique(planes.blocks[facets])
    return f"the joint of {counted(len(which), 'block')} ({named(which, blocks.name)})"


def _too_far(
    blocks: Blocks,
    planes: FacetPlanes,
    facets: IntArray,
    plane: tuple[FloatArray, FloatArray],
    thickness: float,
    tolerance: float,
) -> Message | None:
    """A facet that would be moved by more than the thickness, or back into its block."""
    least, greatest = _heights(blocks, *plane, len(planes.blocks))
    ahead = planes.normals[facets] @ plane[1] > 0.0
    back = np.where(ahead, greatest[facets], -least[facets])
    far = np.where(ahead, -least[facets], greatest[facets])
    size = blocks.sizes[planes.blocks[facets]]
    wrong = (back > tolerance * size) | (far > thickness * (1 + UP_TO))
    if not wrong.any():
        return None
    which = blocks.name(int(planes.blocks[facets[wrong]][0]))
    words = f"{_joint_of(blocks, planes, facets)} has no one plane: {which} would grow past it, or into itself"
    return Message("joint-not-closed", words)
