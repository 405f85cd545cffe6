"""Marks on a plane figure: gaps of joints filled, hinges as dots, sliding as pairs of half arrows; arrows of loads."""

from __future__ import annotations

import textwrap

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.model import Settlement
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.motion import moved_points
from mbla.results.collapse.thrust import curvature_sides
from mbla.results.pictures.load_marks import (
    FEW,
    LONGEST,
    OFF_PATH,
    LoadMarks,
    arrow_steps,
    axles_near,
    settlement_arrow,
)
from mbla.results.pictures.page import HINGE, INK, OPEN, SLIDE, pale
from mbla.results.pictures.plane.flat import Flat, joint_ends
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.shown_loads import ShownLoad

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


# --- Loads: forces where they act, one arrow for an acceleration, arcs for moments -----------------------------------


ROUNDING = 1e-9
"""share of the single forces across the page below which their sum is none, and of arrows that cannot be seen"""
COLUMNS, LINES = 90, 3
"""letters and lines of a load in the legend"""


def draw_load(sheet: Sheet, flat: Flat, scene: Scene, load: ShownLoad) -> None:
    """Arrows of a load, and its words in the legend."""
    if load.settlement is not None:
        _draw_settlement(sheet, flat, scene, load, load.settlement)
        return
    marks, colour = load.marks, load.colour
    tips = moved_points(scene.model.blocks, scene.motion, marks.blocks, marks.tips)
    drawn = _draw_arrows(sheet, flat, tips, marks.forces, marks, colour)
    drawn |= _draw_moments(sheet, flat, scene, marks, colour)
    pull = flat.project(marks.acceleration[None])[0]
    if marks.uniform and pull.any():
        _draw_arrow_beside(sheet, flat, scene, np.flatnonzero(marks.accelerated), pull, colour)
        drawn = True
    text = textwrap.fill(load.text, COLUMNS, max_lines=LINES, placeholder=" ...")
    if drawn:
        sheet.name_arrow(text, colour)
        near = axles_near(marks, scene.model.blocks.vertices, sheet.size)
        if _draw_arrows(sheet, flat, marks.beside[near], marks.beside_forces[near], marks, pale(colour)):
            sheet.name_arrow(OFF_PATH, pale(colour))
    elif load.loads[scene.model.free].any():
        _draw_across(sheet, flat, scene, load.loads, text, colour)


def _draw_settlement(sheet: Sheet, flat: Flat, scene: Scene, load: ShownLoad, settlement: Settlement) -> None:
    """One thick arrow away from what gives way, if it moves along the page, and its name."""
    way = settlement.motions[:, :3].mean(axis=0)
    if flat.project(way[None]).any():
        chosen = np.isin(scene.model.blocks.block_of_vertex, settlement.blocks)
        start, step = settlement_arrow(scene.moved[chosen], way, sheet.size)
        sheet.arrows(flat.project((start + step)[None]), flat.project(step[None]), 4.5, load.colour, 7)
    sheet.name_arrow(load.text, load.colour)


def _draw_across(sheet: Sheet, flat: Flat, scene: Scene, loads: FloatArray, text: str, colour: str) -> None:
    """The sign of a load across the page, in the middle of what it pushes: a dot towards the eye, a cross away."""
    through = np.where(scene.model.fixed, 0.0, loads[:, :3] @ flat.towards)
    total = float(through.sum())
    if abs(total) <= ROUNDING * float(np.abs(through).sum()):  # a couple, which pushes nowhere
        sheet.name(f"{text} (across the page)", color=colour, linestyle="none", marker=r"$\odot$", markersize=14)
        return
    sign, way = (r"$\odot$", "towards the viewer") if total > 0 else (r"$\otimes$", "away from the viewer")
    middle = np.average(flat.project(scene.model.blocks.centroids), axis=0, weights=np.abs(through))
    sheet.dots(middle[None], 26, color=colour, marker=sign, linewidths=0.6, zorder=7)
    sheet.name(f"{text} ({way})", color=colour, linestyle="none", marker=sign, markersize=14)


def _draw_arrows(sheet: Sheet, flat: Flat, tips: FloatArray, forces: FloatArray, marks: LoadMarks, colour: str) -> bool:
    """Arrows that end at points, (n, 3) m, in one scale for the load; whether any is seen."""
    steps = flat.project(arrow_steps(forces, marks.largest, sheet.size))
    if np.linalg.norm(steps, axis=1).max(initial=0.0) <= ROUNDING * sheet.size:
        return False
    thin = len(tips) > FEW
    sheet.arrows(flat.project(tips), steps, 1.4 if thin else 3.0, colour, 7, thin=thin)
    return True


def _draw_moments(sheet: Sheet, flat: Flat, scene: Scene, marks: LoadMarks, colour: str) -> bool:
    """Three quarters of a circle about the centroid, the way the moment turns."""
    blocks, rows = scene.model.blocks, marks.moment_blocks
    senses = np.sign(marks.moments @ flat.towards)
    centres = moved_points(blocks, scene.motion, rows, blocks.centroids[rows])
    angles = np.linspace(0, 1.5 * np.pi, 40)
    for centre, sense, block in zip(flat.project(centres), senses, rows, strict=True):
        if sense == 0:
            continue
        radius = min(0.3 * float(blocks.sizes[block]), LONGEST * sheet.size)
        arc = centre + radius * np.column_stack([np.cos(sense * angles), np.sin(sense * angles)])
        sheet.lines(arc[None], 2.4, colour, zorder=7)
        last = arc[-1] - arc[-2]
        step = 0.5 * radius * last / np.linalg.norm(last)
        sheet.arrows(arc[-1:] + step / 2, step[None], 2.4, colour, 7)
    return bool(np.any(senses != 0))


def _draw_arrow_beside(sheet: Sheet, flat: Flat, scene: Scene, blocks: IntArray, pull: FloatArray, colour: str) -> None:
    """One thick arrow towards the middle of some blocks: before the box around everything drawn so far if these are all
    that have a mass, else before the box around them.
    """
    masses = scene.model.blocks.masses[blocks]
    weights = masses if masses.any() else np.ones(len(blocks))
    centre = np.average(flat.project(scene.model.blocks.centroids[blocks]), axis=0, weights=weights)
    others = (scene.model.blocks.masses > 0) & ~scene.model.fixed
    others[blocks] = False
    mine = np.isin(scene.model.blocks.block_of_vertex, blocks)
    points = flat.project(scene.moved[mine]) if others.any() else np.vstack(sheet.drawn)
    low, high = points.min(axis=0) - 0.02 * sheet.size, points.max(axis=0) + 0.02 * sheet.size
    unit = pull / np.linalg.norm(pull)
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = np.where(unit > 0, (centre - low) / unit, np.where(unit < 0, (centre - high) / unit, np.inf))
    tip = centre - float(sides.min()) * unit
    sheet.arrows(tip[None], LONGEST * sheet.size * unit[None], 4.5, colour, 7)
