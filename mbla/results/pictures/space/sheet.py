"""What stands around a spatial picture: words, legend, axes, scale bar, colours, warning, and an inset of the whole."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mbla.results.pictures.key import add_axes, add_bar, add_legend
from mbla.results.pictures.page import GHOST, INK, Page, add_words
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.camera import Panel
from mbla.results.pictures.space.shapes import ColourScale, Drawing

Room = tuple[float, float]


def fill_sheet(page: Page, scene: Scene, kind: str, drawing: Drawing) -> tuple[float, float]:
    """Words above, notes and legend below; where the room between them ends below and above, shares of the height."""
    used = add_words(page, scene.words_of(kind), scene.mark_of(kind))
    bottom = 0.012
    for note in reversed(drawing.notes):
        style = {"ha": "right", "va": "bottom", "fontsize": page.small, "color": INK, "parse_math": False}
        bottom += 1.1 * page.height_of(page.figure.text(0.985, bottom, note, **style))
    boxes = [page.box(name, facecolor=colour, edgecolor=GHOST, linewidth=0.5) for name, colour in drawing.legend]
    return add_legend(page, boxes, bottom=bottom, corner=True), 1 - used


def add_images(
    page: Page, images: Sequence[Any], panels: Sequence[Panel], scene: Scene, drawing: Drawing, room: Room
) -> list[Any]:
    """The images of panels behind the words, with axes, scale bars and colours; their artists.

    room : where the room for the structure ends below and above, as shares of the height
    """
    artists = []
    for panel, image in zip(panels, images, strict=True):
        axes = page.figure.add_axes((panel.across[0], 0.0, panel.share, 1.0), zorder=-1)
        artists.append(axes.imshow(image, aspect="auto", interpolation="none", extent=(0.0, 1.0, 0.0, 1.0)))
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.set_axis_off()
        unit, metres = scene.model.units.length, panel.camera.height / page.figure.get_figheight()
        if panel.gain == 1.0:
            ways = np.column_stack([panel.camera.right, panel.camera.up])
            add_axes(page, "xyz", ways, 0.04, 0.06)
            add_bar(page, metres, unit, 0.1, 0.045)
        else:
            artists[-1].set_clip_path(_frame(page, axes, (0.005, room[0], 0.985, room[1] - room[0])))
            bar = add_bar(page, metres, unit, panel.across[0] + 0.02, room[1] - 0.06)
            style = {"fontsize": page.small, "color": INK, "ha": "right", "va": "top"}
            told = page.figure.text(0.985, room[1] - 0.015, f"what moves, enlarged {panel.gain:.1f} times", **style)
            for artists_of in (bar, [told]):
                _ground(page, axes, artists_of)
        if panel.inside is not None:
            _frame(page, axes, panel.inside)
    if drawing.scale is not None:
        _add_colours(page, drawing.scale, room[0])
    return artists


def _frame(page: Page, axes: Any, box: tuple[float, float, float, float]) -> Any:
    """Around what is enlarged, left, bottom, width and height."""
    left, bottom, width, height = box
    style = {"fill": False, "edgecolor": GHOST, "linewidth": 0.12 * page.letter}
    return axes.add_patch(page.parts.patches.Rectangle((left, bottom), width, height, **style))


def _ground(page: Page, axes: Any, artists: Sequence[Any]) -> None:
    """White behind what is written over a picture."""
    box = type(page.extent_of(artists[0])).union([page.extent_of(each) for each in artists]).padded(0.3 * page.letter)
    place = box.transformed(axes.transData.inverted())
    white = page.parts.patches.Rectangle((place.x0, place.y0), place.width, place.height, facecolor="white", zorder=1.5)
    axes.add_patch(white)


def _add_colours(page: Page, scale: ColourScale, bottom: float) -> None:
    """The scale of colours as a bar above the legend."""
    size = page.letter
    bar = page.figure.add_axes((0.76, bottom + 0.05, 0.22, 0.016))
    bar.imshow(scale.colours[None], aspect="auto", extent=(scale.low, scale.high, 0.0, 1.0))
    bar.set_yticks([])
    bar.tick_params(labelsize=0.8 * size, length=0.3 * size, colors=INK)
    bar.set_title(scale.label, fontsize=0.85 * size, color=INK)
    for spine in bar.spines.values():
        spine.set_linewidth(0.5)
