"""A plane of symmetry as it stands to the blocks of a model: which it cuts, and where the image of each will be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.deck import Deck
from mbla.deck.tree import KeyPath
from mbla.deck.types import SymmetryPlane
from mbla.errors import Fault, Message
from mbla.model.model import Model
from mbla.model.ragged import row_maxima
from mbla.model.selectors import build_roster, select_blocks
from mbla.model.supports.guide import unit
from mbla.model.wording import named


@dataclass(frozen=True)
class Mirror:
    """A plane and what it does to a model.

    point, normal : (3,)
    label    : ``x = 0``
    halves   : (n,) blocks that it cuts in two
    image_of : (n,) block that is the image of each, itself for halves
    """

    point: FloatArray
    normal: FloatArray
    label: str
    halves: BoolArray
    image_of: IntArray

    @property
    def reflection(self) -> FloatArray:
        """R, (3, 3)."""
        return np.asarray(np.eye(3) - 2.0 * np.outer(self.normal, self.normal))

    def motions(self, values: FloatArray) -> FloatArray:
        """Images of velocities and angular velocities, or of forces and moments, in the second axis of (n, 6, ...)."""
        image = np.empty_like(values)
        image[:, :3] = np.einsum("ij,nj...->ni...", self.reflection, values[:, :3])
        image[:, 3:] = -np.einsum("ij,nj...->ni...", self.reflection, values[:, 3:])
        return image


def _plane(plane: SymmetryPlane) -> tuple[FloatArray, FloatArray, str]:
    for axis, key in enumerate("xyz"):
        coordinate = getattr(plane, key)
        if coordinate is not None:
            return coordinate * np.eye(3)[axis], np.eye(3)[axis], f"{key} = {coordinate:g}"
    assert plane.point is not None  # a rule of the deck: x, y, z, or a point with a normal
    assert plane.normal is not None
    return np.array(plane.point), unit(plane.normal), "the plane of symmetry"


def find_mirror(deck: Deck, model: Model, plane: SymmetryPlane, path: KeyPath) -> tuple[Mirror | None, list[Fault]]:
    """The plane as it stands to the blocks, or what is wrong with that."""
    blocks, (point, normal, label) = model.blocks, _plane(plane)
    heights = (blocks.vertices - point) @ normal
    allowed = deck.contacts.tolerance * blocks.sizes
    above, below = (row_maxima(sign * heights, blocks.vertex_start) for sign in (1.0, -1.0))
    if np.sum(below > allowed) > np.sum(above > allowed):
        normal, heights, above, below = -normal, -heights, below, above
    across = np.flatnonzero(below > allowed)
    if len(across):
        verb = "reaches" if len(across) == 1 else "reach"
        message = (
            f"{named(across, blocks.name)} {verb} across {label}: give the blocks on one side, and of a block that the "
            "plane cuts its half, named by halves"
        )
        return None, [deck.fault_at(path, Message("symmetry-broken", message))]
    halves = np.zeros(len(blocks), dtype=bool)
    if plane.halves is not None:
        faults: list[Fault] = []
        roster = build_roster(blocks, frozenset(), deck.fault_at)
        chosen = select_blocks(plane.halves, (*path, "halves"), roster, faults)
        if chosen is None:
            return None, faults
        on_plane = row_maxima(np.abs(heights[blocks.loops]), blocks.loop_start) <= allowed[blocks.block_of_face]
        cut = np.bincount(blocks.block_of_face[on_plane], minlength=len(blocks)) > 0
        loose = chosen[~cut[chosen]]
        if len(loose):
            verb = "has" if len(loose) == 1 else "have"
            message = f"{named(loose, blocks.name)} {verb} no face on {label}, where the other half would join"
            return None, [deck.fault_at((*path, "halves"), Message("symmetry-broken", message))]
        halves[chosen] = True
    image_of = np.arange(len(blocks))
    image_of[~halves] = len(blocks) + np.arange(int((~halves).sum()))
    return Mirror(point, normal, label, halves, image_of), []
