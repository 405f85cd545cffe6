"""Plane pictures of each kind: model, forces, mechanism."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.thrust import OUTSIDE
from mbla.results.listing.text import number
from mbla.results.pictures.key import add_axes, add_bar, add_legend
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import (
    FIXED_BLOCK,
    HINGE,
    INK,
    REST,
    SLIDE,
    THRUST,
    add_words,
    open_page,
    shade,
)
from mbla.results.pictures.plane.flat import Flat
from mbla.results.pictures.plane.marks import draw_joint_marks, draw_load
from mbla.results.pictures.plane.sheet import (
    STRIP,
    Sheet,
    colours_by_group,
    colours_by_part,
    draw_blocks,
    draw_ghost,
    draw_grounds,
    lay_out,
    new_sheet,
    number_parts,
)
from mbla.results.pictures.scene import OUTSIDE_WORDS, Scene
from mbla.results.pictures.shown_loads import shown_loads

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
    thrust, use = scene.thrust, scene.torsion_use
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
    for label, chosen, marker, face, edge, sizes, rim in (
        ("outside the middle third", (eccentricity > MIDDLE_THIRD) & (eccentricity < EDGE), "o", "white", HINGE,
         (8.0, 3.5), 1.6),
        ("at the edge of the joint", (eccentricity >= EDGE) & (eccentricity <= OUTSIDE), "o", HINGE, INK,
         (9.0, 4.5), 0.8),
        (OUTSIDE_WORDS, eccentricity > OUTSIDE, "D", "white", HINGE, (10.0, 5.0), 1.6),
        ("all friction used", use >= USED, "s", SLIDE, INK, (7.0, 3.5), 0.8),
    ):  # fmt: skip
        if chosen.any():
            order = 3.8 if marker == "s" else 6  # below the forces
            style = {"facecolors": face, "edgecolors": edge, "linewidths": rim, "marker": marker, "zorder": order}
            sheet.dots(points[chosen], sizes[0] if few else sizes[1], **style)
            look = {"marker": marker, "markerfacecolor": face, "markeredgecolor": edge}
            sheet.name(label, linestyle="none", markersize=9, **look)


# --- A plane figure of one case: model, mechanism or forces ---------------------------------------------------------


def draw_plane(path: Path, scene: Scene, flat: Flat, kind: str, options: PictureOptions) -> None:
    """Write a figure of a case in its plane; kind ``model``, ``mechanism`` or ``forces``.

    Raises
    ------
    UsageError
        The extra for pictures is not installed.
    FileError
        The file cannot be written.
    """
    with open_page(path, options) as page:
        box = np.ptp(flat.project(scene.model.blocks.vertices), axis=0)
        sheet = new_sheet(page, float(np.linalg.norm(box)))
        draw_grounds(sheet, flat, scene)
        KIND_DRAWN_BY[kind](sheet, flat, scene)
        for load in shown_loads(scene, kind):
            draw_load(sheet, flat, scene, load)
        above = add_words(page, scene.words_of(kind), scene.mark_of(kind))
        below = add_legend(page, list(sheet.handles.values()))
        metres, level = lay_out(sheet, above, below), below + 0.42 * STRIP
        add_bar(page, metres, scene.model.units.length, 0.03, level)
        if kind == "model":
            add_axes(page, _axis_names(flat), np.eye(2), 0.22, level - 0.012)


def _axis_names(flat: Flat) -> tuple[str, str]:
    """Names of what runs to the right and up; the direction in numbers where it is none of the axes."""
    for axis, name in enumerate("xy"):
        along = float(flat.right[axis])
        if abs(along) > 1 - 1e-9:
            return name if along > 0 else f"-{name}", "z"
    return f"({flat.right[0]:.3g}, {flat.right[1]:.3g}, 0)", "z"


def _draw_model(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    draw_blocks(sheet, flat, scene, colours_by_group(sheet, scene), scene.model.blocks.vertices)


def _draw_mechanism(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    draw_blocks(sheet, flat, scene, colours_by_part(sheet, scene), scene.moved)
    draw_ghost(sheet, flat, scene)
    draw_joint_marks(sheet, flat, scene)
    number_parts(sheet, flat, scene)


def _draw_forces(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    colours = [FIXED_BLOCK if fixed else REST for fixed in scene.model.fixed]
    draw_blocks(sheet, flat, scene, colours, scene.model.blocks.vertices)
    draw_forces(sheet, flat, scene)


KIND_DRAWN_BY = {"model": _draw_model, "mechanism": _draw_mechanism, "forces": _draw_forces}
