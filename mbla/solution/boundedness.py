"""Whether the non-associative load factor is bounded where friction with normality locks the structure.

With normality sliding dilates, and what is confined cannot slide: the associative factor has no bound as soon as some
contact forces carry every multiple of the live load. Without dilatancy these forces must also come about. Where a
factor is so large that the dead load and the strength of the joints are nothing beside it, what is left is the live
load alone on a stress-free assembly of dry joints, and how large it is does not matter: equilibrium and Coulomb's law
are homogeneous. So the factor is

- unbounded where the stress-free assembly carries the live load alone (:mod:`mbla.solution.weakening`),
- bounded where it does not.

Joints that can crush carry nothing for ever, and count as open.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.settings import SolverSettings
from mbla.solution.weakening import Outcome, weaken_springs


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
    reason: str


BOUNDED = (
    "with dilatancy friction locks the structure under any multiple of the live load; without it joints give way, so "
    "that there is a load factor"
)
UNBOUNDED = "without dilatancy too, friction locks the structure under any multiple of the live load"
DOUBTFUL = (
    "with dilatancy friction locks the structure under any multiple of the live load; whether it does so without is "
    "doubtful"
)


def non_associative_bounded(program: Program, settings: SolverSettings) -> BoundednessResult:
    """Decide whether the load factor without dilatancy is bounded, for a program whose associative factor is not."""
    weakening = weaken_springs(program, "live_load", lasting_limits(program.limits), settings)
    if weakening.outcome is Outcome.FALLS:
        return BoundednessResult(Boundedness.BOUNDED, weakening.block, BOUNDED)
    if weakening.outcome is Outcome.CARRIED:
        return BoundednessResult(Boundedness.UNBOUNDED, None, UNBOUNDED)
    return BoundednessResult(Boundedness.DOUBTFUL, weakening.block, f"{DOUBTFUL}: {weakening.reason}")


def lasting_limits(limits: YieldLimits) -> YieldLimits:
    """What is left of the limits at forces that grow for ever: friction, where the joint cannot crush."""
    none = np.zeros_like(limits.friction)
    lasting = np.where(np.isfinite(limits.compression), 0.0, np.inf)
    return replace(limits, cohesion=none, tension=none, compression=lasting)
