"""Contact forces on a plane figure: the resultant of each joint where it acts, and lines of thrust."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.thrust import OUTSIDE
from mbla.results.listing.text import number
from mbla.results.pictures.palette import HINGE, INK, SLIDE, THRUST, shade
from mbla.results.pictures.plane.flat import Flat
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import OUTSIDE_WORDS, Scene

MIDDLE_THIRD, EDGE = 1 / 3, 0.99
"""eccentricity beyond which a joint without tension is not pressed all over, and from which the force is at its edge"""
USED = 0.999
"""share of the friction from which all of it counts as used: forces are known to about a thousandth of it"""
WIDEST, FINEST = 9.0, 0.7
"""width of the largest force and of the least, points"""
LENGTH = 0.7
"""of a force over the typical side of a block"""
KEY = (1.0, 0.5, 0.1)
"""forces shown in the key, over the largest"""


def draw_forces(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    """Resultants as short lines along the force, the wider and darker the larger; marks on eccentric ones."""
    thrust, use = scene.thrust, scene.joint_use
    if thrust is None or use is None or not thrust.carried.any():
        return
    rows = np.flatnonzero(thrust.carried)
    points, vectors = flat.project(scene.thrust_points[rows]), flat.project(thrust.forces[rows])
    sizes = np.linalg.norm(vectors, axis=1)
    side = float(np.median(np.sqrt(scene.model.blocks.volumes / _depths(scene, flat))))
    half = LENGTH * min(side, 0.2 * sheet.size) / 2 * vectors / sizes[:, None]
    share = sizes / sizes.max()
    order = np.argsort(share)
    lines = np.stack([points - half, points + half], axis=1)[order]
    widths = _widths(share)[order]
    sheet.lines(lines, widths, [shade(value) for value in share[order]], zorder=4)
    _draw_thrust_lines(sheet, flat, scene)
    _mark_eccentric(sheet, points, thrust.eccentricity[rows], use[rows])
    unit = scene.model.units.force
    for value in KEY:
        width = float(_widths(np.array(value)))
        sheet.name(f"{number(float(f'{value * sizes.max():.3g}'))} {unit}", color=shade(value), linewidth=width)


def _widths(share: FloatArray) -> FloatArray:
    """Width of forces by their share of the largest, points: by the root, so that small ones can be seen."""
    return np.asarray(np.maximum(WIDEST * np.sqrt(share), FINEST))


def _depths(scene: Scene, flat: Flat) -> FloatArray:
    """Extent of each block across the plane, (n_blocks,)."""
    place = scene.model.blocks.vertices @ flat.towards
    start = scene.model.blocks.vertex_start[:-1]
    return np.asarray(np.maximum.reduceat(place, start) - np.minimum.reduceat(place, start))


def _draw_thrust_lines(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    paths = [flat.project(line) for line in scene.thrust_lines]
    if paths:
        sheet.lines(paths, 3.2, "white", zorder=4.5)
        sheet.lines(paths, 1.6, THRUST, zorder=4.6)
        sheet.name("line of thrust", color=THRUST, linewidth=1.6)


def _mark_eccentric(sheet: Sheet, points: FloatArray, eccentricity: FloatArray, use: FloatArray) -> None:
    few = len(points) < 60
    style = {"linewidths": 1.6, "zorder": 6}
    outside = (eccentricity > MIDDLE_THIRD) & (eccentricity < EDGE)
    look = {"linestyle": "none", "markersize": 9}
    if outside.any():
        sheet.dots(points[outside], 8.0 if few else 3.5, facecolors="white", edgecolors=HINGE, **style)
        label = "outside the middle third"
        sheet.name(label, marker="o", markerfacecolor="white", markeredgecolor=HINGE, **look)
    edge = (eccentricity >= EDGE) & (eccentricity <= OUTSIDE)
    if edge.any():
        sheet.dots(points[edge], 9.0 if few else 4.5, facecolors=HINGE, edgecolors=INK, linewidths=0.8, zorder=6)
        sheet.name("at the edge of the joint", marker="o", markerfacecolor=HINGE, markeredgecolor=INK, **look)
    beyond = eccentricity > OUTSIDE
    if beyond.any():
        sheet.dots(points[beyond], 10.0 if few else 5.0, facecolors="white", edgecolors=HINGE, marker="D", **style)
        sheet.name(OUTSIDE_WORDS, marker="D", markerfacecolor="white", markeredgecolor=HINGE, **look)
    used = use >= USED
    if used.any():
        sheet.dots(
            points[used], 7.0 if few else 3.5, facecolors=SLIDE, edgecolors=INK, linewidths=0.8, zorder=3.8, marker="s"
        )
        sheet.name("all friction used", marker="s", markerfacecolor=SLIDE, markeredgecolor=INK, **look)
