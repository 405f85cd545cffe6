"""Torsion of interfaces in a program, reduced or not, as cones: see :mod:`mbla.program.resultants.torsion`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.conditions import Conditions
from mbla.program.program import Program
from mbla.program.resultants.torsion import torsion_rows
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces


def torsion_conditions(
    full: Program, forces: sp.csr_array, interfaces: TwistingInterfaces, chosen: BoolArray
) -> Conditions | None:
    """The conditions of chosen interfaces, (n_interfaces,), that a spatial program has points of; None without.

    forces : (3 n_points of the model, 3 n_points) see ``Lift``
    """
    seen = np.zeros(len(chosen), dtype=bool)
    seen[interfaces.interface_of_point[np.diff(forces[::3].indptr) > 0]] = True
    limits = interfaces.limits.only((seen & chosen)[interfaces.limits.interfaces])
    n, lengths = len(limits.interfaces), np.ones(len(chosen))
    if not n:
        return None
    lengths[limits.interfaces] = limits.radii
    map_ = sp.csr_array(_resultants(full, interfaces, lengths) @ forces)
    unit = float(np.abs(sp.csr_array(map_[(6 * limits.interfaces)]).data).max())
    without_unit = replace(
        limits,
        cohesion=limits.cohesion / (full.scaling.force * unit),
        radii=np.ones(n),
        corners=limits.corners / np.repeat(limits.radii, np.diff(limits.start))[:, None],
    )
    rows = torsion_rows(without_unit, len(chosen))
    by_length = np.column_stack([np.ones((len(chosen), 3)), np.repeat(1.0 / lengths[:, None], 3, axis=1)]).ravel()
    motions = sp.csr_array(sp.diags_array(by_length / unit) @ rows.motion)
    return Conditions(
        velocities=sp.csr_array(map_.T @ rows.motion / unit),
        cost=rows.cost,
        cones=rows.cones,
        cone_sizes=rows.cone_sizes,
        motions=(motions, sp.csr_array(motions.shape)),
        reserves=(),
        single=np.full(len(rows.cost), -1),
    )


def _resultants(full: Program, interfaces: TwistingInterfaces, lengths: FloatArray) -> sp.csr_array:
    """N, T1, T2 and moments about normal, tangent 1 and tangent 2 at the centroid over a length, (6 n, 3 n_points).

    lengths : (n_interfaces,)
    """
    owner, n = interfaces.interface_of_point, len(lengths)
    x1, x2 = (interfaces.places / lengths[owner][:, None]).T
    point, one = np.arange(len(owner)), np.ones(len(owner))
    # M_n = x1 T2 − x2 T1; M_1 = x2 N; M_2 = −x1 N
    terms = [(0, 0, one), (1, 1, one), (2, 2, one), (3, 2, x1), (3, 1, -x2), (4, 0, x2), (5, 0, -x1)]
    rows = np.concatenate([6 * owner + row for row, _, _ in terms])
    columns = np.concatenate([3 * point + column for _, column, _ in terms])
    units = np.broadcast_to(full.scaling.units, owner.shape)
    values = np.concatenate([units * value for _, _, value in terms])
    return sp.csr_array(sp.coo_array((values, (rows, columns)), shape=(6 * n, 3 * len(owner))))
