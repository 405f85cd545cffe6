"""Rings of blocks about the z axis, with planar faces.

A circle is a regular polygon of n sides with its corners on the circle, the same for all rings, and each block spans a
whole number of them, its facets: half a block more or less are still whole facets, so that the rings of a running bond
meet facet on facet. Between two neighbouring meridians every joint is a plane, a trapezoid with two parallel sides; a
bed joint that rises towards the outside is a funnel of such trapezoids, into which the blocks above fit and round which
those below are cut. Blocks of several facets are not convex, but all their faces are plane and no gap is left anywhere.

Sections at every height are regular polygons, of area n/2 sin(2 pi/n) rho^2 instead of pi rho^2: with A the area of the
profile and rho its centroid's distance from the axis, a ring has the volume n sin(2 pi/n) A rho.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.generators.chains import chains
from mbla.model.solids.polyhedra import Polyhedra


def meridians(count: int) -> FloatArray:
    """Directions (count, 2) of the corners of a regular polygon, the first along x."""
    angles = 2 * np.pi / count * np.arange(count)
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def ring_blocks(profile: FloatArray, segments: int, facets: int, turned: bool) -> Polyhedra:
    """The blocks of one ring, counter-clockwise as seen from above.

    profile  : (n_corners, 2) distance from the axis and height, clockwise with the axis to the left
    segments : number of blocks
    facets   : sides of the polygon that a block spans
    turned   : the ring begins half a block on; facets is even then
    """
    first = facets * np.arange(segments) + (facets // 2 if turned else 0)
    corner = (first[:, None] + np.arange(facets + 1)) % (segments * facets)
    around = meridians(segments * facets)[corner]
    stations = np.empty((*corner.shape, len(profile), 3))
    stations[..., :2] = around[:, :, None, :] * profile[:, :1]
    stations[..., 2] = profile[:, 1]
    return chains(stations)
