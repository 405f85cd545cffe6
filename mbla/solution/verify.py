"""Verification: everything that is claimed, recomputed from model, contacts and solution.

No solver is asked and no matrix of the program stage is used for a verdict: forces are summed over blocks and
velocities taken from rigid-body motion directly (:mod:`mbla.solution.statics`). Relative measures, w being the mean
load of a loaded free block:

- equilibrium: largest unbalanced force, or moment over the block's lever arm, over w;
- yield: largest excess of a force over its yield conditions, over w;
- penetration: largest closing velocity over the largest contact speed, where the joint cannot crush;
- complementarity: share of the power balance, hence of the load factor, that the claimed flow rule leaves unexplained::

      Σ |(N + f_t)(v_N − s tan ψ)| + Σ |(μN + c) s + T·v_T|   over   max(|λ|, |f_D·u|, Σ (μN + c) s, 1e-3 Σ ‖f_D‖‖u‖)

  with s = ‖v_T‖ (the last term gives structures whose load factor is zero a scale) and ψ the friction angle
  (associative), zero (non-associative) or the joint's dilatancy angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program import assemble
from mbla.program.assemble import yield_limits
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.bounds import repaired_forces, repaired_mechanisms
from mbla.solution.solution import Checks, Mechanics, Solution, Status
from mbla.solution.statics import contact_resultants, contact_velocities, power

EQUILIBRIUM_TOLERANCE = 1e-6
OWN_EQUILIBRIUM_TOLERANCE = 1e-2
YIELD_TOLERANCE = 1e-4
PENETRATION_TOLERANCE = 1e-4
SOLVED_COMPLEMENTARITY = 1e-4
APPROXIMATE_RESIDUAL = 1e-2
"""Beyond this a factor is not a result; between it and the tolerances above it is approximate."""

ZERO_FACTOR = 1e-3
"""Load factors below this share of dead over live load are taken for that share in relative measures."""

PROVED_RESIDUAL = 2e-9
"""Unbalanced force and excess over yield, in mean loads of a block, with which forces still prove a bound."""

GAP_TOLERANCE = 1e-5
"""Greatest relative distance of static and kinematic bound at which an associative factor counts as verified."""


@dataclass(frozen=True)
class Residuals:
    """Relative residuals of one pair of forces and mechanism; see the module's text."""

    equilibrium: float
    yielding: float
    penetration: float
    complementarity: float
    live_power: float
    power_balance: float
    own_equilibrium: float
    """largest unbalanced force of a block over its own dead load"""


def verify(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute residuals and bounds of a solution; NaN where there is nothing to check."""
    if solution.mechanics is None or solution.associative is None:
        return _certificate_checks(model, contacts, load_case, solution)
    limits = yield_limits(model, contacts)
    residuals = residuals_of(model, contacts, load_case, solution.mechanics, _dilatancy(limits, solution.flow_rule))
    static, kinematic = associative_bounds(model, contacts, load_case, solution.associative)
    gap = _relative_gap(static, kinematic, model, load_case)
    failures = _failures(residuals, solution, static, kinematic, gap)
    return Checks(
        equilibrium_residual=residuals.equilibrium,
        yield_violation=residuals.yielding,
        penetration=residuals.penetration,
        complementarity_residual=residuals.complementarity,
        live_power=residuals.live_power,
        power_balance=residuals.power_balance,
        static_bound=static,
        kinematic_bound=kinematic,
        gap=gap,
        verified=not failures,
        failures=failures,
    )


def verified_status(solution: Solution, checks: Checks) -> Status:
    """What may be claimed: the solver's status, lowered to what verification found."""
    if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
        if solution.status is Status.NO_EQUILIBRIUM and not checks.verified:
            return Status.NOT_VERIFIED
        return solution.status
    if checks.verified and solution.status is Status.SOLVED:
        return Status.SOLVED
    residuals = (
        checks.equilibrium_residual,
        checks.yield_violation,
        checks.penetration,
        checks.complementarity_residual,
    )
    bounds_hold = checks.gap <= APPROXIMATE_RESIDUAL
    return Status.APPROXIMATE if max(residuals) <= APPROXIMATE_RESIDUAL and bounds_hold else Status.NOT_VERIFIED


def residuals_of(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, dilatancy: FloatArray
) -> Residuals:
    """Residuals of forces and mechanism under a flow rule with the given dilatancy (tangent), (n_points,)."""
    limits = yield_limits(model, contacts)
    free, u, x = model.free, mechanics.mechanism, mechanics.contact_forces
    arms = _arms(model, contacts)[free]
    loads = load_case.dead_load + mechanics.load_factor * load_case.live_load
    mean = _mean_load(load_case, free, arms)
    unbalanced = (contact_resultants(model, contacts, x) + loads)[free]
    unbalanced[:, 3:] /= arms[:, None]

    v = contact_velocities(model, contacts, u)
    sliding = np.hypot(v[:, 1], v[:, 2])
    speed = float(np.linalg.norm(v, axis=1).max(initial=0.0))
    closing = np.where(np.isinf(limits.compression), np.maximum(-v[:, 0], 0.0), 0.0)
    live_power, dead_power = power(load_case.live_load, u), power(load_case.dead_load, u)
    strength = limits.friction * x[:, 0] + limits.cohesion
    unexplained, dissipated = _flow_power(limits, dilatancy, x, v, sliding, strength)
    external = dead_power + mechanics.load_factor * live_power
    gross = float(np.linalg.norm(load_case.dead_load[:, :3], axis=1) @ np.linalg.norm(u[:, :3], axis=1))
    frictional = float(np.abs(strength * sliding).sum())
    balance = max(abs(mechanics.load_factor * live_power), abs(dead_power), frictional, ZERO_FACTOR * gross)
    return Residuals(
        equilibrium=float(np.abs(unbalanced).max(initial=0.0)) / mean,
        yielding=float(yield_violation(x, limits).max(initial=0.0)) / mean,
        penetration=float(closing.max(initial=0.0)) / speed if speed > 0 else np.nan,
        complementarity=unexplained / balance if balance > 0 else np.nan,
        live_power=live_power,
        power_balance=abs(external - dissipated) / balance if balance > 0 else np.nan,
        own_equilibrium=_own_equilibrium(load_case, free, arms, unbalanced),
    )


def _own_equilibrium(load_case: LoadCase, free: IntArray, arms: FloatArray, unbalanced: FloatArray) -> float:
    """Largest unbalanced force of a block over its own dead load: a light block that falls is lost in the mean."""
    dead = load_case.dead_load[free]
    own = np.hypot(np.linalg.norm(dead[:, :3], axis=1), np.linalg.norm(dead[:, 3:], axis=1) / arms)
    loaded = own > 0
    return float((np.abs(unbalanced).max(axis=1)[loaded] / own[loaded]).max(initial=0.0))


def _flow_power(
    limits: YieldLimits,
    dilatancy: FloatArray,
    x: FloatArray,
    v: FloatArray,
    sliding: FloatArray,
    strength: FloatArray,
) -> tuple[float, float]:
    """Power that the flow rule leaves unexplained, and the power that the joints dissipate."""
    surplus = v[:, 0] - dilatancy * sliding
    crushable = np.isfinite(limits.compression)
    capacity = np.where(crushable, limits.compression, 0.0)
    opening = np.maximum(surplus, 0.0)
    crushing = np.where(crushable, np.maximum(-surplus, 0.0), 0.0)
    normal = np.abs((x[:, 0] + limits.tension) * opening) + np.abs((capacity - x[:, 0]) * crushing)
    normal += np.where(crushable, 0.0, np.abs(x[:, 0] * np.minimum(surplus, 0.0)))
    shear = np.abs(strength * sliding + x[:, 1] * v[:, 1] + x[:, 2] * v[:, 2])
    dissipated = (strength - dilatancy * x[:, 0]) * sliding + limits.tension * opening + capacity * crushing
    return float((normal + shear).sum()), float(dissipated.sum())


def associative_bounds(
    model: Model, contacts: Contacts, load_case: LoadCase, associative: Mechanics
) -> tuple[float, float]:
    """Static and kinematic bound of the associative load factor, NaN where none could be proved."""
    program = assemble(model, contacts, load_case)
    scaling = program.scaling
    scaled_forces = associative.contact_forces / scaling.force
    repaired = repaired_forces(program, scaled_forces, associative.load_factor / scaling.live)
    static = np.nan
    if repaired is not None:
        static = _proved_static(
            model, contacts, load_case, scaling.forces(repaired[0]), scaling.load_factor(repaired[1])
        )
    velocities = associative.mechanism[program.free].ravel() / (scaling.row * scaling.live)
    largest = 2.0 * float(np.abs(associative.contact_forces[:, 0]).max(initial=0.0))
    values = [
        _proved_kinematic(model, contacts, load_case, program.mechanism(u), largest)
        for u in repaired_mechanisms(program, velocities)
    ]
    kinematic = min((value for value in values if np.isfinite(value)), default=np.nan)
    return static, kinematic


def _proved_static(
    model: Model, contacts: Contacts, load_case: LoadCase, forces: FloatArray, load_factor: float
) -> float:
    """The load factor if the forces balance it within the yield conditions up to rounding, else NaN."""
    free = model.free
    arms = _arms(model, contacts)[free]
    mean = _mean_load(load_case, free, arms)
    loads = load_case.dead_load + load_factor * load_case.live_load
    unbalanced = (contact_resultants(model, contacts, forces) + loads)[free]
    unbalanced[:, 3:] /= arms[:, None]
    excess = yield_violation(forces, yield_limits(model, contacts)).max(initial=0.0)
    rounding = PROVED_RESIDUAL * max(mean, 1e-6 * float(np.abs(forces).max(initial=0.0)))
    proved = np.abs(unbalanced).max(initial=0.0) <= rounding and excess <= rounding
    return load_factor if proved else np.nan


def _proved_kinematic(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanism: FloatArray, largest: float
) -> float:
    """Load factor at or above the collapse value: −f_D·u plus dissipation, per live power.

    Incompatibility δ = μ s − v_N left by rounding is charged with ``largest``: by virtual work, no admissible forces
    with normal forces up to that size can carry more.
    """
    limits = yield_limits(model, contacts)
    v = contact_velocities(model, contacts, mechanism)
    live_power = power(load_case.live_load, mechanism)
    if not live_power > 0.0:
        return np.nan
    sliding = np.hypot(v[:, 1], v[:, 2])
    surplus = v[:, 0] - limits.friction * sliding
    lack = np.maximum(-surplus, 0.0)
    resistance = np.where(np.isinf(limits.compression), largest, limits.compression)
    dissipated = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0) + resistance * lack
    return float((dissipated.sum() - power(load_case.dead_load, mechanism)) / live_power)


def _certificate_checks(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """No load factor: check the mechanism that shows why, where there is one."""
    failures: tuple[str, ...] = (solution.reason,) if solution.status is not Status.UNBOUNDED else ()
    if solution.certificate is not None:
        failures = _certificate_failures(model, contacts, load_case, solution.certificate)
    nan = np.nan
    return Checks(nan, nan, nan, nan, nan, nan, nan, nan, nan, verified=not failures, failures=failures)


def _certificate_failures(
    model: Model, contacts: Contacts, load_case: LoadCase, certificate: FloatArray
) -> tuple[str, ...]:
    """The dead load must do more work than the joints can dissipate, and no joint may be closed but by rounding."""
    limits = yield_limits(model, contacts)
    v = contact_velocities(model, contacts, certificate)
    speed = float(np.abs(v).max(initial=0.0))
    sliding = np.hypot(v[:, 1], v[:, 2])
    surplus = v[:, 0] - limits.friction * sliding
    crushable = np.isfinite(limits.compression)
    lack = np.where(crushable, 0.0, np.maximum(-surplus, 0.0)).max(initial=0.0)
    capacity = np.where(crushable, limits.compression, 0.0)
    dissipated = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0)
    dissipated = dissipated + capacity * np.maximum(-surplus, 0.0)
    failures = []
    if lack > 1e-5 * max(speed, float(np.abs(certificate[:, :3]).max(initial=0.0))):
        failures.append(
            f"the mechanism that shows the lack of equilibrium closes joints by {lack / speed:.1g} of its speed"
        )
    if not power(load_case.dead_load, certificate) > dissipated.sum():
        failures.append("the dead load does no work in the mechanism that should show the lack of equilibrium")
    return tuple(failures)


def _dilatancy(limits: YieldLimits, flow_rule: str) -> FloatArray:
    """Tangent of the dilatancy angle that a flow rule claims, (n_points,)."""
    return {
        "associative": limits.friction,
        "non_associative": np.zeros_like(limits.friction),
        "dilatancy": limits.dilatancy,
    }[flow_rule]


def _relative_gap(static: float, kinematic: float, model: Model, load_case: LoadCase) -> float:
    """Distance of the bounds over the load factor; over dead load / live load where the factor is tiny."""
    free = model.free
    dead, live = (np.linalg.norm(load[free, :3]) for load in (load_case.dead_load, load_case.live_load))
    size = max(abs(kinematic), ZERO_FACTOR * float(dead / live) if live > 0 else 0.0)
    return float(abs(kinematic - static) / size) if size > 0 else np.nan


def _failures(residuals: Residuals, solution: Solution, static: float, kinematic: float, gap: float) -> tuple[str, ...]:
    limits = (
        ("equilibrium residual", residuals.equilibrium, EQUILIBRIUM_TOLERANCE),
        ("unbalanced force of a block over its own dead load", residuals.own_equilibrium, OWN_EQUILIBRIUM_TOLERANCE),
        ("yield violation", residuals.yielding, YIELD_TOLERANCE),
        ("penetration", residuals.penetration, PENETRATION_TOLERANCE),
        ("complementarity residual", residuals.complementarity, SOLVED_COMPLEMENTARITY),
        ("deviation of the live power from 1", abs(residuals.live_power - 1.0), EQUILIBRIUM_TOLERANCE),
    )
    failures = [f"{name} {value:.2g} exceeds {limit:g}" for name, value, limit in limits if not value <= limit]
    if not gap <= GAP_TOLERANCE:
        failures.append(
            f"static bound {static:.8g} and kinematic bound {kinematic:.8g} lie further apart than {GAP_TOLERANCE:g}"
        )
    factor = solution.mechanics.load_factor if solution.mechanics else np.nan
    if solution.flow_rule != "associative" and factor > kinematic * (1 + GAP_TOLERANCE) + GAP_TOLERANCE * abs(
        kinematic
    ):
        failures.append(
            f"the load factor {factor:.8g} exceeds the kinematic bound {kinematic:.8g} of the associative one"
        )
    return tuple(failures)


def _arms(model: Model, contacts: Contacts) -> FloatArray:
    """Mean distance of each block's contact points from its centroid (its size where it has none), (n_blocks,)."""
    n_blocks = len(model.blocks)
    bodies = contacts.bodies[contacts.interface_of_point]
    total, count = np.zeros(n_blocks), np.zeros(n_blocks)
    for side in (0, 1):
        here = bodies[:, side] < n_blocks
        block = bodies[here, side]
        np.add.at(total, block, np.linalg.norm(contacts.points[here] - model.blocks.centroids[block], axis=1))
        np.add.at(count, block, 1.0)
    return np.where(count > 0, total / np.maximum(count, 1.0), model.blocks.sizes)


def _mean_load(load_case: LoadCase, free: IntArray, arms: FloatArray) -> float:
    """Mean size of the dead load (live load where there is none) of the loaded free blocks."""
    for load in (load_case.dead_load, load_case.live_load):
        sizes = np.hypot(np.linalg.norm(load[free, :3], axis=1), np.linalg.norm(load[free, 3:], axis=1) / arms)
        if np.any(sizes > 0):
            return float(sizes[sizes > 0].mean())
    return 1.0
