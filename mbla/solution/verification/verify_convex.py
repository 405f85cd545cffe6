"""Verification of conditions on interfaces, torsion and crushing: as in ``verify_points``, with these.

A point of an interface moves by what torsion and crushing of the interface leave of the motion of the blocks, and its
force obeys its own cone. Resultants are summed up from the contact forces, and conditions and dissipation of interfaces
come from :mod:`mbla.solution.verification.interface_laws`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.program import Program, assemble
from mbla.program.assemble import yield_limits
from mbla.program.resultants.resultants_map import resultants_map
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.proof.kinematic_repair import repaired_mechanisms
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.thresholds import LIVE_POWER_DEVIATION, SOLVED_EQUILIBRIUM, SOLVED_RESIDUAL
from mbla.solution.verification.case import PASSED_ON_ROUNDING, PROVED_RESIDUAL, Case, InterfaceTerms, Motion
from mbla.solution.verification.elastic_law import elastic_residual
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
from mbla.solution.verification.residuals import residuals_of
from mbla.solution.verification.statics import allowed_motion, largest_on_interface
from mbla.solution.verification.verify_points import checked

ROUNDED_OFF = 1e-9
"""Excess of an interface over what it carries when it crushes, over its normal force, that is rounding: where all of it
is crushed the excess grows with the square root of that of the conditions."""

SHARP = 1e-4
"""Share of the forces on a block that the scale of its residuals is not less than: joints that crush under thousands of
times its weight are solved to 1e-9 of what they bear."""

THRESHOLDS = (0.0, 1e-6, np.inf)
"""Share of the largest contact speed below which the motion of an interface is taken for rounding and left out."""

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
class InterfaceCase(Case):
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
    def program(self) -> Program:
        """That of the contact points, by which motions are repaired; no verdict comes from it."""
        program = assemble(self.model, self.contacts, self.load_case, own=False)  # motions are in the common unit
        return replace(program, limits=program.limits.without_crushing(~self.contacts.tie_points))

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

    def repaired_forces(self, mechanics: Mechanics) -> tuple[FloatArray, float] | None:
        """The given forces, (n_points, 3) N, and load factor: repaired when they were found, with all conditions."""
        return mechanics.contact_forces, mechanics.load_factor

    def repaired_motions(self, motion: Motion) -> Iterator[Motion]:
        """Mechanism and motions of the interfaces, as given and repaired.

        What a torsional motion lacks in opening is added to it first.
        """
        program, to_deck = self.program, self.program.scaling.live / self.program.scaling.force
        opened = self._motions(motion[1]).copy()
        opened[:, 0, 0] += np.maximum(torsion_power(self.laws, opened[:, 0])[1], 0.0)
        for u, moved in self._compatible(program.velocities(motion[0]), opened / to_deck):
            yield allowed_motion(self.model, program.mechanism(u), self.scale.arms), moved * to_deck

    def _compatible(self, velocities: FloatArray, motions: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Versions of the velocities of the blocks, (n_rows,), moved towards compatibility, with motions.

        motions : (n_interfaces, 2, 6) of the interfaces, in the program's units. They are taken as they are, without
                  those that are rounding, and left out; all of them count as one more velocity, whose value is 1 first
        """
        program, map_ = self.program, resultants_map(self.contacts)
        yield velocities, motions
        speed = float(np.abs(program.contact_velocities(velocities)).max(initial=0.0))
        size = np.abs(motions).max(axis=2, keepdims=True)
        for threshold in THRESHOLDS:
            kept = np.where(size > threshold * speed, motions, 0.0)
            together = sp.csr_array((map_.T @ kept.sum(axis=1).ravel())[None, :])
            for u in repaired_mechanisms(_with_motion(program, together), np.append(velocities, 1.0)):
                yield u[:-1], float(u[-1]) * kept

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
    return yield_limits(model, contacts).without_crushing(~contacts.tie_points)


def _with_motion(program: Program, motion: sp.csr_array) -> Program:
    """The program with a motion of interfaces behind the velocities of the blocks: v = Aᵀu − motionᵀ w.

    motion : (1, 3 n_points)
    """
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(sp.vstack([program.equilibrium_matrix, -motion])),
        dead_load=np.append(program.dead_load, 0.0),
        live_load=np.append(program.live_load, 0.0),
    )


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
