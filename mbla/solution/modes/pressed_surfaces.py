"""Where interfaces press at rest, and the moments of these surfaces.

Forces at contact points say what an interface carries, and where: its surface presses as a whole where that is within
its kern, or nowhere pulls more than the tensile strength; else in the part that carries the same without tension
(:mod:`mbla.solution.modes.carrying_part`). So periods of what stands on the edge of its joints are as long as those of
its surfaces, not of points at its corners.

Where some of its points are open and what it carries is next to an edge, it presses where the two bodies close. Where a
motion has opened it they are turned against each other as they are there, and brought together until the surface
presses as much as its points do::

    ∫ k_N (h + s)₊ dA = Σ N,    h = f_t/k_N − opening

Of an interface with holes the contact points that press count, each with its share of the area.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts, summed
from mbla.contacts.contacts import Contacts
from mbla.solution.modes.carrying_part import carrying_part
from mbla.solution.modes.polygons import clipped, lifted, moments_of, powers, products_of
from mbla.solution.modes.rest import Rest

TOUCHES = 1e-6
"""Force of a contact point over the load of the lighter of its bodies from which it presses: the step at rest leaves
1e-7 of it without balance."""

NARROW, EDGE = 1e-3, 0.05
"""Distance of a force from the edge of a surface, over the root of its area, from which its part follows from the
force: where all points press, else where some are open."""

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
    local, tension = local_points(contacts), strengths(rest)[:n]
    opening = _opening(rest, relative, owner, local)
    above = _above(rest, owner, opening)
    holds = above > TOUCHES * _lighter(rest)[owner]
    share = np.bincount(owner, holds, n) / np.maximum(np.diff(contacts.point_start[: n + 1]), 1)
    outlines, of_outlines, start = _outlines(contacts, local, opening)
    moments = moments_of(outlines, start)
    hollow = np.abs(moments[:, 0] - contacts.areas[:n]) > WHOLE * contacts.areas[:n]
    turned = rest.turned & (share < 1.0)
    force, arms = _resultants(
        contacts, owner, local, np.maximum(above, 0.0) - tension[owner] * contacts.point_areas[: len(owner)]
    )
    least = np.minimum.reduceat(_uncracked(outlines, start, moments, force, arms), start[:-1])
    whole = (share > 0.0) & ~turned & (least >= -tension)
    found = np.where(whole[:, None], moments, 0.0)
    stiffness = rest.stiffness[:n, 0]
    volumes = np.bincount(owner, np.maximum(above, 0.0), n) / stiffness
    for row in np.flatnonzero((share > 0.0) & ~whole & ~hollow).tolist():
        own = slice(int(start[row]), int(start[row + 1]))
        outline, heights = outlines[own], tension[row] / stiffness[row] - of_outlines[own]
        edge, part = (NARROW if share[row] == 1.0 else EDGE), None
        if force[row] > 0.0 and not turned[row]:
            part = carrying_part(outline, arms[row], edge)
        if part is None and share[row] < 1.0:
            part = clipped(outline, lifted(outline, heights, volumes[row]) if turned[row] else heights)
        if part is not None and len(part):
            found[row] = moments_of(part, np.array([0, len(part)]))[0]
    areas = np.where(holds, contacts.point_areas[: len(owner)], 0.0)
    by_points = summed(owner, areas[:, None] * powers(local), n)
    found[hollow] = by_points[hollow]
    return PressedSurfaces(found[:, 0], found[:, 1:3], found[:, 3:])


def _resultants(
    contacts: Contacts, owner: IntArray, local: FloatArray, forces: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Normal force of each surface, (n,), and its eccentricity, (n, 2) m; nan of those without a force."""
    total: FloatArray = np.bincount(owner, forces, contacts.n_surfaces).astype(np.float64)
    firsts = np.column_stack([np.bincount(owner, forces * each, contacts.n_surfaces) for each in local.T])
    return total, firsts / np.where(total > 0.0, total, np.nan)[:, None]


def _uncracked(
    outlines: FloatArray, start: IntArray, moments: FloatArray, force: FloatArray, arms: FloatArray
) -> FloatArray:
    """Stress of surfaces that press as a whole, at the corners of their outlines, (n_corners,); −inf of no force."""
    right = np.column_stack([np.ones(len(force)), np.nan_to_num(arms)])
    planes = np.linalg.solve(products_of(moments), right[:, :, None])[:, :, 0] * force[:, None]
    planes[~(force > 0.0)] = -np.inf, 0.0, 0.0
    of_corner = planes[np.repeat(np.arange(len(force)), np.diff(start))]
    return np.asarray(of_corner[:, 0] + (of_corner[:, 1:] * outlines).sum(axis=1))


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
