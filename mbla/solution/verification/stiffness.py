"""Stiffness that elastic joints should have over each other's, written a second time for verification.

The corners of an interface share its area equally; where its outline goes straight on at some points, as on a grid,
each has the stiffness of its own share. Ties are as stiff as the mean of the points.

Blocks of less than 1e-8 of the mean load that touch no more than one other body, by themselves or as a pile, are solved
in units of their own load, and their joints are as stiff as others in these: over the mean of their kind, times the
square of the unit.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.solution.verification.statics import lever_arms, load_sizes

STRAIGHT_ON = 1e-6
"""Sine of the turn of an outline at a point that counts as none."""

LIGHT = 1e-8
"""Load of a block over the mean load, below which it has a unit of its own."""


def relative_stiffness(model: Model, contacts: Contacts, load_case: LoadCase) -> FloatArray:
    """Normal stiffness of the points but for one common factor, (n_points,)."""
    areas, units = areas_of_stiffness(contacts), _units(model, contacts, load_case)
    kinds, kind = np.unique(units, return_inverse=True)
    means = np.array([areas[units == unit].mean() for unit in kinds])
    return np.asarray(areas / means[kind] * units**2)


def areas_of_stiffness(contacts: Contacts) -> FloatArray:
    """Area that each point is as stiff as, (n_points,)."""
    of, corners = contacts.interface_of_point, np.diff(contacts.point_start)
    first, count = contacts.point_start[:-1][of], corners[of]
    place = np.arange(len(of)) - first
    into = contacts.points - contacts.points[first + (place - 1) % count]
    out = contacts.points[first + (place + 1) % count] - contacts.points
    sizes = np.linalg.norm(into, axis=1) * np.linalg.norm(out, axis=1)
    straight = np.linalg.norm(np.cross(into, out), axis=1) <= STRAIGHT_ON * sizes
    as_a_grid = np.bincount(of, straight, len(contacts)) > 0
    areas = np.where(as_a_grid[of], contacts.point_areas, (contacts.areas / np.maximum(corners, 1))[of])
    joints = ~contacts.tie_points
    areas[~joints] = areas[joints].mean() if joints.any() else 1.0
    return areas


def _units(model: Model, contacts: Contacts, load_case: LoadCase) -> FloatArray:
    """Unit of the forces at each point over the common one, (n_points,)."""
    n, moves = len(model.blocks), np.append(~model.fixed, False)
    loads = np.append(load_sizes(load_case.dead_load, lever_arms(model, contacts)), 0.0) * moves
    loads = loads / loads[loads > 0].mean() if loads.any() else loads
    light = (loads > 0) & (loads < LIGHT)
    light[model.guides.blocks] = False  # guides press back whatever presses on such a block
    units = np.ones(n + 1)
    ends = np.minimum(contacts.bodies, n)
    ends = np.where(moves[ends], ends, n)  # what does not move is one body
    if light.any() and load_case.question.multiplies:
        both, one = light[ends].all(axis=1), light[ends].sum(axis=1) == 1
        graph = coo_array((np.ones(both.sum()), ends[both].T), shape=(n + 1, n + 1))
        pile = connected_components(graph, directed=False)[1]
        small, large = np.where(light[ends[one, 0], None], ends[one], ends[one, ::-1]).T
        neighbours = np.bincount(np.unique(np.column_stack([pile[small], large]), axis=0)[:, 0], minlength=n + 1)
        most = np.zeros(n + 1)
        np.maximum.at(most, pile, loads)
        units = np.where(light & (neighbours[pile] <= 1), most[pile], 1.0)
    return np.asarray(units[ends].min(axis=1)[contacts.interface_of_point])
