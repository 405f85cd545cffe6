"""Marks of a mechanism: joints that open, slide, crush and turn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.slip_lines import is_beside
from mbla.results.listing.text import number
from mbla.results.pictures.marks.marks import Mark, arrows, interface_names, outer_rows, rings, segments
from mbla.results.pictures.page import CRUSH, HINGE, INK, OPEN, SLIDE
from mbla.results.pictures.scene import PictureScene

THIN = 0.3
"""thickness of hinges that the listing does not name and of outlines, over that of other hinges"""
LEAST_SHARE, MOST_PLANES = 0.1, 20
"""share of the largest slip from which a sliding plane has an arrow, and how many have one"""
ACROSS = 0.5
"""cosine to the width of a soil below which a side of a joint is seen as its length"""
LEAST_SLIP = 0.02
"""half length of the arrow of a small joint that slides, over the size of the structure"""


def joint_marks(scene: PictureScene, *, flat: bool = True) -> list[Mark]:
    """What opens, slides, crushes and turns in the motion as drawn; nothing of a structure at rest.

    flat : in a plane every joint that moves; else, where they would be drawn one behind another, the cracks between the
           parts of the listing, with their hinge lines and sliding planes
    """
    joints, contacts = scene.joint_motion, scene.contacts
    if joints is None or not len(contacts) or not scene.motion.any():
        return []
    names = interface_names(scene.model, contacts)
    slides = np.isin(joints.modes, (InterfaceMode.SLIDE, InterfaceMode.TWIST)) & ~joints.in_soil
    opens = np.isin(joints.modes, (InterfaceMode.OPEN, InterfaceMode.HINGE)) & ~joints.in_soil
    if not flat:
        slips = _slips(scene, joints, np.flatnonzero(slides & scene.apart), names)
        crushing = _outlines("crushing", CRUSH, contacts, joints.crushes & scene.apart, names)
        opening = replace(_opening(contacts, opens & scene.apart, names), covered=True)
        found = [opening, cracks(scene, names), *slips, crushing, _hinges(scene, joints, names, scene.apart)]
        return [mark for mark in found if len(mark.pairs)]
    found = [
        _opening(contacts, opens, names),
        _outlines("sliding", SLIDE, contacts, slides, names),
        *_slips(scene, joints, np.flatnonzero(slides), names),
        _outlines("crushing", CRUSH, contacts, joints.crushes, names),
        _hinges(scene, joints, names),
        slip_lines(scene, joints),
    ]
    return [mark for mark in found if len(mark.pairs)]


def interface_sides(contacts: Contacts, chosen: BoolArray) -> IntArray:
    """Sides of the outer boundaries of chosen interfaces, as pairs of contact points, (n, 2)."""
    first, corners = contacts.point_start[contacts.interface_of_point], contacts.outline[contacts.interface_of_point]
    rows = np.arange(len(contacts.points))
    following = np.where(rows - first + 1 < corners, rows + 1, first)
    on_outline = chosen[contacts.interface_of_point] & (rows - first < corners)
    return np.column_stack([rows, following])[on_outline]


def cracks(scene: PictureScene, names: Sequence[str]) -> Mark:
    """Outlines of the surfaces in which parts of the listing come apart, as part of the blocks of both sides.

    A side that two interfaces of one surface share lies within it.
    """
    contacts = scene.contacts
    sides = interface_sides(contacts, scene.apart)
    of_body = np.append(scene.clusters, np.zeros(len(scene.model.grounds), dtype=np.int64))
    owners = contacts.interface_of_point[sides[:, 0]]
    parts = np.sort(of_body[contacts.bodies[owners]], axis=1)
    outer = outer_rows(contacts.points[sides], scene.size, parts)
    sides, owners = np.tile(sides[outer], (2, 1)), np.tile(owners[outer], 2)
    bodies = contacts.bodies[owners[: len(owners) // 2]].T.ravel()
    texts = [f"crack: {names[owner]}" for owner in owners.tolist()]
    both = np.column_stack([bodies, bodies])
    mark = segments("crack", INK, contacts.points[sides], both, texts, np.full(len(sides), THIN))
    return replace(mark, covered=True)


def slip_lines(scene: PictureScene, joints: InterfaceMotion) -> Mark:
    """Joints of cells of soil in its section that move notably, as part of both sides, the thicker the faster."""
    contacts, model = scene.contacts, scene.model
    speeds = np.where(joints.in_soil, np.linalg.norm(joints.translation, axis=1), 0.0)
    most = float(speeds.max(initial=0.0))
    moves = joints.in_soil & (joints.modes != InterfaceMode.STICK) & (speeds >= LEAST_SHARE * most)
    across = np.array([soil.axes[2] for soil in model.soils]).reshape(-1, 3)
    of_body = np.append(model.soil_of_block, np.full(len(model.grounds), -1))
    for row, direction in enumerate(across):
        own = (of_body[contacts.bodies] == row).any(axis=1)
        moves &= ~(own & is_beside(contacts, np.arange(len(contacts)), direction))
    sides = interface_sides(contacts, moves)
    owners = contacts.interface_of_point[sides[:, 0]]
    soil = of_body[contacts.bodies[owners]].max(axis=1)
    steps = np.diff(contacts.points[sides], axis=1)[:, 0]
    level = np.abs(np.einsum("ij,ij->i", steps, across[soil])) < ACROSS * np.linalg.norm(steps, axis=1)
    sides, owners = np.tile(sides[level], (2, 1)), owners[level]
    bodies = contacts.bodies[owners].T.ravel()
    owners = np.tile(owners, 2)
    widths = np.maximum(speeds[owners] / (most or 1.0), THIN)
    texts = [f"slip line: {number(100 * speeds[row] / most)} % of the fastest" for row in owners.tolist()]
    return segments("slip line", SLIDE, contacts.points[sides], np.column_stack([bodies, bodies]), texts, widths)


def _outlines(name: str, colour: str, contacts: Contacts, chosen: BoolArray, names: list[str]) -> Mark:
    sides = interface_sides(contacts, chosen)
    owners = contacts.interface_of_point[sides[:, 0]]
    texts = [f"{name}: {names[row]}" for row in owners.tolist()]
    return segments(name, colour, contacts.points[sides], contacts.bodies[owners], texts, np.full(len(sides), THIN))


def _opening(contacts: Contacts, chosen: BoolArray, names: list[str]) -> Mark:
    """Segments from corners of interfaces as part of body a to the same as part of body b, and the areas between."""
    sides = interface_sides(contacts, chosen)
    corners, row = np.unique(sides, return_inverse=True)
    row = row.reshape(sides.shape)
    owners = np.tile(contacts.interface_of_point[corners], 2)
    of_a, of_b = contacts.bodies[contacts.interface_of_point[corners]].T
    body, count = np.concatenate([of_a, of_b]), len(corners)
    return Mark(
        "opening",
        OPEN,
        np.tile(contacts.points[corners], (2, 1)),
        np.column_stack([body, body]),
        np.column_stack([np.arange(count), count + np.arange(count)]),
        np.full(count, THIN),
        tuple(f"opening: {names[owner]}" for owner in owners.tolist()),
        np.column_stack([row[:, 0], row[:, 1], count + row[:, 1], count + row[:, 0]]),
    )


def _hinges(scene: PictureScene, joints: InterfaceMotion, names: list[str], chosen: BoolArray | None = None) -> Mark:
    """Axes of the interfaces, or of chosen ones, that open about one; those on hinge lines of the listing are thick."""
    rows = np.flatnonzero(
        (joints.modes == InterfaceMode.HINGE) & ~joints.in_soil & (True if chosen is None else chosen)
    )
    widths = np.ones(len(rows))
    if scene.failure is not None:
        listed = [row for line in scene.failure.hinge_lines for row in line.interfaces.tolist()]
        widths = np.where(np.isin(rows, listed), 1.0, THIN)
    texts = [f"hinge: {names[row]}" for row in rows.tolist()]
    return segments("hinge", HINGE, joints.hinge_ends[rows], scene.contacts.bodies[rows], texts, widths)


def _slips(scene: PictureScene, joints: InterfaceMotion, sliding: IntArray, names: list[str]) -> list[Mark]:
    """How one part goes over the other, in the middle of each sliding plane of the listing: an arrow or a ring.

    It is that of the part which moves, of two that do the lighter one, as in the listing.
    """
    contacts = scene.contacts
    rows = sliding
    if scene.failure is not None:
        least = LEAST_SHARE * max((plane.share for plane in scene.failure.sliding_planes), default=0.0)
        found_planes = [plane for plane in scene.failure.sliding_planes if plane.share >= least][:MOST_PLANES]
        planes = [(plane.interfaces, plane.centroid) for plane in found_planes]
        away = [np.linalg.norm(contacts.centroids[each] - centre, axis=1) / scene.size for each, centre in planes]
        nearest = [each[np.argmin(np.round(far, 9))] for (each, _), far in zip(planes, away, strict=True)]
        rows = np.array(nearest, dtype=np.int64)
    a, b = np.append(scene.clusters, np.zeros(len(scene.model.grounds), dtype=np.int64))[contacts.bodies[rows]].T
    sign = np.where(b >= a, 1.0, -1.0)[:, None]  # motions of joints are those of body b over body a
    normals, texts = contacts.normals[rows], [f"sliding: {names[row]}" for row in rows.tolist()]
    travel = sign * joints.translation[rows]
    travel = travel - np.einsum("ij,ij->i", travel, normals)[:, None] * normals
    spin = np.einsum("ij,ij->i", sign * joints.rotation[rows], normals)
    length = np.linalg.norm(travel, axis=1)
    reach = np.sqrt(contacts.areas[rows])
    twists = (joints.modes[rows] == InterfaceMode.TWIST) & (spin != 0)
    goes = ~twists & (length > 0)
    half = travel[goes] / length[goes, None] * np.maximum(0.4 * reach[goes], LEAST_SLIP * scene.size)[:, None]
    bodies, centres = contacts.bodies[rows], contacts.centroids[rows]
    labels = [text for text, chosen in zip(texts, goes, strict=True) if chosen]
    found = [arrows("sliding", SLIDE, centres[goes] + half, 2 * half, bodies[goes], labels)]
    if twists.any():
        axes = np.sign(spin[twists])[:, None] * normals[twists]
        found += rings("sliding", SLIDE, centres[twists], axes, 0.35 * reach[twists], bodies[twists], "twisting")
    return found
