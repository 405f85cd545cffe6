"""Interfaces of one pair of bodies that lie on each other: given twice, or one over part of another.

Outlines are fans of triangles about their first corner, each with the sign of its turn, so that the area that two
outlines have in common is the sum of the signed common areas of their triangles, convex or not.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.plane_axes import plane_axes
from mbla.model.signed_polygons import intersections, signed_areas

SAME_PLANE = 0.99
"""cosine of the angle between normals from which outlines may lie on each other, as that of faces of one facet"""


def overlapping(
    bodies: Sequence[tuple[int, int]], normals: Sequence[FloatArray], outlines: Sequence[FloatArray], reach: FloatArray
) -> Iterator[tuple[int, int]]:
    """Numbers of interfaces, the earlier one first, that share more than a strip as wide as ``reach`` along an edge.

    outlines : (n, 3) corners of each, counter-clockwise about its normal
    reach    : (n,) length below which a distance is rounding
    """
    of_pair: dict[tuple[int, int], list[int]] = {}
    for number, pair in enumerate(bodies):
        of_pair.setdefault(pair, []).append(number)
    for numbers in of_pair.values():
        for first, second in combinations(numbers, 2):
            normal = normals[first]
            if normal @ normals[second] < SAME_PLANE:
                continue
            away = (outlines[second] - outlines[first][0]) @ normal
            if np.abs(away).min() > reach[first]:
                continue  # steps of one bed
            if common_area(outlines[first], outlines[second], normal) > reach[first] * _half_perimeter(
                outlines[first], outlines[second]
            ):
                yield first, second


def common_area(outline: FloatArray, other: FloatArray, normal: FloatArray) -> float:
    """Area that two outlines, both counter-clockwise about a unit normal, have in common as seen along it."""
    frame = plane_axes(normal[None])[0].T
    origin = outline.mean(axis=0)
    own, others = _fan((outline - origin) @ frame), _fan((other - origin) @ frame)
    signs = np.sign(signed_areas(others))
    others[signs < 0] = others[signs < 0][:, ::-1]
    pairs = np.repeat(own, len(others), axis=0), np.tile(others, (len(own), 1, 1))
    return float(signed_areas(intersections(*pairs)) @ np.tile(signs, len(own)))


def _fan(corners: FloatArray) -> FloatArray:
    """Triangles about the first corner, (n - 2, 3, 2)."""
    return np.stack([np.broadcast_to(corners[0], corners[2:].shape), corners[1:-1], corners[2:]], axis=1)


def _half_perimeter(*outlines: FloatArray) -> float:
    """Half the perimeter of the shortest outline: no edge of a convex one is longer."""
    return min(float(np.linalg.norm(np.roll(each, -1, axis=0) - each, axis=1).sum()) for each in outlines) / 2
