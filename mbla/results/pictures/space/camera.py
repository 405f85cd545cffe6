"""Where a picture in space is looked at from, and how several views share a sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.key import add_axes, add_bar, add_legend
from mbla.results.pictures.page import GHOST, INK, Page, add_words
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.shapes import ColourScale, Drawing

FRAME = ((0.04, 0.96), (0.12, 0.86))
"""part of the picture, from left to right and from bottom to top, that the structure fills; the rest is for words"""


@dataclass(frozen=True)
class Camera:
    """A parallel projection.

    centre    : (3,) m, in the middle of the picture
    towards   : (3,) unit, from the centre to the eye
    right, up : (3,) unit, directions of the picture
    height    : m from the lower to the upper edge of the picture
    aspect    : width over height of the picture
    depth     : m, radius of everything that is seen
    """

    centre: FloatArray
    towards: FloatArray
    right: FloatArray
    up: FloatArray
    height: float
    aspect: float
    depth: float

    def project(self, points: FloatArray) -> FloatArray:
        """Places on the page, (n, 2): 0 to 1 from left to right and from bottom to top."""
        arms = points - self.centre
        return np.column_stack(
            [0.5 + arms @ self.right / (self.height * self.aspect), 0.5 + arms @ self.up / self.height]
        )


def axes_of(azimuth: float, elevation: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit vectors towards the eye, to the right and up, (3,) each."""
    turn, rise = np.deg2rad([azimuth, elevation])
    towards = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([-np.sin(turn), np.cos(turn), 0.0])
    return towards, right, np.cross(towards, right)


def fitted(
    points: FloatArray,
    azimuth: float,
    elevation: float,
    aspect: float,
    frame: tuple[tuple[float, float], tuple[float, float]] = FRAME,
) -> Camera:
    """The camera that shows points as large as the frame allows, (n, 3) m."""
    towards, right, up = axes_of(azimuth, elevation)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    arms = points - middle  # far from the origin their coordinates would lose digits
    across, along = arms @ right, arms @ up
    (left, end), (bottom, top) = frame
    height = float(max(np.ptp(along) / (top - bottom), np.ptp(across) / (end - left) / aspect))
    height = height or 1.0
    centre = middle + right * ((across.max() + across.min()) / 2 + (0.5 - (left + end) / 2) * height * aspect)
    centre = centre + up * ((along.max() + along.min()) / 2 + (0.5 - (bottom + top) / 2) * height)
    depth = float(np.linalg.norm(arms, axis=1).max()) or 1.0
    return Camera(centre, towards, right, up, height, aspect, max(depth, height))


# --- How a page is shared out ---------------------------------------------------------------------------------------


CLOSE = 0.62
"""share of the width that the enlarged part takes"""
LEAST_GAIN = 1.6
"""enlargement from which it is worth a panel of its own"""
AROUND = 0.04
"""margin about the enlarged part, share of its panel"""

Span = tuple[float, float]


@dataclass(frozen=True)
class Panel:
    """One image on a page.

    across : where it begins and ends, shares of the width of the page
    inside : what of this panel another one enlarges, left, bottom, width and height as shares of the panel
    gain   : enlargement over the panel with the whole structure, 1 for that itself
    """

    camera: Camera
    across: Span
    inside: tuple[float, float, float, float] | None = None
    gain: float = 1.0

    @property
    def share(self) -> float:
        """Of the width of the page."""
        return self.across[1] - self.across[0]


def focus_of(scene: Scene) -> FloatArray | None:
    """Where the parts of the listing that move were and are, (n, 3) m; None where nothing or everything moves."""
    chosen = (scene.clusters > 0)[scene.model.blocks.block_of_vertex]
    if not scene.motion.any() or not chosen.any() or chosen.all():
        return None
    return np.vstack([scene.model.blocks.vertices[chosen], scene.moved[chosen]])


def panels_of(
    extent: FloatArray,
    focus: FloatArray | None,
    view: tuple[float, float],
    aspect: float,
    room: tuple[Span, Span],
) -> list[Panel]:
    """One panel, or the whole at the left and the focus at the right.

    extent, focus : (n, 3) m, all that is shown, and what may be enlarged
    aspect        : width over height of the page
    room          : part of every panel that its contents fill, from left to right and from bottom to top
    """
    whole = fitted(extent, *view, aspect, room)
    if focus is None:
        return [Panel(whole, (0.0, 1.0))]
    (left, right), height = room
    inner = ((left + AROUND, right - AROUND), (height[0] + AROUND, height[1] - 2 * AROUND))
    close = fitted(focus, *view, CLOSE * aspect, inner)
    beside = fitted(extent, *view, (1 - CLOSE) * aspect, room)
    if whole.height < LEAST_GAIN * close.height:
        return [Panel(whole, (0.0, 1.0))]
    far = float(np.linalg.norm(extent - close.centre, axis=1).max())  # so that nothing before the focus is cut away
    places = beside.project(focus)
    low, high = places.min(axis=0) - 0.01, places.max(axis=0) + 0.01
    inside = (float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1]))
    return [
        Panel(beside, (0.0, 1 - CLOSE), inside),
        Panel(replace(close, depth=max(far, close.depth)), (1 - CLOSE, 1.0), gain=beside.height / close.height),
    ]


# --- What stands around a spatial picture ----------------------------------------------------------------------------


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
            add_axes(page, "xyz", ways, 0.055, 0.06)
            add_bar(page, metres, unit, 0.12, 0.045)
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
