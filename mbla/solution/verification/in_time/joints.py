"""Contact points of a time history held against joint laws of the deck: where they are, how stiff they are, their axes.

Two bodies that touch as built share the stiffness of that area whatever part of it still touches; others that of the
mean area. Fewer points than ``CORNERS`` have less, each its part of as many. At later searches points that stay keep
what they have, and others come or go beside them. Without a stiffness in the deck a block of mean weight W and size s
overlaps by ``SAG`` of s over the mean area A: k = W/(A SAG s).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import Joint, LoadCase
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.verification.in_time.bodies import Solids
from mbla.solution.verification.points_on_bodies import distances_from_bodies

AWAY = 0.05
"""Distance of a contact point from its body, over the size of the body, beyond which it is not on the body."""

SKEW = 1e-6
"""Products of the unit vectors of a frame up to which they are at right angles; differences of stiffnesses."""

SAG, CORNERS, CARRIED = 1e-6, 4, 3.0
"""As told above, and by how much stiffer than its area a pair of bodies may be at later searches."""


def points_failures(contacts: Contacts, case: LoadCase, solids: Solids, frames: Frames) -> Iterator[Message]:
    """Where contact points are on no body, their axes not at right angles, or their stiffness another."""
    areas = Areas.of(contacts, case, solids)
    for number, points in enumerate(frames.sets):
        for words in _wrong(areas, solids, points, not number):
            yield Message("time-points", f"search {number} has contact points {words}")


def _wrong(areas: Areas, solids: Solids, points: PointSet, first: bool) -> Iterator[str]:
    """Of one search, the first or a later one."""
    on = points.bodies[:, 0] >= 0
    bodies, laws, axes = points.bodies[on], points.laws[on], points.frames[on]
    last = len(solids) + len(solids.model.grounds)
    if (bodies >= last).any() or (laws < 0).any() or (laws >= len(areas.laws)).any():
        yield "with bodies or joint laws that the deck does not have"
        return
    if not np.abs(axes @ axes.transpose(0, 2, 1) - np.eye(3)).max(initial=0.0) <= SKEW:
        yield "whose frames are not of unit vectors at right angles"
    if any(not _away(solids, bodies[:, side], points.arms[on, side]) <= AWAY for side in (0, 1)):
        yield "that are on no body"
    if not areas.fit(bodies, laws, points.stiffness[on], first):
        yield "that are not as stiff as their joints"


def _away(solids: Solids, bodies: IntArray, arms: FloatArray) -> float:
    """Largest distance of material points from the nearest block of their body, over its size."""
    blocks, order = solids.model.blocks, np.argsort(solids.label, kind="stable")
    count = np.bincount(solids.label)
    on = bodies < len(solids)
    own = bodies[on]
    point = np.repeat(np.arange(len(own)), count[own])
    within = np.arange(len(point)) - np.repeat(np.cumsum(count[own]) - count[own], count[own])
    block = order[starts(count)[own][point] + within]
    places = (solids.centres[own] + arms[on])[point] - blocks.centroids[block]
    nearest = np.full(len(own), np.inf)
    np.minimum.at(nearest, point, distances_from_bodies(blocks, block, places))
    return float(nearest.max(initial=0.0))


@dataclass(frozen=True)
class Areas:
    """Areas that pairs of bodies share as built, and stiffnesses of joint laws.

    numbers : (n_pairs,) one of each pair, ascending
    shared  : (n_pairs,) m²
    laws    : of the model
    usual   : stiffness of joints for which the deck gives none, force per volume
    bodies  : how many there are, grounds among them
    """

    numbers: IntArray
    shared: FloatArray
    laws: list[Joint]
    usual: float
    bodies: int

    @staticmethod
    def of(contacts: Contacts, case: LoadCase, solids: Solids) -> Areas:
        """Of a structure as built."""
        model, count = solids.model, len(solids) + len(solids.model.grounds)
        body = np.append(solids.label, len(solids) + np.arange(len(model.grounds)))[contacts.bodies]
        between = body[:, 0] != body[:, 1]
        numbers, row = np.unique(_numbers(body[between], count), return_inverse=True)
        shared = np.asarray(np.bincount(row.ravel(), contacts.areas[between], len(numbers)), dtype=np.float64)
        loads = np.linalg.norm(case.dead_load[~model.fixed, :3], axis=1)
        weight = float(loads[loads > 0.0].mean()) if (loads > 0.0).any() else np.nan
        usual = weight / (float(shared.mean()) * SAG * float(solids.sizes[solids.free].mean()))
        return Areas(numbers, shared, list(model.joints.values()), usual, count)

    def fit(self, bodies: IntArray, laws: IntArray, stiffness: FloatArray, first: bool) -> bool:
        """Whether points of bodies (n, 2) with laws (n,) of a search are as stiff, (n, 3), as they are to be."""
        ratio = np.array([law.shear_ratio for law in self.laws])[laws]
        normal = np.array([law.normal_stiffness for law in self.laws])[laws]
        normal = np.where(np.isnan(normal), self.usual, normal)
        along = np.abs(stiffness[:, 1:] - (ratio * stiffness[:, 0])[:, None])
        pairs, row = np.unique(_numbers(bodies, self.bodies), return_inverse=True)
        place = np.minimum(np.searchsorted(self.numbers, pairs), len(self.numbers) - 1)
        area = np.where(self.numbers[place] == pairs, self.shared[place], self.shared.mean())
        own = np.bincount(row.ravel(), stiffness[:, 0] / normal, len(pairs)) / area
        count = np.minimum(np.bincount(row.ravel(), minlength=len(pairs)) / CORNERS, 1.0)
        exact = (np.abs(own - 1.0) <= SKEW) | (np.abs(own - count) <= SKEW)
        whole = exact if first else (own > 0.0) & (own <= CARRIED)
        return bool((along <= SKEW * stiffness[:, :1]).all() and whole.all())


def _numbers(bodies: IntArray, count: int) -> IntArray:
    low, high = np.sort(bodies, axis=1).T
    return np.asarray(low * count + high)
