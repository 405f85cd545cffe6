"""The parts of interfaces that press at rest, written a second time on purpose, and points of quadrature on them."""

from __future__ import annotations

import numpy as np
import shapely
from scipy.optimize import brentq

from mbla.arrays import FloatArray, IntArray
from mbla.solution.verification.rest import AtRest

FAR = 1e3
"""Size of a half plane over that of what it cuts."""

PRESSES = 1e-6
"""Force of a contact point over the load of the lighter of two bodies from which it is closed."""

NARROW, EDGE = 1e-3, 0.05
"""Distance of a force from the edge of a surface from which its springs carry the force, over the root of its area: of
one whose points are all closed, and of another."""

MOST, SHORT, SINGULAR = 60, 1e-6, 1e15
"""Planes at most until one carries a force, least share of the way to the next, condition of what presses nowhere."""

EXACT, CARRIED, ROUNDING = 1e-12, 1e-7, 1e-6
"""What springs leave of a force and its moments, what they may, and stress at a corner that is none, relative."""


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
        outline, own = _outline(rest, row)
        frame, centre = contacts.frames[own.start], contacts.centroids[row]
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


def within_kern(rest: AtRest, row: int) -> bool:
    """Whether an outline presses as a whole under what its points carry, but for rounding: no corner pulls too much."""
    outline, points = _outline(rest, row)
    force, arm = _resultant(rest, row, points)
    if not force > 0.0:
        return bool(rest.pressed[points].min() >= 0.0)
    law = rest.model.joints[rest.contacts.joint_names[rest.contacts.joints[row]]]
    stress = np.column_stack([outline, np.ones(len(outline))]) @ _plane(_products([outline]), arm) * force
    return bool(stress.min() >= -law.tensile_strength - ROUNDING * float(np.abs(stress).max()))


def _cut(rest: AtRest, row: int, outline: FloatArray) -> list[FloatArray]:
    """The parts of an outline that press: those of springs without tension that carry what its points do.

    Where they carry next to an edge, it is the part that closes, by the plane through the openings of the corners;
    where a motion has opened the joint that plane is lifted until it holds what they carry.
    """
    contacts = rest.contacts
    points = slice(int(contacts.point_start[row]), int(contacts.point_start[row + 1]))
    law = rest.model.joints[contacts.joint_names[contacts.joints[row]]]
    stiffness = float(rest.stiffness[row, 0])
    height = (law.tensile_strength / stiffness - rest.moved[points, 0])[: len(outline)]
    found, *_ = np.linalg.lstsq(np.column_stack([outline, np.ones(len(outline))]), height, rcond=None)
    plane = np.asarray(found, dtype=np.float64)
    if not rest.turned[row]:
        force, arm = _resultant(rest, row, points)
        closed = bool((rest.pressed[points] > PRESSES * rest.lighter[points]).all())
        parts = _carrying(outline, arm, NARROW if closed else EDGE) if force > 0.0 else None
        if parts is not None or closed:
            return parts or []
        return _above(outline, plane)
    if not np.ptp(height) > 0.0:
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


def _outline(rest: AtRest, row: int) -> tuple[FloatArray, slice]:
    """Corners of an interface along its tangents, from its centroid, and the rows of its points."""
    contacts = rest.contacts
    own = slice(int(contacts.point_start[row]), int(contacts.point_start[row + 1]))
    corners = contacts.points[own][: contacts.outline[row]]
    return (corners - contacts.centroids[row]) @ contacts.frames[own.start][1:].T, own


def _resultant(rest: AtRest, row: int, points: slice) -> tuple[float, FloatArray]:
    """Normal force of an interface, and where it acts from the centroid."""
    contacts, normal = rest.contacts, rest.forces[points, 0]
    places = (contacts.points[points] - contacts.centroids[row]) @ contacts.frames[points.start][1:].T
    force = float(normal.sum())
    return force, places.T @ normal / force if force > 0.0 else np.full(2, np.nan)


def _products(parts: list[FloatArray]) -> FloatArray:
    """∫ (y_1, y_2, 1)ᵀ(y_1, y_2, 1) dA over polygons, (3, 3): middles of the sides of triangles are exact."""
    found = np.zeros((3, 3))
    for part in parts:
        here, there = part, np.roll(part, -1, axis=0)
        area = (here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]) / 2.0
        for middle in (here / 2.0, (here + there) / 2.0, there / 2.0):
            whole = np.column_stack([middle, np.ones(len(middle))])
            found += np.einsum("n,ni,nj->ij", area / 3.0, whole, whole)
    return found


def _plane(products: FloatArray, arm: FloatArray) -> FloatArray:
    """Heights a y_1 + b y_2 + c that carry a force of one at a place."""
    return np.asarray(np.linalg.solve(products, np.append(arm, 1.0)))


def _carrying(outline: FloatArray, arm: FloatArray, edge: float) -> list[FloatArray] | None:
    """Parts of an outline whose springs carry a force there without tension; None where none do."""
    size, hull = float(np.sqrt(shapely.Polygon(outline).area)), shapely.Polygon(outline).convex_hull
    force = shapely.Point(arm)
    if not (hull.contains(force) and hull.exterior.distance(force) > edge * size):
        return None
    own, wanted = outline / size, np.append(arm / size, 1.0)

    def energy(plane: FloatArray, products: FloatArray) -> float:
        return float(0.5 * plane @ products @ plane - wanted @ plane)

    plane, products = _plane(_products([own]), arm / size), _products([own])
    for _ in range(MOST):
        products = _products(_above(own, plane))
        left, here = float(np.abs(products @ plane - wanted).max()), energy(plane, products)
        if left <= EXACT or not np.linalg.cond(products) < SINGULAR:
            break
        towards, share = np.linalg.solve(products, wanted), 1.0
        while share > SHORT:  # the least of a convex function
            there = plane + share * (towards - plane)
            if energy(there, _products(_above(own, there))) < here + EXACT * abs(here):
                break
            share /= 2.0
        plane = plane + share * (towards - plane)
    return [part * size for part in _above(own, plane)] if left <= CARRIED else None


def _above(outline: FloatArray, plane: FloatArray) -> list[FloatArray]:
    """The parts of an outline where a plane a y_1 + b y_2 + c lies above nothing."""
    if not np.hypot(*plane[:2]) > 0.0:
        return [outline] if plane[2] > 0.0 else []
    normal = plane[:2] / np.hypot(*plane[:2])
    foot = -plane[2] / np.hypot(*plane[:2]) * normal
    size = float(np.linalg.norm(foot)) + FAR * float(np.abs(outline).max())
    along = np.array([-normal[1], normal[0]])
    half = [foot - size * along, foot + size * along, foot + size * (along + normal), foot + size * (normal - along)]
    part = shapely.Polygon(outline).intersection(shapely.Polygon(half))
    pieces = [piece for piece in shapely.get_parts(part) if piece.geom_type == "Polygon" and piece.area > 0.0]
    return [np.array(shapely.geometry.polygon.orient(piece).exterior.coords)[:-1] for piece in pieces]
