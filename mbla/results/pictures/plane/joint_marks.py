"""What joints do in a mechanism, on a plane figure: gaps filled, hinges as dots, sliding as pairs of half arrows."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.thrust import curvature_sides
from mbla.results.pictures.page import HINGE, INK, OPEN, SLIDE
from mbla.results.pictures.plane.flat import Flat, joint_ends
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import Scene

CURVED = 0.5
"""cosine to the curve's own direction from which a hinge is one of the intrados or extrados, as in the listing"""
ARROW = 0.05
"""longest arrow of a sliding joint over the size of the structure; it is at most half as long as the joint"""
CRUSHES = 1e-3
"""speed of closing over the largest speed of the ends of joints from which a joint is said to crush: residuals of a
solved case are smaller"""
LARGE, SMALL, MANY_HINGES = 11.0, 5.0, 60
"""diameter of hinges, points; small ones where there are many"""


def draw_joint_marks(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    """Marks of all interfaces that open, turn or slide; nothing without a mechanism."""
    joints = scene.joint_motion
    if joints is None or not scene.motion.any():
        return
    _draw_gaps(sheet, flat, scene, joints)
    _draw_sliding(sheet, flat, scene, joints)
    _draw_hinges(sheet, flat, scene, joints)


def _draw_gaps(sheet: Sheet, flat: Flat, scene: Scene, joints: InterfaceMotion) -> None:
    """The space between both sides of joints that open, hatched; where they crush, what overlaps, dotted."""
    ends = joint_ends(scene.contacts, flat)
    velocities = _end_velocities(scene, joints, ends)
    speeds = np.einsum("ijk,ik->ij", velocities, scene.contacts.normals)
    least = CRUSHES * float(np.linalg.norm(velocities, axis=2).max(initial=0.0))
    opens = np.isin(joints.modes, (InterfaceMode.OPEN, InterfaceMode.HINGE))
    a, b = (flat.project(side)[ends] for side in scene.contact_sides)
    gaps, overlaps = [], []
    for row in np.flatnonzero(opens | (speeds.min(axis=1) < -least)):
        for part, sign in _parts(a[row], b[row], speeds[row], least):
            if sign < 0:
                overlaps.append(part)
            elif opens[row]:
                gaps.append(part)
    style = {"edgecolors": INK, "linewidths": sheet.width(0.6), "zorder": 3}
    if gaps:
        sheet.areas(gaps, facecolors=OPEN, hatch="xxxx", **style)
        sheet.name_area("opening", facecolor=OPEN, edgecolor=INK, hatch="xxxx")
    if overlaps:
        sheet.areas(overlaps, facecolors="white", hatch="....", **style)
        sheet.name_area("crushing", facecolor="white", edgecolor=INK, hatch="....")


def _end_velocities(scene: Scene, joints: InterfaceMotion, ends: IntArray) -> FloatArray:
    """Velocity of body b relative to a at both ends of each joint, (n_interfaces, 2, 3)."""
    arms = scene.contacts.points[ends] - scene.contacts.centroids[:, None]
    return np.asarray(joints.translation[:, None] + np.cross(joints.rotation[:, None], arms))


def _parts(a: FloatArray, b: FloatArray, speeds: FloatArray, least: float) -> list[tuple[FloatArray, int]]:
    """Outlines between both sides, (2, 2) each, with 1 where they part and -1 where they overlap."""
    signs = np.where(speeds < -least, -1, 1)
    if signs[0] == signs[1]:
        return [(np.array([a[0], a[1], b[1], b[0]]), int(signs[0]))]
    share = speeds[0] / (speeds[0] - speeds[1])
    middle = ((1 - share) * (a[0] + b[0]) + share * (a[1] + b[1])) / 2
    return [(np.array([a[end], middle, b[end]]), int(signs[end])) for end in (0, 1)]


def _draw_hinges(sheet: Sheet, flat: Flat, scene: Scene, joints: InterfaceMotion) -> None:
    """Dots on the axes: diamonds at the extrados, white at the intrados, full dots where there is no curve.

    Hinges inside a part as the listing tells it turn little: they are small.
    """
    hinges = np.flatnonzero(joints.modes == InterfaceMode.HINGE)
    if not len(hinges):
        return
    centres = flat.project(scene.between(hinges, joints.hinge_points[hinges]))
    outward = curvature_sides(scene.model, scene.contacts)[hinges]
    offset = joints.hinge_points[hinges] - scene.contacts.centroids[hinges]
    along = np.einsum("ij,ij->i", offset, outward)
    limit = CURVED * np.linalg.norm(offset, axis=1) * np.linalg.norm(outward, axis=1)
    faces = (
        ("hinge", np.abs(along) <= limit, HINGE),
        ("hinge at the extrados", along > limit, HINGE),
        ("hinge at the intrados", along < -limit, "white"),
    )
    told = _told(scene, hinges)
    size = np.where(told, LARGE if told.sum() < MANY_HINGES else SMALL, SMALL)
    for name, which, face in faces:
        if which.any():
            shape = "D" if name == "hinge at the extrados" else "o"
            edge = HINGE if face == "white" else INK
            rim = 2.2 if face == "white" else 0.8
            sheet.dots(centres[which], size[which], color=face, edgecolors=edge, zorder=6, linewidths=rim, marker=shape)
            look = {"markerfacecolor": face, "markeredgecolor": edge, "linestyle": "none", "markersize": 9}
            sheet.name(name, marker=shape, markeredgewidth=sheet.width(rim), **look)


def _told(scene: Scene, hinges: IntArray) -> BoolArray:
    """Hinges on the hinge lines of the listing, (n,)."""
    if scene.failure is None:
        return np.ones(len(hinges), dtype=bool)
    return np.asarray(np.isin(hinges, [row for line in scene.failure.hinge_lines for row in line.interfaces]))


def _arrowed(scene: Scene, chosen: IntArray) -> IntArray:
    """Of sliding interfaces one of each sliding plane of the listing, that nearest to its middle."""
    if scene.failure is None:
        return chosen
    kept = []
    for plane in scene.failure.sliding_planes:
        away = np.linalg.norm(scene.contacts.centroids[plane.interfaces] - plane.centroid, axis=1)
        kept.append(int(plane.interfaces[np.argmin(np.round(away / scene.size, 9))]))
    return np.array(sorted(kept), dtype=np.int64)


def _draw_sliding(sheet: Sheet, flat: Flat, scene: Scene, joints: InterfaceMotion) -> None:
    """Two arrows along a sliding joint, each on the side of the body that slips that way; the joint itself thick."""
    chosen = np.flatnonzero(np.isin(joints.modes, (InterfaceMode.SLIDE, InterfaceMode.TWIST)))
    if not len(chosen):
        return
    ends = joint_ends(scene.contacts, flat)
    middle = (scene.contact_sides[0] + scene.contact_sides[1]) / 2
    first, last = flat.project(middle[ends[chosen, 0]]), flat.project(middle[ends[chosen, 1]])
    sheet.lines(np.stack([first, last], axis=1), 3.0, SLIDE, zorder=3.5, capstyle="butt")
    sheet.name("sliding", color=SLIDE, linewidth=3.0, marker=r"$\rightleftharpoons$", markersize=16)
    chosen = _arrowed(scene, chosen)
    first, last = flat.project(middle[ends[chosen, 0]]), flat.project(middle[ends[chosen, 1]])
    along = last - first
    length = np.linalg.norm(along, axis=1, keepdims=True)
    along = along / np.where(length > 0, length, 1.0)
    slip = np.einsum("ij,ij->i", flat.project(joints.translation[chosen]), along)
    arm = np.minimum(0.5 * length, ARROW * sheet.size)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    towards_b = np.sign(np.einsum("ij,ij->i", across, flat.project(scene.contacts.normals[chosen])))[:, None]
    for sense in (1.0, -1.0):  # body b, then body a
        step = sense * np.sign(slip)[:, None] * arm * along
        centre = (first + last) / 2 + sense * towards_b * across * 0.22 * arm
        sheet.arrows(centre + step / 2, step, 1.6, SLIDE, 5)
