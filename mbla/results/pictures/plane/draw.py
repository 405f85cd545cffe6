"""Plane pictures of each kind: model, forces, mechanism."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.thrust import OUTSIDE
from mbla.results.listing.text import number
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import (
    CASES,
    DEAD_LOAD,
    FIXED_BLOCK,
    HINGE,
    INK,
    LIVE_LOAD,
    REST,
    SLIDE,
    THRUST,
    add_legend,
    add_words,
    open_page,
    shade,
)
from mbla.results.pictures.plane.flat import Flat
from mbla.results.pictures.plane.joint_marks import draw_joint_marks
from mbla.results.pictures.plane.load_arrows import draw_arrow_from, draw_loads
from mbla.results.pictures.plane.sheet import (
    Sheet,
    add_scale_bar,
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


# --- A plane figure of one case: model, mechanism or forces ---------------------------------------------------------


MOST_CASES = 6
"""load cases whose loads the legend of a picture of the model names"""


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
        above = add_words(page, scene.words_of(kind), scene.mark_of(kind))
        below = add_legend(page, list(sheet.handles.values()))
        metres = lay_out(sheet, above, below)
        add_scale_bar(sheet, metres, below, scene.model.units.length, _axis_names(flat) if kind == "model" else None)


def _axis_names(flat: Flat) -> tuple[str, str]:
    """Names of what runs to the right and up; the direction in numbers where it is none of the axes."""
    for axis, name in enumerate("xy"):
        along = float(flat.right[axis])
        if abs(along) > 1 - 1e-9:
            return name if along > 0 else f"-{name}", "z"
    return f"({flat.right[0]:.3g}, {flat.right[1]:.3g}, 0)", "z"


def _draw_model(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    draw_blocks(sheet, flat, scene, colours_by_group(sheet, scene), scene.model.blocks.vertices)
    case = scene.case.load_case
    draw_loads(sheet, flat, scene, scene.dead_load, case.dead_words, "dead load", DEAD_LOAD)
    cases = {each.load_case.deck_name: each.load_case for each in scene.shown_cases}
    for row, (name, _) in enumerate(cases.items()):
        for each in scene.shown_cases:
            if each.load_case.deck_name == name:
                colour = CASES[row % len(CASES)]
                label = f"live load {name}" if len(cases) > 1 else "live load"
                _draw_live_load(sheet, flat, scene.with_case(each), label, colour, named=row < MOST_CASES)


def _draw_live_load(sheet: Sheet, flat: Flat, scene: Scene, label: str, colour: str, named: bool = True) -> None:
    """The live load, of a vehicle its axles, or the way that a support gives."""
    case, before = scene.case.load_case, set(sheet.handles)
    if case.settlement is None:
        together = [each for each in scene.shown_cases if each.load_case.deck_name == case.deck_name]
        many = case.travel is not None and len(together) > 1
        words = (f"{len(together)} positions",) if many else case.live_words
        draw_loads(sheet, flat, scene, case.live_load, words, label, colour, None if many else case.travel)
    else:
        settlement = case.settlement
        way = flat.project(settlement.motions[:, :3]).mean(axis=0)
        label = f"{label.replace('live load', '').strip()} {settlement.words}".strip()
        if way.any():
            draw_arrow_from(sheet, flat, scene, settlement.blocks, way, colour)
        sheet.name(label, color=colour, linewidth=3.0, marker=">", markersize=9)
    if not named:
        for name in set(sheet.handles) - before:
            del sheet.handles[name]


def _draw_mechanism(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    draw_blocks(sheet, flat, scene, colours_by_part(sheet, scene), scene.moved)
    draw_ghost(sheet, flat, scene)
    draw_joint_marks(sheet, flat, scene)
    number_parts(sheet, flat, scene)
    case = scene.case.load_case
    if scene.mechanics is None and scene.case.solution.certificate is not None:
        draw_loads(sheet, flat, scene, scene.dead_load, case.dead_words, "dead load", DEAD_LOAD)
    _draw_live_load(sheet, flat, replace(scene, shown_cases=()), "live load", LIVE_LOAD)


def _draw_forces(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    colours = [FIXED_BLOCK if fixed else REST for fixed in scene.model.fixed]
    draw_blocks(sheet, flat, scene, colours, scene.model.blocks.vertices)
    draw_forces(sheet, flat, scene)
    _draw_live_load(sheet, flat, replace(scene, shown_cases=()), "live load", LIVE_LOAD)


KIND_DRAWN_BY = {"model": _draw_model, "mechanism": _draw_mechanism, "forces": _draw_forces}
