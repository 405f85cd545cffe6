"""Verification of a state with conditions on interfaces, torsion and crushing, beside those of ``verify_points``.

The motion of a contact point is that of the blocks without the motion of the interface in torsion and crushing, and its
force obeys its own cone. Resultants are summed up from the contact forces, and conditions and dissipation of interfaces
come from :mod:`mbla.solution.verification.interface_laws`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.thresholds import LIVE_POWER_DEVIATION, SOLVED_EQUILIBRIUM, SOLVED_RESIDUAL
from mbla.solution.verification.case import PASSED_ON_ROUNDING, PROVED_RESIDUAL, InterfaceTerms, LoadedModel, Motion
from mbla.solution.verification.elastic_law import elastic_residual
from mbla.solution.verification.interface_laws import (
    InterfaceLaws,
    crushing_excess,
    crushing_power,
    interface_laws,
    sliding_power,
    torsion_excess,
    torsion_power,
)
from mbla.solution.verification.lock import LASTING
from mbla.solution.verification.residuals import residuals_of
from mbla.solution.verification.statics import largest_on_interface
from mbla.solution.verification.strengths import point_strengths
from mbla.solution.verification.verify_points import checked

ROUNDED_OFF = 1e-9
"""Excess over the strength of a crushing interface, over its normal force, that counts as rounding: where all of the
interface is crushed, it grows with the square root of the excess of the conditions."""

SHARP = 1e-4
"""Share of the forces on a block that the scale of its residuals is not less than: joints that crush under thousands of
times its weight are solved to 1e-9 of what they bear."""

WRONG_RESULTANTS = 1e-9
"""Relative distance of stored resultants from those of the stored contact forces that is rounding."""


def verify_convex(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute residuals and bounds of a convex solution; NaN where there is nothing to check."""
    case = InterfaceCase(model, contacts, load_case, solution.contact_model, solution.flow_rule)
    checks = checked(case, solution)
    if solution.mechanics is None:
        return checks
    failures = (*checks.failures, *_wrong_resultants(case, solution.mechanics))
    return replace(checks, verified=not failures, failures=failures)


def torsion_check(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> float:
    """Load factor of the state with torsion of uniform pressure where it fits its law; NaN where not, or without one.

    Its forces balance the loads within the conditions of points and interfaces, and follow from its motion and history.
    """
    state = solution.torsion
    if state is None:
        return np.nan
    case = InterfaceCase(model, contacts, load_case, "convex", solution.flow_rule)
    none = np.zeros(len(contacts.points))
    residuals, elastic = residuals_of(case, state, none), elastic_residual(case, state, none)
    fits = max(residuals.yielding, elastic) <= SOLVED_RESIDUAL and residuals.equilibrium <= SOLVED_EQUILIBRIUM
    return state.load_factor if fits and abs(residuals.live_power - 1.0) <= LIVE_POWER_DEVIATION else np.nan


@dataclass(frozen=True)
class InterfaceCase(LoadedModel):
    """A load case with conditions on interfaces; resultants are (n_interfaces, 6)."""

    contact_model: str
    flow_rule: str = "associative"

    @cached_property
    def limits(self) -> YieldLimits:
        """Strengths of the contact points alone, which do not crush where their interface does."""
        return point_limits(self.model, self.contacts)

    @cached_property
    def laws(self) -> InterfaceLaws:
        """Strengths of the interfaces."""
        return interface_laws(self.model, self.contacts, self.contact_model)

    @cached_property
    def _arms(self) -> FloatArray:
        """Of the contact points from the centroids of their interfaces, in their frames, (n_points, 3)."""
        contacts = self.contacts
        arm = contacts.points - contacts.centroids[contacts.interface_of_point]
        arm = np.einsum("pjx,px->pj", contacts.frames, arm)
        arm[:, 0] = 0.0  # corners lie in the plane of the interface but for the tolerance of contacts
        return np.asarray(arm)

    def resultants(self, forces: FloatArray) -> FloatArray:
        """Forces and moments about the centroids of the interfaces in their frames, (n_interfaces, 6) N, N m.

        forces : (n_points, 3) N, compression positive
        """
        both = np.concatenate([forces, np.cross(self._arms, forces)], axis=1)
        total = np.zeros((len(self.contacts), 6))
        np.add.at(total, self.contacts.interface_of_point, both)
        return total

    def motion_of(self, mechanics: Mechanics) -> Motion:
        """How blocks and interfaces move; interfaces do not where no motions are stored."""
        return mechanics.mechanism, self._motions(mechanics.interface_motions)

    def admissible(self, motion: Motion) -> Motion:
        """The same for the blocks; what a torsional motion lacks in opening is added to it."""
        mechanism, _ = super().admissible(motion)
        opened = self._motions(motion[1]).copy()
        opened[:, 0, 0] += np.maximum(torsion_power(self.laws, opened[:, 0])[1], 0.0)
        return mechanism, opened

    def _motions(self, motions: FloatArray | None) -> FloatArray:
        return np.zeros((len(self.contacts), 2, 6)) if motions is None else motions

    def interface_velocities(self, motions: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        """Rigid motions of interfaces at the contact points, those by crushing apart, (n_points, 3)."""
        motions, interface = self._motions(motions), self.contacts.interface_of_point
        both, crushing = (
            motion[interface, :3] + np.cross(motion[interface, 3:], self._arms)
            for motion in (motions.sum(axis=1), motions[:, 1])
        )
        return both, crushing

    def interface_terms(self, mechanics: Mechanics) -> InterfaceTerms:
        """What torsion and crushing dissipate, by the flow rule of the case."""
        laws, resultants = self.laws, self.resultants(mechanics.contact_forces)
        motions = self._motions(mechanics.interface_motions)
        twisted = sliding = sliding_power(laws, resultants, motions[:, 0])
        if self.flow_rule == "associative":
            twisted, lacking = torsion_power(laws, motions[:, 0])
            twisted = twisted + np.maximum(lacking, 0.0) * np.maximum(resultants[:, 0] + laws.tension, 0.0)
        # no force comes near a strength of more: what crushes is at its own
        most = 2.0 * largest_on_interface(self.contacts, mechanics.contact_forces)
        crushed = crushing_power(laws, motions[:, 1], most)
        slip = np.abs(twisted + (resultants * motions[:, 0]).sum(axis=1))
        of_crushing = np.abs(crushed + (resultants * motions[:, 1]).sum(axis=1))
        return InterfaceTerms(
            dissipated=float(twisted.sum() + crushed.sum()),
            frictional=float(sliding.sum()),
            unexplained=float((slip + of_crushing).sum()),
            slip=float(slip.sum()),
        )

    def off_flow(self, mechanics: Mechanics) -> FloatArray:
        """How far forces of interfaces are from those with which they flow as they do, (n_interfaces,) [force].

        Torsion flows by the motion of the step, crushing by all that it has been, that before the step included. Power
        that neither force nor strength explains is, over the speed of a corner, what the force lacks; the same speed
        times the stiffness of the points is the force that springs without that motion would have. The lesser counts,
        as an interface that does not flow may lack any force, and one that lacks none may flow.
        """
        laws, resultants = self.laws, self.resultants(mechanics.contact_forces)
        motions, stiffness = self._motions(mechanics.interface_motions), mechanics.stiffness
        assert stiffness is not None
        crushed = motions[:, 1] if mechanics.crushed is None else motions[:, 1] + mechanics.crushed
        flows = (
            (sliding_power(laws, resultants, motions[:, 0], rounded=True), motions[:, 0], stiffness[:, 1]),
            (crushing_power(laws, crushed), crushed, stiffness[:, 0]),
        )
        start, interface, found = self.contacts.point_start[:-1], self.contacts.interface_of_point, []
        for power, motion, springs in flows:
            moved = motion[interface, :3] + np.cross(motion[interface, 3:], self._arms)
            speed = np.maximum.reduceat(np.linalg.norm(moved, axis=1), start)
            lacks = np.abs(power + (resultants * motion).sum(axis=1)) / np.maximum(speed, 1e-300)
            found.append(np.minimum(lacks, np.add.reduceat(springs, start) * speed))
        return np.asarray(np.maximum(*found))

    def _excess(self, forces: FloatArray) -> FloatArray:
        """Over the conditions of each interface, (n_interfaces,) [force]."""
        resultants = self.resultants(forces)
        return np.maximum(torsion_excess(self.laws, resultants), crushing_excess(self.laws, resultants))

    def interface_excess(self, forces: FloatArray, point_scale: FloatArray) -> float:
        """Largest excess of an interface over its conditions, relative to the scale of its points.

        forces      : (n_points, 3) N, compression positive
        point_scale : (n_points,) N
        """
        scale = np.minimum.reduceat(point_scale, self.contacts.point_start[:-1])
        return float((self._excess(forces) / scale).max(initial=0.0))

    def block_scale(self, forces: FloatArray, factor: float) -> FloatArray:
        """What residuals of each block are relative to, (n_blocks,)."""
        return self.scale.rounded_scale(self.contacts, forces, factor, SHARP)

    def forces_prove(self, forces: FloatArray, factor: float) -> bool:
        """Whether forces balance the loads within all conditions, those of interfaces too, up to rounding.

        forces : (n_points, 3) N, compression positive
        """
        block_scale, start = (
            self.scale.rounded_scale(self.contacts, forces, factor, PASSED_ON_ROUNDING),
            self.contacts.point_start[:-1],
        )
        allowed = PROVED_RESIDUAL * self.scale.of_lighter(self.contacts, block_scale)
        pressed = np.maximum(np.add.reduceat(forces[:, 0], start), 0.0)
        rounded_off = np.where(self.laws.crushable, ROUNDED_OFF * pressed, 0.0)
        of_interfaces = np.maximum(np.minimum.reduceat(allowed, start), rounded_off)
        return super().forces_prove(forces, factor) and bool(np.all(self._excess(forces) <= of_interfaces))

    def charge(self, forces: FloatArray, factor: float, motion: Motion) -> float:
        """That of the points, and of forces of interfaces beyond their conditions at the fastest of their points."""
        motions, interface = self._motions(motion[1]), self.contacts.interface_of_point
        moved = motions[interface, :, :3] + np.cross(motions[interface, :, 3:], self._arms[:, None])
        speed = np.maximum.reduceat(np.linalg.norm(moved, axis=2).max(axis=1), self.contacts.point_start[:-1])
        beyond = float((np.maximum(self._excess(forces), 0.0) * speed).sum()) / self.powers(motion[0])[1]
        return super().charge(forces, factor, motion) + beyond

    def dissipation(self, motion: Motion, most: float = np.inf) -> tuple[float, float]:
        """Power that joints dissipate at most by associative flow, and Σ of what motions lack in opening."""
        motions = self._motions(motion[1])
        of_points, short = super().dissipation(motion, most)
        twisted, lacking = torsion_power(self.laws, motions[:, 0])
        crushed = crushing_power(self.laws, motions[:, 1], most)
        corners = np.diff(self.contacts.point_start)
        lack = short + float((corners * np.maximum(lacking, 0.0)).sum())
        return of_points + float(twisted.sum() + crushed.sum()), lack


def point_limits(model: Model, contacts: Contacts) -> YieldLimits:
    """Strengths of the contact points alone, which do not crush where their interface does; ties keep theirs."""
    return point_strengths(model, contacts).without_crushing(~contacts.tie_points)


def _wrong_resultants(case: InterfaceCase, mechanics: Mechanics) -> tuple[Message, ...]:
    """Stored resultants must be those of the stored forces."""
    if mechanics.resultants is None or mechanics.interface_motions is None:
        return (Message("wrong-resultants", "the resultants and motions of the interfaces are missing"),)
    resultants = case.resultants(mechanics.contact_forces)
    off = np.abs(resultants - mechanics.resultants).max(initial=0.0)
    if off <= WRONG_RESULTANTS * max(float(np.abs(resultants).max(initial=0.0)), 1e-300):
        return ()
    return (Message("wrong-resultants", "the resultants of the interfaces are not those of the contact forces"),)


def convex_lock_failures(
    model: Model, contacts: Contacts, load_case: LoadCase, lock: FloatArray, contact_model: str
) -> tuple[Message, ...]:
    """Why forces, (n_points, 3) [N], are not within the conditions on interfaces at any multiple."""
    case = InterfaceCase(model, contacts, load_case, contact_model)
    none = np.zeros(len(contacts))
    dry = replace(case.laws, cohesion=none, tension=none)
    resultants = case.resultants(lock)
    allowed = LASTING * np.maximum.reduceat(np.linalg.norm(lock, axis=1), contacts.point_start[:-1])
    crushed = case.laws.crushable & (np.abs(resultants).max(axis=1) > allowed)
    if np.any(torsion_excess(dry, resultants) > allowed) or crushed.any():
        words = "the forces that should show that the structure locks do not stay within the conditions on interfaces"
        return (Message("lock-not-proved", words),)
    return ()
