"""The geometric factor of safety in a sentence."""

from __future__ import annotations

import math

from mbla.results.listing.text import number, sentence
from mbla.results.results import CaseResult


def geometric_safety_lines(case: CaseResult) -> list[str]:
    """The factor, what shows it and how sure it is; nothing where the deck does not ask for it."""
    found = case.solution.geometric_safety
    if found is None:
        return []
    says = f"Geometric factor of safety of the dead load, all joints shrunk about their middles: {number(found.factor)}"
    says += " and more" if not math.isfinite(found.most) else f", less than {found.most:.8g}"
    says += ", verified by forces" if found.verified else ", NOT verified by forces"
    says += " and a mechanism." if math.isfinite(found.most) else "."
    return ["", *sentence(says)]
