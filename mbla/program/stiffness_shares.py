"""Shares of the stiffness of joints that the contact points of a reduced program have, and which of them are brittle.

Normal stiffness is in proportion to area, and the corners of an interface share it equally: shares by the area nearest
to each would hang on rounding of the coordinates. Where a deck asks for more points than corners each has the stiffness
of its own area, as on a grid, whose sum goes to the integral. Ties are as stiff as the mean of the points.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts
from mbla.program.program import Program
from mbla.program.reductions.scene import refined


def stiffness_areas(contacts: Contacts) -> FloatArray:
    """Area that each point of all contacts is as stiff as, (n_points,); of ties the mean."""
    of_point, joints = contacts.interface_of_point, ~contacts.tie_points
    shares = (contacts.areas / np.maximum(np.diff(contacts.point_start), 1))[of_point]
    own = np.zeros(len(shares), dtype=bool)
    own[joints] = refined(of_point[joints], contacts.points[joints], contacts.frames[joints, 0])
    shares[own] = contacts.point_areas[own]
    shares[~joints] = shares[joints].mean() if joints.any() else 1.0
    return np.asarray(shares)


def shares_in_units(areas: FloatArray, units: FloatArray | float) -> FloatArray:
    """Shares of points, (n_points,), from their areas: those with forces in one unit have mean 1."""
    every, number = np.unique(np.broadcast_to(units, len(areas)), return_inverse=True)
    mean = np.bincount(number, areas, len(every)) / np.bincount(number, minlength=len(every))
    return np.asarray(areas / mean[number])


def shares_of(program: Program) -> FloatArray:
    """Those of a program's points, (n_points,) with mean 1, from the areas of the points of the full model.

    A point of a reduced program is as stiff as those that it stands for: with forces x = P y their compliances add up,
    1/k_y = Σ P² / k_x. Points of light blocks, whose forces have units of their own, are as stiff as others in these.
    """
    shares = stiffness_through(program)
    return np.asarray(shares / shares.mean()) if len(shares) else shares


def brittle_of(program: Program) -> BoolArray:
    """Which of a program's points lose their force at their greatest and at their least one, (n_points, 2)."""
    brittle = program.facts.brittle
    if brittle is None:
        return np.zeros((program.n_points, 2), dtype=np.bool_)
    return np.asarray(abs(program.lift.normal_forces).T @ brittle.astype(np.float64) > 0.0)


def stiffness_through(program: Program) -> FloatArray:
    """Stiffness of a program's points over the mean of those of the full model, (n_points,)."""
    shares, lift = shares_in_units(program.facts.areas, program.scaling.units), program.reduction
    if lift is None:
        return shares
    compliance = np.asarray(lift.normal_forces.power(2).T @ (1.0 / shares))
    return np.asarray(np.where(compliance > 0.0, 1.0 / np.maximum(compliance, 1e-300), shares.mean()))
