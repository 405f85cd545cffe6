"""The diagram: load factor over azimuth in polar coordinates, or the interaction curve of two loads.

Drawn are the load factors of verified points, joined where neighbours both have one; the polygon that static bounds
prove safe and the one that mechanisms draw around it, both of associative flow. A point without a verified answer is
crossed in red, and no line leads to it; one where the load never brings collapse is a triangle at the rim.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.listing.text import counted
from mbla.results.pictures.diagrams import dress, hollow, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, GREEN, INK, SKY, VERMILION, WARNING, Page
from mbla.sweeps.interaction.domain import Point, extremes
from mbla.sweeps.interaction.question import DIRECTION
from mbla.sweeps.interaction.words import ASSOCIATIVE, conclusions

if TYPE_CHECKING:
    from mbla.sweeps.interaction.study import Interaction

SIZE = (1200, 1240)
"""pixels: a square diagram, words above and a legend below"""
ROOM = 1.12
"""edge of the diagram over the farthest point"""
OFF_RAY = 1e-9
"""relative size below which a coordinate is zero"""


def draw_study(path: Path, study: Interaction, options: PictureOptions | None = None) -> None:
    """Write the diagram, PNG, SVG or PDF.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    left_out = sum(not point.answered for point in study.points)
    mark = f"NOT VERIFIED at {counted(left_out, 'point')} of {len(study.points)}" if left_out else ""
    if study.domain is not None and study.domain.crossings:
        mark = "ERROR OF VERIFICATION: bounds contradict each other" + (f"; {mark}" if mark else "")
    words = [study.about.heading, *study.question.words, *conclusions(study)[:2]]
    edge = _edge(study)
    with open_diagrams(path, options or PictureOptions(size=SIZE), words, mark) as sheet:
        if edge is None:
            return
        page, polar = sheet.page, study.question.kind == DIRECTION
        layout = "compressed" if polar else "constrained"
        axes = sheet.frames(1, layout=layout, subplot_kw={"projection": "polar" if polar else None})[0, 0]
        dress(page, axes, *(() if polar else study.question.axes))
        if polar:
            axes.set_rlim(0.0, edge)
            axes.set_thetagrids(range(0, 360, 30))
            axes.set_rlabel_position(22.5)
        else:
            _limit(page, axes, study)
        handles = _draw_domain(page, axes, study, polar=polar)
        sheet.add_legend(handles + _draw_points(page, axes, study, edge, polar=polar))


def _edge(study: Interaction) -> float | None:
    """Greatest distance from the origin to draw; None where nothing has a distance."""
    radii = [
        value
        for point in study.points
        for value in (point.load_factor, point.static_bound, point.kinematic_bound)
        if math.isfinite(value)
    ]
    return ROOM * max(map(abs, radii)) if any(radii) else (1.0 if study.points else None)


def _limit(page: Page, axes: Any, study: Interaction) -> None:
    """A plane that begins at the origin where no point lies beyond it."""
    places = np.array([(0.0, 0.0), *(place for point in study.points for place in _places(point))])
    reach = np.abs(places).max(axis=0)
    reach = ROOM * np.where(reach > OFF_RAY * reach.max(), reach, max(reach.max(), 1e-300))
    low = np.where(places.min(axis=0) > -OFF_RAY * reach, -0.02 * reach, -reach)
    axes.set(xlim=(low[0], reach[0]), ylim=(low[1], reach[1]))
    axes.axhline(0.0, color=GHOST, linewidth=page.scale, zorder=1)
    axes.axvline(0.0, color=GHOST, linewidth=page.scale, zorder=1)


def _places(point: Point) -> list[tuple[float, float]]:
    values = (point.load_factor, point.static_bound, point.kinematic_bound)
    return [point.at(value) for value in values if math.isfinite(value)]


def _onto(places: Iterable[Sequence[float]] | FloatArray, *, polar: bool) -> tuple[FloatArray, FloatArray]:
    """Places in the plane of the two factors as the axes take them."""
    x, y = np.array(list(places), dtype=float).reshape(-1, 2).T
    return (np.arctan2(y, x), np.hypot(x, y)) if polar else (x, y)


def _draw_domain(page: Page, axes: Any, study: Interaction, *, polar: bool) -> list[Any]:
    """Both polygons; straight sides stay straight, in polar axes too."""
    domain = study.domain
    if domain is None:
        return []
    handles: list[Any] = []
    if len(domain.inner) > 2 and not domain.crossings:  # nothing is called safe on bounds that contradict each other
        x, y = _onto(domain.inner, polar=polar)
        axes.fill(x, y, facecolor=SKY, alpha=0.35, edgecolor="none", zorder=2)
        handles.append(page.box("safe by static bounds (associative flow)", facecolor=SKY, alpha=0.35))
    if len(domain.outer) > 2:
        x, y = _onto([*domain.outer, domain.outer[0]], polar=polar)
        style = {"color": BLUE, "linewidth": 1.4 * page.scale, "linestyle": "--"}
        axes.plot(x, y, zorder=3, **style)
        handles.append(page.line("bound by mechanisms (associative flow)", **style))
    return handles


def _draw_points(page: Page, axes: Any, study: Interaction, edge: float, *, polar: bool) -> list[Any]:
    points = study.points
    handles: list[Any] = []
    own = study.about.flow_rule == ASSOCIATIVE
    colour = INK if own else VERMILION
    size = (4.5 if len(points) > 40 else 6.0) * page.scale
    curve = {"color": colour, "linewidth": 1.6 * page.scale}
    runs = joined_runs(points, closed=study.question.closed)
    for run in runs:
        axes.plot(*_onto([point.at(point.load_factor) for point in run], polar=polar), zorder=4, **curve)
    known = [point for point in points if point.has_factor]
    if known:
        dots = {"marker": "o", "markersize": size, "color": colour, "linestyle": "none"}
        axes.plot(*_onto([point.at(point.load_factor) for point in known], polar=polar), zorder=5, **dots)
        name = f"load factor, {study.about.flow_rule.replace('_', '-')} flow"
        handles.append(page.line(name, marker="o", markersize=size, **curve))
    handles += _draw_least(page, axes, study, polar=polar)
    doubtful = [point for point in points if not point.answered]
    free = [point for point in points if point.unbounded]
    fallen = [point for point in points if point.answered and not point.has_factor and not point.unbounded]
    for chosen, marker, tint, words in (
        (doubtful, "x", WARNING, "no verified answer"),
        (free, "^", GREEN, "never collapses (at the rim)"),
        (fallen, "s", WARNING, "no load factor: dead load alone (at the origin)"),
    ):
        if chosen:
            look = hollow(page, marker, tint, 1.8 * size / page.scale, 1.8)
            radius = {"x": None, "^": edge, "s": 0.0}[marker]
            places = [rim_place(axes, point, edge, radius, polar=polar) for point in chosen]
            axes.plot(*_onto(places, polar=polar), zorder=7, clip_on=False, **look)
            handles.append(page.line(words, **look))
    return handles


def rim_place(axes: Any, point: Point, edge: float, radius: float | None, *, polar: bool) -> tuple[float, float]:
    """Where a point without a load factor is marked: at a radius, or where its figures are if it has any."""
    if radius is None:
        figures = (point.load_factor, point.static_bound, point.kinematic_bound)
        radius = next((value for value in figures if math.isfinite(value)), edge)
    x, y = point.at(radius)
    if polar:
        return x, y
    reach = max(abs(x) / max(map(abs, axes.get_xlim())), abs(y) / max(map(abs, axes.get_ylim())))
    return (x / reach, y / reach) if radius == edge and reach > 0.0 else (x, y)


def _draw_least(page: Page, axes: Any, study: Interaction, *, polar: bool) -> list[Any]:
    """The least load factor, ringed at its angles."""
    ends = extremes(study.points)
    if ends is None or study.question.kind != DIRECTION:
        return []
    chosen = [point for point in study.points if point.has_factor and point.angle in ends[0].angles]
    if len(chosen) == sum(point.has_factor for point in study.points):
        return []
    look = hollow(page, "o", VERMILION, 14.0, 2.0)
    axes.plot(*_onto([point.at(point.load_factor) for point in chosen], polar=polar), zorder=6, **look)
    return [page.line(f"least, {ends[0].load_factor:.6g}", **look)]


def joined_runs(points: Sequence[Point], *, closed: bool) -> list[list[Point]]:
    """Neighbours that have a verified load factor, run by run; a closed diagram begins after a gap if there is one."""
    order = list(points)
    if closed and len(order) > 2:
        gap = next((place for place, point in enumerate(order) if not point.has_factor), None)
        order = [*order, order[0]] if gap is None else order[gap:] + order[:gap]
    runs: list[list[Point]] = [[]]
    for point in order:
        if point.has_factor:
            runs[-1].append(point)
        elif runs[-1]:
            runs.append([])
    return [run for run in runs if len(run) > 1]
