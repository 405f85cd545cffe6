"""The solution of one load case, and what its verification found."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, StrEnum

from mbla.arrays import FloatArray, IntArray


class Status(StrEnum):
    """Outcome of a load case, as the JSON prints it."""

    SOLVED = "solved"
    APPROXIMATE = "approximate"
    NOT_VERIFIED = "not_verified"
    NO_EQUILIBRIUM = "no_equilibrium"
    UNBOUNDED = "unbounded"
    ITERATION_LIMIT = "iteration_limit"
    TIME_LIMIT = "time_limit"
    NUMERICAL_ERROR = "numerical_error"


class ContactMode(IntEnum):
    """What a contact point does in the mechanism."""

    STICK = 0
    SLIDE = 1
    OPEN = 2


@dataclass(frozen=True)
class IterationRecord:
    """One iteration of one cone program; a line of the .sta file.

    program : number of the cone program in the sequence, from 1 (the associative one)
    """

    program: int
    iteration: int
    load_factor: float
    gap: float
    primal_residual: float
    dual_residual: float
    step: float
    seconds: float


@dataclass(frozen=True)
class ProgramRecord:
    """One cone program of the sequence: what it gave and how far the sequence had converged."""

    program: int
    kind: str
    status: Status
    load_factor: float
    change: float
    iterations: int
    seconds: float


@dataclass(frozen=True)
class Mechanics:
    """Forces and velocities that belong to one load factor.

    load_factor        : live load multiplier
    contact_forces     : (n_points, 3) N, T1, T2 [N], compression positive, on body b along the frame, on a against it
    contact_velocities : (n_points, 3) velocity of b relative to a in the frame, opening positive, scaled as mechanism
    mechanism          : (n_blocks, 6) velocity and angular velocity about the centroid, live load power = 1; zero on
                         fixed blocks
    modes              : (n_points,) ContactMode
    """

    load_factor: float
    contact_forces: FloatArray
    contact_velocities: FloatArray
    mechanism: FloatArray
    modes: IntArray


@dataclass(frozen=True)
class Solution:
    """Answer of the solver stage for one load case, before verification.

    status      : what the solver stage claims; never better than what ``verify`` confirms
    mechanics   : by the deck's flow rule; None where there is no load factor
    associative : by the associative flow rule; the same object where that is the deck's flow rule
    certificate : (n_blocks, 6) for no_equilibrium: motion in which the dead load does more work than the joints
                  dissipate; None otherwise
    reason      : for every status but solved, one sentence in words
    """

    flow_rule: str
    status: Status
    mechanics: Mechanics | None
    associative: Mechanics | None
    certificate: FloatArray | None
    reason: str
    programs: tuple[ProgramRecord, ...]
    iterations: tuple[IterationRecord, ...]
    seconds: float


@dataclass(frozen=True)
class Checks:
    """What ``verify`` recomputed from model, contacts and solution; relative, NaN where there is nothing to check.

    equilibrium_residual     : largest unbalanced force (moment over block size) over mean block weight
    yield_violation          : largest excess of shear, tension or compression over its limit, over mean block weight
    penetration              : largest closing velocity over largest contact speed
    complementarity_residual : share of the power balance that forces and velocities leave unexplained under the flow
                               rule claimed
    live_power               : live load times mechanism, should be 1
    power_balance            : dissipation minus external power, over the larger of the two
    static_bound, kinematic_bound : of the associative load factor, valid whatever the solver did
    gap                      : their relative distance
    verified                 : true where everything is within tolerance
    failures                 : what is not, in words
    """

    equilibrium_residual: float
    yield_violation: float
    penetration: float
    complementarity_residual: float
    live_power: float
    power_balance: float
    static_bound: float
    kinematic_bound: float
    gap: float
    verified: bool
    failures: tuple[str, ...]
