"""Hinge lines: hinges of interfaces between the same two clusters that lie on one line.

A wall that tilts over has a hinge under each of its stones; they share one axis and are one hinge line. Where clusters
were merged up to a share of the motion, their hinges may differ by as much and are still one line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.by_interface import interface_radii
from mbla.results.collapse.cluster_joints import ClusterJoints, runs
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.work import Work

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
    shear      : share of the power put in that their shear forces take; nan where none is put in
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
    shear: float

    @property
    def length(self) -> float:
        """From end to end, m."""
        return float(np.linalg.norm(self.end - self.start))


def hinge_lines(
    contacts: Contacts, motion: InterfaceMotion, joints: ClusterJoints, work: Work, merged: float = 0.0
) -> tuple[HingeLine, ...]:
    """Those between different clusters, by falling share of the motion, then by their first interface."""
    hinges = np.flatnonzero((motion.modes == InterfaceMode.HINGE) & joints.between)
    directions = joints.signs[:, None] * motion.hinge_directions
    size, parallel = interface_radii(contacts), loosened(SAME_DIRECTION, merged)
    lines = []
    for run in runs(joints.pairs, hinges):
        rest = run
        while len(rest):
            seed = rest[0]
            arms = motion.hinge_points[rest] - motion.hinge_points[seed]
            off = np.linalg.norm(np.cross(arms, directions[seed]), axis=1)
            same = (directions[rest] @ directions[seed] >= parallel) & (
                off <= (SAME_LINE + merged) * np.maximum(size[rest], size[seed])
            )
            lines.append(_line(motion, joints, work, rest[same], directions[seed]))
            rest = rest[~same]
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
        shear=float((work.friction + work.cohesion)[interfaces].sum()) / (work.given or float("nan")),
    )
