"""The angle of a tilting table, from what was found for its load case."""

from __future__ import annotations

import math

from mbla.model.model import LoadCase, Tilt
from mbla.results.listing.text import number
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult
from mbla.solution.tilt_circle import angle_above, line_of

AT_COLLAPSE = 1e-6
"""distance of a load factor from 1 within which it belongs to the angle of the table"""


def angle_of(case: CaseResult) -> float:
    """Angle of collapse in degrees; nan where there is none, or no table."""
    tilt, found = case.load_case.tilt, result_of(case)
    if tilt is None or found is None:
        return math.nan
    return math.degrees(math.atan(found.load_factor)) if tilt.tangent else tilt.angle


def angle_at(tilt: Tilt, load_factor: float) -> float:
    """Angle in degrees that a load factor stands for; nan where it stands for none."""
    if tilt.tangent:
        return math.degrees(math.atan(load_factor))
    return tilt.angle if tilt.angle == 0.0 or abs(load_factor - 1.0) <= AT_COLLAPSE else math.nan


def angle_bounds(case: CaseResult) -> tuple[float, float]:
    """Angle that is certainly borne and angle that is certainly not, by associative flow; degrees, nan if not known."""
    tilt, solution, checks = case.load_case.tilt, case.solution, case.checks
    if tilt is None or solution.associative is None:
        return math.nan, math.nan
    if tilt.tangent:
        return math.degrees(math.atan(checks.static_bound)), math.degrees(math.atan(checks.kinematic_bound))
    if math.isnan(tilt.angle) or math.isnan(checks.kinematic_bound):
        return math.nan, math.nan
    highest = line_of(tilt, solution.associative, checks.kinematic_bound).first_crossing()
    lowest = angle_above(tilt.upright, checks.static_bound, math.radians(tilt.angle))
    return math.degrees(lowest), math.degrees(highest) if math.isfinite(highest) else math.nan


def tilt_words(load_case: LoadCase, load_factor: float) -> str:
    """``31.2 degrees of tilt``, for a load factor of a tilting table."""
    tilt = load_case.tilt
    assert tilt is not None  # asked for such cases only
    angle = angle_at(tilt, load_factor)
    if not math.isnan(angle):
        return f"{number(angle)} degrees of tilt"
    return f"{number(load_factor)} times the change of the loads by the tilt"
