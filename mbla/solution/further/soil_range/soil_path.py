"""Load factors on paths of elastic joints in soil of cells, as results have them."""

from __future__ import annotations

from dataclasses import dataclass

SHARES = (0.0, 1.0)
"""tan ψ over tan φ of the two paths"""


@dataclass(frozen=True)
class SoilPath:
    """The path on which joints of masonry slide without dilatancy and soil with a share of its friction angle.

    share       : tan ψ over tan φ of the soil, and over tan δ where it touches blocks: 0 or 1
    load_factor : the greatest on the path; nan where none was found
    status      : as verified
    reason      : why it is not solved; empty where it is
    """

    share: float
    load_factor: float
    status: str
    reason: str
