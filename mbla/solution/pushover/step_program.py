"""The program of one step: forces and mechanism of a moved structure with the gaps between its blocks.

Pairs of programs of :mod:`alternation` start from the normal forces of the step before, in the plane with an
interior-point run where they leave more than ``ENOUGH``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from scipy.spatial import cKDTree

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids, solids_of
from mbla.contacts.moved import MovedContacts
from mbla.contacts.tied import tied
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose, moved_case, moved_model
from mbla.model.ties.moved import TieHistory, moved_ties
from mbla.model.ties.ties import Ties
from mbla.program.assemble import assemble
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.certificate import steepest_fall
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.mechanics import mechanics_of, motion_of
from mbla.solution.nonassociative.alternation import Alternation
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.moving_anchor import run_with_moving_anchor
from mbla.solution.parts import assemble_parts
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Mechanics

FEW_PAIRS, MORE_PAIRS, MOST_RUN = 3, 2, 60
"""Pairs of programs before an interior-point run from their best state, which is made if they leave more than the
residual ``ENOUGH``, pairs after it (twelve left as many steps rough), and factorisations of the run. In
space there are these pairs alone: joints carry all force at the point about which they twist there, and whatever looks
further finds other states, lower by a fifth, at the same place."""

WANTED, ENOUGH = 1e-5, 1e-4
"""Residual of the joint law with which a step is done, and with which what was found is enough."""


def _switches(model: Model) -> ReductionSwitches:
    """Planes and parts; halves where the deck gives a plane of symmetry, about which blocks move on alike."""
    return ReductionSwitches(on=True, mirror=bool(model.mirrors), points=False)


@dataclass(frozen=True)
class Normals:
    """Normal forces of a step where they act: start for the next.

    bodies, places, values : (n_points, 2), (n_points, 3) m, (n_points,) N
    """

    bodies: IntArray
    places: FloatArray
    values: FloatArray

    @staticmethod
    def of(contacts: Contacts, forces: FloatArray) -> Normals:
        """From contact forces, (n_points, 3) N."""
        return Normals(contacts.bodies[contacts.interface_of_point], contacts.points, forces[:, 0])

    def at(self, contacts: Contacts) -> FloatArray:
        """Those of the nearest points of the same two bodies, (n_points,) N; none where these did not touch."""
        bodies = contacts.bodies[contacts.interface_of_point]
        _, pair = np.unique(np.vstack([self.bodies, bodies]), axis=0, return_inverse=True)
        pair, mine = pair.ravel(), len(self.bodies)
        size = float(np.ptp(contacts.points, axis=0).max()) or 1.0
        tree = cKDTree(np.column_stack([self.places / size, 10.0 * pair[:mine]]))
        distance, nearest = tree.query(np.column_stack([contacts.points / size, 10.0 * pair[mine:]]))
        return np.asarray(np.where(distance < 5.0, self.values[nearest], 0.0))


NO_WORK = 1e-12
"""Power of the live load in a motion over what its parts add up to regardless of sign, that is rounding."""


def _does_work(program: Program, state: LawState) -> bool:
    """Whether the live load does work in the motion of a state: else no mechanism of unit live power is in it."""
    powers = program.live_load * state.velocities
    return float(powers.sum()) > NO_WORK * float(np.abs(powers).sum())


@dataclass(frozen=True)
class StepProgram:
    """Solves steps by the flow rule of the analysis."""

    settings: SolverSettings
    log: Log

    def solved(
        self, solids: Solids, case: LoadCase, found: MovedContacts, work: float, normals: Normals
    ) -> Mechanics | None:
        """Forces and mechanism there, of the solids; None without any."""
        if not len(found.gaps):
            return None
        program = assemble(solids.model, solids.contacts, case, own=False)
        scaling = program.scaling
        program = replace(program, gaps=found.gaps / work * scaling.force * scaling.units / scaling.live)
        parts = reduce_program(solids.model, solids.contacts, program, _switches(solids.model), associative=False).parts
        near = normals.at(found.contacts)
        states = [self._state(part, near) if np.any(part.live_load) else None for part in parts]
        known = [(state.load_factor, row) for row, state in enumerate(states) if state is not None]
        if len(known) < sum(bool(np.any(part.live_load)) for part in parts) or not known:
            return None
        row = min(known)[1]
        state = states[row]
        assert state is not None  # it is among those known
        solved, state = assemble_parts(parts, row, state, self.settings, self.log, states) or (parts[row], state)
        return mechanics_of(solved, state) if _does_work(solved, state) else None

    def _state(self, part: Program, normals: FloatArray) -> LawState | None:
        """The state of a part from the normal forces of the step before; from its motion it took half as long again."""
        slope = self._slope(part)
        alternation = Alternation(part, slope, self.settings, self.log, [])
        found: list[LawState] = []
        start = _reduced(part, normals)
        for last, most in ((False, FEW_PAIRS), (True, MORE_PAIRS)):
            for state in islice(_states(alternation, start), 2 * most):
                found.append(state)
                if state.residual < WANTED:
                    break
            best = min(found, key=lambda state: state.residual, default=None)
            if best is None or best.residual < ENOUGH or last or part.components == 3:
                break
            run = run_with_moving_anchor(stiffness_of(part), slope, best.forces, MOST_RUN, WANTED, lambda *each: None)
            if run.best is not None:
                found.append(run.best)
                start = run.best.forces[:, 0]
        return best

    def _slope(self, part: Program) -> FloatArray:
        """Tangent of the dilatancy angle, (n_points,)."""
        return part.limits.dilatancy_by(self.settings.analysis.flow_rule)

    def falling(self, solids: Solids, case: LoadCase) -> BoolArray:
        """Blocks that the dead load alone brings down there, (n_blocks,)."""
        program = assemble(solids.model, solids.contacts, case, own=False)
        falls = np.zeros(len(solids.model.blocks), dtype=bool)
        for part in reduce_program(
            solids.model, solids.contacts, program, _switches(solids.model), associative=False
        ).parts:
            motion = steepest_fall(part, self.settings, self.log)
            if motion is not None:
                falls |= np.any(motion_of(part, motion) != 0.0, axis=1)
        return np.asarray(falls[solids.label])


def _states(alternation: Alternation, normal: FloatArray) -> Iterator[LawState]:
    """States of a program of forces with the motion before it and with the one after it, in turn.

    normal : (n_points,) normal forces to start from; those of associative flow where their friction does not hold
    """
    velocities = alternation.motion_for(normal)
    if velocities is None:
        held = alternation.forces_for(np.zeros_like(alternation.program.dead_load), 0.0)
        velocities = None if held is None else alternation.motion_for(held[0][:, 0])
    while velocities is not None:
        found = alternation.forces_for(velocities, 0.0)
        if found is None:
            return
        forces, load_factor = found
        yield alternation.state(forces, velocities, load_factor)
        velocities = alternation.motion_for(forces[:, 0])
        if velocities is not None:
            yield alternation.state(forces, velocities, load_factor)


def moved_solids(
    model: Model, found: MovedContacts, case: LoadCase, pose: Pose, fallen: BoolArray, ties: Ties, slack: FloatArray
) -> tuple[Solids, LoadCase, MovedContacts]:
    """The model that the solver sees there, debris fixed, the loads on it, and its contacts, ties with their slack."""
    there = moved_model(model, pose)
    solids = solids_of(replace(there, fixed=there.fixed | fallen, load_cases=(), ties=ties), found.contacts)
    solids = tied(solids)
    if solids.contacts.ties is not None:
        found = replace(found, contacts=solids.contacts, gaps=np.append(found.gaps, slack[solids.contacts.ties.rows]))
    return solids, solids.load_case(moved_case(case, pose)), found


def ties_left(model: Model, pose: Pose, fallen: BoolArray, history: TieHistory) -> tuple[Ties, FloatArray]:
    """Ties there that have not broken and are not on debris, without their prestress; and their slack, m."""
    there = moved_ties(model.ties, model.blocks, pose)
    gone = history.broken(model.ties)
    on_debris = np.append(fallen, False)[model.ties.bodies]  # OUTSIDE takes the last entry
    gone[model.ties.tie_of_point[on_debris]] = True
    left = np.flatnonzero(~gone)
    return replace(there, prestress=np.zeros(len(there))).take(left), history.slack(there)[left]


def _reduced(part: Program, normals: FloatArray) -> FloatArray:
    """Normal forces of the points of a part, non-dimensional, from those of all points of the model, (n_points,) N."""
    programs = [part]
    while (reduction := programs[-1].reduction) is not None:
        programs.append(reduction.full)
    full = np.zeros((len(normals), programs[-1].components))
    full[:, 0] = normals / part.scaling.force
    values = full.ravel()
    for program in reversed(programs[:-1]):
        assert program.reduction is not None
        forces = program.reduction.forces
        values = (forces.T @ values) / np.maximum(np.asarray(forces.power(2).sum(axis=0)).ravel(), 1e-300)
    return np.asarray(values.reshape(-1, part.components)[:, 0])
