"""How a page is shared out: the whole structure, and beside it what moves, enlarged where that is a small part."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.camera import Camera, fitted

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
