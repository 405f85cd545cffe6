"""A plane figure of one case: model, mechanism or forces."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import add_legend, add_words, open_page
from mbla.results.pictures.palette import CASES, DEAD_LOAD, FIXED_BLOCK, LIVE_LOAD, REST
from mbla.results.pictures.plane.flat import Flat
from mbla.results.pictures.plane.forces import draw_forces
from mbla.results.pictures.plane.joint_marks import draw_joint_marks
from mbla.results.pictures.plane.load_arrows import draw_arrow_from, draw_loads
from mbla.results.pictures.plane.sheet import Sheet, add_scale_bar, lay_out, new_sheet
from mbla.results.pictures.plane.structure import (
    colours_by_group,
    colours_by_part,
    draw_blocks,
    draw_ghost,
    draw_grounds,
    number_parts,
)
from mbla.results.pictures.scene import Scene

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
    for number, (name, _) in enumerate(cases.items()):
        for each in scene.shown_cases:
            if each.load_case.deck_name == name:
                colour = CASES[number % len(CASES)]
                label = f"live load {name}" if len(cases) > 1 else "live load"
                _draw_live_load(sheet, flat, scene.with_case(each), label, colour, named=number < MOST_CASES)


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
