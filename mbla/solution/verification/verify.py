"""Verification: everything that is claimed, recomputed from model, contacts and solution.

No solver is asked and no matrix of the program stage is used for a verdict: forces are summed over blocks and
velocities taken from rigid-body motion directly (``statics``). What the residuals are is said in
:mod:`mbla.solution.verification.residuals`, what the bounds prove in :mod:`mbla.solution.associative.proofs`.

What may be claimed follows from the figures alone:

- associative flow: the load factor lies between its bounds, and they are no further apart than 1e-5. Forces and
  mechanism then fit the law to 1e-4;
- associative flow with friction polyhedra (``verify_polyhedral``): the two prove a bracket of the true
  cone. The case is solved where that is no wider than 1e-5, else approximate;
- flow without normality: no bound proves the factor, its residuals speak for it. The largest is at most 1e-6: solved;
  1e-4: solved, with a warning among the results' notices; 1e-2: approximate; beyond: not verified. Unbalanced forces
  count as solved up to 1e-5 with every flow rule.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.associative.proofs import associative_bounds, certificate_failures
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.verification.load_scale import load_scale
from mbla.solution.verification.residuals import Residuals, residuals_of

SOLVED_RESIDUAL = 1e-4
"""Residual up to which a factor counts as solved; without a proof the results warn of it from 1e-6 on."""

APPROXIMATE_RESIDUAL = 1e-2
"""Up to this it is approximate; beyond, it is not a result."""

SOLVED_EQUILIBRIUM = 1e-5
"""Unbalanced force up to which a factor counts as solved: the forces must carry it to as many digits as bounds give. On
a light block beside a heavy one 2e-5 of what it carries was worth 1.1e-4 of the load factor."""

LIVE_POWER = 1e-6
"""Deviation of the live power from 1: a mechanism of another size is another one."""

GAP_TOLERANCE = 1e-5
"""Greatest relative distance of static and kinematic bound at which an associative factor counts as verified."""

ROUNDING = 1e-9
"""Bounds that cross by no more than this have met."""


def verify(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute residuals and bounds of a solution; NaN where there is nothing to check."""
    limits = yield_limits(model, contacts)
    scale = load_scale(model, contacts, load_case, limits)
    nan = np.nan
    if solution.mechanics is None:
        failures: tuple[Message, ...] = (
            (Message("not-verified", solution.reason),) if solution.status is not Status.UNBOUNDED else ()
        )
        if solution.certificate is not None:
            failures = certificate_failures(model, contacts, load_case, solution.certificate, limits, scale)
        return Checks(nan, nan, nan, nan, nan, nan, nan, nan, nan, verified=not failures, failures=failures)
    dilatancy = dilatancy_of(limits, solution.flow_rule)
    residuals = residuals_of(model, contacts, load_case, solution.mechanics, dilatancy)
    static = kinematic = size = nan
    if solution.associative is not None:
        static, kinematic = associative_bounds(model, contacts, load_case, solution.associative, limits, scale)
        size = max(abs(kinematic), scale.least_factor(solution.associative.mechanism))
        if 0.0 < static - kinematic <= ROUNDING * size:
            static = kinematic
    failures = failures_of(residuals, solution, static, kinematic, size)
    return Checks(
        equilibrium_residual=residuals.equilibrium,
        yield_violation=residuals.yielding,
        penetration=residuals.penetration,
        complementarity_residual=residuals.complementarity,
        live_power=residuals.live_power,
        power_balance=residuals.power_balance,
        static_bound=static,
        kinematic_bound=kinematic,
        gap=abs(kinematic - static) / size if size > 0 else nan,
        verified=not failures,
        failures=failures,
        tension_violation=residuals.tension,
        slip_residual=residuals.slip,
    )


def verified_status(solution: Solution, checks: Checks) -> Status:
    """What may be claimed: the solver's status, lowered to what verification found."""
    if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
        if solution.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED) and not checks.verified:
            return Status.NOT_VERIFIED
        return solution.status
    brackets = solution.outer is not None and solution.flow_rule == "associative"
    if checks.verified and solution.status is Status.SOLVED:
        return Status.SOLVED if not brackets or checks.gap <= GAP_TOLERANCE else Status.APPROXIMATE
    measures = [
        checks.equilibrium_residual,
        checks.yield_violation,
        checks.penetration,
        checks.complementarity_residual,
        checks.power_balance,
        abs(checks.live_power - 1.0),
    ]
    if solution.flow_rule == "associative" and solution.outer is None:  # polyhedra lie apart, however well solved
        measures.append(checks.gap)
    elif _above(solution, checks.kinematic_bound, APPROXIMATE_RESIDUAL * abs(checks.kinematic_bound)):
        return Status.NOT_VERIFIED
    return Status.APPROXIMATE if all(value <= APPROXIMATE_RESIDUAL for value in measures) else Status.NOT_VERIFIED


def meets_what_was_asked(solution: Solution, checks: Checks) -> bool:
    """Whether an approximate answer is as sharp as the analysis asks for, by the figures of the verification.

    Associative flow: its proved bounds lie within the gap asked for. Other flow: every residual is within the one asked
    for, and the load factor not above the proved kinematic bound by more than that.
    """
    asked = solution.asked
    if asked is None or solution.mechanics is None or not abs(checks.live_power - 1.0) <= LIVE_POWER:
        return False
    residuals = (
        checks.equilibrium_residual,
        checks.yield_violation,
        checks.penetration,
        checks.complementarity_residual,
        checks.power_balance,
    )
    if solution.flow_rule == "associative":
        return checks.gap <= asked and all(value <= APPROXIMATE_RESIDUAL for value in residuals)
    above = _above(solution, checks.kinematic_bound, asked * abs(checks.kinematic_bound))
    return not above and all(value <= asked for value in residuals)


def dilatancy_of(limits: YieldLimits, flow_rule: str) -> FloatArray:
    """Tangent of the dilatancy angle that a flow rule claims, (n_points,)."""
    return {
        "associative": limits.friction,
        "non_associative": np.zeros_like(limits.friction),
        "livesley": np.zeros_like(limits.friction),
        "dilatancy": limits.dilatancy,
    }[flow_rule]


def tolerances(flow_rule: str) -> dict[str, float]:
    """What a solved case may miss at most, by the name of each figure in ``Checks``; others are parts of these.

    The live power may miss 1 by so much; the gap counts for associative flow, whose load factor the bounds prove.
    """
    associative = flow_rule == "associative"
    return {
        "equilibrium_residual": SOLVED_EQUILIBRIUM,
        "yield_violation": SOLVED_RESIDUAL,
        "penetration": SOLVED_RESIDUAL,
        "complementarity_residual": SOLVED_RESIDUAL,
        "power_balance": SOLVED_RESIDUAL,
        "live_power": LIVE_POWER,
        **({"gap": GAP_TOLERANCE} if associative else {}),
    }


def failures_of(
    residuals: Residuals, solution: Solution, static: float, kinematic: float, size: float
) -> tuple[Message, ...]:
    """What is not within tolerance; ``size`` is the unit of differences of load factors."""
    associative = solution.flow_rule == "associative"
    failures = residual_failures(residuals, solution.flow_rule)
    if associative:
        failures += _bound_failures(solution, static, kinematic, size)
    elif _above(solution, kinematic, SOLVED_RESIDUAL * size):
        assert solution.mechanics is not None
        words = (
            f"the load factor {solution.mechanics.load_factor:.8g} exceeds the kinematic bound {kinematic:.8g} "
            "of the associative one"
        )
        failures.append(Message("above-kinematic-bound", words))
    return tuple(failures)


def residual_failures(residuals: Residuals, flow_rule: str, of: str = "") -> list[Message]:
    """Residuals that exceed what the flow rule allows; ``of`` goes before each."""
    allowed = tolerances(flow_rule)
    limits = (
        ("equilibrium-residual", "equilibrium residual", residuals.equilibrium, allowed["equilibrium_residual"]),
        ("yield-violation", "yield violation", residuals.yielding, allowed["yield_violation"]),
        ("penetration", "penetration", residuals.penetration, allowed["penetration"]),
        (
            "complementarity-residual",
            "complementarity residual",
            residuals.complementarity,
            allowed["complementarity_residual"],
        ),
        ("power-balance", "power balance", residuals.power_balance, allowed["power_balance"]),
        (
            "live-power",
            "deviation of the live power from 1",
            abs(residuals.live_power - 1.0),
            allowed["live_power"],
        ),
    )
    return [
        Message(identifier, f"{of}{name} {value:.2g} exceeds {limit:g}")
        for identifier, name, value, limit in limits
        if not value <= limit
    ]


def _bound_failures(solution: Solution, static: float, kinematic: float, size: float) -> list[Message]:
    """What the bounds of the associative load factor leave unproved."""
    assert solution.mechanics is not None
    room, factor = GAP_TOLERANCE * size, solution.mechanics.load_factor  # as reported: forces may be others than proved
    if not abs(kinematic - static) <= room:
        words = (
            f"static bound {static:.8g} and kinematic bound {kinematic:.8g} lie further apart than {GAP_TOLERANCE:g}"
        )
        return [Message("bounds-apart", words)]
    if not static - room <= factor <= kinematic + room:
        words = f"the load factor {factor:.8g} does not lie between its bounds {static:.8g} and {kinematic:.8g}"
        return [Message("outside-bounds", words)]
    return []


def _above(solution: Solution, bound: float, room: float) -> bool:
    """Whether the load factor exceeds an upper bound by more than ``room``; not where there is no bound."""
    return solution.mechanics is not None and bool(solution.mechanics.load_factor > bound + room)
