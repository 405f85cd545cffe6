"""A structure with another value of a parameter, its contact points matched to those of the structure as it is.

Model and contacts are built again from the deck. Fewer or more blocks, supports or contact points, or other joint laws
at them, are another structure, with which forces and motions cannot be compared.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from mbla.arrays import FloatArray, IntArray
from mbla.assembly import Assembly, assembly_of, build_assembly
from mbla.contacts.contacts import Contacts
from mbla.deck import Deck, read_deck_text
from mbla.errors import MblaError
from mbla.model import Model, build_model
from mbla.model.model import LoadCase
from mbla.model.soil.soil_mesh import StrangeCornersError
from mbla.solution.verification.statics import lever_arms, off_guides

NEAR = 1e-3
"""Distance of matched contact points, over the size of the largest block, and sine of the angle between their normals:
a small step of a parameter moves them by much less."""

WITHOUT_GEOMETRY = ("materials", "joints", "loads", "load_cases", "ties")
"""sections of the deck that move no block: the contacts are the same"""

OFF_GUIDE = 1e-9
"""velocity against a guide, over the largest, that is rounding"""


@dataclass(frozen=True)
class LoadedAssembly:
    """An assembly under one load case, in which no support settles."""

    assembly: Assembly
    load_case: LoadCase

    @property
    def model(self) -> Model:
        """Its blocks."""
        return self.assembly.model

    @property
    def contacts(self) -> Contacts:
        """As found."""
        return self.assembly.contacts

    def moved_along(self, motion: FloatArray, centroids: FloatArray) -> FloatArray:
        """The motion of each block, (n_blocks, 6), as a rigid body in space, about the centroids that it has here.

        A group of blocks that moves as one rigid body goes on doing so, whatever the parameter does to centroids.

        centroids : (n_blocks, 3) m, about which it is given
        """
        arms = self.model.blocks.centroids - centroids
        return np.hstack([motion[:, :3] + np.cross(motion[:, 3:], arms), motion[:, 3:]])


def structure_with(deck: Deck, text: str, like: LoadedAssembly, section: str) -> LoadedAssembly | str:
    """The structure with an override ``key.path=value``, its contact points in the order of the one that it is like.

    section : of the deck, that the override changes

    Returns a word on what is another, where it cannot be compared.
    """
    name = like.load_case.name
    try:
        other = read_deck_text(deck.sources[0].text, deck.path, (*deck.overrides, text), expected=False)
        model = build_model(other, {soil.name: soil.corners for soil in like.model.soils})
        if len(model.blocks) != len(like.model.blocks):
            return "number of blocks"
        same = section in WITHOUT_GEOMETRY
        assembly = assembly_of(model, like.contacts) if same else build_assembly(other, model)
    except (MblaError, StrangeCornersError):
        return "deck that is refused"
    model = assembly.model
    case = next((case for case in model.load_cases if case.name == name), None)
    if case is None or not np.array_equal(model.fixed, like.model.fixed):
        return "supports" if case is not None else "load case"
    if not np.array_equal(model.ties.start, like.model.ties.start):
        return "number of ties"
    if not np.array_equal(model.ties.bodies, like.model.ties.bodies):
        return "blocks that ties hold"
    matched = assembly.contacts if same else matched_contacts(assembly.contacts, like)
    return "contacts" if matched is None else LoadedAssembly(replace(assembly, contacts=matched), case)


def guides_allow(structure: LoadedAssembly, motion: FloatArray) -> bool:
    """Whether guided blocks may still move so."""
    arms = lever_arms(structure.model, structure.contacts)
    return off_guides(structure.model, motion, arms) <= OFF_GUIDE


def matched_contacts(contacts: Contacts, like: LoadedAssembly) -> Contacts | None:
    """The same contacts in the order of others and in frames turned along with their normals; None where they differ.

    Tangents need not follow the rule of the search: frames turn by the least rotation that takes the normals along.
    """
    known = like.contacts
    if len(contacts) != len(known) or len(contacts.points) != len(known.points):
        return None
    if not len(known):
        return contacts
    size = float(like.model.blocks.sizes.max())
    found = cKDTree(_labelled(contacts, size)).query(_labelled(known, size))
    distance, rows = np.asarray(found[0]), np.asarray(found[1])
    if distance.max() > NEAR or len(np.unique(rows)) < len(rows):
        return None
    interfaces = contacts.interface_of_point[rows[known.point_start[:-1]]]
    of_points = np.repeat(interfaces, np.diff(known.point_start))
    if not np.array_equal(contacts.interface_of_point[rows], of_points):
        return None
    laws = np.array(contacts.joint_names)[contacts.joints[interfaces]]
    if not np.array_equal(laws, np.array(known.joint_names)[known.joints]):
        return None
    normals = contacts.normals[interfaces]
    return replace(
        contacts,
        bodies=known.bodies,
        normals=normals,
        areas=contacts.areas[interfaces],
        centroids=contacts.centroids[interfaces],
        gaps=contacts.gaps[interfaces],
        joints=known.joints,
        joint_names=known.joint_names,
        point_start=known.point_start,
        outline=contacts.outline[interfaces],
        points=contacts.points[rows],
        frames=_turned(known.frames, normals[known.interface_of_point]),
        point_areas=contacts.point_areas[rows],
    )


def _labelled(contacts: Contacts, size: float) -> FloatArray:
    """Contact points over the size of a block, with normal and bodies as further coordinates, (n_points, 8)."""
    interface: IntArray = contacts.interface_of_point
    return np.hstack([contacts.points / size, contacts.normals[interface], contacts.bodies[interface]])


def _turned(frames: FloatArray, normals: FloatArray) -> FloatArray:
    """Frames, (n, 3, 3), turned so that their first rows are the given normals, (n, 3): R = I + [v] + [v]²/(1 + c)."""
    axis = np.cross(frames[:, 0], normals)
    cosine = np.einsum("px,px->p", frames[:, 0], normals)
    once = np.cross(axis[:, None, :], frames)
    twice = np.cross(axis[:, None, :], once)
    return np.asarray(frames + once + twice / (1.0 + cosine)[:, None, None])
