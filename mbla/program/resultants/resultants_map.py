"""From contact forces to the resultants of interfaces."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.program.resultants.shapes import local_points


def resultants_map(contacts: Contacts) -> sp.csr_array:
    """The map from contact forces to the resultants of the interfaces, (6 n_interfaces, 3 n_points).

    N, T1, T2 and moments about normal, tangent 1 and tangent 2 at the centroid; lengths in the deck's units.
    """
    places = local_points(contacts)
    places[np.abs(places) < 1e-14 * np.hypot(*places.T).max(initial=0.0)] = 0.0
    return resultants_of_points(places, contacts.interface_of_point, len(contacts))


def resultants_of_points(
    places: FloatArray, interface: IntArray, n_interfaces: int, units: FloatArray | float = 1.0
) -> sp.csr_array:
    """The same for points at places in their interfaces, (n_points, 2), with forces in units, (n_points,)."""
    x1, x2 = places.T
    point, one = np.arange(len(interface)), np.ones(len(interface))
    # N, T1, T2; M_n = x1 T2 − x2 T1; M_1 = x2 N; M_2 = −x1 N
    terms = [(0, 0, one), (1, 1, one), (2, 2, one), (3, 2, x1), (3, 1, -x2), (4, 0, x2), (5, 0, -x1)]
    rows = np.concatenate([6 * interface + row for row, _, _ in terms])
    columns = np.concatenate([3 * point + column for _, column, _ in terms])
    values = np.concatenate([units * value for _, _, value in terms])
    return sp.csr_array(sp.coo_array((values, (rows, columns)), shape=(6 * n_interfaces, 3 * len(interface))))
