"""Guides: blocks that may move in given ways only, each by itself or several as one rigid body.

A guided body has up to five independent motions, its ways. In way j block b of the body moves with velocity and angular
velocity (v, ω) about its centroid, row :math:`motions[., :, j]`. What the body may do is any sum of its ways; the
support takes every force and moment that does no work in them. So loads and contact forces f of the body are in
equilibrium where Σ_b motionsᵀ f_b = 0, one equation a way.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.supports import Support
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.wording import counted, vector

WAYS = 6
"""columns of the motions of a body; those beyond its own ways are zero"""

ALONG = 1e-9
"""what a guide leaves of a unit slide along a direction, up to which it lets its block go there"""


@dataclass(frozen=True)
class Guides:
    """Guided blocks, in the deck's units.

    blocks  : (m,) guided blocks, each once
    bodies  : (m,) number of the rigid body that each belongs to, from 0, ascending
    motions : (m, 6, 6) velocity (3) and angular velocity (3) about the centroid of the block in every way of its body;
              columns beyond the ways of the body are zero
    words   : the guides in words, for the listing
    """

    blocks: IntArray
    bodies: IntArray
    motions: FloatArray
    words: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.blocks)

    @property
    def n_bodies(self) -> int:
        """Guided rigid bodies."""
        return int(self.bodies.max(initial=-1)) + 1


NO_GUIDES = Guides(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros((0, 6, WAYS)))


def together(blocks: IntArray, motions: FloatArray) -> Guides:
    """Blocks, (m,), as one body with one way to move, (m, 6)."""
    ways = np.zeros((len(blocks), 6, WAYS))
    ways[:, :, 0] = motions
    return Guides(blocks, np.zeros(len(blocks), dtype=np.int64), ways)


def joined(first: Guides, second: Guides) -> Guides:
    """Both; the blocks of the second leave the first."""
    kept = ~np.isin(first.blocks, second.blocks)
    _, bodies = np.unique(first.bodies[kept], return_inverse=True)
    n = int(bodies.max(initial=-1)) + 1
    return Guides(
        np.concatenate([first.blocks[kept], second.blocks]),
        np.concatenate([bodies.astype(np.int64), n + second.bodies]),
        np.concatenate([first.motions[kept], second.motions]),
        (*first.words, *second.words),
    )


def slide(direction: FloatArray, count: int) -> FloatArray:
    """Velocity along a unit direction (3,), (count, 6): without rotation."""
    return np.broadcast_to(np.concatenate([direction, np.zeros(3)]), (count, 6)).copy()


def turn(axis: FloatArray, about: FloatArray, centroids: FloatArray) -> FloatArray:
    """Unit rotation about an axis through a point, (n, 6), of blocks with these centroids, (n, 3)."""
    velocity = np.cross(axis, centroids - about)
    return np.hstack([velocity, np.broadcast_to(axis, velocity.shape)])


def rigid_motions(centres: FloatArray, centroids: FloatArray) -> FloatArray:
    """The six motions of a body about its centre, (3,) or that of each block, as motions of its blocks, (n, 6, 6)."""
    motions = np.zeros((len(centroids), 6, 6))
    for axis, along in enumerate(np.eye(3)):
        motions[:, :, axis] = slide(along, len(centroids))
        motions[:, :, 3 + axis] = turn(along, centres, centroids)
    return motions


def held_along(guides: Guides, direction: FloatArray) -> IntArray:
    """Guided blocks that cannot slide along a unit direction, (3,), so that their guides take forces along it."""
    wanted = slide(direction, 1)[0]
    left = [wanted - ways @ np.linalg.lstsq(ways, wanted, rcond=None)[0] for ways in guides.motions]
    return np.asarray(guides.blocks[np.array([np.linalg.norm(rest) > ALONG for rest in left], dtype=bool)])


COMPONENTS = ("x", "y", "z", "rx", "ry", "rz")


def is_guide(support: Support) -> bool:
    """Whether the blocks of a support may move in some way."""
    if support.slide is not None or support.turn is not None:
        return True
    return support.fixed is not None and len(support.fixed) < len(COMPONENTS)


def guides_of(support: Support, chosen: IntArray, blocks: Blocks) -> Guides:
    """The guides that an item of `supports` makes of the blocks it selects, (n,)."""
    together, centroids = bool(support.together), blocks.centroids[chosen]
    if support.fixed is not None:
        centre = np.average(centroids, axis=0, weights=blocks.volumes[chosen]) if together else centroids
        free = [component not in support.fixed for component in COMPONENTS]
        ways = rigid_motions(centre, centroids)[:, :, free]
        words = f"held in {', '.join(each for each in COMPONENTS if each in support.fixed)}"
    else:
        ways, words = _ways(support, centroids)
    motions = np.zeros((len(chosen), 6, WAYS))
    motions[:, :, : ways.shape[2]] = ways
    bodies = np.zeros(len(chosen), dtype=np.int64) if together else np.arange(len(chosen))
    subject = counted(len(chosen), "block") + (" as one body" if together else "")
    return Guides(chosen, bodies, motions, (f"{subject} {words}",))


def _ways(support: Support, centroids: FloatArray) -> tuple[FloatArray, str]:
    """Motions that slide, turn, or both, (n, 6, k), and the same in words."""
    ways, words = [], []
    if support.slide is not None:
        ways.append(slide(unit(support.slide), len(centroids)))
        words.append(f"slide along {vector(support.slide)}")
    if support.turn is not None:
        ways.append(turn(unit(support.turn.axis), np.array(support.turn.about), centroids))
        words.append(f"turn about {vector(support.turn.axis)} through {vector(support.turn.about)}")
    return np.stack(ways, axis=2), f"may {' and '.join(words)} only"
