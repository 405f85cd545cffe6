"""Shares of the stiffness of joints that the contact points of a reduced program have, and which of them are brittle.

Normal stiffness is in proportion to area, and the points of an interface share it equally: shares by the area nearest
to each point would hang on rounding of the coordinates. Ties are as stiff as the mean of the points.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts
from mbla.program.program import Program, Reduction


def equal_shares(contacts: Contacts) -> FloatArray:
    """Area of each point of all contacts, (n_points,), interfaces divided equally; of ties the mean."""
    of_point = contacts.interface_of_point
    shares = (contacts.areas / np.maximum(np.diff(contacts.point_start), 1))[of_point]
    joints = np.ones(len(shares), dtype=bool)
    joints[contacts.tie_points] = False
    shares[~joints] = shares[joints].mean() if joints.any() else 1.0
    return np.asarray(shares)


def shares_of(program: Program) -> FloatArray:
    """Those of a program's points, (n_points,) with mean 1, from the areas of the points of the full model.

    Points that stand for several, as those of a planar program, are as stiff as these together.
    """
    shares = _through(program)
    return np.asarray(shares / shares.mean()) if len(shares) else shares


def brittle_of(program: Program) -> BoolArray:
    """Which of a program's points lose their force at their greatest and at their least one, (n_points, 2)."""
    reduction = program.reduction
    if reduction is None:
        none = np.zeros((program.n_points, 2), dtype=np.bool_)
        return none if program.brittle is None else program.brittle
    above = brittle_of(reduction.full)
    return np.asarray(_stands_for(program, reduction).T @ above.astype(np.float64) > 0.0)


def _through(program: Program) -> FloatArray:
    reduction = program.reduction
    if reduction is None:
        assert program.areas is not None  # of the full model
        return program.areas
    above = _through(reduction.full)
    shares = np.asarray(_stands_for(program, reduction).T @ above)
    return np.asarray(np.where(shares > 0.0, shares, above.mean()))


def _stands_for(program: Program, reduction: Reduction) -> sp.csr_array:
    """1 where a point, by columns, stands for one of the program that was reduced, by rows."""
    normal = sp.csr_array(reduction.forces[:: reduction.full.components][:, :: program.components])
    normal.eliminate_zeros()
    normal.data = np.ones_like(normal.data)
    return normal
