"""Tilt: the loads at collapse are those of the tilting table at the angle stated, and that is the one to be stated."""

from __future__ import annotations

import math

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.questions.tilt import AT_ONCE, Tilt, chord, line_of, never_left
from mbla.solution.solution import WITH_VALUE, Checks, Solution

SAME_LOADS = 1e-6
"""difference of the loads, relative to the turning ones, up to which the angle is the right one"""
GOOD = 1e-6
"""distance of the load factor from 1 up to which the case may be called solved"""


def never_failures(tilt: Tilt, live_load: FloatArray, checks: Checks) -> tuple[Message, ...]:
    """What is wrong with the claim that a table collapses at no angle, proved by the loads of the one turned over."""
    failures = checks.failures
    off = float(np.abs(live_load - chord(tilt, math.pi)).max(initial=0.0))
    if off > SAME_LOADS * float(np.abs(tilt.turning).max(initial=0.0)):
        failures += (
            Message("tilt-not-proved", "the live load is not the change from the level table to the one turned over"),
        )
    if not never_left(tilt.upright, checks.static_bound):
        failures += (Message("tilt-not-proved", "nothing proves that the table bears every angle up to 180 degrees"),)
    return failures


def only_direction_counts(model: Model, contacts: Contacts, tilt: Tilt) -> bool:
    """Whether loads can be borne in any multiple if in one: no strength but friction, and nothing but gravity."""
    laws = [model.joints[name] for name in contacts.joint_names]
    strength = any(law.cohesion or law.tensile_strength or math.isfinite(law.compressive_strength) for law in laws)
    strength |= bool(len(model.ties))
    size = float(np.abs(tilt.turning).max(initial=0.0))
    return not strength and float(np.abs(tilt.fixed[model.free]).max(initial=0.0)) <= 1e-12 * size


def tilt_failures(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> tuple[Message, ...]:
    """What is wrong with the angle of a case that claims one."""
    tilt, mechanics = load_case.question.record(Tilt), solution.mechanics
    if tilt is None or mechanics is None or solution.status not in WITH_VALUE:
        return ()
    if tilt.tangent and abs(mechanics.load_factor) > SAME_LOADS and not only_direction_counts(model, contacts, tilt):
        return (
            Message(
                "tilt-not-proved", "the load factor is not the tangent of the angle: the size of the loads counts, too"
            ),
        )
    angle = math.degrees(math.atan(mechanics.load_factor)) if tilt.tangent else tilt.angle
    if math.isnan(angle):
        return ()
    loads = load_case.dead_load + mechanics.load_factor * load_case.live_load
    scale = math.hypot(1.0, mechanics.load_factor) if tilt.tangent else 1.0
    off = float(np.abs(loads / scale - tilt.loads_at(angle)).max(initial=0.0))
    size = float(np.abs(tilt.turning).max(initial=0.0))
    if off <= SAME_LOADS * size:
        return ()
    words = f"the loads at collapse are not those at {angle:.6g} degrees: they differ by {off / size:.1e}"
    return (Message("tilt-not-proved", words),)


def leads_across(tilt: Tilt, live_load: FloatArray) -> bool:
    """Whether a live load, (n_blocks, 6), is that of the level table across, which leads to no angle."""
    off = float(np.abs(live_load - tilt.across).max(initial=0.0))
    return off <= SAME_LOADS * float(np.abs(tilt.across).max(initial=0.0))


def angle_of_load(tilt: Tilt, live_load: FloatArray) -> float:
    """Angle in radians to which a live load leads from the level table, whether it is that of collapse or not."""
    size = max(float(np.abs(tilt.across).max(initial=0.0)), np.finfo(np.float64).tiny)
    columns = np.column_stack([tilt.across.ravel(), -tilt.turning.ravel()]) / size
    (across, lowered), *_ = np.linalg.lstsq(columns, live_load.ravel() / size)
    return float(np.arctan2(across, 1.0 - lowered))


def found_tangent(model: Model, contacts: Contacts, tilt: Tilt, live_load: FloatArray, solution: Solution) -> bool:
    """Whether a run states the load factor of a live load as tangent of the angle.

    It does of the load across the level table where only directions count, and where that table bears nothing of it.
    """
    found = solution.associative
    if found is None or solution.status not in WITH_VALUE or not leads_across(tilt, live_load):
        return tilt.tangent
    at_once = line_of(tilt, found.mechanism, found.load_factor).first_crossing() <= AT_ONCE
    return at_once or only_direction_counts(model, contacts, tilt)


def found_angle(tilt: Tilt, live_load: FloatArray, solution: Solution) -> float:
    """The angle of collapse in degrees that a run states of a live load and the load factor found for it.

    nan where the load factor is its tangent, where the load leads to none, and where the table does not collapse there.
    """
    own = solution.mechanics
    if tilt.tangent or leads_across(tilt, live_load) or (own is not None and own.load_factor > 1.0 + GOOD):
        return math.nan
    angle = math.degrees(angle_of_load(tilt, live_load))
    if own is None:
        return math.nan if math.isnan(tilt.angle) else angle
    at_once = abs(own.load_factor) <= GOOD and tilt.angle == 0.0
    return 0.0 if at_once else angle
