"""The geometric factor of safety in a sentence."""

from __future__ import annotations

import math

from mbla.results.listing.blocks import Block, Paragraph
from mbla.results.listing.text import number
from mbla.results.results import CaseResult
from mbla.solution.solution import Standing


def geometric_safety_blocks(case: CaseResult) -> list[Block]:
    """The factor, what shows it and how sure it is; nothing where the deck does not ask for it.

    It says that some forces carry the dead load, no more than associative flow does: what standing adds goes with it.
    """
    found = case.solution.further.geometric_safety
    if found is None:
        return []
    says = f"Geometric factor of safety of the dead load, all joints shrunk about their middles: {number(found.factor)}"
    says += f", less than {found.most:.8g}" if math.isfinite(found.most) else " and more"
    says += ", verified by forces" if found.verified else ", NOT verified by forces"
    says += " and a mechanism." if math.isfinite(found.most) else f". {ON_MIDDLES}"
    standing = case.solution.standing
    if standing is None:
        says += f" {UNASSESSED}"
    elif found.factor >= 1.0 and standing.verdict is not Standing.YES:
        says += f" It is no safety: {standing.reason}."
    return [Paragraph(says)]


ON_MIDDLES = (
    "It stands on the middles of its joints: their size is no measure of safety, and their strength never enters."
)
UNASSESSED = "Whether it stands from the stress-free assembly was not assessed."
