"""That the loads at collapse are those of the tilting table at the angle said."""

from __future__ import annotations

import math

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model, Tilt
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.tilt_circle import chord, never_left

SAME = 1e-6
"""difference of the loads, relative to the turning ones, up to which the angle is the right one"""


def never_failures(load_case: LoadCase, checks: Checks) -> tuple[Message, ...]:
    """What is wrong with the claim that a table collapses at no angle, proved by the loads of the one turned over."""
    tilt = load_case.tilt
    assert tilt is not None  # asked for such cases only
    failures = checks.failures
    off = float(np.abs(load_case.live_load - chord(tilt, math.pi)).max(initial=0.0))
    if off > SAME * float(np.abs(tilt.turning).max(initial=0.0)):
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
    size = float(np.abs(tilt.turning).max(initial=0.0))
    return not strength and float(np.abs(tilt.fixed[model.free]).max(initial=0.0)) <= 1e-12 * size


def tilt_failures(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> tuple[Message, ...]:
    """What is wrong with the angle of a case that claims one."""
    tilt, mechanics = load_case.tilt, solution.mechanics
    if tilt is None or mechanics is None or solution.status not in (Status.SOLVED, Status.APPROXIMATE):
        return ()
    if tilt.tangent and abs(mechanics.load_factor) > SAME and not only_direction_counts(model, contacts, tilt):
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
    if off <= SAME * size:
        return ()
    words = f"the loads at collapse are not those at {angle:.6g} degrees: they differ by {off / size:.1e}"
    return (Message("tilt-not-proved", words),)
