"""Interfaces between clusters: which two meet in each, which of them moves, and how much."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.by_interface import largest_by_interface
from mbla.results.collapse.interface_modes import TOGETHER
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class ClusterJoints:
    """Clusters on both sides of every interface.

    pairs   : (n_interfaces, 2) the cluster that moves, and that against which it does; of two that move the lighter
              one, which has the higher number, comes first, and rest (0) always second
    signs   : (n_interfaces,) 1 where the first is that of body b, whose motion relative to body a is known, else -1
    between : (n_interfaces,) the clusters differ and move against each other there
    shares  : (n_interfaces,) largest contact speed of each over the largest of all
    """

    pairs: IntArray
    signs: FloatArray
    between: BoolArray
    shares: FloatArray

    def clusters(self, interface: int) -> tuple[int, int]:
        """Both clusters of an interface."""
        first, second = self.pairs[interface].tolist()
        return first, second


def cluster_joints(model: Model, contacts: Contacts, clusters: IntArray, mechanics: Mechanics) -> ClusterJoints:
    """From the cluster of each block, (n_blocks,)."""
    of_body = np.append(clusters, np.zeros(len(model.grounds), dtype=np.int64))
    a, b = of_body[contacts.bodies].T
    speeds = largest_by_interface(contacts, np.linalg.norm(mechanics.contact_velocities, axis=1))
    shares = speeds / (float(speeds.max(initial=0.0)) or 1.0)
    return ClusterJoints(
        pairs=np.stack([np.maximum(a, b), np.minimum(a, b)], axis=1),
        signs=np.where(b >= a, 1.0, -1.0),
        between=(a != b) & (shares > TOGETHER),
        shares=shares,
    )


def runs(pairs: IntArray, chosen: IntArray) -> Iterator[IntArray]:
    """Chosen interfaces by the clusters that meet in them, each run in its order."""
    if not len(chosen):
        return
    order = np.lexsort((chosen, pairs[chosen, 1], pairs[chosen, 0]))
    ordered = chosen[order]
    new = np.any(np.diff(pairs[ordered], axis=0) != 0, axis=1)
    yield from np.split(ordered, np.flatnonzero(new) + 1)


def points_of(contacts: Contacts, interfaces: IntArray) -> IntArray:
    """Contact points of some interfaces, one after the other."""
    return np.concatenate([np.arange(contacts.point_start[i], contacts.point_start[i + 1]) for i in interfaces])
