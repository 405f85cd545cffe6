"""Parts that are not connected, each on its own path: the one that decides for all."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mbla.solution.flow.path_of_part import PathOfPart
from mbla.solution.flow.path_record import Stop


def deciding(found: Sequence[PathOfPart]) -> int | None:
    """Number of the part that decides; None where nothing bounds the load of any.

    One that does not stand, or may not, comes before all others, then one without a figure, then the least λ_p.
    """
    for stop in (Stop.DOES_NOT_STAND, Stop.UNDECIDED):
        for number, part in enumerate(found):
            if part.stop is stop:
                return number
    rank = [-math.inf if math.isnan(part.load_factor) else part.load_factor for part in found]
    least = min(rank, default=math.inf)
    return rank.index(least) if least < math.inf else None
