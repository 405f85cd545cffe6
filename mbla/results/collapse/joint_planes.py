"""Joints between the parts of a mechanism as lines about which these turn, and planes along which they slide.

A wall that tilts over has a hinge under each of its stones; they share one axis and are one hinge line. Where clusters
were merged up to a share of the motion, their hinges may differ by as much and are still one line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import (
    TOGETHER,
    InterfaceMode,
    InterfaceMotion,
    interface_radii,
    largest_by_interface,
)
from mbla.results.collapse.mechanics import Work
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


def groups(pairs: IntArray, chosen: IntArray, same: Callable[[int, IntArray], BoolArray]) -> Iterator[IntArray]:
    """Chosen interfaces by the clusters that meet in them, then by what is the same as for the first of them.

    same : whether interfaces belong to a first one, (n,)
    """
    for pair in np.unique(pairs[chosen], axis=0):
        rest = chosen[(pairs[chosen] == pair).all(axis=1)]
        while len(rest):
            own = same(int(rest[0]), rest)
            own[0] = True  # one that does not travel has no way to compare
            yield rest[own]
            rest = rest[~own]


# --- Hinge lines: hinges of interfaces between the same two clusters that lie on one line ---------------------------


SAME_DIRECTION = float(np.cos(np.radians(2.0)))
"""cosine from which two axes count as parallel"""
SAME_LINE = 0.02
"""distance of two axes, over the radius of the interface, up to which they count as one line"""


@dataclass(frozen=True)
class HingeLine:
    """An axis about which one cluster turns relative to another.

    clusters   : that which turns, and that which it turns against; 0 is at rest and comes second
    interfaces : (n,) on it, in their order
    start, end : (3,) m, of the line, both in its interfaces; the same for a hinge about a corner
    direction  : (3,) unit; the first cluster turns about it relative to the second by the right hand. It leads from
                 start to end, but for hinges that slide too, whose closed points need not lie on their axis
    rotation   : the largest relative angular velocity of its interfaces
    share      : the largest contact speed of its interfaces over the largest of all
    slides     : closed points of it slide too
    crushes    : closed points of it crush too
    shear_power_share : of the power put in, what their shear forces take; nan where none is put in
    """

    clusters: tuple[int, int]
    interfaces: IntArray
    start: FloatArray
    end: FloatArray
    direction: FloatArray
    rotation: float
    share: float
    slides: bool
    crushes: bool
    shear_power_share: float

    @property
    def length(self) -> float:
        """From end to end, m."""
        return float(np.linalg.norm(self.end - self.start))


def hinge_lines(
    contacts: Contacts, motion: InterfaceMotion, joints: ClusterJoints, work: Work, merged: float = 0.0
) -> tuple[HingeLine, ...]:
    """Those between different clusters, by falling share of the motion, then by their first interface."""
    hinges = np.flatnonzero((motion.modes == InterfaceMode.HINGE) & joints.between)
    if not len(hinges):
        return ()
    directions = joints.signs[:, None] * motion.hinge_directions
    size, parallel = interface_radii(contacts), loosened(SAME_DIRECTION, merged)

    def on_one_line(seed: int, rest: IntArray) -> BoolArray:
        arms = motion.hinge_points[rest] - motion.hinge_points[seed]
        off = np.linalg.norm(np.cross(arms, directions[seed]), axis=1)
        near = off <= (SAME_LINE + merged) * np.maximum(size[rest], size[seed])
        return np.asarray(near & (directions[rest] @ directions[seed] >= parallel))

    found = groups(joints.pairs, hinges, on_one_line)
    lines = [_line(motion, joints, work, interfaces, directions[interfaces[0]]) for interfaces in found]
    return tuple(sorted(lines, key=lambda line: (-round(line.share, 6), line.interfaces[0])))


def loosened(cosine: float, merged: float) -> float:
    """The cosine of an angle that is larger by that whose sine is a share of the motion."""
    return float(np.cos(np.arccos(cosine) + np.arcsin(merged)))


def _line(
    motion: InterfaceMotion,
    joints: ClusterJoints,
    work: Work,
    interfaces: IntArray,
    direction: FloatArray,
) -> HingeLine:
    """From the first to the last of the ends of its hinges."""
    ends = motion.hinge_ends[interfaces].reshape(-1, 3)
    along = (ends - motion.hinge_points[interfaces[0]]) @ direction
    return HingeLine(
        clusters=joints.clusters(interfaces[0]),
        interfaces=interfaces,
        start=ends[along.argmin()],
        end=ends[along.argmax()],
        direction=direction,
        rotation=float(np.linalg.norm(motion.rotation[interfaces], axis=1).max()),
        share=float(joints.shares[interfaces].max()),
        slides=bool(motion.slides[interfaces].any()),
        crushes=bool(motion.crushes[interfaces].any()),
        shear_power_share=float((work.friction + work.cohesion)[interfaces].sum()) / (work.supplied or float("nan")),
    )


# --- Sliding planes -------------------------------------------------------------------------------------------------


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
    power_share : of the power put in, what is dissipated there; nan where none is put in
    shear_power_share : the same of the shear forces alone: where joints dilate, normal forces give some or all back
    share      : the largest contact speed of its interfaces over the largest of all
    """

    clusters: tuple[int, int]
    interfaces: IntArray
    area: float
    centroid: FloatArray
    normal: FloatArray
    direction: FloatArray
    twists: bool
    power_share: float
    shear_power_share: float
    share: float


def sliding_planes(
    contacts: Contacts, motion: InterfaceMotion, joints: ClusterJoints, work: Work, merged: float = 0.0
) -> tuple[SlidingPlane, ...]:
    """Those between different clusters, by falling work of the shear forces, then by falling motion."""
    kinds = (InterfaceMode.SLIDE, InterfaceMode.TWIST)
    sliding = np.flatnonzero(np.isin(motion.modes, kinds) & joints.between)
    if not len(sliding):
        return ()
    normals = joints.signs[:, None] * contacts.normals
    travel = joints.signs[:, None] * motion.translation
    travel -= np.einsum("ij,ij->i", travel, normals)[:, None] * normals
    speeds = np.linalg.norm(travel, axis=1)
    ways = travel / np.where(speeds > 0, speeds, 1.0)[:, None]
    size, one_way = interface_radii(contacts), loosened(SAME_WAY, merged)

    def in_one_plane(seed: int, rest: IntArray) -> BoolArray:
        off = np.abs((contacts.centroids[rest] - contacts.centroids[seed]) @ normals[seed])
        same = normals[rest] @ normals[seed] >= SAME_NORMAL
        same &= off <= SAME_PLANE * np.maximum(size[rest], size[seed])
        same &= (motion.modes[rest] == motion.modes[seed]) & (ways[rest] @ ways[seed] >= one_way)
        return np.asarray(same)

    found = groups(joints.pairs, sliding, in_one_plane)
    planes = [_plane(contacts, motion, joints, work, interfaces, normals, travel) for interfaces in found]
    return tuple(
        sorted(
            planes, key=lambda p: (-round(np.nan_to_num(p.shear_power_share), 6), -round(p.share, 6), p.interfaces[0])
        )
    )


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
    supplied = work.supplied or float("nan")
    shear = float(work.friction[interfaces].sum() + work.cohesion[interfaces].sum())
    return SlidingPlane(
        clusters=joints.clusters(interfaces[0]),
        interfaces=interfaces,
        area=float(areas.sum()),
        centroid=areas @ contacts.centroids[interfaces] / areas.sum(),
        normal=normals[interfaces[0]],
        direction=mean / (float(np.linalg.norm(mean)) or 1.0),
        twists=bool(motion.modes[interfaces[0]] == InterfaceMode.TWIST),
        power_share=float(work.dissipated[interfaces].sum()) / supplied,
        shear_power_share=shear / supplied,
        share=float(joints.shares[interfaces].max()),
    )
