"""How far a hinge reaches within its interface.

The faces of a hinge touch at its closed points, which lie on its axis unless they slide too: with dilatancy one end
lifts more than the other, and the axis through their mean leaves the interface. The hinge reaches then from the closed
point that lies first along the axis to that which lies last, one and the same where it turns about a corner. Where it
crushes, its axis crosses the interface beside the closed points and reaches from boundary to boundary.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts

CRUSHED = 0.02
"""Distance of the axis from the mean of the closed points, over the radius of the interface, from which it runs beside
them: less is no crushing that a reader of the ends would see."""


def hinge_ends(
    contacts: Contacts, is_open: BoolArray, points: FloatArray, directions: FloatArray, crushed: BoolArray
) -> FloatArray:
    """First and last point of every hinge, (n_interfaces, 2, 3) m; nan for other modes.

    is_open    : (n_points,)
    points, directions : (n_interfaces, 3) of the axes, nan where there is no hinge
    crushed    : (n_interfaces,) the axis runs beside the closed points
    """
    owner = contacts.interface_of_point
    hinge = np.isfinite(points[:, 0])
    closed = np.flatnonzero(hinge[owner] & ~crushed[owner] & ~is_open)
    across, crossings = _crossings(contacts, points, directions, hinge & crushed)
    places, owners = np.concatenate([contacts.points[closed], crossings]), np.concatenate([owner[closed], across])
    ends = np.full((len(contacts), 2, 3), np.nan)
    order = np.lexsort((np.einsum("ij,ij->i", places - points[owners], directions[owners]), owners))
    rows, first, count = np.unique(owners[order], return_index=True, return_counts=True)
    ends[rows, 0], ends[rows, 1] = places[order[first]], places[order[first + count - 1]]
    return ends


def _crossings(
    contacts: Contacts, points: FloatArray, directions: FloatArray, chosen: BoolArray
) -> tuple[IntArray, FloatArray]:
    """Where axes cross the outer boundary of their interfaces: interface and place, (n,) and (n, 3)."""
    owner = contacts.interface_of_point
    place = np.arange(len(owner)) - contacts.point_start[owner]
    rows = np.flatnonzero(chosen[owner] & (place < contacts.outline[owner]))
    here = owner[rows]
    following = np.where(place[rows] + 1 == contacts.outline[here], contacts.point_start[here], rows + 1)
    across = np.cross(contacts.normals[here], directions[here])
    one, other = (np.einsum("ij,ij->i", contacts.points[end] - points[here], across) for end in (rows, following))
    cut = (one * other <= 0.0) & (one != other)
    share = (one[cut] / (one[cut] - other[cut]))[:, None]
    start, stop = contacts.points[rows[cut]], contacts.points[following[cut]]
    return here[cut], start + share * (stop - start)
