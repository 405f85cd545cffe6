"""Walls along the lines of a plan: where each stands, and where they meet.

The wall along a line from P to Q stands between the offsets of its faces to the left of the line. At a corner both
walls reach to its far side, so that they share a square; where an end lies on another wall it reaches through to that
wall's far face. In a shared square walls along x run through in the first courses of the bond, those along y in the
second ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.masonry.leg import Passage

SAME_PLACE = 1e-6
"""places of a plan this close, relative to the thickness of its walls, are one place"""


@dataclass(frozen=True)
class WallLine:
    """A wall of a plan.

    start   : (2,) of its line; along: (2,) its direction; length: of its line
    before, after : by how much the wall reaches beyond the line at its start and its end
    right   : offset of its right face to the left of the line
    thickness : of the wall
    key     : of its line in the deck
    """

    start: FloatArray
    along: FloatArray
    length: float
    before: float
    after: float
    right: float
    thickness: float
    key: KeyPath

    @property
    def left(self) -> FloatArray:
        """Direction (2,) across the wall, to the left of its line."""
        return np.array([-self.along[1], self.along[0]])

    @property
    def origin(self) -> FloatArray:
        """Corner (2,) of the wall at its start and right face."""
        return np.asarray(self.start - self.before * self.along + self.right * self.left)

    @property
    def whole_length(self) -> float:
        """With what reaches beyond the line."""
        return self.before + self.length + self.after

    @property
    def along_x(self) -> bool:
        """Whether it runs along x, else along y."""
        return bool(abs(self.along[0]) > 0.5)

    def corners(self) -> FloatArray:
        """Least and greatest x and y of the wall, (2, 2)."""
        far = self.origin + self.whole_length * self.along + self.thickness * self.left
        return np.sort(np.stack([self.origin, far]), axis=0)

    def place_of(self, box: FloatArray) -> tuple[float, float]:
        """Where a box (2, 2) of the plan begins and ends along the wall."""
        places = np.sort((box - self.origin) @ self.along)
        return float(places[0]), float(places[1])


def turned_corners(lines: Sequence[WallLine], middle: float, *, closed: bool) -> list[WallLine]:
    """Walls of a line that turns by right angles, each reaching to the far side of its corners.

    middle : offset of their middle to the left of the line
    closed : whether the last one ends where the first begins
    """
    turned = list(lines)
    for n in range(len(turned) if closed else len(turned) - 1):
        here, after = turned[n], (n + 1) % len(turned)
        turn = float(here.along[0] * turned[after].along[1] - here.along[1] * turned[after].along[0])
        reach = here.thickness / 2 - turn * middle
        turned[n] = replace(here, after=reach)
        turned[after] = replace(turned[after], before=reach)
    return turned


def line_along(start: FloatArray, end: FloatArray, middle: float, thickness: float, key: KeyPath) -> WallLine:
    """The wall along a line, (2,) each, by the offset of its middle to the left of it; its ends are free."""
    length = float(np.abs(end - start).max())
    along = np.round((end - start) / length)
    return WallLine(start, along, length, 0.0, 0.0, middle - thickness / 2, thickness, key)


def reaching_through(line: WallLine, lines: Sequence[WallLine]) -> WallLine:
    """A cross wall whose ends, where they lie on another wall, reach to that wall's far face."""
    room = SAME_PLACE * line.thickness
    before, after = 0.0, 0.0
    for other in lines:
        if other is line or other.along_x == line.along_x:
            continue
        box = other.corners() + np.array([[-room], [room]])
        low, high = np.sort((other.corners() - line.start) @ line.along)
        if _inside(line.start, box):
            before = max(before, -float(low))
        if _inside(line.start + line.length * line.along, box):
            after = max(after, float(high) - line.length)
    return replace(line, before=before, after=after)


def _inside(point: FloatArray, box: FloatArray) -> bool:
    return bool((point >= box[0]).all() and (point <= box[1]).all())


def passages_of(lines: Sequence[WallLine], courses: int) -> list[tuple[tuple[int, Passage], ...]]:
    """For each wall the walls that it shares a square with, by number, and where."""
    found: list[list[tuple[int, Passage]]] = [[] for _ in lines]
    for first, second, box in _shared(lines):
        for one, other in ((first, second), (second, first)):
            found[one].append((other, Passage(*lines[one].place_of(box), courses)))
    return [tuple(sorted(each, key=lambda entry: entry[1].left)) for each in found]


def check_plan(lines: Sequence[WallLine]) -> Iterator[Finding]:
    """Walls meet in full squares, and do not lie on each other; key paths below the item."""
    for first, second, box in _shared(lines):
        room = SAME_PLACE * lines[first].thickness
        if lines[first].along_x == lines[second].along_x:
            yield Finding("wall-shape", f"the wall that ends here lies on wall {first}", *lines[second].key)
        elif (np.ptp(box, axis=0) < lines[first].thickness - room).any():
            message = f"meets wall {first} over a part of its thickness only: let it end on its line, or clear of it"
            yield Finding("wall-shape", message, *lines[second].key)


def _shared(lines: Sequence[WallLine]) -> Iterator[tuple[int, int, FloatArray]]:
    """Pairs of walls whose plans overlap, and the box that they share."""
    corners = [line.corners() for line in lines]
    for second in range(len(lines)):
        for first in range(second):
            box = np.stack(
                [np.maximum(corners[first][0], corners[second][0]), np.minimum(corners[first][1], corners[second][1])]
            )
            if (box[1] - box[0] > SAME_PLACE * lines[first].thickness).all():
                yield first, second, box
