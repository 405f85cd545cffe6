"""Contacts as arrays: interfaces between bodies, and the contact points at their corners."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.contacts.outlines.overlay import Overlays, in_space
from mbla.contacts.outlines.refine import InterfacePoints
from mbla.errors import KeyPath, Notice, Refusal
from mbla.process.imports import import_scipy

import_scipy()  # before the stages that compute


@dataclass(frozen=True)
class Contacts:
    """Interfaces sorted by (body a, body b, position); body a < body b, but ground is always body a.

    bodies       : (n_interfaces, 2)  bodies a and b; block index, or len(blocks) + index of a ground plane
    normals      : (n_interfaces, 3)  unit, from a to b
    areas        : (n_interfaces,) m2
    centroids    : (n_interfaces, 3) m
    gaps         : (n_interfaces,) m  greatest distance between the two faces over the interface, negative
                   where they overlap
    joints       : (n_interfaces,)    row of ``joint_names``
    joint_names  : joint laws in use
    point_start  : (n_interfaces + 1,) contact points of interface i are points[point_start[i]:point_start[i + 1]]
    outline      : (n_interfaces,)    how many of them form the outer boundary, in order, counter-clockwise about the
                   normal; the rest are corners of holes
    points       : (n_points, 3) m
    frames       : (n_points, 3, 3)   rows: normal, tangent 1, tangent 2; right-handed; the same for all points of an
                   interface
    point_areas  : (n_points,) m2     share of the interface area: sums to the area, first moment about the centroid
                   zero
    solid_of_block : (n_blocks,)      blocks that are glued to each other have the number of one rigid body, numbered
                   in the order of first blocks; None where every block is one (see :mod:`mbla.contacts.glue`)
    cut          : (n_interfaces,)    1, -1: their forces act on the last block too, a load cell, as on body b or on
                   body a; 0: they do not; None without one (see :mod:`mbla.assembly.load_cell`); in no file

    ties         : in what the solver sees, ties as further interfaces behind all others, of one contact point each
                   (:mod:`mbla.assembly.ties`); None where there are none

    Internal interfaces (glued), and those whose joint law is open, are none of these.
    """

    bodies: IntArray
    normals: FloatArray
    areas: FloatArray
    centroids: FloatArray
    gaps: FloatArray
    joints: IntArray
    joint_names: tuple[str, ...]
    point_start: IntArray
    outline: IntArray
    points: FloatArray
    frames: FloatArray
    point_areas: FloatArray
    report: ContactReport
    solid_of_block: IntArray | None = None
    cut: IntArray | None = None
    ties: TieContacts | None = None

    def __len__(self) -> int:
        return len(self.areas)

    @staticmethod
    def on(
        overlays: Overlays,
        areas: tuple[FloatArray, FloatArray],
        found: InterfacePoints,
        joints: tuple[IntArray, tuple[str, ...]],
        gaps: FloatArray,
        report: ContactReport,
        solid_of_block: IntArray | None,
    ) -> Contacts:
        """The interfaces of overlays, in space and in the deck's unit of length.

        areas  : area and centroid of each, relative to block size
        found  : their points, relative to block size
        joints : row of each in the names of laws, and these names
        gaps   : (n,) m
        """
        size, interface = overlays.sizes, found.polygon
        return Contacts(
            bodies=overlays.bodies,
            normals=overlays.frames[:, 0],
            areas=areas[0] * size**2,
            centroids=in_space(overlays, np.arange(len(overlays)), areas[1]),
            gaps=gaps,
            joints=joints[0],
            joint_names=joints[1],
            point_start=starts(np.bincount(interface, minlength=len(overlays)).astype(np.int64)),
            outline=found.outline,
            points=in_space(overlays, interface, found.points),
            frames=overlays.frames[interface],
            point_areas=found.areas * size[interface] ** 2,
            report=report,
            solid_of_block=solid_of_block,
        )

    @property
    def by_joint(self) -> dict[str, tuple[int, float]]:
        """Number and total area [m2] of the interfaces of each joint law in use."""
        rows = [self.joints == law for law in range(len(self.joint_names))]
        each = [(int(own.sum()), float(self.areas[own].sum())) for own in rows]
        return dict(zip(self.joint_names, each, strict=True))

    @property
    def n_surfaces(self) -> int:
        """Number of interfaces that are surfaces, which come first; the others are ties."""
        return len(self) - (0 if self.ties is None else len(self.ties.rows))

    @cached_property
    def tie_points(self) -> BoolArray:
        """Which contact points are ties, (n_points,)."""
        return np.asarray(self.interface_of_point >= self.n_surfaces)

    @cached_property
    def interface_of_point(self) -> IntArray:
        """(n_points,)."""
        return row_of_item(self.point_start)

    @cached_property
    def cut_of_point(self) -> IntArray | None:
        """``cut`` of the interface of each contact point, (n_points,)."""
        return None if self.cut is None else np.asarray(self.cut[self.interface_of_point])


@dataclass(frozen=True)
class TieContacts:
    """Ties as contact points: their strengths, and the forces beside those along the line of two bodies.

    A tie has a force N = senses × (its tension) − offsets between −tension and compression, and no shear.

    rows     : (k,) which of the model's ties, in the order of their interfaces
    senses   : (k,) 1 where N is tension, −1 where it is compression
    offsets  : (k,) N of the force that acts as a dead load
    tension, compression : (k,) N
    brittle  : (k, 2) carries nothing any more once it has given way at its greatest N, and at its least
    points, bodies : (m,) of further forces: contact point, body that it acts on
    places   : (m, 3) m, where it acts
    forces   : (m, 3) of an N of 1
    """

    rows: IntArray
    senses: FloatArray
    offsets: FloatArray
    tension: FloatArray
    compression: FloatArray
    brittle: BoolArray
    points: IntArray
    bodies: IntArray
    places: FloatArray
    forces: FloatArray


class ContactsRefused(Refusal):
    """A model that the search for contacts cannot handle; ``path`` leads to the key of the deck that asks for it."""

    def __init__(self, identifier: str, words: str, path: KeyPath) -> None:
        super().__init__(identifier, words)
        self.path = path


@dataclass(frozen=True)
class ContactReport:
    """Findings of the search besides the contacts kept; blocks as body numbers.

    slivers        : (n, 2) bodies of common surfaces dropped because they are thinner than the tolerance
    sliver_widths  : (n,) relative to block size
    near_misses    : (n, 2) bodies with opposite faces that miss each other: by more than the tolerance somewhere, and
                     by at most ten times the tolerance amid the common surface
    near_miss_gaps : (n,) greatest distance over the common surface, relative to block size; negative where faces
                     overlap
    overlaps       : (n, 2) blocks that share volume deeper than the tolerance
    overlap_depths : (n,) how far they reach into each other, relative to block size
    overlap_swallows : (n,) where one reaches through half of the other
    unchecked      : (n, 2) pairs of blocks whose overlap could not be judged, because one is not a closed solid
    isolated       : blocks without any contact
    unsupported    : connected parts of free blocks that reach no support, each a sorted array of blocks (blocks without
                     contact included)
    fixed_contacts : contacts between bodies that are both fixed; they are left out of ``Contacts``, like the next two
    open_interfaces : interfaces whose joint law is open
    glued          : (n, 2) bodies of internal interfaces: glued ones, and others between blocks that glue joins anyway
    held           : blocks that do not move because they are glued to a support
    notices        : the above in words
    """

    slivers: IntArray
    sliver_widths: FloatArray
    near_misses: IntArray
    near_miss_gaps: FloatArray
    overlaps: IntArray
    overlap_depths: FloatArray
    overlap_swallows: BoolArray
    unchecked: IntArray
    isolated: IntArray
    unsupported: tuple[IntArray, ...]
    fixed_contacts: int
    open_interfaces: int
    glued: IntArray
    held: IntArray
    notices: tuple[Notice, ...]
