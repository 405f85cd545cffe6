"""Planes of symmetry as they stand to the blocks, and the images of vectors in them.

With unit normal m and reflection R = I − 2 m mᵀ a force F becomes R F, a moment M, which is an axial vector, −R M, and
so velocity and angular velocity.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.deck import Deck
from mbla.deck.sections.supports import SymmetryPlane
from mbla.errors import DeckError, Finding, KeyPath
from mbla.model.model import Model
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.ragged import row_maxima
from mbla.model.supports.supports import plane_of
from mbla.model.transform import AffineMap, reflection
from mbla.model.wording import named

UNNAMED = "the plane of symmetry"
"""in words"""
ACROSS = 1e-9
"""component across the plane, relative to a vector, that is rounding"""


def refuse(deck: Deck, findings: Iterable[Finding]) -> None:
    """DeckError where there are findings."""
    if faults := [deck.fault_at(*finding) for finding in findings]:
        raise DeckError(faults)


@dataclass(frozen=True)
class ModelMirror:
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

    @cached_property
    def reflection(self) -> AffineMap:
        """R about the plane."""
        return reflection(self.point, self.normal)

    def motions(self, values: FloatArray) -> FloatArray:
        """Images of velocities and angular velocities, or of forces and moments, in the second axis of (n, 6, ...)."""
        matrix, none = self.reflection.matrix, np.zeros((3, 3))
        both = np.block([[matrix, none], [none, -matrix]])
        return np.asarray(np.einsum("ij,nj...->ni...", both, values))


def find_mirror(deck: Deck, model: Model, plane: SymmetryPlane, path: KeyPath) -> ModelMirror:
    """The plane as it stands to the blocks; raises DeckError where blocks reach across it."""
    blocks, (point, normal, label) = model.blocks, plane_of(plane)
    label = label or UNNAMED
    heights = (blocks.vertices - point) @ normal
    allowed = deck.contacts.tolerance * blocks.sizes
    above, below = (row_maxima(sign * heights, blocks.vertex_start) for sign in (1.0, -1.0))
    if np.sum(below > allowed) > np.sum(above > allowed):
        normal, heights, above, below = -normal, -heights, below, above
    across = np.flatnonzero(below > allowed)
    if len(across):
        message = (
            f"blocks reach across {label}: {named(across, blocks.name)}; give the blocks on one side, and of "
            "one that the plane cuts its half, named by halves"
        )
        refuse(deck, [Finding("symmetry-broken", message, *path)])
    halves = np.zeros(len(blocks), dtype=bool)
    if plane.halves is not None:
        selection = BlockSelection(blocks, fault_at=deck.fault_at)
        chosen = select_blocks(plane.halves, (*path, "halves"), selection)
        if chosen is None:
            raise DeckError(selection.faults)
        on_plane = row_maxima(np.abs(heights[blocks.loops]), blocks.loop_start) <= allowed[blocks.block_of_face]
        cut = np.bincount(blocks.block_of_face[on_plane], minlength=len(blocks)) > 0
        loose = chosen[~cut[chosen]]
        if len(loose):
            message = f"without a face on {label}, where the other half would join: {named(loose, blocks.name)}"
            refuse(deck, [Finding("symmetry-broken", message, *path, "halves")])
        halves[chosen] = True
    image_of = np.arange(len(blocks))
    image_of[~halves] = len(blocks) + np.arange(int((~halves).sum()))
    return ModelMirror(point, normal, label, halves, image_of)
