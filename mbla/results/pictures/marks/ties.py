"""Ties in pictures: lines from point to point, strips and fill as short lines there; those that yield stand out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.ties.ties import OUTSIDE, Ties
from mbla.results.collapse.ties import TieRow, TieState, tie_rows
from mbla.results.listing.text import number
from mbla.results.pictures.marks.marks import Mark, segments
from mbla.results.pictures.page import GHOST
from mbla.results.pictures.scene import PictureScene

TIE, YIELDING, SOIL = "#00695C", "#C2185B", "#8D6E63"
"""colours of ties, and of fill that holds faces"""
STRIP = 0.3
"""half length of the line that stands for what acts at one place, over the size of the smaller block"""


def tie_marks(scene: PictureScene, *, at_work: bool = True) -> list[Mark]:
    """Ties by what they do in the mechanism, where there is one and they are shown at work; else all alike."""
    ties = scene.model.ties
    if not len(ties):
        return []
    rows = tie_rows(scene.model, scene.mechanics if at_work else None)
    ends, bodies, owner = _segments(scene, ties)
    found = []
    for label, colour, state, soil in (
        ("tie", TIE, TieState.HOLDS, False),
        ("slack tie", GHOST, TieState.SLACK, False),
        ("tie that yields", YIELDING, TieState.YIELDS, False),
        ("soil on a face", SOIL, TieState.HOLDS, True),
        ("soil, active limit", GHOST, TieState.ACTIVE, True),
        ("soil, passive limit", YIELDING, TieState.PASSIVE, True),
    ):
        chosen = np.flatnonzero([rows[row].state is state for row in owner.tolist()] & (ties.of_fill[owner] == soil))
        texts = [_text(rows[row], scene.model.units.force) for row in owner[chosen].tolist()]
        mark = segments(label, colour, ends[chosen], bodies[chosen], texts, np.full(len(chosen), 0.7))
        found.append(replace(mark, bodies=np.repeat(bodies[chosen].reshape(-1, 1), 2, axis=1)))
    return [mark for mark in found if len(mark.pairs)]


def _segments(scene: PictureScene, ties: Ties) -> tuple[FloatArray, IntArray, IntArray]:
    """Ends of all stretches, (n, 2, 3) m, the body at each, (n, 2), -1 outside, and the tie of each, (n,)."""
    stretches = ties.stretches
    ends, bodies = ties.places[stretches].copy(), ties.bodies[stretches]
    crosses = (ends[:, 0] == ends[:, 1]).all(axis=1)
    if crosses.any():
        sizes = np.where(bodies[crosses] == OUTSIDE, np.inf, scene.model.blocks.sizes[bodies[crosses]]).min(axis=1)
        half = STRIP * sizes[:, None] * ties.pulls[stretches[crosses, 0]]
        ends[crosses, 0] -= half
        ends[crosses, 1] += half
    return ends, bodies, ties.tie_of_point[stretches[:, 0]]


def _text(row: TieRow, unit: str) -> str:
    if np.isnan(row.force):
        return f"{row.name}: {number(row.least)} .. {number(row.greatest)} {unit}"
    use = "" if np.isnan(row.use) else f", {100 * row.use:.0f} % of its capacity"
    return f"{row.name}: {number(row.force)} {unit}{use}{' ' * bool(row.state)}{row.state}"
