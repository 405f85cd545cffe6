"""Proof of the associative load factor: repaired forces and motions of the full model.

Reductions leave rounding in the full model, and parts at rest carry their loads to the tolerance of a program. So
forces are repaired to balance all loads, and motions are moved towards compatibility. The forces and the motion with
the sharpest bounds are claimed; the verification evaluates these bounds with its own statics and repairs nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program import Program, assemble
from mbla.program.resultants.resultants_map import resultants_map
from mbla.solution.full_model.contact_modes import contact_modes
from mbla.solution.proof.kinematic_repair import repaired_mechanisms
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.reach import stays_within, within_reach
from mbla.solution.solution import Mechanics, Solution
from mbla.solution.verification.case import LoadedModel, Motion
from mbla.solution.verification.proofs import certificate_failures, kinematic_bound
from mbla.solution.verification.verify_convex import InterfaceCase

LARGE, LARGE_GAP = 30_000, 1e-5
"""Rows of equilibrium, 5,000 blocks in space, beyond which a mechanism that proves a load factor so close to the static
bound is not repaired once more: that has been done for the reduced program."""

THRESHOLDS = (0.0, 1e-6, np.inf)
"""Share of the largest contact speed below which the motion of an interface is taken for rounding and left out."""


def with_proof(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Solution:
    """The solution with the associative forces and mechanism, or the certificate, that are claimed to prove it.

    Model, contacts and loads are those of rigid bodies, ties among the contacts.
    """
    given, fall = solution.associative, solution.certificate
    if given is None and (fall is None or solution.mechanics is not None):
        return solution
    repair: _AtPoints
    if solution.conditions_on_interfaces:
        program = assemble(model, contacts, load_case, own=False)  # motions are in the common unit
        program = replace(program, limits=program.limits.without_crushing(~contacts.tie_points))
        repair = _AtInterfaces(InterfaceCase(model, contacts, load_case, solution.contact_model), program)
    else:
        repair = _AtPoints(LoadedModel(model, contacts, load_case), assemble(model, contacts, load_case))
    if given is None:
        assert fall is not None
        motion, motions = _fall(repair, (fall, solution.certificate_motions))
        return replace(solution, certificate=motion, certificate_motions=motions)
    claimed = _proof(repair, given)
    by_path = solution.mechanics is not given
    return replace(solution, associative=claimed, mechanics=solution.mechanics if by_path else claimed)


@dataclass(frozen=True)
class _AtPoints:
    """How a state of contact points is repaired, by the program of the full model, and who judges it."""

    case: LoadedModel
    program: Program

    def forces(self, mechanics: Mechanics) -> tuple[FloatArray, float] | None:
        """Forces near the given ones, (n_points, 3) N, that balance the loads at a load factor; None without."""
        scaling = self.program.scaling
        forces = scaling.scaled_forces(mechanics.contact_forces)
        easier = within_reach(self.program)
        program = easier if easier is not None and stays_within(easier, forces) else self.program
        found = repaired_forces(program, forces, mechanics.load_factor / scaling.live)
        return None if found is None else (scaling.forces(found[0]), scaling.load_factor(found[1]))

    def motions(self, motion: Motion) -> Iterator[Motion]:
        """The motion and versions of it moved towards compatibility, each found when it is asked for."""
        repaired = repaired_mechanisms(self.program, self.program.velocities(motion[0]))
        next(repaired)
        yield motion
        for u in repaired:
            yield self.program.mechanism(u), None


class _AtInterfaces(_AtPoints):
    """The same of interfaces, whose forces were repaired when they were found, with all conditions."""

    case: InterfaceCase

    def forces(self, mechanics: Mechanics) -> tuple[FloatArray, float] | None:
        """The given ones."""
        return mechanics.contact_forces, mechanics.load_factor

    def motions(self, motion: Motion) -> Iterator[Motion]:
        """Motions of interfaces are taken as they are, without those that are rounding, and left out.

        All of them count as one more velocity, whose value is 1 first.
        """
        yield motion
        program, map_ = self.program, resultants_map(self.case.contacts)
        to_deck = program.scaling.live / program.scaling.force
        mechanism, opened = self.case.admissible(motion)
        assert opened is not None
        velocities, opened = program.velocities(mechanism), opened / to_deck
        speed = float(np.abs(program.contact_velocities(velocities)).max(initial=0.0))
        size = np.abs(opened).max(axis=2, keepdims=True)
        for threshold in THRESHOLDS:
            kept = np.where(size > threshold * speed, opened, 0.0)
            together = sp.csr_array((map_.T @ kept.sum(axis=1).ravel())[None, :])
            versions = repaired_mechanisms(_with_motion(program, together), np.append(velocities, 1.0))
            for u in versions:
                yield program.mechanism(u[:-1]), float(u[-1]) * to_deck * kept


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


def _proof(repair: _AtPoints, given: Mechanics) -> Mechanics:
    """Repaired forces, and the motion that proves the least load factor."""
    case, found = repair.case, repair.forces(given)
    forces, factor = (given.contact_forces, given.load_factor) if found is None else found
    best, claimed = np.nan, case.motion_of(given)
    for motion in repair.motions(claimed):
        bound = kinematic_bound(case, case.admissible(motion), forces)
        if np.isfinite(bound) and not bound >= best:
            best, claimed = bound, motion
        near = found is not None and abs(bound - factor) <= LARGE_GAP * abs(bound)
        if near and len(repair.program.dead_load) > LARGE:
            break
    mechanism, motions = claimed  # of a live power of 1 still, as the least change leaves it
    velocities = case.velocities(mechanism)
    return replace(
        given,
        load_factor=factor,
        contact_forces=forces,
        contact_velocities=velocities,
        mechanism=mechanism,
        modes=contact_modes(forces, velocities, case.limits, case.limits.dilatancy_by("associative")),
        interface_motions=motions,
    )


def _fall(repair: _AtPoints, given: Motion) -> Motion:
    """The first motion that proves that the dead load alone is not carried; the given one where none does."""
    for motion in repair.motions(given):
        if not certificate_failures(repair.case, motion):
            largest = float(np.abs(motion[0]).max(initial=0.0))
            return motion[0] / largest, None if motion[1] is None else motion[1] / largest
    return given
