"""Places for labels beside points, so that none covers a point, another label, or leaves the frame."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

RINGS = (1.0, 1.8, 3.0, 4.5, 6.5, 9.0, 12.0, 16.0)
"""distances that are tried one after the other, in heights of a line"""
SIDES = 16
"""directions at each of them"""


@dataclass(frozen=True)
class Box:
    """A rectangle, in pixels."""

    left: float
    bottom: float
    right: float
    top: float

    def overlaps(self, other: Box) -> bool:
        """Whether the two have an area in common."""
        beside = self.right <= other.left or other.right <= self.left
        return not (beside or self.top <= other.bottom or other.top <= self.bottom)

    def within(self, other: Box) -> bool:
        """Whether this lies inside of the other."""
        across = other.left <= self.left and self.right <= other.right
        return across and other.bottom <= self.bottom and self.top <= other.top


def label_places(
    points: Sequence[tuple[float, float]], sizes: Sequence[tuple[float, float]], frame: Box, mark: float
) -> list[Box | None]:
    """A box for the label of each point, the nearest that is free; None where there is none within reach.

    points : of the marks, in pixels; earlier ones choose first
    sizes  : width and height of each label
    mark   : half the size of a mark
    """
    taken = [Box(x - mark, y - mark, x + mark, y + mark) for x, y in points]
    places: list[Box | None] = []
    for point, size in zip(points, sizes, strict=True):
        tried = (box for box in _around(point, size, mark))
        free = next((box for box in tried if box.within(frame) and not any(box.overlaps(each) for each in taken)), None)
        places.append(free)
        taken += [] if free is None else [free]
    return places


def _around(point: tuple[float, float], size: tuple[float, float], mark: float) -> list[Box]:
    """Boxes around a point, ring after ring, to the right first."""
    (x, y), (width, height) = point, size
    boxes = []
    for ring in RINGS:
        reach = mark + 0.4 * height * ring
        for step in range(SIDES):
            turn = (step + 1) // 2 * (1 if step % 2 else -1)
            angle = 2.0 * math.pi * turn / SIDES
            ahead, aside = math.cos(angle), math.sin(angle)
            centre_x = x + ahead * (reach + width / 2.0)
            centre_y = y + aside * (reach + height / 2.0)
            boxes.append(
                Box(centre_x - width / 2.0, centre_y - height / 2.0, centre_x + width / 2.0, centre_y + height / 2.0)
            )
    return boxes
