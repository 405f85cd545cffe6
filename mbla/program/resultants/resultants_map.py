"""From contact forces to the resultants of interfaces."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.contacts.contacts import Contacts
from mbla.program.resultants.shapes import local_points


def resultants_map(contacts: Contacts) -> sp.csr_array:
    """The map from contact forces to the resultants of the interfaces, (6 n_interfaces, 3 n_points).

    N, T1, T2 and moments about normal, tangent 1 and tangent 2 at the centroid; lengths in the deck's units.
    """
    arms = local_points(contacts)
    arms[np.abs(arms) < 1e-14 * np.hypot(*arms.T).max(initial=0.0)] = 0.0
    x1, x2 = arms.T
    interface = contacts.interface_of_point
    point = np.arange(len(interface))
    one = np.ones(len(interface))
    # N, T1, T2; M_n = x1 T2 − x2 T1; M_1 = x2 N; M_2 = −x1 N
    terms = [(0, 0, one), (1, 1, one), (2, 2, one), (3, 2, x1), (3, 1, -x2), (4, 0, x2), (5, 0, -x1)]
    rows = np.concatenate([6 * interface + row for row, _, _ in terms])
    columns = np.concatenate([3 * point + column for _, column, _ in terms])
    values = np.concatenate([value for _, _, value in terms])
    shape = (6 * len(contacts), 3 * len(interface))
    return sp.csr_array(sp.coo_array((values, (rows, columns)), shape=shape))
