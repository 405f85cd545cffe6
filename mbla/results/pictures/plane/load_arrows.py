"""Loads on a plane figure: forces at the points where they act, one arrow for an acceleration, arcs for moments."""

from __future__ import annotations

import textwrap

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Settlement
from mbla.results.collapse.motion import moved_points
from mbla.results.pictures.load_marks import (
    FEW,
    LONGEST,
    OFF_PATH,
    LoadMarks,
    arrow_steps,
    axles_near,
    settlement_arrow,
)
from mbla.results.pictures.page import pale
from mbla.results.pictures.plane.flat import Flat
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.shown_loads import ShownLoad

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
