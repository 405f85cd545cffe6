"""Verification: everything that is claimed, recomputed from model, contacts and solution.

No solver is called, nothing is repaired, and no matrix of the program stage is used: forces are summed over blocks and
velocities taken from rigid-body motion directly (``statics``). The residuals are defined in
:mod:`mbla.solution.verification.residuals`, what the bounds prove in :mod:`mbla.solution.verification.proofs`.

What may be claimed follows from the figures alone, by the limits of :mod:`mbla.solution.thresholds`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.solution.solution import WITH_VALUE, Checks, Solution, Status
from mbla.solution.thresholds import (
    APPROXIMATE_RESIDUAL,
    BOUNDS_ROUNDING,
    GAP_TOLERANCE,
    LIVE_POWER_DEVIATION,
    SOLVED_EQUILIBRIUM,
    SOLVED_RESIDUAL,
)
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.elastic_law import elastic_residual
from mbla.solution.verification.proofs import associative_bounds, certificate_failures
from mbla.solution.verification.residuals import Residuals, residuals_of


@dataclass(frozen=True)
class Bounds:
    """What forces and a mechanism prove of the associative load factor; NaN where nothing is proved.

    size : unit of differences of load factors
    """

    static: float = np.nan
    kinematic: float = np.nan
    size: float = np.nan

    @classmethod
    def of(cls, static: float, kinematic: float, least_factor: float) -> Bounds:
        """Bounds that cross by no more than rounding have met at the kinematic one."""
        size = max(abs(kinematic), least_factor)
        met = 0.0 < static - kinematic <= BOUNDS_ROUNDING * size
        return cls(kinematic if met else static, kinematic, size)

    @property
    def gap(self) -> float:
        """Relative distance of the bounds."""
        return abs(self.kinematic - self.static) / self.size if self.size > 0 else np.nan


def checks_of(residuals: Residuals, bounds: Bounds, failures: tuple[Message, ...], elastic: float = np.nan) -> Checks:
    """The record of what was found.

    elastic : misfit of the law of elastic joints, NaN for rigid ones
    """
    rigid = bool(np.isnan(elastic))
    return Checks(
        equilibrium_residual=residuals.equilibrium,
        yield_violation=residuals.yielding,
        penetration=residuals.penetration if rigid else np.nan,
        complementarity_residual=residuals.complementarity if rigid else np.nan,
        live_power=residuals.live_power,
        power_balance=residuals.power_balance if rigid else np.nan,
        static_bound=bounds.static,
        kinematic_bound=bounds.kinematic,
        gap=bounds.gap,
        verified=not failures,
        failures=failures,
        tension_violation=residuals.tension,
        slip_residual=residuals.slip if rigid else np.nan,
        elastic_residual=elastic,
    )


def verify_points(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute residuals and bounds of a solution; NaN where there is nothing to check."""
    return checked(LoadedModel(model, contacts, load_case), solution)


def checked(case: LoadedModel, solution: Solution) -> Checks:
    """The same, by the conditions of a case."""
    if solution.mechanics is None:
        return _checked_without_mechanics(case, solution)
    dilatancy = case.limits.dilatancy_by(solution.flow_rule)
    residuals, bounds = residuals_of(case, solution.mechanics, dilatancy), _bounds_of(case, solution)
    elastic = elastic_residual(case, solution.mechanics, dilatancy)
    return checks_of(residuals, bounds, failures_of(residuals, solution, bounds, elastic), elastic)


def _bounds_of(case: LoadedModel, solution: Solution) -> Bounds:
    """Of associative flow; NaN without it."""
    associative = solution.associative
    if associative is None:
        return Bounds()
    return Bounds.of(*associative_bounds(case, associative), case.scale.least_factor(associative.mechanism))


def _checked_without_mechanics(case: LoadedModel, solution: Solution) -> Checks:
    """Of a solution without forces and mechanism: of its certificate where it has one; all figures but the bounds of
    associative flow are NaN.
    """
    stands = solution.status in WITH_VALUE and not case.load_case.has_load_factor  # which is verified by itself
    claims = stands or solution.status is Status.UNBOUNDED
    failures: tuple[Message, ...] = () if claims else (Message("not-verified", solution.reason),)
    if solution.certificate is not None:
        failures = certificate_failures(case, (solution.certificate, solution.certificate_motions))
    nan, bounds = np.nan, _bounds_of(case, solution)
    figures = (nan, nan, nan, nan, nan, nan, bounds.static, bounds.kinematic, bounds.gap)
    return Checks(*figures, verified=not failures, failures=failures)


def verified_status(solution: Solution, checks: Checks) -> Status:
    """What may be claimed: the solver's status, lowered to what verification found."""
    if solution.further.time_history.end is not HistoryEnd.NONE:
        return Status.NOT_VERIFIED if solution.status in WITH_VALUE and not checks.verified else solution.status
    if solution.status not in WITH_VALUE:
        if solution.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED) and not checks.verified:
            return Status.NOT_VERIFIED
        return solution.status
    if checks.verified and (solution.status is Status.SOLVED or solution.mechanics is None):
        return solution.status
    measures = [checks.equilibrium_residual, checks.yield_violation, abs(checks.live_power - 1.0)]
    if np.isnan(checks.elastic_residual):
        measures += [checks.penetration, checks.complementarity_residual, checks.power_balance]
    else:
        measures.append(checks.elastic_residual)
    if solution.flow_rule == "associative":
        measures.append(checks.gap)
    elif _above(solution, checks.kinematic_bound, APPROXIMATE_RESIDUAL * abs(checks.kinematic_bound)):
        return Status.NOT_VERIFIED
    return Status.APPROXIMATE if all(value <= APPROXIMATE_RESIDUAL for value in measures) else Status.NOT_VERIFIED


def meets_what_was_asked(solution: Solution, checks: Checks) -> bool:
    """Whether an approximate answer is as sharp as the analysis asks for, by the figures of the verification.

    Associative flow: its proved bounds lie within the gap asked for. Other flow: every residual is within the one
    asked for, and the load factor not above the proved kinematic bound by more than that.
    """
    requested = solution.tolerance_requested
    if requested is None or solution.mechanics is None or not abs(checks.live_power - 1.0) <= LIVE_POWER_DEVIATION:
        return False
    residuals = (
        checks.equilibrium_residual,
        checks.yield_violation,
        checks.penetration,
        checks.complementarity_residual,
        checks.power_balance,
    )
    if solution.flow_rule == "associative":
        return checks.gap <= requested and all(value <= APPROXIMATE_RESIDUAL for value in residuals)
    above = _above(solution, checks.kinematic_bound, requested * abs(checks.kinematic_bound))
    return not above and all(value <= requested for value in residuals)


def tolerances(flow_rule: str) -> dict[str, float]:
    """What a solved case may miss at most, by the name of each figure in ``Checks``; others are parts of these.

    The live power may deviate from 1 by that; the gap counts for associative flow, whose load factor the bounds prove.
    """
    associative = flow_rule == "associative"
    return {
        "equilibrium_residual": SOLVED_EQUILIBRIUM,
        "yield_violation": SOLVED_RESIDUAL,
        "penetration": SOLVED_RESIDUAL,
        "complementarity_residual": SOLVED_RESIDUAL,
        "power_balance": SOLVED_RESIDUAL,
        "live_power": LIVE_POWER_DEVIATION,
        **({"gap": GAP_TOLERANCE} if associative else {"elastic_residual": SOLVED_RESIDUAL}),
    }


def failures_of(
    residuals: Residuals, solution: Solution, bounds: Bounds, elastic: float = np.nan
) -> tuple[Message, ...]:
    """What is not within tolerance.

    elastic : misfit of the law of elastic joints, NaN for rigid ones
    """
    failures = _residual_failures(residuals, solution.flow_rule)
    if not np.isnan(elastic):
        failures = [failure for failure in failures if failure.identifier not in OF_RIGID_JOINTS]
    if elastic > SOLVED_RESIDUAL:
        words = f"forces are {elastic:.2g} off the law of elastic joints, which exceeds {SOLVED_RESIDUAL:g}"
        failures.append(Message("elastic-law-residual", words))
    if solution.flow_rule == "associative":
        failures += _bound_failures(solution, bounds)
    elif _above(solution, bounds.kinematic, SOLVED_RESIDUAL * bounds.size):
        assert solution.mechanics is not None
        words = (
            f"the load factor {solution.mechanics.load_factor:.8g} exceeds the kinematic bound {bounds.kinematic:.8g} "
            "of the associative one"
        )
        failures.append(Message("above-kinematic-bound", words))
    return tuple(failures)


OF_RIGID_JOINTS = ("penetration", "complementarity-residual", "power-balance")
"""failures that say nothing of joints with a stiffness, which close and store power"""


def _residual_failures(residuals: Residuals, flow_rule: str) -> list[Message]:
    """Residuals that exceed what the flow rule allows."""
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
        Message(identifier, f"{name} {value:.2g} exceeds {limit:g}")
        for identifier, name, value, limit in limits
        if not value <= limit
    ]


def _bound_failures(solution: Solution, bounds: Bounds) -> list[Message]:
    """What the bounds of the associative load factor leave unproved."""
    assert solution.mechanics is not None
    static, kinematic, room = bounds.static, bounds.kinematic, GAP_TOLERANCE * bounds.size
    factor = solution.mechanics.load_factor  # as reported: forces may be others than proved
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
