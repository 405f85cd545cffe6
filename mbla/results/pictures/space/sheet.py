"""What stands around a spatial picture: words, legend, axes, scale bar, colours, warning, and an inset of the whole."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from mbla.results.listing.text import number
from mbla.results.pictures.page import GHOST, INK, Page, add_words
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.camera import Camera, Panel
from mbla.results.pictures.space.shapes import ColourScale, Drawing

Room = tuple[float, float]

ROOM = 0.7
"""share of the width that the legend may take beside axes and scale bar"""


def fill_sheet(page: Page, scene: Scene, kind: str, drawing: Drawing) -> tuple[float, float]:
    """Words above and legend below; where the room between them ends below and above, as shares of the height."""
    used = add_words(page, scene.words_of(kind), scene.mark_of(kind))
    return _add_legend(page, drawing), 1 - used


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
        unit = scene.model.units.length
        if panel.gain == 1.0:
            _add_triad(axes, panel.camera, page.letter)
            _add_scale_bar(axes, panel.camera, unit, page.letter, (0.22 / panel.camera.aspect, 0.045))
        else:
            artists[-1].set_clip_path(_frame(page, axes, (0.005, room[0], 0.985, room[1] - room[0])))
            bar = _add_scale_bar(axes, panel.camera, unit, page.letter, (0.03, room[1] - 0.06))
            style = {"fontsize": 0.85 * page.letter, "color": INK, "ha": "right", "va": "top"}
            told = axes.text(0.975, room[1] - 0.015, f"what moves, enlarged {panel.gain:.1f} times", **style)
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


def _add_triad(axes: Any, camera: Camera, size: float) -> None:
    """Directions of x, y and z at the lower left; an axis towards the viewer is a dot."""
    height = 0.055
    origin = np.array([0.1 / camera.aspect, 0.085])
    for name, axis in zip("xyz", np.eye(3), strict=True):
        step = np.array([axis @ camera.right / camera.aspect, axis @ camera.up]) * height
        if np.hypot(step[0] * camera.aspect, step[1]) < 0.15 * height:
            axes.plot(*origin, marker="o", markersize=0.45 * size, color=INK, fillstyle="none")
            axes.text(*(origin - [0.012, 0.022]), name, fontsize=0.85 * size, color=INK, ha="center", va="center")
            continue
        arrow = {"arrowstyle": "-|>", "color": INK, "linewidth": 0.1 * size, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", origin + step, origin, arrowprops=arrow)
        axes.text(*(origin + 1.3 * step), name, fontsize=0.85 * size, color=INK, ha="center", va="center")


def round_length(most: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is not above ``most``."""
    power = 10.0 ** math.floor(math.log10(most))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= most * (1 + 1e-12))


def _add_scale_bar(axes: Any, camera: Camera, unit: str, size: float, corner: tuple[float, float]) -> list[Any]:
    """A length across the line of sight, which parallel projection shows the same everywhere; its artists."""
    width = camera.height * camera.aspect
    length = round_length(0.12 * width)
    left, bottom = corner
    right = left + length / width
    lines = axes.plot(
        [left, left, right, right], [bottom + 0.008, bottom, bottom, bottom + 0.008], color=INK, lw=0.12 * size
    )
    style = {"fontsize": 0.85 * size, "color": INK, "ha": "center"}
    text = axes.text((left + right) / 2, bottom + 0.012, f"{number(length)} {unit}", **style)
    return [*lines, text]


def _ground(page: Page, axes: Any, artists: Sequence[Any]) -> None:
    """White behind what is written over a picture."""
    box = type(page.extent_of(artists[0])).union([page.extent_of(each) for each in artists]).padded(0.3 * page.letter)
    place = box.transformed(axes.transData.inverted())
    white = page.parts.patches.Rectangle((place.x0, place.y0), place.width, place.height, facecolor="white", zorder=1.5)
    axes.add_patch(white)


def _add_legend(page: Page, drawing: Drawing) -> float:
    """Names and colours at the lower right; where it ends above, as a share of the height."""
    size, figure, bottom = page.letter, page.figure, 0.012
    for note in reversed(drawing.notes):
        style = {"ha": "right", "va": "bottom", "fontsize": 0.85 * size, "color": INK, "parse_math": False}
        bottom += 1.1 * page.height_of(figure.text(0.985, bottom, note, **style))
    if not drawing.legend:
        return bottom
    handles = [page.box(name, facecolor=colour, edgecolor=GHOST, linewidth=0.5) for name, colour in drawing.legend]
    style = {"loc": "lower right", "bbox_to_anchor": (0.995, bottom - 0.008), "frameon": False, "borderaxespad": 0.2}
    style |= {"fontsize": 0.95 * size, "handlelength": 1, "handletextpad": 0.4, "columnspacing": 1.2, "labelcolor": INK}
    for columns in range(len(handles), 0, -1):
        legend = figure.legend(handles=handles, ncols=columns, **style)
        for text in legend.get_texts():
            text.set_parse_math(False)
        if columns == 1 or page.extent_of(legend).width <= ROOM * page.options.pixels[0]:
            break
        legend.remove()
    return bottom + page.height_of(legend)


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
