"""Whether the non-associative load factor is bounded where friction with normality locks the structure.

With normality sliding dilates, and what is confined cannot slide: the associative factor has no bound as soon as some
contact forces carry every multiple of the live load. Without dilatancy these forces must also come about. Where a
factor is so large that the dead load and the strength of the joints are nothing beside it, what is left is the live
load alone on a stress-free assembly of dry joints, and how large it is does not matter: equilibrium and Coulomb's law
are homogeneous. So the factor is

- bounded where the stress-free assembly does not carry the live load alone (``weak_spring_continuation``),
- unbounded where it does and the load path from the dead load leads there (``standing_path``):
  standing under the live load alone says nothing of smaller multiples beside the dead load, under which it may fall.

Joints that can crush carry nothing for ever, and count as open.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from mbla.errors import Message
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.standing.standing_path import SMALL, StandingPath
from mbla.solution.standing.weak_spring_continuation import Outcome, weaken_springs


class Boundedness(StrEnum):
    """Whether there is a greatest load factor."""

    BOUNDED = "bounded"
    UNBOUNDED = "unbounded"
    DOUBTFUL = "doubtful"


@dataclass(frozen=True)
class BoundednessResult:
    """What was found; the block that the live load alone carries away where bounded, and one sentence in words."""

    verdict: Boundedness
    block: int | None
    reason: Message


BOUNDED = Message(
    "locked-by-dilatancy",
    "with dilatancy friction locks the structure under any multiple of the live load; without it joints give way, so "
    "that there is a load factor",
)
ENDS = Message(
    "locked-by-dilatancy",
    "with dilatancy friction locks the structure under any multiple of the live load; without it joints give way "
    "before the live load alone would be carried, so that there is a load factor",
)
UNBOUNDED = Message(
    "unbounded",
    "without dilatancy too, friction locks the structure under any multiple of the live load: it stands under the live "
    "load alone, and from the dead load on under all multiples up to {:.6g} that were looked at",
)
DOUBTFUL = Message(
    "not-verified",
    "with dilatancy friction locks the structure under any multiple of the live load; whether it does so without is "
    "doubtful",
)

NO_START = "it was not seen to stand under its dead load, from which the load path starts"


def non_associative_bounded(path: StandingPath) -> BoundednessResult:
    """Decide whether the load factor without dilatancy is bounded, for a program whose associative factor is not.

    path : of the program, at its beginning; followed as far as it takes
    """
    program = path.program
    weakening = weaken_springs(program, "live_load", lasting_limits(program.limits), path.settings)
    if weakening.outcome is Outcome.FALLS:
        return BoundednessResult(Boundedness.BOUNDED, weakening.block, BOUNDED)
    if weakening.outcome is Outcome.UNDECIDED:
        return BoundednessResult(Boundedness.DOUBTFUL, weakening.block, DOUBTFUL.around(after=f": {weakening.reason}"))
    path.follow_on(SMALL * path.unit, np.inf)
    if path.goes_on:
        value = program.scaling.load_factor(path.last.load_factor)
        return BoundednessResult(Boundedness.UNBOUNDED, None, UNBOUNDED.format(value))
    if path.fall is not None:
        return BoundednessResult(Boundedness.BOUNDED, path.fall.weakening.block, ENDS)
    if path.end is None:
        reason = DOUBTFUL.around(after=f": {NO_START}")
        return BoundednessResult(Boundedness.DOUBTFUL, path.last.weakening.block, reason)
    end = path.end.weakening
    return BoundednessResult(Boundedness.DOUBTFUL, end.block, DOUBTFUL.around(after=f": {end.reason}"))


def lasting_limits(limits: YieldLimits) -> YieldLimits:
    """What is left of the limits at forces that grow for ever: friction, where the joint cannot crush."""
    none = np.zeros_like(limits.friction)
    lasting = np.where(np.isfinite(limits.compression), 0.0, np.inf)
    return replace(limits, cohesion=none, tension=none, compression=lasting)
