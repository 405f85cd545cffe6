"""Modes of interfaces from the velocities of their contact points.

The faces of a hinge touch at its closed points, which lie on its axis unless they slide too: with dilatancy one end
lifts more than the other, and the axis through their mean leaves the interface. The hinge reaches then from the closed
point that lies first along the axis to that which lies last, one and the same where it turns about a corner. Where it
crushes, its axis crosses the interface off the closed points and reaches as far as these.

Two rigid bodies move against each other by one velocity v of body b relative to a at the centroid c of the interface
and one rotation ω; the velocity at a point x of it is v + ω × (x − c). What that is called is decided by ratios of the
motion of the interface itself and by the modes of its contact points (:mod:`mbla.solution.full_model.contact_modes`),
so that neither units nor the size of the mechanism matter:

- stick: nothing in it moves, measured by the fastest contact of the structure;
- open: all of its points open, or it opens without tilting;
- hinge: some open, others stay closed and slide less than those open; its axis runs through the closed ones;
- slide: closed points move along the interface (and lift by dilatancy, or open less than they slide elsewhere);
- twist: it slides, and the centre about which it turns lies nearer to its centroid than its farthest point does;
- crush: points close into each other, faster than they slide, and none opens. Where some do it is a hinge that crushes.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.ties.moved import elongations
from mbla.solution.solution import ContactMode, Mechanics


def sum_by_interface(contacts: Contacts, values: FloatArray | BoolArray) -> FloatArray:
    """Sum over the points of each interface, (n_interfaces, ...) from (n_points, ...)."""
    return summed(contacts.interface_of_point, values, len(contacts))


def largest_by_interface(contacts: Contacts, values: FloatArray) -> FloatArray:
    """Largest over the points of each interface, 0 or more, (n_interfaces,) from (n_points,)."""
    largest = np.zeros(len(contacts))
    np.maximum.at(largest, contacts.interface_of_point, values)
    return largest


def interface_radii(contacts: Contacts) -> FloatArray:
    """Distance of the farthest point of each interface from its centroid, (n_interfaces,) m."""
    arms = contacts.points - contacts.centroids[contacts.interface_of_point]
    return largest_by_interface(contacts, np.linalg.norm(arms, axis=1))


# --- How far a hinge reaches within its interface -------------------------------------------------------------------


CRUSHED = 0.02
"""Distance of the axis from the mean of the closed points, over the radius of the interface, from which it runs off
them: less is no crushing that a reader of the ends would see."""


def hinge_ends(
    contacts: Contacts, is_open: BoolArray, points: FloatArray, directions: FloatArray, crushed: BoolArray
) -> FloatArray:
    """First and last point of every hinge, (n_interfaces, 2, 3) m; nan for other modes.

    is_open    : (n_points,)
    points, directions : (n_interfaces, 3) of the axes, nan where there is no hinge
    crushed    : (n_interfaces,) the axis runs off the closed points, as far as these
    """
    closed = np.flatnonzero(np.isfinite(points[:, 0])[contacts.interface_of_point] & ~is_open)
    owners, places = contacts.interface_of_point[closed], contacts.points[closed]
    along = np.einsum("ij,ij->i", places - points[owners], directions[owners])
    on_axis = points[owners] + along[:, None] * directions[owners]
    places = np.where(crushed[owners, None], on_axis, places)
    ends = np.full((len(contacts), 2, 3), np.nan)
    order = np.lexsort((along, owners))
    rows, first, count = np.unique(owners[order], return_index=True, return_counts=True)
    ends[rows, 0], ends[rows, 1] = places[order[first]], places[order[first + count - 1]]
    return ends


# --- What each interface does in a mechanism ------------------------------------------------------------------------


TOGETHER = 1e-4
"""Share of the largest contact speed up to which two blocks count as moving together: residuals up to 1e-4 count as
solved, and motions below that are not known."""
CREEPS = 1e-2
"""The same of a step of elastic joints, in which those that hold creep as they give way elsewhere: 1e-4 to 1e-2."""
AT_THE_POINT = 1e-6
"""Relative distance up to which a centre counts as lying on the farthest point, about which blocks do turn: that is
sliding, not left to rounding."""


class InterfaceMode(IntEnum):
    """What an interface does in the mechanism."""

    STICK = 0
    SLIDE = 1
    OPEN = 2
    HINGE = 3
    """some of its points open, others stay closed"""
    TWIST = 4
    """it slides by turning about its normal"""
    CRUSH = 5
    """points of it close, none opens"""


@dataclass(frozen=True)
class InterfaceMotion:
    """Relative motion of the bodies of each interface, in the deck's axes, scaled as the mechanism.

    modes           : (n_interfaces,) InterfaceMode
    slides          : (n_interfaces,) closed points slide too, whatever the mode
    crushes         : (n_interfaces,) closed points crush too, whatever the mode
    translation     : (n_interfaces, 3) velocity of b relative to a at the centroid
    rotation        : (n_interfaces, 3) angular velocity of b relative to a
    hinge_points    : (n_interfaces, 3) m, a point on the axis of a hinge; nan for other modes
    hinge_directions: (n_interfaces, 3) its unit direction, b turns about it relative to a by the right hand; nan for
                      other modes
    hinge_ends      : (n_interfaces, 2, 3) m, where the hinge begins and ends within the interface; nan for other modes
    in_soil         : (n_interfaces,) of cells of soil, with each other, with blocks or with ground
    """

    modes: IntArray
    slides: BoolArray
    crushes: BoolArray
    translation: FloatArray
    rotation: FloatArray
    hinge_points: FloatArray
    hinge_directions: FloatArray
    hinge_ends: FloatArray
    in_soil: BoolArray

    def count(self, mode: InterfaceMode) -> int:
        """Interfaces of that mode, but for those of cells of soil: what these do says how the soil is divided."""
        return int(np.sum((self.modes == mode) & ~self.in_soil))


def together_of(mechanics: Mechanics) -> float:
    """Share of the largest contact speed up to which blocks count as moving together in a mechanism."""
    return TOGETHER if mechanics.remembered is None else CREEPS


def interface_motion(model: Model, contacts: Contacts, mechanics: Mechanics) -> InterfaceMotion:
    """Modes, relative motion and hinge axes of every interface."""
    translation, rotation = relative_motion(model, contacts, mechanics.mechanism)
    opening = mechanics.contact_velocities[:, 0]
    sliding = np.hypot(mechanics.contact_velocities[:, 1], mechanics.contact_velocities[:, 2])
    is_open = mechanics.modes == ContactMode.OPEN
    n_open = sum_by_interface(contacts, is_open)
    moving = ~moves_together(
        contacts, mechanics.contact_velocities, together_of(mechanics), fastest_tie(model, mechanics.mechanism)
    )
    slides = moving & (sum_by_interface(contacts, mechanics.modes == ContactMode.SLIDE) > 0)
    is_crushing = mechanics.modes == ContactMode.CRUSH
    crushes = moving & (sum_by_interface(contacts, is_crushing) > 0)
    opens_more = largest_by_interface(contacts, np.where(is_open, opening, 0.0)) >= largest_by_interface(
        contacts, np.where(is_open, 0.0, sliding)
    )
    modes = np.full(len(contacts), int(InterfaceMode.STICK), dtype=np.int64)
    modes[slides] = InterfaceMode.SLIDE
    modes[slides & _turns_about_normal(contacts, translation, rotation)] = InterfaceMode.TWIST
    if crushes.any():
        closes = largest_by_interface(contacts, np.where(is_crushing, -opening, 0.0))
        modes[crushes & ((closes >= largest_by_interface(contacts, sliding)) | ~slides)] = InterfaceMode.CRUSH
    partly = moving & (n_open > 0)
    modes[partly] = InterfaceMode.SLIDE
    modes[partly & opens_more] = InterfaceMode.HINGE
    apart = (n_open == np.diff(contacts.point_start)) | (opens_more & ~_tilts(contacts, translation, rotation))
    modes[partly & apart] = InterfaceMode.OPEN
    return InterfaceMotion(
        modes,
        slides,
        crushes,
        translation,
        rotation,
        *_axes(contacts, modes == InterfaceMode.HINGE, is_open, opening, rotation),
        in_soil=in_soil(model, contacts),
    )


def in_soil(model: Model, contacts: Contacts) -> BoolArray:
    """Whether a cell of soil is on a side of each interface, (n_interfaces,)."""
    cell = np.append(model.soil_of_block >= 0, np.zeros(len(model.grounds), dtype=bool))
    return np.asarray(cell[contacts.bodies].any(axis=1))


def within_soil(model: Model, contacts: Contacts) -> BoolArray:
    """Whether both sides of each interface are cells of soil, (n_interfaces,)."""
    cell = np.append(model.soil_of_block >= 0, np.zeros(len(model.grounds), dtype=bool))
    return np.asarray(cell[contacts.bodies].all(axis=1))


def relative_motion(model: Model, contacts: Contacts, motion: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Velocity at the centroid of each interface and angular velocity, of b relative to a, (n_interfaces, 3) each."""
    translation, rotation = np.zeros((len(contacts), 3)), np.zeros((len(contacts), 3))
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = np.flatnonzero(contacts.bodies[:, side] < len(model.blocks))  # grounds do not move
        block = contacts.bodies[here, side]
        arm = contacts.centroids[here] - model.blocks.centroids[block]
        translation[here] += sign * (motion[block, :3] + np.cross(motion[block, 3:], arm))
        rotation[here] += sign * motion[block, 3:]
    return translation, rotation


def fastest_tie(model: Model, motion: FloatArray) -> float:
    """Greatest rate at which a tie gets longer or shorter in a motion of the blocks, (n_blocks, 6); 0 without ties."""
    return float(np.abs(elongations(model.blocks, model.ties, motion)).max(initial=0.0))


def moves_together(contacts: Contacts, velocities: FloatArray, together: float, fastest: float) -> BoolArray:
    """Interfaces whose bodies move as one, (n_interfaces,), from velocities at the contact points, (n_points, 3).

    together : share of the fastest contact, or tie, up to which they do
    fastest  : speed of the fastest tie
    """
    speeds = np.linalg.norm(velocities, axis=1)
    return np.asarray(largest_by_interface(contacts, speeds) <= together * speeds.max(initial=fastest))


def _turns_about_normal(contacts: Contacts, translation: FloatArray, rotation: FloatArray) -> BoolArray:
    """The centre of the rotation about the normal, ‖v_t‖/|ω_n| from the centroid, lies within the farthest point."""
    along = np.linalg.norm(_in_plane(contacts, translation), axis=1)
    spin = np.abs(np.einsum("ij,ij->i", rotation, contacts.normals))
    return np.asarray(along < (1.0 - AT_THE_POINT) * spin * interface_radii(contacts))


def _tilts(contacts: Contacts, translation: FloatArray, rotation: FloatArray) -> BoolArray:
    """The faces do not stay parallel as they part: without a tilt there is no axis."""
    tilt = np.linalg.norm(_in_plane(contacts, rotation), axis=1) * interface_radii(contacts)
    return np.asarray(tilt > TOGETHER * np.abs(np.einsum("ij,ij->i", translation, contacts.normals)))


def _in_plane(contacts: Contacts, vectors: FloatArray) -> FloatArray:
    """The part of vectors that lies in the plane of each interface."""
    normal = np.einsum("ij,ij->i", vectors, contacts.normals)
    return np.asarray(vectors - normal[:, None] * contacts.normals)


def _axes(
    contacts: Contacts, hinges: BoolArray, is_open: BoolArray, opening: FloatArray, rotation: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Point, direction and ends of the axis of every hinge.

    The axis lies in the plane of the interface through the mean of its closed points. Where these crush it is the line
    between those that close and those that open, at which the normal velocity w + (n × ω)·(x − mean) vanishes.
    """
    if not hinges.any():
        nowhere = np.full((len(contacts), 3), np.nan)
        return nowhere, nowhere, np.full((len(contacts), 2, 3), np.nan)
    closed = np.where(is_open, 0.0, 1.0)
    weight = np.maximum(sum_by_interface(contacts, closed), 1.0)
    mean = sum_by_interface(contacts, closed[:, None] * contacts.points) / weight[:, None]
    normal_velocity = np.minimum(sum_by_interface(contacts, closed * opening) / weight, 0.0)
    in_plane = _in_plane(contacts, rotation)
    size = np.linalg.norm(in_plane, axis=1)
    gradient = np.cross(contacts.normals, in_plane)
    with np.errstate(divide="ignore", invalid="ignore"):
        points = mean - (normal_velocity / size**2)[:, None] * gradient
        directions = in_plane / size[:, None]
    points[~hinges], directions[~hinges] = np.nan, np.nan
    crushed = np.linalg.norm(points - mean, axis=1) > CRUSHED * interface_radii(contacts)
    return points, directions, hinge_ends(contacts, is_open, points, directions, crushed)
