"""The diagram: load factor over azimuth in polar coordinates, or the interaction curve of two loads.

Drawn are the load factors of verified points, joined where neighbours both have one; the polygon that static bounds
prove safe and the one that mechanisms draw around it, both of associative flow. Points without a load factor are marked
at the rim, at the origin where the structure does not stand.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck import Deck
from mbla.results.pictures.diagrams import dress, hollow, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, INK, SKY, Page
from mbla.sweeps.answers import Answer
from mbla.sweeps.interaction.domain import Domain, Points
from mbla.sweeps.interaction.question import DIRECTION, Question
from mbla.sweeps.pictures.sheet import MARKS, count_words, mark_handles

SIZE = (1200, 1240)
"""pixels: a square diagram, words above and a legend below"""
ROOM = 1.12
"""edge of the diagram over the farthest point"""


def draw_diagram(
    deck: Deck, question: Question, points: Points, domain: Domain | None, words: Sequence[str], path: Path
) -> None:
    """Write the diagram.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    polar = question.kind == DIRECTION
    rule = deck.analysis.flow_rule.replace("_", "-")
    mark = "ERROR OF VERIFICATION: bounds contradict each other" if domain is not None and domain.crossed else ""
    radii = np.concatenate([points.factors.values, points.static, points.kinematic])
    edge = ROOM * float(np.abs(radii[np.isfinite(radii)]).max(initial=0.0)) or 1.0
    words = [deck.title, *words, count_words(points.factors)]
    with open_diagrams(path, PictureOptions(size=SIZE), words, mark) as sheet:
        page, layout = sheet.page, "compressed" if polar else "constrained"
        axes = sheet.frames(1, layout=layout, subplot_kw={"projection": "polar" if polar else None})[0, 0]
        dress(page, axes, *(() if polar else question.axes))
        if polar:
            axes.set_rlim(0.0, edge)
            axes.set_thetagrids(range(0, 360, 30))
            axes.set_rlabel_position(22.5)
        else:
            _limit(page, axes, points)
        handles = [] if domain is None else _draw_domain(page, axes, domain, polar=polar)
        curve = points.places if not question.closed else np.vstack([points.places, points.places[:1]])
        style = {"color": INK, "linewidth": 1.6 * page.scale, "marker": "o", "markersize": 5.0 * page.scale}
        axes.plot(*_onto(curve, polar=polar), zorder=4, **style)
        handles.append(page.line(f"load factor, {rule} flow", **style))
        _mark(page, axes, points, edge, polar=polar)
        sheet.add_legend([*handles, *mark_handles(page, points.factors.answer)])


def _limit(page: Page, axes: Any, points: Points) -> None:
    """A plane that begins at the origin where no point lies beyond it."""
    rays = [points.ways * values[:, None] for values in (points.factors.values, points.static, points.kinematic)]
    places = np.nan_to_num(np.vstack([np.zeros(2), *rays]))
    reach = ROOM * np.abs(places).max(axis=0)
    reach = np.where(reach > 1e-9 * reach.max(), reach, max(reach.max(), 1e-300))
    low = np.where(places.min(axis=0) > -1e-9 * reach, -0.02 * reach, -reach)
    axes.set(xlim=(low[0], reach[0]), ylim=(low[1], reach[1]))
    axes.axhline(0.0, color=GHOST, linewidth=page.scale, zorder=1)
    axes.axvline(0.0, color=GHOST, linewidth=page.scale, zorder=1)


def _onto(places: FloatArray, *, polar: bool) -> tuple[FloatArray, FloatArray]:
    """Places (n, 2) in the plane of the two factors as the axes take them, (n,) each."""
    x, y = places.T
    return (np.arctan2(y, x), np.hypot(x, y)) if polar else (x, y)


def _draw_domain(page: Page, axes: Any, domain: Domain, *, polar: bool) -> list[Any]:
    """Both polygons, which have straight sides in polar axes too; nothing is called safe on bounds that contradict."""
    handles: list[Any] = []
    if len(domain.inner) > 2 and not domain.crossed:
        axes.fill(*_onto(domain.inner, polar=polar), facecolor=SKY, alpha=0.35, edgecolor="none", zorder=2)
        handles.append(page.box("safe by static bounds (associative flow)", facecolor=SKY, alpha=0.35))
    if len(domain.outer) > 2:
        style = {"color": BLUE, "linewidth": 1.4 * page.scale, "linestyle": "--"}
        axes.plot(*_onto(np.vstack([domain.outer, domain.outer[:1]]), polar=polar), zorder=3, **style)
        handles.append(page.line("bound by mechanisms (associative flow)", **style))
    return handles


def _mark(page: Page, axes: Any, points: Points, edge: float, *, polar: bool) -> None:
    """Points without a verified load factor: at what they have, at the origin, or at the rim."""
    x, y = ((0.0, edge), (0.0, edge)) if polar else (axes.get_xlim(), axes.get_ylim())
    reach = np.abs(points.ways) / np.array([max(map(abs, x)), max(map(abs, y))])
    rim = points.ways / (np.hypot(*reach.T) if polar else reach.max(axis=1))[:, None]
    values = points.factors.values
    for answer, mark in MARKS.items():
        own = points.factors.of(answer)
        if own.any():
            places = np.where(np.isfinite(values)[:, None], points.ways * values[:, None], rim)[own]
            places = 0.0 * places if answer == Answer.NO_EQUILIBRIUM else places
            look = hollow(page, mark.marker, mark.colour)
            axes.plot(*_onto(places, polar=polar), zorder=7, clip_on=False, **look)
