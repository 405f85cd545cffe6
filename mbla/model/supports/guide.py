"""Guides of a deck: blocks that slide, turn, or keep some of their displacements at zero."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.types import Support
from mbla.model.blocks import Blocks
from mbla.model.guides import Guides, held_components, rigid_motions, slide, turn
from mbla.model.wording import counted, vector

COMPONENTS = ("x", "y", "z", "rx", "ry", "rz")


def is_guide(support: Support) -> bool:
    """Whether the blocks of a support may move in some way."""
    if support.slide is not None or support.turn is not None:
        return True
    return support.fixed is not None and len(support.fixed) < len(COMPONENTS)


def guides_of(support: Support, chosen: IntArray, blocks: Blocks) -> Guides:
    """The guides that an item of `supports` makes of the blocks it selects."""
    together = bool(support.together)
    bodies = np.zeros(len(chosen), dtype=np.int64) if together else np.arange(len(chosen))
    if support.fixed is not None:
        motions = _held(support, chosen, blocks, together)
        words = f"held in {', '.join(c for c in COMPONENTS if c in support.fixed)}"
    else:
        motions, words = _ways(support, chosen, blocks)
    subject = counted(len(chosen), "block") + (" as one body" if together else "")
    return Guides(chosen, bodies, motions, (f"{subject} {words}",))


def unit(direction: tuple[float, float, float]) -> FloatArray:
    """The direction as a unit vector; the largest entry first, so that squares neither overflow nor vanish."""
    vector = np.array(direction)
    vector = vector / np.abs(vector).max()
    return np.asarray(vector / np.linalg.norm(vector))


def _held(support: Support, chosen: IntArray, blocks: Blocks, together: bool) -> FloatArray:
    """Motions with some components held, about each centroid, or about the common one of a body."""
    assert support.fixed is not None
    fixed = np.array([component in support.fixed for component in COMPONENTS])
    if not together:
        return held_components(fixed, len(chosen))
    centre = np.average(blocks.centroids[chosen], axis=0, weights=blocks.volumes[chosen])
    motions = np.zeros((len(chosen), 6, 6))
    motions[:, :, : int((~fixed).sum())] = rigid_motions(centre, blocks.centroids[chosen])[:, :, ~fixed]
    return motions


def _ways(support: Support, chosen: IntArray, blocks: Blocks) -> tuple[FloatArray, str]:
    """Motions that slide, turn, or both, and the same in words."""
    ways, words = [], []
    if support.slide is not None:
        ways.append(slide(unit(support.slide), len(chosen)))
        words.append(f"slide along {vector(support.slide)}")
    if support.turn is not None:
        ways.append(turn(unit(support.turn.axis), np.array(support.turn.about), blocks.centroids[chosen]))
        words.append(f"turn about {vector(support.turn.axis)} through {vector(support.turn.about)}")
    motions = np.zeros((len(chosen), 6, 6))
    motions[:, :, : len(ways)] = np.stack(ways, axis=2)
    return motions, f"may {' and '.join(words)} only"
