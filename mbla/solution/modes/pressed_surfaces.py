"""Where interfaces press at rest, and the moments of these surfaces.

An interface that presses at all its corners counts as a whole. Of another one counts the part in which the two bodies
close, or are no further apart than its tensile strength allows: bodies are rigid, so that the opening is linear, and
the edge of that part is a straight line. Where a motion has opened a joint, corners that carry it overlap by less than
an edge does that carries the same. So two bodies, turned against each other as they are there, are brought together
until the surface presses as much as its points do::

    ∫ k_N (h + s)₊ dA = Σ N,    h = f_t/k_N − opening

Moments of polygons are exact::

    A, S = ∫ y dA, I = ∫ y yᵀ dA,    y = (y_1, y_2) along the tangents from the centroid of the interface

Of an interface with holes the contact points that press count, each with its share of the area.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts, summed
from mbla.contacts.contacts import Contacts
from mbla.model.solids.ragged import next_item, row_sums
from mbla.solution.modes.rest import Rest

TOUCHES = 1e-6
"""Force of a contact point over the load of the lighter of its bodies from which it presses: the step at rest leaves
1e-7 of it without balance."""

MOST, SHARP = 60, 1e-14
"""Steps of Newton's method, and the last of them over the greatest difference of heights."""

WHOLE = 1e-6
"""Difference of the area inside an outline from that of its interface, relative, from which it has holes."""


@dataclass(frozen=True)
class PressedSurfaces:
    """Of the interfaces that are surfaces, (n,) each.

    areas  : m²; 0 of those that do not press
    firsts : (n, 2) S, m³
    seconds : (n, 3) I_11, I_12, I_22, m⁴
    """

    areas: FloatArray
    firsts: FloatArray
    seconds: FloatArray


def pressed_surfaces(rest: Rest, relative: FloatArray) -> PressedSurfaces:
    """Moments of what presses.

    relative : (n, 6) displacement of body b relative to body a at the centroid of each interface, and rotation, in the
               frame of the interface
    """
    contacts = rest.bodies.contacts
    n = contacts.n_surfaces
    owner = contacts.interface_of_point[: contacts.point_start[n]]
    local = local_points(contacts)
    opening = _opening(rest, relative, owner, local)
    above = _above(rest, owner, opening)
    holds = above > TOUCHES * _lighter(rest)[owner]
    share = np.bincount(owner, holds, n) / np.maximum(np.diff(contacts.point_start[: n + 1]), 1)
    outlines, of_outlines, start = _outlines(contacts, local, opening)
    hollow = np.abs(moments_of(outlines, start)[:, 0] - contacts.areas[:n]) > WHOLE * contacts.areas[:n]
    found = np.where((share == 1.0)[:, None], moments_of(outlines, start), 0.0)
    stiffness = rest.stiffness[:n, 0]
    volumes = np.bincount(owner, np.maximum(above, 0.0), n) / stiffness
    tension = strengths(rest)[:n]
    for row in np.flatnonzero((share > 0.0) & (share < 1.0) & ~hollow).tolist():
        own = slice(int(start[row]), int(start[row + 1]))
        heights = tension[row] / stiffness[row] - of_outlines[own]
        part = clipped(outlines[own], lifted(outlines[own], heights, volumes[row]) if rest.turned[row] else heights)
        if len(part):
            found[row] = moments_of(part, np.array([0, len(part)]))[0]
    areas = np.where(holds, contacts.point_areas[: len(owner)], 0.0)
    by_points = summed(owner, areas[:, None] * _powers(local), n)
    found[hollow] = by_points[hollow]
    return PressedSurfaces(found[:, 0], found[:, 1:3], found[:, 3:])


def strengths(rest: Rest) -> FloatArray:
    """Tensile strength of the interfaces, (n_interfaces,)."""
    contacts = rest.bodies.contacts
    laws = [rest.bodies.model.joints[name] for name in contacts.joint_names]
    return np.asarray(np.array([law.tensile_strength for law in laws], dtype=np.float64)[contacts.joints])


def local_points(contacts: Contacts) -> FloatArray:
    """Contact points of surfaces along the tangents, from the centroids of their interfaces, (n_points, 2)."""
    n = int(contacts.point_start[contacts.n_surfaces])
    arms = contacts.points[:n] - contacts.centroids[contacts.interface_of_point[:n]]
    return np.asarray(np.einsum("ntx,nx->nt", contacts.frames[:n, 1:], arms))


def clipped(polygon: FloatArray, heights: FloatArray) -> FloatArray:
    """The part of a polygon (k, 2) where a linear function with these values at its corners, (k,), is positive."""
    corners = []
    for here, there, low, high in zip(polygon, np.roll(polygon, -1, 0), heights, np.roll(heights, -1), strict=True):
        if low > 0.0:
            corners.append(here)
        if (low > 0.0) != (high > 0.0):
            corners.append(here + low / (low - high) * (there - here))
    return np.array(corners).reshape(-1, 2)


def lifted(polygon: FloatArray, heights: FloatArray, volume: float) -> FloatArray:
    """Values at the corners of a polygon, (k,), of a linear function and a constant, the positive part a volume.

    Newton's method for ∫ (h + s)₊ dA, which grows with s ever faster: from above it comes down to the root.
    """
    plane, *_ = np.linalg.lstsq(np.column_stack([np.ones(len(polygon)), polygon]), heights, rcond=None)
    shift = 0.0
    for _ in range(MOST):
        part = clipped(polygon, heights + shift)
        area, *firsts = moments_of(part, np.array([0, len(part)]))[0, :3] if len(part) else np.zeros(3)
        if not area > 0.0:
            break
        by = (volume - float(plane @ [area, *firsts])) / area - shift
        shift += by
        if abs(by) <= SHARP * float(np.ptp(heights)):
            break
    return np.asarray(heights + shift)


def _opening(rest: Rest, relative: FloatArray, owner: IntArray, local: FloatArray) -> FloatArray:
    """How far the bodies are apart at each point, (n_points,) m of surfaces: linear over an interface."""
    of_point = relative[owner]
    opening = of_point[:, 0] + of_point[:, 4] * local[:, 1] - of_point[:, 5] * local[:, 0]
    return np.asarray(rest.gaps[: len(owner)] + opening)


def _above(rest: Rest, owner: IntArray, opening: FloatArray) -> FloatArray:
    """Normal force of each point and its tensile strength, (n_points,) of surfaces; negative where it is open."""
    tension = strengths(rest)[owner] * rest.bodies.contacts.point_areas[: len(owner)]
    return np.asarray(tension - rest.points[: len(owner), 0] * opening)


def _lighter(rest: Rest) -> FloatArray:
    """Load of the lighter of the bodies of each interface that have one and move, (n_interfaces,)."""
    model, contacts = rest.bodies.model, rest.bodies.contacts
    loads = np.linalg.norm(rest.case.dead_load[:, :3], axis=1)
    mean = float(loads[model.free][loads[model.free] > 0.0].mean())
    own = np.full(len(model.blocks) + len(model.grounds), mean)
    own[model.free] = np.where(loads[model.free] > 0.0, loads[model.free], mean)
    return np.asarray(own[contacts.bodies].min(axis=1))


def _outlines(contacts: Contacts, local: FloatArray, opening: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Outer boundaries of the surfaces, one after the other, and how far the bodies are apart at their corners."""
    n = contacts.n_surfaces
    inside = np.arange(len(local)) - contacts.point_start[contacts.interface_of_point[: len(local)]]
    outer = inside < contacts.outline[contacts.interface_of_point[: len(local)]]
    return local[outer], opening[outer], starts(contacts.outline[:n].astype(np.int64))


def _powers(points: FloatArray) -> FloatArray:
    """1, y_1, y_2, y_1², y_1 y_2, y_2² of points, (n, 6)."""
    one, two = points.T
    return np.column_stack([np.ones(len(points)), one, two, one * one, one * two, two * two])


def moments_of(corners: FloatArray, start: IntArray) -> FloatArray:
    """A, S_1, S_2, I_11, I_12, I_22 of polygons, (n, 6): ∫ f dA over the triangles from the origin to each edge."""
    here, there = corners, corners[next_item(start)]
    twice = here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]
    middle = _powers(here) + _powers(there) + _powers(here + there)
    middle[:, 0], middle[:, 1:3] = 12.0, 2.0 * middle[:, 1:3]
    return row_sums(twice[:, None] / 24.0 * middle, start)
