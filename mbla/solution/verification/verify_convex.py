"""Verification of conditions on interfaces, torsion and crushing: as in ``verify``, with these.

A point of an interface moves by what torsion and crushing of the interface leave of the motion of the blocks, and its
force obeys its own cone. Resultants are summed up from the contact forces, and conditions and dissipation of interfaces
come from :mod:`mbla.solution.verification.interface_laws` and :mod:`mbla.solution.verification.interface_laws`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.program.resultants import ConvexProgram, assemble_convex
from mbla.program.resultants.assemble import near_crushing, without_crushing
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.associative.bounds import LOCKED_IN
from mbla.solution.associative.proofs import PASSED_ON_ROUNDING, PROVED_RESIDUAL
from mbla.solution.resultants.convex_repair import repaired_convex_forces, repaired_convex_motions
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.verification.further_claims import LASTING
from mbla.solution.verification.interface_laws import (
    InterfaceLaws,
    crushing_excess,
    crushing_power,
    interface_laws,
    sliding_power,
    torsion_excess,
    torsion_power,
)
from mbla.solution.verification.residuals import Residuals, flow_power, penetration_of, share_of, unbalanced_loads
from mbla.solution.verification.statics import (
    LoadScale,
    allowed_motion,
    contact_velocities,
    load_scale,
    off_guides,
    power,
)
from mbla.solution.verification.verify_points import Bounds, checks_of, checks_without_mechanics, failures_of

ROUNDED_OFF = 1e-9
"""Excess of an interface over what it carries when it crushes, over its normal force, that is rounding: where all of it
is crushed the excess grows with the square root of that of the conditions."""

SHARP = 1e-4
"""Share of the forces on a block that the scale of its residuals is not less than: joints that crush under thousands of
times its weight are solved to 1e-9 of what they bear."""

WRONG_RESULTANTS = 1e-9
"""Relative distance of stored resultants from those of the stored contact forces that is rounding."""


def verify_convex(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute residuals and bounds of a convex solution; NaN where there is nothing to check."""
    case = _Case(model, contacts, load_case, solution.contact_model)
    if solution.mechanics is None:
        return checks_without_mechanics(
            solution, lambda motion: _certificate_failures(case, motion, solution.certificate_motions)
        )
    residuals = _residuals(case, solution.mechanics, solution.flow_rule)
    bounds = Bounds()
    if solution.associative is not None:
        least_factor = case.scale.least_factor(solution.associative.mechanism)
        bounds = Bounds.of(*_bounds(case, solution.associative), least_factor)
    failures = failures_of(residuals, solution, bounds) + _wrong_resultants(case, solution.mechanics)
    return checks_of(residuals, bounds, failures)


class _Case:
    """Model, contacts, loads, and what follows from them alone."""

    def __init__(self, model: Model, contacts: Contacts, load_case: LoadCase, contact_model: str) -> None:
        self.model, self.contacts, self.load_case, self.contact_model = model, contacts, load_case, contact_model
        self.laws: InterfaceLaws = interface_laws(model, contacts, contact_model)
        limits = yield_limits(model, contacts)
        self.limits: YieldLimits = without_crushing(limits)
        self.scale: LoadScale = load_scale(model, contacts, load_case, limits)

    def program(self) -> ConvexProgram:
        """The program by which forces and motions are repaired; no verdict comes from it."""
        return assemble_convex(self.model, self.contacts, self.load_case, self.contact_model)

    def own_velocities(self, mechanism: FloatArray, motions: FloatArray) -> FloatArray:
        """Velocities of the points without the motions of their interfaces, (n_points, 3)."""
        moved = contact_velocities(self.model, self.contacts, mechanism)
        return moved - self.interface_velocities(motions.sum(axis=1))

    def interface_velocities(self, motions: FloatArray) -> FloatArray:
        """Rigid motions of interfaces, (n_interfaces, 6), at the contact points, (n_points, 3)."""
        interface = self.contacts.interface_of_point
        arm = self._arms()
        spin = motions[interface, 3:]
        return np.asarray(motions[interface, :3] + np.cross(spin, arm))

    def resultants(self, forces: FloatArray) -> FloatArray:
        """Forces and moments about the centroids of the interfaces in their frames, (n_interfaces, 6)."""
        both = np.concatenate([forces, np.cross(self._arms(), forces)], axis=1)
        total = np.zeros((len(self.contacts), 6))
        np.add.at(total, self.contacts.interface_of_point, both)
        return total

    def _arms(self) -> FloatArray:
        contacts = self.contacts
        arm = contacts.points - contacts.centroids[contacts.interface_of_point]
        arm = np.einsum("pjx,px->pj", contacts.frames, arm)
        arm[:, 0] = 0.0  # corners lie in the plane of the interface but for the tolerance of contacts
        return np.asarray(arm)


def point_limits(model: Model, contacts: Contacts) -> YieldLimits:
    """Strengths of the contact points alone, which do not crush where their interface does."""
    return without_crushing(yield_limits(model, contacts))


def convex_bounds(
    model: Model, contacts: Contacts, load_case: LoadCase, associative: Mechanics, contact_model: str
) -> tuple[float, float]:
    """Static and kinematic bound of the associative load factor, NaN where none could be proved."""
    return _bounds(_Case(model, contacts, load_case, contact_model), associative)


def _bounds(case: _Case, associative: Mechanics) -> tuple[float, float]:
    convex, load_case = case.program(), case.load_case
    scaling = convex.points.scaling
    crushes = np.any(_motions_of(case, associative)[:, 1] != 0.0, axis=1)
    convex = convex.with_crushing_of(crushes | near_crushing(convex, associative.contact_forces / scaling.force))
    forces = scaling.scaled_forces(associative.contact_forces)
    repaired = repaired_convex_forces(convex, forces, associative.load_factor / scaling.live)
    static = np.nan
    if repaired is not None:
        forces, factor = scaling.forces(repaired[0]), scaling.load_factor(repaired[1])
        if _forces_prove(case, forces, factor):
            static = factor
    if not np.any(load_case.dead_load[case.model.free]):
        static = float(np.fmax(static, 0.0))  # no forces balance no load
    largest = 2.0 * float(np.abs(associative.contact_forces[:, 0]).max(initial=0.0))
    values = [
        _proved_kinematic(case, mechanism, motions, largest)
        for mechanism, motions in _moved(case, convex, associative.mechanism, _motions_of(case, associative))
    ]
    return static, min((value for value in values if np.isfinite(value)), default=np.nan)


def _motions_of(case: _Case, mechanics: Mechanics) -> FloatArray:
    """Motions of the interfaces, none where none are stored."""
    motions = mechanics.interface_motions
    return np.zeros((len(case.contacts), 2, 6)) if motions is None else motions


def _moved(
    case: _Case, convex: ConvexProgram, mechanism: FloatArray, motions: FloatArray
) -> list[tuple[FloatArray, FloatArray]]:
    """Mechanism and motions of the interfaces, as given and repaired, in the deck's units.

    What a torsional motion lacks in opening is added to it first.
    """
    program, scaling = convex.points, convex.points.scaling
    velocities = program.velocities(mechanism)
    opened = motions.copy()
    opened[:, 0, 0] += np.maximum(torsion_power(case.laws, motions[:, 0])[1], 0.0)
    to_deck = scaling.live / scaling.force
    found = repaired_convex_motions(convex, velocities, opened / to_deck)
    return [(allowed_motion(case.model, program.mechanism(u), case.scale.arms), moved * to_deck) for u, moved in found]


def _forces_prove(case: _Case, forces: FloatArray, factor: float) -> bool:
    """Whether forces balance the loads within all conditions up to rounding."""
    scale, contacts = case.scale, case.contacts
    unbalanced = unbalanced_loads(case.model, contacts, case.load_case, forces, factor, scale)
    block_scale = scale.rounded_scale(contacts, forces, factor, PASSED_ON_ROUNDING)
    point_scale = scale.of_lighter(contacts, block_scale)
    allowed = PROVED_RESIDUAL * point_scale
    pressed = np.maximum(np.add.reduceat(forces[:, 0], contacts.point_start[:-1]), 0.0)
    interface_allowed = np.maximum(
        np.minimum.reduceat(allowed, contacts.point_start[:-1]),
        np.where(case.laws.crushable, ROUNDED_OFF * pressed, 0.0),
    )
    return bool(
        np.all(unbalanced <= PROVED_RESIDUAL * block_scale)
        and np.all(yield_violation(forces, case.limits) <= allowed)
        and np.all(_interface_excess(case, forces) <= interface_allowed)
    )


def _interface_excess(case: _Case, forces: FloatArray) -> FloatArray:
    resultants = case.resultants(forces)
    return np.maximum(torsion_excess(case.laws, resultants), crushing_excess(case.laws, resultants))


def _proved_kinematic(case: _Case, mechanism: FloatArray, motions: FloatArray, largest: float) -> float:
    """Load factor at or above the collapse value; ``largest`` is the normal force with which rounding is charged."""
    live_power = power(case.load_case.live_load, mechanism)
    if not live_power > 0.0:
        return np.nan
    dissipated, lack = _dissipation(case, mechanism, motions)
    return (dissipated + largest * lack - power(case.load_case.dead_load, mechanism)) / live_power


def _dissipation(case: _Case, mechanism: FloatArray, motions: FloatArray) -> tuple[float, float]:
    """Power that joints dissipate at most by associative flow, and Σ of what motions lack in opening, over points."""
    limits, v = case.limits, case.own_velocities(mechanism, motions)
    sliding = np.hypot(v[:, 1], v[:, 2])
    surplus = v[:, 0] - limits.friction * sliding
    short = np.maximum(-surplus, 0.0)
    crushable = np.isfinite(limits.compression)
    of_points = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0)
    of_points = of_points + np.where(crushable, limits.compression, 0.0) * short
    twisted, lacking = torsion_power(case.laws, motions[:, 0])
    crushed = crushing_power(case.laws, motions[:, 1])
    corners = np.diff(case.contacts.point_start)
    lack = float(short[~crushable].sum()) + float((corners * np.maximum(lacking, 0.0)).sum())
    return float(of_points.sum() + twisted.sum() + crushed.sum()), lack


def _certificate_failures(case: _Case, certificate: FloatArray, motions: FloatArray | None) -> tuple[Message, ...]:
    """Why a mechanism does not prove that the dead load alone is not carried; nothing where it does."""
    convex = case.program()
    motions = np.zeros((len(case.contacts), 2, 6)) if motions is None else motions
    failures: tuple[Message, ...] = ()
    for mechanism, moved in _moved(case, convex, certificate, motions):
        dissipated, lack = _dissipation(case, mechanism, moved)
        work = power(case.load_case.dead_load, mechanism) - dissipated
        if work > LOCKED_IN * float(case.scale.own.sum()) * lack:
            return ()
        speed = float(np.abs(contact_velocities(case.model, case.contacts, mechanism)).max(initial=0.0))
        share = share_of(lack, speed)
        words = f"the mechanism that shows the lack of equilibrium closes joints by {share:.1g} of its speed"
        if not work > 0:
            words = "the dead load does no work in the mechanism that should show the lack of equilibrium"
        failures = failures or (Message("collapse-not-proved", words),)
    return failures


def _residuals(case: _Case, mechanics: Mechanics, flow_rule: str) -> Residuals:
    """Residuals of points and interfaces under a flow rule."""
    limits, laws, scale = case.limits, case.laws, case.scale
    u, x, factor = mechanics.mechanism, mechanics.contact_forces, mechanics.load_factor
    motions, resultants = _motions_of(case, mechanics), case.resultants(mechanics.contact_forces)
    v = case.own_velocities(u, motions)
    moved = contact_velocities(case.model, case.contacts, u)
    speed = float(np.linalg.norm(moved, axis=1).max(initial=0.0))
    crushing = case.interface_velocities(motions[:, 1])
    closing = np.where(np.isinf(limits.compression), np.maximum(crushing[:, 0] - moved[:, 0], 0.0), 0.0)
    live_power, dead_power = power(case.load_case.live_load, u), power(case.load_case.dead_load, u)
    sliding = np.hypot(v[:, 1], v[:, 2])
    strength = limits.friction * x[:, 0] + limits.cohesion
    flow = flow_power(limits, limits.dilatancy_by(flow_rule), x, v, sliding, strength)
    if flow_rule == "associative":
        twisted, lacking = torsion_power(laws, motions[:, 0])
        twisted = twisted + np.maximum(lacking, 0.0) * np.maximum(resultants[:, 0] + laws.tension, 0.0)
    else:
        twisted = sliding_power(laws, resultants, motions[:, 0])
    crushed = crushing_power(laws, motions[:, 1])
    of_torsion = np.abs(twisted + (resultants * motions[:, 0]).sum(axis=1))
    of_crushing = np.abs(crushed + (resultants * motions[:, 1]).sum(axis=1))
    frictional = float(np.abs(strength * sliding).sum() + sliding_power(laws, resultants, motions[:, 0]).sum())
    balance = max(abs(factor * live_power), abs(dead_power), frictional, scale.least_factor(u))
    dissipated = flow.dissipated + float(twisted.sum() + crushed.sum())
    unbalanced = unbalanced_loads(case.model, case.contacts, case.load_case, x, factor, scale)[case.model.free]
    block_scale = scale.rounded_scale(case.contacts, x, factor, SHARP)
    point_scale = scale.of_lighter(case.contacts, block_scale)
    interface_scale = np.minimum.reduceat(point_scale, case.contacts.point_start[:-1])
    excess = float((yield_violation(x, limits) / point_scale).max(initial=0.0))
    return Residuals(
        equilibrium=float((unbalanced / block_scale[case.model.free]).max(initial=0.0)),
        yielding=max(excess, float((_interface_excess(case, x) / interface_scale).max(initial=0.0))),
        tension=float((np.maximum(-x[:, 0] - limits.tension, 0.0) / point_scale).max(initial=0.0)),
        penetration=max(penetration_of(closing, speed, u, scale.arms), off_guides(case.model, u, scale.arms)),
        complementarity=share_of(flow.normal + flow.slip + float((of_torsion + of_crushing).sum()), balance),
        slip=share_of(flow.slip + float(of_torsion.sum()), balance),
        live_power=live_power,
        power_balance=share_of(abs(dead_power + factor * live_power - dissipated), balance),
    )


def convex_residuals(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, flow_rule: str, contact_model: str
) -> Residuals:
    """Residuals of points and interfaces of any forces and motions under a flow rule."""
    return _residuals(_Case(model, contacts, load_case, contact_model), mechanics, flow_rule)


def convex_lock_failures(model: Model, contacts: Contacts, lock: FloatArray, contact_model: str) -> tuple[Message, ...]:
    """Why forces, (n_points, 3) [N], are not within the conditions on interfaces however often they are taken."""
    case = _Case(model, contacts, model.load_cases[0], contact_model)
    none = np.zeros(len(contacts))
    dry = replace(case.laws, cohesion=none, tension=none)
    resultants = case.resultants(lock)
    allowed = LASTING * np.maximum.reduceat(np.linalg.norm(lock, axis=1), contacts.point_start[:-1])
    crushed = case.laws.crushable & (np.abs(resultants).max(axis=1) > allowed)
    if np.any(torsion_excess(dry, resultants) > allowed) or crushed.any():
        words = "the forces that should show that the structure locks do not stay within the conditions on interfaces"
        return (Message("lock-not-proved", words),)
    return ()


def _wrong_resultants(case: _Case, mechanics: Mechanics) -> tuple[Message, ...]:
    """Stored resultants must be those of the stored forces."""
    if mechanics.resultants is None or mechanics.interface_motions is None:
        return (Message("wrong-resultants", "the resultants and motions of the interfaces are missing"),)
    resultants = case.resultants(mechanics.contact_forces)
    off = np.abs(resultants - mechanics.resultants).max(initial=0.0)
    if off <= WRONG_RESULTANTS * max(float(np.abs(resultants).max(initial=0.0)), 1e-300):
        return ()
    return (Message("wrong-resultants", "the resultants of the interfaces are not those of the contact forces"),)
