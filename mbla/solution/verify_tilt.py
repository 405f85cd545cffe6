"""That the loads at collapse are those of the tilting table at the angle said."""

from __future__ import annotations

import math

import numpy as np

from mbla.model.model import LoadCase
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.tilt_circle import chord, never_left

SAME = 1e-6
"""difference of the loads, relative to the turning ones, up to which the angle is the right one"""


def never_failures(load_case: LoadCase, checks: Checks) -> tuple[str, ...]:
    """What is wrong with the claim that a table collapses at no angle, proved by the loads of the one turned over."""
    tilt = load_case.tilt
    assert tilt is not None  # asked for such cases only
    failures = checks.failures
    off = float(np.abs(load_case.live_load - chord(tilt, math.pi)).max(initial=0.0))
    if off > SAME * float(np.abs(tilt.turning).max(initial=0.0)):
        failures += ("the live load is not the change from the level table to the one turned over",)
    if not never_left(tilt.upright, checks.static_bound):
        failures += ("nothing proves that the table bears every angle up to 180 degrees",)
    return failures


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
