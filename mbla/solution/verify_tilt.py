"""That the loads at collapse are those of the tilting table at the angle said."""

from __future__ import annotations

import math

import numpy as np

from mbla.model.model import LoadCase
from mbla.solution.solution import Solution, Status

SAME = 1e-6
"""difference of the loads, relative to the turning ones, up to which the angle is the right one"""


def tilt_failures(load_case: LoadCase, solution: Solution) -> tuple[str, ...]:
    """What is wrong with the angle of a case that claims one."""
    tilt, mechanics = load_case.tilt, solution.mechanics
    if tilt is None or mechanics is None or solution.status not in (Status.SOLVED, Status.APPROXIMATE):
        return ()
    angle = math.degrees(math.atan(mechanics.load_factor)) if tilt.tangent else tilt.angle
    if math.isnan(angle):
        return ()
    loads = load_case.dead_load + mechanics.load_factor * load_case.live_load
    scale = math.hypot(1.0, mechanics.load_factor) if tilt.tangent else 1.0
    off = float(np.abs(loads / scale - tilt.loads_at(angle)).max(initial=0.0))
    size = float(np.abs(tilt.turning).max(initial=0.0))
    if off <= SAME * size:
        return ()
    return (f"the loads at collapse are not those at {angle:.6g} degrees: they differ by {off / size:.1e}",)
