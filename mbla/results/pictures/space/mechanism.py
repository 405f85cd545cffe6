"""The collapse mechanism in space: parts in tints over the ghost, hinges as rods, arrows of sliding, coloured gaps."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.motion import moved_points, vertex_displacements
from mbla.results.pictures.palette import FIXED_BLOCK, GHOST, HINGE, OPEN, REST, SLIDE
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.drawing import Drawing
from mbla.results.pictures.space.loads import live_load_arrows
from mbla.results.pictures.space.shapes import (
    Faces,
    Lines,
    Shape,
    arrows,
    balls,
    painted,
    rgb,
    rods,
    together,
    turning_arrows,
)
from mbla.results.pictures.space.structure import block_faces, edge_lines, ghost_lines, grounds, interface_faces
from mbla.results.pictures.tints import tint_of_part
from mbla.solution.solution import ContactMode

PARTS = ("#7FB2D6", "#F2C36B", "#B7DDF2", "#F4EE9B", "#5E97BF", "#E8A87C")
"""tints of parts that move; neighbours get different ones"""
MOST_ARROWS = 60
"""arrows of sliding, of the interfaces that slide farthest; more hide each other"""
MARK = 0.0045
"""radius of hinges over the diagonal of what is shown"""
THINNEST = 0.55
"""thickness of marks where little moves, over that where most does"""
LIFT = 2e-4
"""distance of coloured interfaces from the faces of blocks, over the same"""


def mechanism_drawing(scene: Scene, widest: Scene | None = None) -> Drawing:
    """The structure as moved; at rest where no motion is known.

    widest : the same with the greatest displacement, where this is a frame of a film: marks keep its sizes
    """
    widest = widest or scene
    motion = widest.motion
    moving = moving_blocks(widest)
    legend: list[tuple[str, str]] = []
    solid: list[Shape] = [*grounds(scene), block_faces(scene, scene.moved, part_colours(scene, moving))]
    solid.append(edge_lines(scene, scene.moved))
    marks: list[Shape] = []
    if motion.any():
        solid.append(ghost_lines(scene, moving))
    if motion.any() and len(scene.contacts):
        gaps, lines, entries = joint_marks(scene, widest.moved)
        solid += gaps
        marks += lines
        legend += entries
    extent = np.vstack([scene.moved, scene.model.blocks.vertices, *scene.slabs])
    loads, entries = live_load_arrows(scene)
    marks += loads
    extent = np.vstack([extent, *(shape.points for shape in loads)])
    legend += entries
    if moving.any():
        legend += [("at rest", REST)] * bool((~moving & ~scene.model.fixed).any()) + [("before", GHOST)]
    if scene.model.fixed.any():
        legend.append(("support", FIXED_BLOCK))
    return Drawing(tuple(solid), tuple(marks), 0.6, extent, tuple(legend))


def moving_blocks(scene: Scene) -> BoolArray:
    """Blocks that are drawn away from their place, (n_blocks,)."""
    blocks = scene.model.blocks
    distance = np.zeros(len(blocks))
    steps = np.linalg.norm(vertex_displacements(blocks, scene.motion), axis=1)
    np.maximum.at(distance, blocks.block_of_vertex, steps)
    return np.asarray(distance > 1e-4 * distance.max(initial=0.0))


def part_colours(scene: Scene, moving: BoolArray) -> FloatArray:
    """Colour of each block, (n_blocks, 3): stone at rest, grey if fixed, else by the part it moves with."""
    colours = np.tile(rgb(REST), (len(moving), 1))
    if moving.any():
        tints = np.array([rgb(tint) for tint in PARTS])[tint_of_part(scene, scene.parts, len(PARTS))]
        colours[moving] = tints[scene.parts[moving]]
    colours[scene.model.fixed & ~moving] = rgb(FIXED_BLOCK)
    return colours


# --- joints -------------------------------------------------------------------------------------------------------


def joint_marks(scene: Scene, seen: FloatArray) -> tuple[list[Shape], list[Shape], list[tuple[str, str]]]:
    """Coloured faces of gaps and sliding; hinges, outlines and arrows that shine through; entries of the legend.

    seen : (n, 3) m, all that is shown, for the size of marks
    """
    reach = float(np.linalg.norm(np.ptp(seen, axis=0)))
    joints = scene.joint_motion
    if joints is None:
        return [], [], []
    slides = (joints.modes == InterfaceMode.SLIDE) | (joints.modes == InterfaceMode.TWIST)
    opens = (joints.modes == InterfaceMode.OPEN) | (joints.modes == InterfaceMode.HINGE)
    faces: list[Shape] = []
    marks: list[Shape] = []
    legend = []
    if (joints.modes == InterfaceMode.HINGE).any():
        marks.append(hinge_rods(scene, joints, MARK * reach))
        legend.append(("hinge", HINGE))
    if slides.any():
        faces.append(_both_faces(scene, slides, SLIDE, LIFT * reach))
        marks += [_outlines(scene, slides), *slide_arrows(scene, joints, MARK * reach)]
        legend.append(("sliding", SLIDE))
    if opens.any():
        faces.append(_both_faces(scene, opens, OPEN, LIFT * reach))
        legend.append(("opening", OPEN))
    return faces, marks, legend


def hinge_rods(scene: Scene, joints: InterfaceMotion, radius: float) -> Faces:
    """Rods along the axes of hinges, as long as the interface is where it stays closed; balls at their ends."""
    contacts = scene.contacts
    rows = np.flatnonzero(joints.modes == InterfaceMode.HINGE)
    point, direction = joints.hinge_points, joints.hinge_directions
    owner = contacts.interface_of_point
    mechanics = scene.mechanics
    closed = np.isin(owner, rows) & (mechanics is None or mechanics.modes != ContactMode.OPEN)
    along = np.einsum("ij,ij->i", contacts.points - point[owner], direction[owner])
    low, high = np.full(len(contacts), np.inf), np.full(len(contacts), -np.inf)
    np.minimum.at(low, owner[closed], along[closed])
    np.maximum.at(high, owner[closed], along[closed])
    first, last = (
        moved_at_interface(scene, rows, point[rows] + place[rows, None] * direction[rows]) for place in (low, high)
    )
    colours = np.tile(rgb(HINGE), (len(rows), 1))
    radii = radius * _weights(np.linalg.norm(joints.rotation[rows], axis=1))
    short = np.linalg.norm(last - first, axis=1) < 2 * radii
    middle = (first + last)[short] / 2
    return together([rods(first, last, radii, colours), balls(middle, 1.6 * radii[short], colours[short])])


def _weights(sizes: FloatArray) -> FloatArray:
    """Thickness of marks, 1 for what moves most; they stay visible where it moves little."""
    return np.asarray(np.clip(np.sqrt(sizes / (sizes.max(initial=0.0) or 1.0)), THINNEST, 1.0))


def moved_at_interface(scene: Scene, rows: IntArray, points: FloatArray) -> FloatArray:
    """Points of interfaces, (n, 3) m, midway between where body a and where body b takes them."""
    total = np.zeros_like(points)
    for side in (0, 1):
        owners = scene.contacts.bodies[rows, side]
        block = owners < len(scene.model.blocks)
        moved = points.copy()
        moved[block] = moved_points(scene.model.blocks, scene.motion, owners[block], points[block])
        total += moved / 2
    return total


def slide_arrows(scene: Scene, joints: InterfaceMotion, radius: float) -> list[Faces]:
    """Arrows along the travel of body b over body a in the middle of interfaces; about it where they twist."""
    contacts = scene.contacts
    spin = np.einsum("ij,ij->i", joints.rotation, contacts.normals)
    travel = (
        joints.translation - np.einsum("ij,ij->i", joints.translation, contacts.normals)[:, None] * contacts.normals
    )
    length = np.linalg.norm(travel, axis=1)
    shapes = []
    rows = _most(np.flatnonzero((joints.modes == InterfaceMode.SLIDE) & (length > 0)), length)
    if len(rows):
        middle = moved_at_interface(scene, rows, contacts.centroids[rows])
        half = travel[rows] / length[rows, None] * (0.4 * np.sqrt(contacts.areas[rows]) + 4 * radius)[:, None]
        radii = 0.7 * radius * _weights(length[rows])
        shapes.append(arrows(middle - half, middle + half, radii, np.tile(rgb(SLIDE), (len(rows), 1))))
    rows = _most(np.flatnonzero(joints.modes == InterfaceMode.TWIST), np.abs(spin))
    if len(rows):
        middle = moved_at_interface(scene, rows, contacts.centroids[rows])
        axes = np.sign(spin[rows])[:, None] * contacts.normals[rows]
        shapes.append(turning_arrows(middle, axes, 0.35 * np.sqrt(contacts.areas[rows]), 0.7 * radius, rgb(SLIDE)))
    return shapes


def _most(rows: IntArray, sizes: FloatArray) -> IntArray:
    return np.asarray(rows[np.argsort(-sizes[rows], kind="stable")[:MOST_ARROWS]])


def _both_faces(scene: Scene, chosen: BoolArray, colour: str, lift: float) -> Faces:
    rows = np.flatnonzero(chosen)
    parts = []
    for side, sign in ((0, 1.0), (1, -1.0)):
        shift = sign * lift * scene.contacts.normals[rows]
        parts.append(painted(*interface_faces(scene.contacts, scene.contact_sides[side], rows, shift), colour, False))
    return together(parts)


def _outlines(scene: Scene, chosen: BoolArray) -> Lines:
    rows = np.flatnonzero(chosen)
    middle = (scene.contact_sides[0] + scene.contact_sides[1]) / 2
    points, start, loops = interface_faces(scene.contacts, middle, rows, np.zeros((len(rows), 3)))
    following = loops + 1
    following[start[1:] - 1] = start[:-1]
    return Lines(points, np.column_stack([loops, following]), SLIDE, 3.0)
