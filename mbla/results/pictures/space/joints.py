"""What joints do, in space: hinges as rods, arrows of sliding, coloured gaps; those that the listing tells stand out.

A large vault moves a little at hundreds of joints. Those between its clusters (:mod:`mbla.results.collapse.collapse`),
which the listing tells, are drawn thick, the others as thin lines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.collapse.collapse import Failure
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.listing.text import counted
from mbla.results.pictures.page import CRUSH, HINGE, OPEN, SLIDE
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.shapes import (
    Faces,
    Lines,
    Shape,
    arrows,
    balls,
    interface_faces,
    painted,
    rgb,
    rods,
    together,
    turning_arrows,
)

MOST_LINES, MOST_PLANES = 30, 20
"""hinge lines and sliding planes that stand out, those that move most; more hide each other"""
LEAST = 0.1
"""share of the largest motion of its kind from which a hinge line or sliding plane stands out"""
MOST_ARROWS = 6
"""arrows on one sliding plane"""
MARK = 0.0045
"""radius of hinges over the diagonal of what is shown"""
THINNEST = 0.55
"""thickness of marks where little moves, over that where most does"""
LIFT = 2e-4
"""distance of coloured interfaces from the faces of blocks, over the same"""


@dataclass(frozen=True)
class Told:
    """Hinges and sliding planes that stand out.

    hinges  : (n,) interfaces of hinge lines
    shares  : (n,) how much their lines move, 1 for the most
    planes  : interfaces of each sliding plane, (n,) each
    speeds  : (n_planes,) how much they move, 1 for the most
    """

    hinges: IntArray
    shares: FloatArray
    planes: tuple[IntArray, ...]
    speeds: FloatArray


def told_joints(failure: Failure) -> Told:
    """The hinge lines and sliding planes that move most."""
    most = max((line.share for line in failure.hinge_lines), default=0.0) or 1.0
    lines = [line for line in failure.hinge_lines if line.share >= LEAST * most][:MOST_LINES]
    fastest = max((plane.share for plane in failure.sliding_planes), default=0.0) or 1.0
    planes = [plane for plane in failure.sliding_planes if plane.share >= LEAST * fastest][:MOST_PLANES]
    return Told(
        hinges=np.concatenate([np.zeros(0, dtype=np.int64), *(line.interfaces for line in lines)]),
        shares=np.repeat([line.share / most for line in lines], [len(line.interfaces) for line in lines]),
        planes=tuple(plane.interfaces for plane in planes),
        speeds=np.array([plane.share / fastest for plane in planes]),
    )


def joint_marks(
    scene: Scene, widest: Scene, seen: FloatArray
) -> tuple[list[Shape], list[Shape], list[tuple[str, str]], tuple[str, ...]]:
    """Coloured faces of gaps and sliding; hinges, outlines and arrows that shine through; legend; notes.

    widest : the scene that knows the failure; seen : (n, 3) m, all that is shown, for the size of marks
    """
    if widest.collapse is None or widest.failure is None:
        return [], [], [], ()
    reach = float(np.linalg.norm(np.ptp(seen, axis=0)))
    joints, told = widest.collapse.interfaces, told_joints(widest.failure)
    hinges = np.flatnonzero(joints.modes == InterfaceMode.HINGE)
    thin = np.setdiff1d(hinges, told.hinges)
    slides = (joints.modes == InterfaceMode.SLIDE) | (joints.modes == InterfaceMode.TWIST)
    opens = (joints.modes == InterfaceMode.OPEN) | (joints.modes == InterfaceMode.HINGE)
    faces: list[Shape] = []
    marks: list[Shape] = []
    legend = []
    if len(hinges):
        marks += [hinge_rods(scene, joints, told.hinges, MARK * reach * weights(told.shares))] * bool(len(told.hinges))
        marks += [hinge_threads(scene, joints, thin)] * bool(len(thin))
        legend.append(("hinge", HINGE))
    if slides.any():
        faces.append(_both_faces(scene, slides, SLIDE, LIFT * reach))
        if told.planes:
            marks += [
                _outlines(scene, np.concatenate(told.planes), SLIDE),
                *slide_arrows(scene, widest.clusters, joints, told, MARK * reach),
            ]
        legend.append(("sliding", SLIDE))
    if opens.any():
        faces.append(_both_faces(scene, opens, OPEN, LIFT * reach))
        legend.append(("opening", OPEN))
    if joints.crushes.any():
        marks.append(_outlines(scene, np.flatnonzero(joints.crushes), CRUSH))
        legend.append(("crushing", CRUSH))
    return faces, marks, legend, _notes(widest.failure, told, len(thin))


def _notes(failure: Failure, told: Told, thin: int) -> tuple[str, ...]:
    """Which marks stand out, where not all do."""
    planes = len(failure.sliding_planes) - len(told.planes)
    texts = [f"thin: {counted(thin, 'hinge')} within a part or of little motion"] * bool(thin)
    texts += [f"without arrows: {counted(planes, 'sliding plane')} of less motion"] * bool(planes)
    return ("; ".join(texts),) if texts else ()


def hinge_ends(scene: Scene, joints: InterfaceMotion, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Both ends of hinges as moved, (n, 3) m each; one and the same about a corner."""
    first, last = (scene.between(rows, joints.hinge_ends[rows, end]) for end in (0, 1))
    return first, last


def hinge_rods(scene: Scene, joints: InterfaceMotion, rows: IntArray, radii: FloatArray) -> Faces:
    """Rods along the axes of hinges with radii (n,) m; balls where they are as short as thick."""
    first, last = hinge_ends(scene, joints, rows)
    colours = np.tile(rgb(HINGE), (len(rows), 1))
    short = np.linalg.norm(last - first, axis=1) < 2 * radii
    middle = (first + last)[short] / 2
    return together([rods(first, last, radii, colours), balls(middle, 1.6 * radii[short], colours[short])])


def hinge_threads(scene: Scene, joints: InterfaceMotion, rows: IntArray) -> Lines:
    """Thin lines along the axes of hinges, (n,) interfaces."""
    first, last = hinge_ends(scene, joints, rows)
    return Lines(np.vstack([first, last]), np.arange(2 * len(rows)).reshape(2, -1).T, HINGE, 1.1)


def weights(sizes: FloatArray) -> FloatArray:
    """Thickness of marks, (n,), 1 for what moves most; they stay visible where it moves little."""
    return np.asarray(np.clip(np.sqrt(sizes / (sizes.max(initial=0.0) or 1.0)), THINNEST, 1.0))


def slide_arrows(scene: Scene, clusters: IntArray, joints: InterfaceMotion, told: Told, radius: float) -> list[Faces]:
    """Arrows along the travel of one part over the other in the middle of interfaces; about it where they twist.

    It is that of the part which moves, of two that do the lighter one, as in the listing.

    A plane of many interfaces has ``MOST_ARROWS`` of them, spread over it.

    clusters : (n_blocks,) part of each block, 0 at rest
    radius   : of the rods of the hinges that move most, m
    """
    contacts = scene.contacts
    a, b = np.append(clusters, np.zeros(len(scene.model.grounds), dtype=np.int64))[contacts.bodies].T
    sign = np.where(b >= a, 1.0, -1.0)  # motions of joints are those of body b over body a
    spin = sign * np.einsum("ij,ij->i", joints.rotation, contacts.normals)
    across = np.einsum("ij,ij->i", joints.translation, contacts.normals)[:, None] * contacts.normals
    travel = sign[:, None] * (joints.translation - across)
    length = np.linalg.norm(travel, axis=1)
    chosen = [
        plane[np.unique(np.linspace(0, len(plane) - 1, MOST_ARROWS).round().astype(int))] for plane in told.planes
    ]
    every = np.concatenate(chosen)
    thick = 0.7 * radius * weights(np.repeat(told.speeds, [len(rows) for rows in chosen]))
    shapes = []
    straight = (joints.modes[every] == InterfaceMode.SLIDE) & (length[every] > 0)
    rows, radii = every[straight], thick[straight]
    if len(rows):
        middle = scene.between(rows, contacts.centroids[rows])
        half = travel[rows] / length[rows, None] * (0.4 * np.sqrt(contacts.areas[rows]) + 4 * radius)[:, None]
        shapes.append(arrows(middle - half, middle + half, radii, np.tile(rgb(SLIDE), (len(rows), 1))))
    rows = every[joints.modes[every] == InterfaceMode.TWIST]
    if len(rows):
        middle = scene.between(rows, contacts.centroids[rows])
        axes = np.sign(spin[rows])[:, None] * contacts.normals[rows]
        shapes.append(turning_arrows(middle, axes, 0.35 * np.sqrt(contacts.areas[rows]), 0.7 * radius, rgb(SLIDE)))
    return shapes


def _both_faces(scene: Scene, chosen: BoolArray, colour: str, lift: float) -> Faces:
    rows = np.flatnonzero(chosen)
    parts = []
    for side, sign in ((0, 1.0), (1, -1.0)):
        shift = sign * lift * scene.contacts.normals[rows]
        parts.append(painted(*interface_faces(scene.contacts, scene.contact_sides[side], rows, shift), colour, False))
    return together(parts)


def _outlines(scene: Scene, rows: IntArray, colour: str) -> Lines:
    middle = (scene.contact_sides[0] + scene.contact_sides[1]) / 2
    points, start, loops = interface_faces(scene.contacts, middle, rows, np.zeros((len(rows), 3)))
    following = loops + 1
    following[start[1:] - 1] = start[:-1]
    return Lines(points, np.column_stack([loops, following]), colour, 2.0)
