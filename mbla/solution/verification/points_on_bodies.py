"""Whether contact points on record lie on the bodies that they are said to belong to, from vertices and faces alone."""

from __future__ import annotations

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.faces.facets import build_facets
from mbla.model.solids.blocks import Blocks

SAME_PLACE = 1e-7
"""Distance over the size of a body within which points are one."""


def distances_from_bodies(blocks: Blocks, bodies: IntArray, arms: FloatArray) -> FloatArray:
    """Distance of points from the surface of their bodies, over the size of these, (n,); 0 of points of grounds.

    bodies : (n,) numbers of the blocks, beyond them of grounds
    arms   : (n, 3) m from the centroids, as built
    """
    found = np.zeros(len(bodies))
    own = np.flatnonzero(bodies < len(blocks))
    rough = np.round(arms[own] / (SAME_PLACE * blocks.sizes[bodies[own], None]))
    _, first, back = np.unique(np.column_stack([bodies[own], rough]), axis=0, return_index=True, return_inverse=True)
    body, places = bodies[own][first], blocks.centroids[bodies[own][first]] + arms[own][first]
    facets = build_facets(blocks)
    order = np.argsort(facets.blocks, kind="stable")
    begin = starts(np.bincount(facets.blocks, minlength=len(blocks)))
    count = np.diff(begin)[body]
    point = np.repeat(np.arange(len(body)), count)
    within = np.arange(len(point)) - np.repeat(np.cumsum(count) - count, count)
    facet = order[begin[body[point]] + within]
    local = np.einsum("nai,ni->na", facets.frames[facet], places[point] - facets.origins[facet])
    aside = shapely.distance(facets.polygons[facet], shapely.points(local[:, 1:]))
    away = np.hypot(local[:, 0], aside)
    nearest = np.full(len(body), np.inf)
    np.minimum.at(nearest, point, away)
    found[own] = (nearest / blocks.sizes[body])[back.ravel()]
    return found
