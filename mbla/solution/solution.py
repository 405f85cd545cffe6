"""The solution of one load case, and what its verification found."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum, StrEnum

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Message
from mbla.program.reductions.steps import ModelSize as ModelSize
from mbla.program.reductions.steps import ReductionStep as ReductionStep
from mbla.solution.further.further import NOTHING_FURTHER, Further


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


WITH_VALUE = (Status.SOLVED, Status.APPROXIMATE)
"""Statuses of programs and load cases that come with a load factor."""


class ContactMode(IntEnum):
    """What a contact point does in the mechanism."""

    STICK = 0
    SLIDE = 1
    OPEN = 2
    CRUSH = 3


@dataclass(frozen=True)
class IterationRecord:
    """One iteration of one cone program; a line of the .sta file.

    program : number of the cone program in the sequence, from 1 (the associative one); of a pushover the row to come
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
    """One cone program of the sequence: what it gave and how far the sequence had converged.

    solver : of the cone program, mbla or clarabel; empty for steps of the joint law, which are no cone programs
    factorization : library that factorised its linear systems; empty where the solver keeps that to itself
    """

    program: int
    kind: str
    status: Status
    load_factor: float
    change: float
    iterations: int
    seconds: float
    solver: str = ""
    factorization: str = ""


class Standing(StrEnum):
    """Whether the structure stands under its dead load alone, before any live load."""

    YES = "yes"
    SELF_STRESS = "only by self-stress"
    NO = "no"
    DOUBTFUL = "doubtful"


PROVED_STANDING = (Standing.YES, Standing.NO)
"""verdicts that can be proved: by forces with the displacements that bring them about, and a certificate"""


@dataclass(frozen=True)
class StandingResult:
    """What the assessment of standing found.

    verdict : YES: equilibrium arises from the stress-free assembly; SELF_STRESS: only in a self-stressed state
    block   : the block that falls or would fall first; None where none does
    reason  : one sentence in words
    forces, settlement : where it stands: (n_points, 3) contact forces under the dead load alone [N], and (n_blocks, 6)
              the displacements and rotations that cause them on joints of unit stiffness; None where not known
    """

    verdict: Standing
    block: int | None
    reason: str
    forces: FloatArray | None = field(default=None, compare=False)
    settlement: FloatArray | None = field(default=None, compare=False)


@dataclass(frozen=True)
class PathPoint:
    """One state of the path of elastic joints.

    displacement : over the elastic one of the structure at its associative load factor
    open, slide  : contact points open, and others at their friction
    balanced     : whether forces and loads are in balance well enough for it to count
    """

    step: int
    displacement: float
    load_factor: float
    open: int
    slide: int
    balanced: bool


@dataclass(frozen=True)
class PathByStiffness:
    """Where joints of another stiffness lead.

    ratio       : their shear over their normal stiffness
    load_factor : the greatest on their path; nan where it was not seen
    """

    ratio: float
    load_factor: float


@dataclass(frozen=True)
class Mechanics:
    """Forces and velocities that belong to one load factor.

    load_factor        : live load multiplier
    contact_forces     : (n_points, 3) N, T1, T2 [N], compression positive, on body b along the frame, on a against it
    contact_velocities : (n_points, 3) velocity of b relative to a in the frame, opening positive, scaled as mechanism
    mechanism          : (n_blocks, 6) velocity and angular velocity about the centroid, live load power = 1; zero on
                         fixed blocks
    modes              : (n_points,) ContactMode
    resultants         : convex contact model only: (n_interfaces, 6) N, T1, T2 [N] and the moments about normal,
                         tangent 1 and tangent 2 at the centroid of the interface [N m], on body b; the contact forces
                         are then a distribution over the corners with these resultants
    interface_motions  : convex contact model only: (n_interfaces, 2, 6) motion of each interface that torsion [0] and
                         crushing [1] allow it, dual to the resultants: opening, slips, rotations about normal, tangent
                         1 and tangent 2, scaled as mechanism; the contact points move by the rest
    tie_forces         : (n_ties,) N, tension positive, nan where a tie is between what does not move; None without ties
    tie_rates          : (n_ties,) their elongation rates, scaled as mechanism
    remembered         : path of elastic joints: (n_points, 3) N, T1, T2 [N] that joints would have if they did not move
                         in the step of this state; None for rigid joints
    stiffness          : (n_points, 2) normal and shear stiffness in that step: force lost for a velocity, scaled as
                         mechanism
    crushed            : (n_interfaces, 6) motions by which interfaces had crushed before that step, over its length,
                         scaled as mechanism; None where none can
    tie_remembered, tie_stiffness : (n_ties,) the same of ties, as points between their ends, compression positive
    """

    load_factor: float
    contact_forces: FloatArray
    contact_velocities: FloatArray
    mechanism: FloatArray
    modes: IntArray
    resultants: FloatArray | None = None
    interface_motions: FloatArray | None = None
    tie_forces: FloatArray | None = None
    tie_rates: FloatArray | None = None
    remembered: FloatArray | None = None
    stiffness: FloatArray | None = None
    crushed: FloatArray | None = None
    tie_remembered: FloatArray | None = None
    tie_stiffness: FloatArray | None = None


@dataclass(frozen=True)
class Solution:
    """Answer of the solver stage for one load case, before verification.

    Forces of a lock, a level lock, the standing structure and of steps of a pushover have those of ties as contact
    points (:mod:`mbla.assembly.ties`) behind the n_points of the interfaces.

    status      : what the solver stage claims; never better than what ``verify`` confirms
    mechanics   : by the deck's flow rule; None where there is no load factor
    associative : by the associative flow rule; the same object where that is the deck's flow rule
    certificate : (n_blocks, 6) for no_equilibrium: motion in which the dead load does more work than the joints
                  dissipate; None otherwise
    certificate_motions : its interface_motions, convex contact model only
    contact_model : concave, or convex: torsion is a condition on the resultants of interfaces
    stress_blocks : crushing is a condition on the resultants of interfaces
    reason      : for every status but solved, one sentence in words
    scheme      : how a flow without normality was solved; empty for associative flow
    remarks     : what a reader of the figure must know
    torsion     : in space, without dilatancy: the state on the path of elastic joints with torsion of uniform pressure,
                  beside that of contact points alone
    torsion_end : why that path ended; empty where none was followed
    least       : flow other than associative: the state of rigid joints of the least load factor that a search found
    level       : tilting table: associative answer of the level table with the load across, which proves how much of
                  that it bears
    level_lock  : the same where it bears every multiple: (n_points, 3) contact forces that balance that load alone
    standing    : assessment of the dead load alone
    lock        : unbounded, or without an associative answer: (n_points, 3) contact forces that balance the live load
                  alone, so that any multiple is carried with associative flow
    path        : states of the path of elastic joints that was followed
    path_end, path_gain, path_last : why it ended, share of the load factor gained over its last half, and load factor
                  at its end
    path_by_stiffness : what other paths came to, of joints of another stiffness in shear, where any was followed
    further     : what is asked besides the load factor
    size        : what reached the solver
    reductions  : what each reduction left out, in the order in which they were applied; empty where none was attempted
    solver      : that was asked for, as in ``analysis.solver``; ``programs`` say which took each
    tolerance_requested : approximate: gap of the bounds that the analysis asks for, where associative flow is no
                  sharper only because no more was requested; None otherwise
    """

    flow_rule: str
    status: Status
    mechanics: Mechanics | None = None
    associative: Mechanics | None = None
    certificate: FloatArray | None = None
    reason: str = ""
    programs: tuple[ProgramRecord, ...] = ()
    iterations: tuple[IterationRecord, ...] = ()
    seconds: float = 0.0
    scheme: str = ""
    remarks: tuple[Message, ...] = ()
    least: Mechanics | None = None
    torsion: Mechanics | None = None
    torsion_end: str = ""
    level: Mechanics | None = None
    level_lock: FloatArray | None = None
    standing: StandingResult | None = None
    lock: FloatArray | None = None
    path: tuple[PathPoint, ...] = ()
    path_end: str = ""
    path_gain: float = math.nan
    path_last: float = math.nan
    path_by_stiffness: tuple[PathByStiffness, ...] = ()
    further: Further = NOTHING_FURTHER
    size: ModelSize | None = None
    certificate_motions: FloatArray | None = None
    contact_model: str = "concave"
    stress_blocks: bool = False
    solver: str = "auto"
    tolerance_requested: float | None = None
    reductions: tuple[ReductionStep, ...] = ()

    @property
    def conditions_on_interfaces(self) -> bool:
        """Whether conditions hold on the resultants of interfaces, not on contact points alone."""
        return self.contact_model == "convex" or self.stress_blocks

    def with_further(self, further: Further, remarks: Sequence[Message] = ()) -> Solution:
        """The same answer with further results, and what they have to say."""
        return replace(self, further=further, remarks=(*self.remarks, *remarks))


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
    static_bound, kinematic_bound : of the associative load factor, independent of the solver
    gap                      : their relative distance
    tension_violation        : largest tension beyond tensile strength, over mean block weight
    slip_residual            : share of the power balance that sliding against friction leaves unexplained; the rest of
                               the complementarity residual is opening under force
    least_load_factor        : of the least state that was found, where it fits the law of rigid joints; NaN where none
    torsion_load_factor      : of the state with torsion of uniform pressure, where it fits its law; NaN where none
    elastic_residual         : path of elastic joints: largest force that is off their law, over the largest;
                               penetration, complementarity and balance of power are those of rigid ones, NaN here
    verified                 : true where everything is within tolerance
    failures                 : what is not
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
    failures: tuple[Message, ...]
    tension_violation: float = float("nan")
    slip_residual: float = float("nan")
    least_load_factor: float = float("nan")
    torsion_load_factor: float = float("nan")
    elastic_residual: float = float("nan")
