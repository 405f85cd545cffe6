"""What the points of an interface amount to."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts


def sum_by_interface(contacts: Contacts, values: FloatArray | BoolArray) -> FloatArray:
    """Sum over the points of each interface, (n_interfaces, ...) from (n_points, ...)."""
    total = np.zeros((len(contacts), *values.shape[1:]))
    np.add.at(total, contacts.interface_of_point, values)
    return total


def largest_by_interface(contacts: Contacts, values: FloatArray) -> FloatArray:
    """Largest over the points of each interface, 0 or more, (n_interfaces,) from (n_points,)."""
    largest = np.zeros(len(contacts))
    np.maximum.at(largest, contacts.interface_of_point, values)
    return largest


def interface_radii(contacts: Contacts) -> FloatArray:
    """Distance of the farthest point of each interface from its centroid, (n_interfaces,) m."""
    arms = contacts.points - contacts.centroids[contacts.interface_of_point]
    return largest_by_interface(contacts, np.linalg.norm(arms, axis=1))
