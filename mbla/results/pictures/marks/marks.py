"""Marks of a load case on the structure as built; the same for every renderer.

Every point of a mark is one that two bodies carry along: it moves as the mean of both, in a picture (:func:`moved`) and
in the browser. Arrows keep their direction, as loads do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.plane import plane_axes
from mbla.results.collapse.motion import moved_points

DOT = 0.6
"""thickness of dots over that of hinges"""
SAME_PLACE = 1e-6
"""of the size of the structure, up to which two corners are one"""
TURN = 24
"""segments of the ring of a moment"""


@dataclass(frozen=True)
class Mark:
    """Segments, arrows or dots of one kind.

    points : (n, 3) m, as built
    bodies : (n, 2) bodies whose mean motion each point follows, -1 for none
    pairs  : (k, 2) rows of points from which to which segments lead; both the same for a dot
    widths : (k,) thickness over that of a hinge
    texts  : (n) what the browser shows for each point
    faces  : (m, 4) rows of points, areas between bodies that part
    inside : it lies within the blocks and is seen only through them
    covered : blocks in front of it hide it, where other marks shine through
    pale    : its areas are seen through, and lie behind the blocks of a plane figure
    outlined : its pairs are edges of its areas and drawn with them in space
    """

    name: str
    colour: str
    points: FloatArray
    bodies: IntArray
    pairs: IntArray
    widths: FloatArray
    texts: tuple[str, ...]
    faces: IntArray = field(default_factory=lambda: np.zeros((0, 4), dtype=np.int64))
    arrows: bool = False
    inside: bool = False
    covered: bool = False
    pale: bool = False
    outlined: bool = False


def moved(mark: Mark, model: Model, motion: FloatArray) -> FloatArray:
    """Points of a mark after a motion of the blocks, (n_blocks, 6): (n, 3) m."""
    total = np.zeros_like(mark.points)
    for side in (0, 1):
        owners = mark.bodies[:, side]
        own = (owners >= 0) & (owners < len(model.blocks))
        points = mark.points.copy()
        points[own] = moved_points(model.blocks, motion, owners[own], points[own])
        total += points / 2
    if mark.arrows:
        first, last = mark.pairs.T
        total[first] = total[last] - (mark.points[last] - mark.points[first])
    return total


def segments(
    name: str, colour: str, ends: FloatArray, bodies: IntArray, texts: Sequence[str], widths: FloatArray | None = None
) -> Mark:
    """A mark of segments of their own points.

    ends : (k, 2, 3) m; bodies : (k, 2) of each segment; widths : (k,), default: 1
    """
    count = len(ends)
    return Mark(
        name,
        colour,
        ends.reshape(-1, 3),
        np.repeat(bodies, 2, axis=0),
        np.arange(2 * count).reshape(-1, 2),
        np.ones(count) if widths is None else widths,
        tuple(text for text in texts for _ in range(2)),
    )


def arrows(name: str, colour: str, tips: FloatArray, steps: FloatArray, bodies: IntArray, texts: Sequence[str]) -> Mark:
    """Arrows that end at tips, having come by steps, (k, 3) m each; bodies (k, 2)."""
    mark = segments(name, colour, np.stack([tips - steps, tips], axis=1), bodies, texts)
    return replace(mark, arrows=True)


def dots(name: str, colour: str, points: FloatArray, bodies: IntArray, texts: Sequence[str]) -> Mark:
    """Dots within blocks, at points, (k, 3) m."""
    pairs = np.repeat(np.arange(len(points))[:, None], 2, axis=1)
    return Mark(name, colour, points, bodies, pairs, np.full(len(points), DOT), tuple(texts), inside=True)


def rings(
    name: str, colour: str, centres: FloatArray, turns: FloatArray, reach: FloatArray, bodies: IntArray, words: str
) -> list[Mark]:
    """Three quarters of a ring about each axis by the right hand, and an arrow at its end.

    centres : (n, 3) m; turns : (n, 3) along the axes; reach : (n,) m, radii; bodies : (n, 2)
    """
    first, second = plane_axes(turns / np.linalg.norm(turns, axis=1, keepdims=True)).transpose(1, 0, 2)
    angle = np.linspace(0.0, 1.5 * np.pi, TURN + 1)[:, None]
    arms = np.cos(angle) * first[:, None] + np.sin(angle) * second[:, None]
    points = centres[:, None] + reach[:, None, None] * arms
    pieces = np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 3)
    texts = [words] * len(pieces)
    tips, steps = points[:, -1], 0.5 * reach[:, None] * first
    return [
        segments(name, colour, pieces, np.repeat(bodies, TURN, axis=0), texts, np.full(len(pieces), 0.5)),
        arrows(name, colour, tips + steps / 2, steps, bodies, [words] * len(tips)),
    ]


def interface_names(model: Model, contacts: Contacts) -> list[str]:
    """``arch[3] | arch[4]`` for every interface."""
    return [f"{model.body_name(a)} | {model.body_name(b)}" for a, b in contacts.bodies.tolist()]


def outer_rows(sides: FloatArray, size: float, of: IntArray | None = None) -> BoolArray:
    """Which sides, (n, 2, 3) m, no other has too, of the same (n, k) where that is given; ``size`` of the model, m."""
    ends = np.rint(sides / (SAME_PLACE * size)).astype(np.int64)
    later = np.array([one > other for one, other in ends.tolist()], dtype=bool)
    ends[later] = ends[later, ::-1]
    keys = ends.reshape(len(ends), 6)
    keys = keys if of is None else np.hstack([keys, of])
    _, row, times = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(times[row.ravel()] == 1)
