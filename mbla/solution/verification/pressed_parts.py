"""The parts of interfaces that press at rest, written a second time on purpose, and points of quadrature on them."""

from __future__ import annotations

import numpy as np
import shapely
from scipy.optimize import brentq

from mbla.arrays import FloatArray, IntArray
from mbla.solution.verification.rest import AtRest

FAR = 1e3
"""Size of a half plane over that of what it cuts."""


def same_share(shares: FloatArray, share: float) -> np.ndarray:
    """Which shares are one but for rounding."""
    return np.abs(shares - share) <= 1e-9


def quadrature(rest: AtRest, pressed: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
    """Interface, place and area of the points of quadrature on what presses.

    pressed : (n_surfaces,) share of each interface that does
    """
    contacts = rest.contacts
    interface, places, weights = [np.zeros(0, dtype=np.int64)], [np.zeros((0, 3))], [np.zeros(0)]
    for row in np.flatnonzero(pressed > 0.0).tolist():
        own = slice(int(contacts.point_start[row]), int(contacts.point_start[row + 1]))
        corners = contacts.points[own][: contacts.outline[row]]
        frame, centre = contacts.frames[own.start], contacts.centroids[row]
        outline = (corners - centre) @ frame[1:].T
        hollow = abs(shapely.Polygon(outline).area - contacts.areas[row]) > 1e-6 * contacts.areas[row]
        if hollow:
            holds = rest.pressed[own] > 0.0
            spots, shares = contacts.points[own][holds], contacts.point_areas[own][holds]
        else:
            pieces = [outline] if same_share(pressed[row], 1.0) else _cut(rest, row, outline)
            here = np.concatenate([np.zeros((0, 2)), *pieces])
            there = np.concatenate([np.zeros((0, 2)), *(np.roll(piece, -1, axis=0) for piece in pieces)])
            area = (here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]) / 2.0
            middles = np.concatenate([here / 2.0, (here + there) / 2.0, there / 2.0])
            spots, shares = centre + middles @ frame[1:], np.tile(area / 3.0, 3)
        interface.append(np.full(len(spots), row))
        places.append(spots)
        weights.append(shares)
    return np.concatenate(interface), np.concatenate(places), np.concatenate(weights)


def _cut(rest: AtRest, row: int, outline: FloatArray) -> list[FloatArray]:
    """The parts of an outline that press: where the plane through the forces of its corners lies above nothing.

    Where a motion has opened the joint it is lifted until it holds what the points carry.
    """
    contacts = rest.contacts
    points = slice(int(contacts.point_start[row]), int(contacts.point_start[row + 1]))
    law = rest.model.joints[contacts.joint_names[contacts.joints[row]]]
    stiffness = float(rest.stiffness[row, 0])
    height = (law.tensile_strength / stiffness - rest.moved[points, 0])[: len(outline)]
    found, *_ = np.linalg.lstsq(np.column_stack([outline, np.ones(len(outline))]), height, rcond=None)
    plane = np.asarray(found, dtype=np.float64)
    if not rest.turned[row] or not np.ptp(height) > 0.0:
        return _above(outline, plane)
    volume = float(np.maximum(rest.pressed[points], 0.0).sum()) / stiffness

    def missing(lift: float) -> float:
        parts = [shapely.Polygon(piece) for piece in _above(outline, plane + np.array([0.0, 0.0, lift]))]
        heights = [plane @ [part.centroid.x, part.centroid.y, 1.0] + lift for part in parts]
        return float(sum(part.area * height for part, height in zip(parts, heights, strict=True))) - volume

    most = 2.0 * volume / shapely.Polygon(outline).area + float(np.ptp(height))
    low = -float(height.max())
    lift = brentq(missing, low, low + most, xtol=1e-15 * float(np.ptp(height)), rtol=1e-14)
    return _above(outline, plane + np.array([0.0, 0.0, lift]))


def _above(outline: FloatArray, plane: FloatArray) -> list[FloatArray]:
    """The parts of an outline where a plane a y_1 + b y_2 + c lies above nothing."""
    normal = plane[:2] / np.hypot(*plane[:2])
    foot = -plane[2] / np.hypot(*plane[:2]) * normal
    size = float(np.linalg.norm(foot)) + FAR * float(np.abs(outline).max())
    along = np.array([-normal[1], normal[0]])
    half = [foot - size * along, foot + size * along, foot + size * (along + normal), foot + size * (normal - along)]
    part = shapely.Polygon(outline).intersection(shapely.Polygon(half))
    pieces = [piece for piece in shapely.get_parts(part) if piece.geom_type == "Polygon" and piece.area > 0.0]
    return [np.array(shapely.geometry.polygon.orient(piece).exterior.coords)[:-1] for piece in pieces]
