"""How many lines ties may ask for."""

from __future__ import annotations

from mbla.deck.sections.ties import TieSection
from mbla.model.blocks.amounts import copies_of

MOST_TIES = 200_000
"""lines of ties that all ties together may lay out: as much memory as many blocks take"""


def lines_of(tie: TieSection) -> int:
    """How many lines a tie and its copies lay out; a strip, which has one at each joint, at least one a stretch."""
    points = tie.through or tie.strip or []
    own = len(tie.ring.z) if tie.ring else 1 if tie.through and tie.points == "passes" else len(points)
    return copies_of(tie.repeat) * own
