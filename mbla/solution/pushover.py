"""From the first crack to the ground: the load factor as a structure moves, by one step program after another.

A step is limit analysis of the moved geometry with gaps: with the poses of step k, its contacts, their matrix A and the
gaps g of the contact points, and with the live work D̄ of the step (Portioli 2020, doi:10.1007/s10518-019-00722-0;
static form and its dual)::

    max λ D̄ − g·N   s.t.  A x + f_D + λ f_L = 0,  x within its yield conditions
    min −f_D·Δu + dissipation   s.t.  f_L·Δu = D̄,  Δv = AᵀΔu,  Δv_N + g compatible with the joints

At D̄ → 0 and g = 0 that is limit analysis, the first point of the curve. Divided by D̄ it is the program of limit
analysis with the gaps as weights of the normal forces (``Program.gaps``). Pairs of programs of :mod:`alternation` start
from the normal forces of the step before. A gap keeps its sign: where a step let blocks overlap, the next pushes them
apart.

The curve ends where the load factor is nothing, at the displacement asked for, or where no forces or no motion are
found.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from scipy.spatial import cKDTree

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.moved import MovedContacts, MovedSearch
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose, moved_case, moved_model
from mbla.program.assemble import assemble, yield_limits
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.mechanics import mechanics_of
from mbla.solution.nonassociative.alternation import Alternation
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.moving_anchor import run_with_moving_anchor
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import CurveRow, Mechanics, Solution

MOST_PAIRS = 12
"""Pairs of programs of a step at most: one is usual, two where the mechanism changes."""

FEW_PAIRS, ENOUGH, MOST_RUN = 3, 1e-5, 60
"""Pairs before an interior-point run from their best state, if they leave more than the residual; factorisations."""

WANTED = 1e-7
"""Residual of the joint law with which a step is done."""

OFF = 0.2
"""Share by which the control point may miss its step before the step is solved again with another live work."""

LARGEST_MOTION, LARGEST_TURN = 0.02, 0.02
"""Greatest motion of a block in a step, over its size, and greatest rotation, rad."""

MOVES = 1e-3
"""Speed of a block, over the greatest, from which it moves: for the control point that is not given."""


@dataclass(frozen=True)
class Control:
    """Whose displacement is followed: the mean of points of blocks, along a direction.

    blocks, points : (m,), (m, 3) as built
    weights        : (m,), 1 in sum
    direction      : (3,), unit
    """

    blocks: IntArray
    points: FloatArray
    weights: FloatArray
    direction: FloatArray

    @staticmethod
    def of(model: Model, case: LoadCase, mechanism: FloatArray) -> Control:
        """The one that a load case asks for."""
        assert case.pushover is not None  # else nothing is pushed
        asked, control = case.pushover, Control.of_moving(model, case, mechanism)
        if len(asked.blocks):
            masses = model.blocks.masses[asked.blocks]
            points, weights = model.blocks.centroids[asked.blocks], masses / masses.sum()
            control = replace(control, blocks=asked.blocks, points=points, weights=weights)
        return replace(control, direction=asked.direction) if np.isfinite(asked.direction).all() else control

    @staticmethod
    def of_moving(model: Model, case: LoadCase, mechanism: FloatArray) -> Control:
        """The centroid of what moves in a mechanism, (n_blocks, 6), along the live load on it."""
        speed = np.linalg.norm(mechanism[:, :3], axis=1)
        moves = np.flatnonzero(speed > MOVES * speed.max())
        masses, along = model.blocks.masses[moves], case.live_load[moves, :3].sum(axis=0)
        size = float(np.linalg.norm(along))
        direction = along / size if size > 0.0 else np.einsum("n,ni->i", masses, mechanism[moves, :3])
        weights = masses / masses.sum()
        return Control(moves, model.blocks.centroids[moves], weights, direction / np.linalg.norm(direction))

    def displacement(self, model: Model, pose: Pose) -> float:
        """So far, m."""
        return float(self.weights @ pose.displacements(model.blocks, self.blocks, self.points) @ self.direction)

    def speed(self, model: Model, pose: Pose, mechanism: FloatArray) -> float:
        """Of the points, with velocities (n_blocks, 6)."""
        own, arms = mechanism[self.blocks], self.points - model.blocks.centroids[self.blocks]
        turned = np.einsum("nij,nj->ni", pose.rotation[self.blocks], arms)
        return float(self.weights @ (own[:, :3] + np.cross(own[:, 3:], turned)) @ self.direction)


@dataclass(frozen=True)
class CurvePoint:
    """A pose with the load factor that holds it there, and the mechanism by which it goes on.

    displacement : of the control point, m
    mechanism    : (n_blocks, 6) for a live power of 1
    residual     : of the joint law
    penetration  : m, the greatest overlap of blocks
    dissipation, dead_power : power of friction and of the dead load for a live power of 1
    work         : live work of the step that led here
    """

    displacement: float
    load_factor: float
    mechanism: FloatArray
    residual: float
    penetration: float
    dissipation: float
    dead_power: float
    pose: Pose
    work: float = 0.0


@dataclass(frozen=True)
class _Normals:
    """Normal forces of a step where they act: start for the next.

    bodies, places, values : (n_points, 2), (n_points, 3) m, (n_points,) N
    """

    bodies: IntArray
    places: FloatArray
    values: FloatArray

    @staticmethod
    def of(contacts: Contacts, forces: FloatArray) -> _Normals:
        return _Normals(contacts.bodies[contacts.interface_of_point], contacts.points, forces[:, 0])

    def at(self, contacts: Contacts) -> FloatArray:
        """Those of the nearest points of the same two bodies, (n_points,) N; none where these did not touch."""
        bodies = contacts.bodies[contacts.interface_of_point]
        _, pair = np.unique(np.vstack([self.bodies, bodies]), axis=0, return_inverse=True)
        pair, mine = pair.ravel(), len(self.bodies)
        size = float(np.ptp(contacts.points, axis=0).max()) or 1.0
        tree = cKDTree(np.column_stack([self.places / size, 10.0 * pair[:mine]]))
        distance, nearest = tree.query(np.column_stack([contacts.points / size, 10.0 * pair[mine:]]))
        return np.asarray(np.where(distance < 5.0, self.values[nearest], 0.0))


@dataclass
class Pushover:
    """Steps of one load case by the flow rule of the analysis.

    step : m, of the control point
    """

    model: Model
    contacts: Contacts
    search: MovedSearch
    case: LoadCase
    settings: SolverSettings
    log: Log
    step: float

    def points(self, first: Mechanics, control: Control) -> Iterator[CurvePoint]:
        """Points of the curve, the given one of limit analysis first, until no forces or no motion are found."""
        pose, normals = Pose.at_rest(len(self.model.blocks)), _Normals.of(self.contacts, first.contact_forces)
        laws, v = yield_limits(self.model, self.contacts), first.contact_velocities
        strength = laws.friction * first.contact_forces[:, 0] + laws.cohesion
        friction = float(strength @ np.linalg.norm(v[:, 1:], axis=1))
        powers = friction, float(np.vdot(self.case.dead_load, first.mechanism))
        point = CurvePoint(0.0, first.load_factor, first.mechanism, 0.0, 0.0, *powers, pose)
        while True:
            yield point
            work = self.work_of(point, control)
            pose = point.pose.after(work * point.mechanism)
            found = self.search.at(pose)
            solved = self._solved(pose, found, work, normals)
            if solved is None:
                return
            asked = self.work_of(solved[0], control)
            if abs(asked / work - 1.0) > OFF:
                work = asked
                solved = self._solved(pose, found, work, normals) or solved
            point, normals = solved
            point = replace(point, displacement=control.displacement(self.model, pose), work=work)

    def work_of(self, point: CurvePoint, control: Control) -> float:
        """Live work of the step from a point: as far as the control point shall go, and no block goes too far."""
        speed = control.speed(self.model, point.pose, point.mechanism)
        moved = np.linalg.norm(point.mechanism[:, :3], axis=1) / self.model.blocks.sizes
        turned = np.linalg.norm(point.mechanism[:, 3:], axis=1)
        most = min(LARGEST_MOTION / max(moved.max(), 1e-300), LARGEST_TURN / max(turned.max(), 1e-300))
        return float(min(self.step / speed, most) if speed > 0.0 else most)

    def _solved(
        self, pose: Pose, found: MovedContacts, work: float, normals: _Normals
    ) -> tuple[CurvePoint, _Normals] | None:
        model, contacts = moved_model(self.model, pose), found.contacts
        case = moved_case(self.case, pose)
        program = assemble(model, contacts, case, own=False)
        scaling = program.scaling
        program = replace(program, gaps=found.gaps / work * scaling.force * scaling.units / scaling.live)
        switches = ReductionSwitches(True, False, False)
        parts = reduce_program(model, contacts, program, switches, associative=False).parts
        loaded, near = [part for part in parts if np.any(part.live_load)], normals.at(contacts)
        states = [(part, self._state(part, near)) for part in loaded]
        known = [(part, state) for part, state in states if state is not None]
        if len(known) < len(states) or not known:
            return None
        part, state = min(known, key=lambda each: each[1].load_factor)
        mechanics = mechanics_of(part, state)
        penetration = max(-float(found.gaps.min(initial=0.0)), 0.0)
        powers = self._dissipation(part, state), float(np.vdot(case.dead_load, mechanics.mechanism))
        motion = mechanics.load_factor, mechanics.mechanism, state.residual, penetration
        point = CurvePoint(np.nan, *motion, *powers, pose)
        return point, _Normals.of(contacts, mechanics.contact_forces)

    def _state(self, part: Program, normals: FloatArray) -> LawState | None:
        """The state of a part from the normal forces of the step before; from its motion it took half as long again."""
        slope = self._slope(part)
        alternation = Alternation(part, slope, self.settings, self.log, [])
        found: list[LawState] = []
        start = _reduced(part, normals)
        for most in (FEW_PAIRS, MOST_PAIRS):
            for state in islice(alternation.states(start), most):
                found.append(state)
                if state.residual < WANTED:
                    break
            best = min(found, key=lambda state: state.residual, default=None)
            if best is None or best.residual < ENOUGH or most == MOST_PAIRS:
                break
            run = run_with_moving_anchor(stiffness_of(part), slope, best.forces, MOST_RUN, WANTED, lambda *each: None)
            if run.best is not None:
                found.append(run.best)
                start = run.best.forces[:, 0]
        return best

    def _slope(self, part: Program) -> FloatArray:
        """Tangent of the dilatancy angle, (n_points,)."""
        rule = self.settings.analysis.flow_rule
        if rule == "dilatancy":
            return part.limits.dilatancy
        return part.limits.friction if rule == "associative" else np.zeros(part.n_points)

    def _dissipation(self, part: Program, state: LawState) -> float:
        v = part.contact_velocities(state.velocities)
        sliding = np.linalg.norm(v[:, 1:], axis=1)
        power = float((part.limits.friction * state.forces[:, 0] + part.limits.cohesion) @ sliding)
        return power * part.scaling.live


FALLEN, REACHED = "the load factor is nothing", "the displacement asked for is reached"
STEPS_DONE, STUCK = "the steps asked for are done", "no forces or no motion were found for the next step"
LATE = "the time limit was reached"


ROUGH = 1e-4
"""Residual of the joint law from which a step is said to be rough."""


def why_not_pushed(model: Model, contacts: Contacts, solution: Solution, solved: bool) -> str:
    """What keeps a pushover from being done, in words; empty where nothing does."""
    crush = any(np.isfinite(law.compressive_strength) for law in model.joints.values())
    against = {
        "the load case is not solved": not solved or solution.mechanics is None,
        "blocks are glued": len(contacts.report.glued) > 0,
        "blocks are guided": len(model.guides) > 0,
        "it has planes of symmetry": len(model.mirrors) > 0,
        "joints can crush": crush,
        "flow_rule: livesley": solution.flow_rule == "livesley",
        "contact_model: convex": solution.conditions_on_interfaces,
    }
    return ", ".join(words for words, holds in against.items() if holds)


def pushed(
    model: Model,
    contacts: Contacts,
    section: ContactsSection,
    case: LoadCase,
    solution: Solution,
    settings: SolverSettings,
    log: Log,
    solved: bool,
) -> Solution:
    """The solution of a load case with its capacity curve, or with a remark that says why there is none."""
    against = why_not_pushed(model, contacts, solution, solved)
    if against or solution.mechanics is None:
        remark = Message("pushover-not-done", f"there is no pushover: {against}")
        return replace(solution, remarks=(*solution.remarks, remark))
    curve, end = capacity_curve(model, contacts, section, case, solution.mechanics, settings, log)
    rough = [row for row in curve if row.residual > ROUGH]
    remarks = solution.remarks
    if rough:
        worst = max(rough, key=lambda row: row.residual)
        words = f"{len(rough)} of {len(curve) - 1} steps of the pushover violate the joint law by more than {ROUGH:g}, "
        words += f"step {worst.step} the most, by {worst.residual:.2g}"
        remarks = (*remarks, Message("pushover-rough", words))
    return replace(solution, curve=curve, curve_end=end, remarks=remarks)


def capacity_curve(
    model: Model,
    contacts: Contacts,
    section: ContactsSection,
    case: LoadCase,
    first: Mechanics,
    settings: SolverSettings,
    log: Log,
) -> tuple[tuple[CurveRow, ...], str]:
    """Rows of the capacity curve from the mechanics of limit analysis, and in words why it ends."""
    asked = case.pushover
    assert asked is not None  # else nothing is pushed
    search = MovedSearch(model, contacts, section)
    pushover = Pushover(model, contacts, search, case, settings, log, asked.step)
    rows: list[CurveRow] = []
    work, friction, gained, before, end = 0.0, 0.0, 0.0, None, STUCK
    for number, point in enumerate(pushover.points(first, Control.of(model, case, first.mechanism))):
        if before is not None:
            work += 0.5 * (before.load_factor + point.load_factor) * point.work
            friction += 0.5 * (before.dissipation + point.dissipation) * point.work
            gained -= 0.5 * (before.dead_power + point.dead_power) * point.work
        factor, residual, overlap = point.load_factor, point.residual, point.penetration
        rows.append(CurveRow(number, point.displacement, factor, residual, overlap, work, friction, gained))
        before = point
        late = settings.deadline is not None and time.monotonic() > settings.deadline
        if factor <= 0.0 or point.displacement >= asked.until or number >= asked.steps or late:
            end = FALLEN if factor <= 0.0 else LATE if late else REACHED if number < asked.steps else STEPS_DONE
            break
    return tuple(rows), end


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
