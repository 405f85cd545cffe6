"""Torsion of interfaces in a program, reduced or not, as cones: see :mod:`mbla.program.resultants.torsion`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray
from mbla.program.conditions import Conditions
from mbla.program.program import Program
from mbla.program.resultants.resultants_map import resultants_of_points
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
    owner = interfaces.interface_of_point  # moments are over the length of their interface
    places = interfaces.places / lengths[owner][:, None]
    map_ = sp.csr_array(resultants_of_points(places, owner, len(chosen), full.scaling.units) @ forces)
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
