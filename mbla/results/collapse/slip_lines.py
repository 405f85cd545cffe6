"""Slip lines: surfaces in soil of cells along which parts of a mechanism move against each other.

They consist of joints of cells, with each other, with blocks and with ground. Which of them hinge and which slide says
how the soil is divided, not how it fails: what moves there is a line from cell to cell, as far as these are connected.
Along walls beside it, such as spandrels, soil slips on a surface, which is told from its lowest corner to the farthest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.measures import connected_labels
from mbla.results.collapse.cracks import touching_pairs
from mbla.results.collapse.joint_planes import ClusterJoints
from mbla.results.collapse.mechanics import Work

DECIMALS = 6
"""of m, to which ends of cells that meet are the same place"""
BESIDE = 0.5
"""cosine between the normal of an interface and the direction across the soil, above which it is beside it"""


@dataclass(frozen=True)
class SlipLine:
    """Joints of soil between two clusters.

    clusters    : that which moves, and that against which it does; 0 is at rest and comes second
    interfaces  : (n,) from start to end
    start, end  : (3,) m, of it in the middle of the width; the start is the lower one in z, x, then y; of a surface
                  beside the soil two corners
    length      : m along it
    area        : m2
    share       : the largest contact speed of its interfaces over the largest of all
    shear_power_share : of the power put in, what its shear forces take; nan where none is put in
    """

    clusters: tuple[int, int]
    interfaces: IntArray
    start: FloatArray
    end: FloatArray
    length: float
    area: float
    share: float
    shear_power_share: float


def slip_lines(
    model: Model, contacts: Contacts, joints: ClusterJoints, chosen: BoolArray, work: Work
) -> tuple[SlipLine, ...]:
    """Those of chosen interfaces, (n_interfaces,), by falling speed, then by their first interface."""
    moving = np.flatnonzero(joints.between & chosen)
    if not len(moving):
        return ()
    pairs = touching_pairs(contacts, moving)
    same = (joints.pairs[moving[pairs[:, 0]]] == joints.pairs[moving[pairs[:, 1]]]).all(axis=1)
    label = connected_labels(pairs[same], len(moving))
    soil = np.append(model.soil_of_block, np.full(len(model.grounds), -1))
    chains = (moving[label == row] for row in np.unique(label))
    found = [
        _slip_line(model, contacts, joints, chain, work, int(soil[contacts.bodies[chain]].max())) for chain in chains
    ]
    return tuple(sorted(found, key=lambda line: (-round(line.share, 6), int(line.interfaces.min()))))


def _slip_line(
    model: Model, contacts: Contacts, joints: ClusterJoints, interfaces: IntArray, work: Work, soil: int
) -> SlipLine:
    across = model.soils[soil].axes[2]
    beside = is_beside(contacts, interfaces, across)
    pieces = [_ends_of(contacts, interface, across) for interface in interfaces[~beside].tolist()]
    if beside.all():
        pieces = [_farthest(np.concatenate([_corners_of(contacts, each) for each in interfaces.tolist()]))]
    first, last = _ends_of_line(np.concatenate(pieces))
    order = np.argsort((contacts.centroids[interfaces] - first) @ (last - first), kind="stable")
    areas = contacts.areas[interfaces]
    return SlipLine(
        clusters=joints.clusters(int(interfaces[0])),
        interfaces=interfaces[order],
        start=first,
        end=last,
        length=float(sum(np.linalg.norm(piece[1] - piece[0]) for piece in pieces)),
        area=float(areas.sum()),
        share=float(joints.shares[interfaces].max()),
        shear_power_share=float((work.friction + work.cohesion)[interfaces].sum()) / (work.supplied or float("nan")),
    )


def is_beside(contacts: Contacts, interfaces: IntArray, across: FloatArray) -> BoolArray:
    """Which interfaces (n,) lie beside soil that has a plane across a direction, (3,), and not in its section, (n,)."""
    return np.asarray(np.abs(contacts.normals[interfaces] @ across) > BESIDE)


def _corners_of(contacts: Contacts, interface: int) -> FloatArray:
    """Contact points of an interface, (n, 3) m."""
    return contacts.points[contacts.point_start[interface] : contacts.point_start[interface + 1]]


def _ends_of(contacts: Contacts, interface: int, across: FloatArray) -> FloatArray:
    """Both ends of an interface in the plane of the soil, in the middle of the width, (2, 3) m."""
    points = _corners_of(contacts, interface)
    way = np.cross(across, contacts.normals[interface])
    centre = contacts.centroids[interface]
    along = (points - centre) @ way
    return np.asarray(centre + np.outer([along.min(), along.max()], way))


def _ends_of_line(ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Of the ends of its pieces, (2 n, 3) m, the two farthest apart of those that no other piece has, if any."""
    places, times = np.unique(np.round(ends, DECIMALS), axis=0, return_counts=True)
    pair = _farthest(places[times == 1] if (times == 1).sum() > 1 else places)
    first, last = sorted((pair + 0.0).tolist(), key=lambda place: (place[2], place[0], place[1]))
    return np.array(first), np.array(last)


def _farthest(places: FloatArray) -> FloatArray:
    """The two of places (n, 3) that are farthest apart, (2, 3)."""
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    return np.asarray(places[list(np.unravel_index(int(apart.argmax()), apart.shape))])
