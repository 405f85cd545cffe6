"""Loads on a plane figure: forces at the points where they act, one arrow for an acceleration, arcs for moments."""

from __future__ import annotations

import textwrap

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import TravelPosition
from mbla.results.collapse.motion import moved_points
from mbla.results.pictures.load_marks import BESIDE, OFF_PATH, LoadMarks, load_marks
from mbla.results.pictures.page import pale
from mbla.results.pictures.plane.flat import Flat
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import Scene

LONGEST, SHORTEST = 0.12, 0.03
"""of arrows, over the size of the structure"""
LONGEST_OF_MANY, MANY = 0.04, 24
"""the same of more forces than that, which would cover the structure and each other"""
FEW = 4
"""forces up to which arrows are thick"""
ROUNDING = 1e-9
"""share of the single forces across the page below which their sum is none"""
COLUMNS = 90
"""letters in a line of a load in the legend"""
MOST_LINES = 3


def draw_loads(
    sheet: Sheet,
    flat: Flat,
    scene: Scene,
    loads: FloatArray,
    words: tuple[str, ...],
    name: str,
    colour: str,
    travel: TravelPosition | None = None,
) -> None:
    """Arrows of loads on blocks about their centroids, (n_blocks, 6), and their words in the legend.

    travel : the vehicle among them, whose axles are drawn one by one
    """
    marks = load_marks(scene.model, loads, words, travel)
    drawn = _draw_forces(sheet, flat, scene, marks, colour)
    drawn |= _draw_moments(sheet, flat, scene, marks, colour)
    drawn |= _draw_acceleration(sheet, flat, scene, marks, colour)
    text = f"{name}: {'; '.join(words)}" if words else name
    text = textwrap.fill(text, COLUMNS, max_lines=MOST_LINES, placeholder=" ...")
    if drawn:
        sheet.name(text, color=colour, linewidth=3.0, marker=">", markersize=9)
        _draw_beside(sheet, flat, scene, marks, pale(colour))
    elif loads[scene.model.free].any():
        _draw_across(sheet, flat, scene, loads, text, colour)


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


def _draw_forces(sheet: Sheet, flat: Flat, scene: Scene, marks: LoadMarks, colour: str) -> bool:
    if not len(marks.blocks):
        return False
    tips = moved_points(scene.model.blocks, scene.motion, marks.blocks, marks.tips)
    return _draw_arrows(sheet, flat, tips, marks.forces, _largest(flat, marks), colour)


def _draw_beside(sheet: Sheet, flat: Flat, scene: Scene, marks: LoadMarks, colour: str) -> None:
    """Axles of a vehicle off its path, pale; those further off than half the structure's size would shrink it."""
    points = flat.project(marks.beside)
    drawn = np.vstack(sheet.drawn)
    reach = BESIDE * sheet.size
    near = np.all((points > drawn.min(axis=0) - reach) & (points < drawn.max(axis=0) + reach), axis=1)
    if near.any():
        _draw_arrows(sheet, flat, marks.beside[near], marks.beside_forces[near], _largest(flat, marks), colour)
        sheet.name(OFF_PATH, color=colour, linewidth=3.0, marker=">", markersize=9)


def _largest(flat: Flat, marks: LoadMarks) -> float:
    """Of all forces and axles as they are seen."""
    return float(np.linalg.norm(flat.project(np.vstack([marks.forces, marks.beside_forces])), axis=1).max(initial=0.0))


def _draw_arrows(sheet: Sheet, flat: Flat, tips: FloatArray, forces: FloatArray, largest: float, colour: str) -> bool:
    """Arrows that end at points, by the sizes of their forces over the largest; whether any is seen."""
    steps = flat.project(forces)
    sizes = np.linalg.norm(steps, axis=1, keepdims=True)
    if not sizes.any():
        return False
    longest = LONGEST if len(tips) <= MANY else LONGEST_OF_MANY
    length = np.maximum(longest * sizes / largest, min(SHORTEST, longest / 2) * (sizes > 0)) * sheet.size
    width = 3.0 if len(tips) <= FEW else 1.4
    unit = steps / np.where(sizes > 0, sizes, 1.0)
    sheet.arrows(flat.project(tips), length * unit, width, colour, 7, thin=len(tips) > FEW)
    return True


def _draw_moments(sheet: Sheet, flat: Flat, scene: Scene, marks: LoadMarks, colour: str) -> bool:
    """Three quarters of a circle about the centroid, the way the moment turns."""
    senses = np.sign(marks.moments @ flat.towards)
    centres = moved_points(
        scene.model.blocks, scene.motion, marks.moment_blocks, scene.model.blocks.centroids[marks.moment_blocks]
    )
    angles = np.linspace(0, 1.5 * np.pi, 40)
    for centre, sense, block in zip(flat.project(centres), senses, marks.moment_blocks, strict=True):
        if sense == 0:
            continue
        radius = min(0.3 * float(scene.model.blocks.sizes[block]), LONGEST * sheet.size)
        arc = centre + radius * np.column_stack([np.cos(sense * angles), np.sin(sense * angles)])
        sheet.lines(arc[None], 2.4, colour, zorder=7)
        last = arc[-1] - arc[-2]
        step = 0.5 * radius * last / np.linalg.norm(last)
        sheet.arrows(arc[-1:] + step / 2, step[None], 2.4, colour, 7)
    return bool(np.any(senses != 0))


def _draw_acceleration(sheet: Sheet, flat: Flat, scene: Scene, marks: LoadMarks, colour: str) -> bool:
    """One arrow outside the structure that points to the centre of what it accelerates."""
    pull = flat.project(marks.acceleration[None])[0]
    if not marks.uniform or not pull.any():
        return False
    return _draw_arrow_beside(sheet, flat, scene, np.flatnonzero(marks.accelerated), pull, colour)


def draw_arrow_from(sheet: Sheet, flat: Flat, scene: Scene, blocks: IntArray, way: FloatArray, colour: str) -> None:
    """One thick arrow from the box around some blocks as moved, away from their middle."""
    chosen = np.isin(scene.model.blocks.block_of_vertex, blocks)
    points = flat.project(scene.moved[chosen])
    unit = way / np.linalg.norm(way)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    with np.errstate(divide="ignore"):
        reach = float(np.min(np.ptp(points, axis=0) / 2 / np.abs(unit)))
    step = LONGEST * sheet.size * unit
    sheet.arrows((middle + (reach + 0.01 * sheet.size) * unit + step)[None], step[None], 4.5, colour, 7)


def _draw_arrow_beside(sheet: Sheet, flat: Flat, scene: Scene, blocks: IntArray, pull: FloatArray, colour: str) -> bool:
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
    return True
