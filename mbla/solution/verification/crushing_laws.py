"""Crushing of interfaces, written a second time for verification: from fields of stress, not from cones.

A motion that closes the points of an interface by c(x) = −δ(x) dissipates f_c ∫ max(c, 0), summed up over triangles in
closed form. Forces N' and m are those of some field of stress between 0 and f_c if, for every direction θ,

    m·θ ≤ first moment along θ of full stress over the part of area N'/f_c that lies farthest along θ

The direction in which that is closest is found from a coarse round of them by halving. A block of full stress around
the force point, the copy of the outline shrunk by s, proves most interfaces safe beforehand: N' ≤ F (1 − s)².
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.convex.shapes import InterfaceShapes
from mbla.solution.resultants.full_stress import (
    HALVINGS,
    Fan,
    corner_weights,
    mean_positive,
    positive_share,
    second_moments,
)
from mbla.solution.verification.interface_laws import InterfaceLaws, largest, moment_of, tilt

DIRECTIONS = 32
"""In the first round, around an outline whose radii of gyration are all one."""


def crushing_power(laws: InterfaceLaws, motions: FloatArray) -> FloatArray:
    """What crushing motions of interfaces dissipate at most, (n,); inf where one that cannot crush closes.

    motions : (n, 6) dual to the resultants
    """
    shapes = laws.shapes
    closing = -motions[shapes.interface_of_corner, 0] - tilt(shapes, motions)
    fan = Fan.of(shapes)
    block = np.bincount(fan.interface, fan.share * mean_positive(closing[fan.corners]), len(motions))
    dissipated = np.where(laws.crushable, laws.strength, 0.0) * block + laws.tension * motions[:, 0]
    impossible = np.where(np.any(motions != 0, axis=1), np.inf, 0.0)
    return np.asarray(np.where(laws.crushable, dissipated, impossible))


def crushing_excess(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """By how much forces exceed every field of stress, negative inside, (n,) [force].

    Moments count over radii of gyration.
    """
    shapes, normal, moment = laws.shapes, resultants[:, 0] + laws.tension, moment_of(resultants)
    strength = np.where(laws.crushable, laws.strength, 1.0)
    shrunk = largest(shapes, (shapes.edge_slopes() * moment[shapes.interface_of_corner]).sum(axis=1))
    left = np.maximum(normal - shrunk, 0.0)  # N' (1 − s)
    of_copy = np.where(normal > 0.0, np.sqrt(np.maximum(normal, 0.0) ** 3 / strength) - left, shrunk - normal)
    found = np.where(laws.crushable, of_copy, -np.inf)
    rows = np.flatnonzero(found > 0.0)
    if len(rows):
        found[rows] = _exact_excess(shapes, rows, normal[rows], moment[rows], strength[rows])
    return found


def _exact_excess(
    shapes: InterfaceShapes, rows: IntArray, normal: FloatArray, moment: FloatArray, strength: FloatArray
) -> FloatArray:
    """The same for the given interfaces by the search over directions."""
    outlines = _Outlines.of(shapes, rows, normal / strength)
    wanted: FloatArray = np.linalg.solve(outlines.roots, (moment / strength[:, None])[..., None])[..., 0].astype(
        np.float64
    )
    angles = np.arange(DIRECTIONS) * (2.0 * np.pi / DIRECTIONS)
    beyond = np.stack([_beyond(outlines, wanted, np.full(len(rows), angle))[0] for angle in angles])
    middle = angles[beyond.argmax(axis=0)]
    lower, upper = middle - angles[1], middle + angles[1]
    for _ in range(HALVINGS):
        middle = 0.5 * (lower + upper)
        rises = _beyond(outlines, wanted, middle)[1] > 0.0
        lower, upper = np.where(rises, middle, lower), np.where(rises, upper, middle)
    most = np.maximum(beyond.max(axis=0), _beyond(outlines, wanted, middle)[0])
    return np.asarray(np.maximum(strength * most, np.maximum(-normal, normal - strength)))


def _beyond(outlines: _Outlines, wanted: FloatArray, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Moment along a direction beyond what full stress gives, over the strength, and its derivative by the angle."""
    along = np.column_stack([np.cos(angle), np.sin(angle)])
    across = np.column_stack([-along[:, 1], along[:, 0]])
    first = _moment_of_end(outlines, along)
    return ((wanted - first) * along).sum(axis=1), ((wanted - first) * across).sum(axis=1)


def _moment_of_end(outlines: _Outlines, along: FloatArray) -> FloatArray:
    """First moment over the area of the part of given area that lies farthest along a direction, (n, 2)."""
    fan = outlines.fan
    of_corner = (outlines.corners * along[outlines.owner]).sum(axis=1)
    n = len(along)
    lower, upper = np.full(n, np.inf), np.full(n, -np.inf)
    np.minimum.at(lower, outlines.owner, of_corner)
    np.maximum.at(upper, outlines.owner, of_corner)
    for _ in range(HALVINGS):
        middle = 0.5 * (lower + upper)
        beyond = of_corner[fan.corners] - middle[fan.interface][:, None]
        area = np.bincount(fan.interface, fan.share * positive_share(beyond), n)
        more = area > outlines.part
        lower, upper = np.where(more, middle, lower), np.where(more, upper, middle)
    # ∫ x over the end = d/dθ ∫ max(x·θ − d, 0): from the mean of the positive part and how it changes with the corners
    beyond = of_corner[fan.corners] - (0.5 * (lower + upper))[fan.interface][:, None]
    weights = fan.share[:, None] * corner_weights(beyond)
    terms = weights[..., None] * outlines.corners[fan.corners]
    return np.stack([np.bincount(fan.interface, terms[..., axis].sum(axis=1), n) for axis in (0, 1)], axis=1)


@dataclass(frozen=True)
class _Outlines:
    """Outlines of chosen interfaces in coordinates in which their second moments of area are those of a unit circle.

    corners : (n_corners, 2); owner : (n_corners,) row of the outline; part : (n,) share of the area under full stress
    roots   : (n, 2, 2) from these coordinates to those in the plane of the interface
    """

    corners: FloatArray
    owner: IntArray
    fan: Fan
    part: FloatArray
    roots: FloatArray

    @classmethod
    def of(cls, shapes: InterfaceShapes, rows: IntArray, part: FloatArray) -> _Outlines:
        fan, place = Fan.of_some(shapes, rows), np.full(len(shapes.convex), -1)
        place[rows] = np.arange(len(rows))
        roots = np.asarray(np.linalg.cholesky(second_moments(shapes, rows)), dtype=np.float64)
        owner = place[shapes.interface_of_corner]
        inside = np.flatnonzero(owner >= 0)
        corners = np.zeros_like(shapes.corners)
        corners[inside] = np.linalg.solve(roots[owner[inside]], shapes.corners[inside][..., None])[..., 0]
        number = np.cumsum(owner >= 0) - 1
        fan = Fan(fan.interface, number[fan.corners], fan.share)
        return cls(corners[inside], owner[inside], fan, np.clip(part, 0.0, 1.0), roots)
