"""Sliding planes: interfaces between the same two clusters that slide in one plane and in one direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.by_interface import interface_radii
from mbla.results.collapse.cluster_joints import ClusterJoints, runs
from mbla.results.collapse.hinge_lines import loosened
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.work import Work

SAME_NORMAL = float(np.cos(np.radians(2.0)))
"""cosine from which two interfaces count as parallel"""
SAME_PLANE = 0.02
"""distance of two parallel interfaces, over their radius, up to which they lie in one plane"""
SAME_WAY = float(np.cos(np.radians(10.0)))
"""cosine from which two directions of sliding count as one: clusters that also turn slide a little otherwise at each
point"""


@dataclass(frozen=True)
class SlidingPlane:
    """A plane on which one cluster slides over another.

    clusters   : that which slides, and that over which it does; 0 is at rest and comes second
    interfaces : (n,) on it, in their order
    area       : m2, their sum
    centroid   : (3,) m, theirs by area
    normal     : (3,) unit, towards the cluster that slides
    direction  : (3,) unit, in which it slides over the other, in the plane
    twists     : it slides by turning about the normal; the direction is that of the mean and may mean little
    share      : of the power put in that is dissipated there; nan where none is put in
    shear      : the same of the shear forces alone: where joints dilate, normal forces give some or all of it back
    speed      : the largest contact speed of its interfaces over the largest of all
    """

    clusters: tuple[int, int]
    interfaces: IntArray
    area: float
    centroid: FloatArray
    normal: FloatArray
    direction: FloatArray
    twists: bool
    share: float
    shear: float
    speed: float


def sliding_planes(
    contacts: Contacts, motion: InterfaceMotion, joints: ClusterJoints, work: Work, merged: float = 0.0
) -> tuple[SlidingPlane, ...]:
    """Those between different clusters, by falling work of the shear forces, then by falling motion."""
    kinds = (InterfaceMode.SLIDE, InterfaceMode.TWIST)
    sliding = np.flatnonzero(np.isin(motion.modes, kinds) & joints.between)
    normals = joints.signs[:, None] * contacts.normals
    travel = joints.signs[:, None] * motion.translation
    travel -= np.einsum("ij,ij->i", travel, normals)[:, None] * normals
    speeds = np.linalg.norm(travel, axis=1)
    ways = travel / np.where(speeds > 0, speeds, 1.0)[:, None]
    size, one_way = interface_radii(contacts), loosened(SAME_WAY, merged)
    planes = []
    for run in runs(joints.pairs, sliding):
        rest = run
        while len(rest):
            seed = rest[0]
            off = np.abs((contacts.centroids[rest] - contacts.centroids[seed]) @ normals[seed])
            same = normals[rest] @ normals[seed] >= SAME_NORMAL
            same &= off <= SAME_PLANE * np.maximum(size[rest], size[seed])
            same &= (motion.modes[rest] == motion.modes[seed]) & (ways[rest] @ ways[seed] >= one_way)
            same[0] = True  # one that does not travel has no way to compare
            planes.append(_plane(contacts, motion, joints, work, rest[same], normals, travel))
            rest = rest[~same]
    return tuple(sorted(planes, key=lambda p: (-round(np.nan_to_num(p.shear), 6), -round(p.speed, 6), p.interfaces[0])))


def _plane(
    contacts: Contacts,
    motion: InterfaceMotion,
    joints: ClusterJoints,
    work: Work,
    interfaces: IntArray,
    normals: FloatArray,
    travel: FloatArray,
) -> SlidingPlane:
    areas = contacts.areas[interfaces]
    mean = areas @ travel[interfaces]
    given = work.given or float("nan")
    shear = float(work.friction[interfaces].sum() + work.cohesion[interfaces].sum())
    return SlidingPlane(
        clusters=joints.clusters(interfaces[0]),
        interfaces=interfaces,
        area=float(areas.sum()),
        centroid=areas @ contacts.centroids[interfaces] / areas.sum(),
        normal=normals[interfaces[0]],
        direction=mean / (float(np.linalg.norm(mean)) or 1.0),
        twists=bool(motion.modes[interfaces[0]] == InterfaceMode.TWIST),
        share=float(work.dissipated[interfaces].sum()) / given,
        shear=shear / given,
        speed=float(joints.shares[interfaces].max()),
    )
