"""One step of a structure that moves, at the pose where it ends, for a given live work.

Unknown are the displacements of the solids and the load factor. Gaps, frames, A and loads are those of the end of the
step, so that a load factor has no error of the length of its step::

    n = n₀ − k_N g,     t = t₀ − k_T (w_T − w₀),  cut to the limit of shear l(n)
    A x + f_D + λ f_L = 0,     Σ f_L·du = s

The pose is expected to be where the step before leads on to, velocities turned with their solids. From there a step of
elastic joints (:mod:`mbla.solution.law.joint_step`) makes up for what changes in contacts. *Smoothed*, its products
stay at σ: most steps take one direction from the state before. Where that is blocked, forces stay and openings are made
as wide as solids may move, so that products are large at first and fall: joints that open and slide of a sudden are
found in a dozen directions. *Solved*, the law holds as it is: Newton's method with the exact derivative, or ever
smaller products where that comes to nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.pose import paths_of
from mbla.solution.flow.peak_step import centred
from mbla.solution.law.elastic_joints import Memory, StepState, lengths, within
from mbla.solution.law.exact_law import forces_by_law
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import aimed_direction, direction_of, length_of
from mbla.solution.law.return_map import JointForces, joint_forces, joint_stiffness
from mbla.solution.pushover.pose.geometric_stiffness import geometric
from mbla.solution.pushover.pose.moved_joints import History, JointsAt, MovedJoints
from mbla.solution.pushover.pose.step_states import below_strength, gone_on, on_central_path
from mbla.solution.thresholds import SOLVED_RESIDUAL

BALANCED, WORKS = 1e-6, 1e-6
"""Unbalanced force, in mean loads of a block, and deviation of the live work, relative, with which a step is solved."""

NEWTON, WORSE = 8, 10.0
"""Directions of Newton's method, which is given up where it leaves as many times as much as before."""

REGULAR, HELD = 1e-11, 1e-9
"""Springs over the stiffness of a row: that what nothing holds has a place, and what holds blocks at rest."""

FIRM, NEARBY = (REGULAR, 1e-6, 1e-4), 1e-3
"""Springs of Newton's method, and motion beyond which the next is tried: joints at their limit may slide anywhere."""

FARTHEST = 0.05
"""Greatest motion of a solid over its size, and greatest rotation, in a direction of a step."""

ROUNDS, NEAR = 4, (5e-3, 2e-7)
"""Poses at which a step is solved with falling products, one after the other, and unbalanced force of the law itself
from which Newton's method goes on, at the first pose and at the others."""

WIDE, INSIDE = 0.1, 0.9
"""Products of a smoothed step that begins afresh, over mean force times size; greatest shear over its limit there."""

OVERLAP, LATER, LEAST, DIRECTIONS = 0.1, 1e-3, 1e-13, 30
"""Products of a step that is solved, over mean force times the elastic overlap or a share of the live displacement,
whichever is more: at the first pose, at later poses, at the end; most directions."""

LOOSE, CLOSED, REACHED, FEW, CLOSE, EVEN = 1e-3, 0.1, 0.5, 5, 3.0, 30.0
"""A smoothed step is done with this unbalanced force, misfit of openings and slips over the elastic overlap, and reach
of its last direction; directions from the state before; greatest mean product, and greatest product, over
σ."""


@dataclass(frozen=True)
class Smoothed:
    """A smoothed step that is done: joints and state there, displacements since it began, directions it took."""

    at: JointsAt
    state: StepState
    u: FloatArray
    directions: int


@dataclass(frozen=True)
class Found:
    """A pose and the forces of the law there.

    u       : (n_rows,) displacements since the step began
    factor  : of the program
    work    : of the live load since the step began
    off     : largest unbalanced force, in mean loads of a block
    measure : that, or what is missing of the live work in the same measure
    """

    at: JointsAt
    forces: JointForces
    u: FloatArray
    factor: float
    work: float
    off: float
    measure: float

    @property
    def solved(self) -> bool:
        """Whether the step is."""
        return self.measure < BALANCED

    @property
    def fit(self) -> bool:
        """Whether it is fit to be shown: joints in series that slide at one load, each a little, come to no more."""
        return self.measure < SOLVED_RESIDUAL


@dataclass
class PoseStep:
    """A step from a pose.

    joints  : of what touches there
    history : before it
    start   : where it begins
    factor  : of the program, there
    work    : live work; nothing where the structure is at rest under a load factor
    driven  : whether the live work is given
    held    : (n_rows,) springs that hold solids where the step begins: their masses, where they move in time
    spent   : factorisations
    """

    joints: MovedJoints
    history: History
    start: JointsAt
    factor: float
    work: float
    driven: bool = True
    held: FloatArray | float = 0.0
    spent: int = 0

    def smoothed(
        self, twists: FloatArray, before: StepState | None, share: float, kappa: float, anew: bool = False
    ) -> Smoothed | None:
        """The step with products n₀ times the elastic overlap over κ; None where it is blocked.

        twists : (n_solids, 6) that are expected
        before : the state of the step before, of which this one is a share; None where there is none that leads on
        anew   : whether the step begins afresh where that state does not lead to its end
        """
        if before is not None:
            u = self.joints.displacements(twists)
            pose = self.joints.after(self.start.pose, u)
            at = self.joints.there(pose, self.factor)
            step = self._from(at, u, float(self.start.joints.program.live_load @ u))
            sigma = self._product(at) / kappa
            found = self._to(step, gone_on(step, before, share, sigma), sigma, aimed=False)
            if found is not None:
                state, directions = found
                there = self.joints.there(self.joints.after(pose, state.u), state.factor)
                return Smoothed(there, state, u + state.u, directions)
        return self._afresh(before, kappa) if before is None or anew else None

    def _afresh(self, before: StepState | None, kappa: float) -> Smoothed | None:
        """The smoothed step by ever smaller products from the forces before, and again at the pose to which it led."""
        at, u, state, done, directions = self.start, np.zeros(len(self.joints.reduced.dead_load)), before, 0.0, 0
        for number in range(ROUNDS):
            step, sigma, found = self._from(at, u, done), self._product(at) / kappa, None
            if number and state is not None:
                found = self._to(step, gone_on(step, state, 0.0, sigma), sigma, aimed=False)
            if found is None:
                state = on_central_path(step, sigma, self.factor) if state is None else state
                state = replace(state, u=np.zeros_like(u), normal=below_strength(step.joints, state.normal))
                wide = WIDE * self._force(at) * self.joints.structure.size
                found = self._to(step, centred(step.joints, state, wide, INSIDE), sigma, aimed=True)
            if found is None:
                return None
            state, directions = found[0], directions + found[1]
            done += float(at.joints.program.live_load @ state.u)
            at, u = self.joints.there(self.joints.after(at.pose, state.u), state.factor), u + state.u
            if self._size(state.u) < NEARBY:
                return Smoothed(at, state, u, directions)
        return None

    def _product(self, at: JointsAt) -> float:
        """Mean force times elastic overlap."""
        return self._force(at) ** 2 / self.joints.length

    def solved(self, near: Smoothed | None = None) -> Found | None:
        """The best by the law as it is, from a smoothed step or from the beginning; None where there is none."""
        at, u, factor, done = self.start, np.zeros(len(self.joints.reduced.dead_load)), self.factor, 0.0
        best: Found | None = None
        if near is not None:
            at, u, factor = near.at, near.u, near.state.factor
            done = float(self.start.joints.program.live_load @ u)
            best = self._newton(at, u, factor, done)
        for number in range(ROUNDS):
            if best is not None and best.solved:
                break
            found = self._primal(at, u, factor, done, number, None if near is None or number else near.state)
            if found is None:
                break
            best = found if best is None or found.measure < best.measure else best
            at, u, factor, done = found.at, found.u, found.factor, found.work
        return best

    def memory(self, at: JointsAt) -> Memory:
        """What the joints remember, for displacements from that pose on."""
        k_n, k_t = at.joints.normal * self.joints.length, at.joints.shear * self.joints.length
        slip = at.offsets[1:] - self.history.slips
        return Memory(self.history.values[0] - k_n * at.offsets[0], self.history.values[1:] - k_t * slip)

    def after(self, at: JointsAt, normal: FloatArray) -> History:
        """What the joints remember once they are at a pose with normal forces, (n_points,)."""
        joints, limits, memory = at.joints, at.joints.program.limits, self.memory(at)
        k_n, k_t = joints.normal * self.joints.length, joints.shear * self.joints.length
        shear, free = within(memory.shear, joints.limit(normal)), self.history.values[0].copy()
        if joints.dilates:
            free = free + joints.dilatancy * k_n / k_t * lengths(memory.shear - shear)
        crushes = joints.crushable
        there = np.minimum(free - k_n * at.offsets[0], limits.compression)
        free[crushes] = (there + k_n * at.offsets[0])[crushes]
        return History(np.vstack([free[None], shear]), at.offsets[1:])

    def _from(self, at: JointsAt, u: FloatArray, done: float) -> JointStep:
        """The rest of the step from a pose, to which displacements have led that did a work."""
        joints, held = at.joints, self._held
        if np.any(u) and np.any(held):
            program = replace(joints.program, dead_load=joints.program.dead_load - held * u)
            joints = replace(joints, program=program)
        springs = held + self._springs
        return JointStep(joints, self.memory(at), self.joints.length, self.driven, self.work - done, springs)

    @property
    def _held(self) -> FloatArray:
        """Springs that are part of the balance, (n_rows,)."""
        at_rest = 0.0 if self.driven else HELD * self.joints.length
        return at_rest * self.joints.size + self.held

    @property
    def _springs(self) -> FloatArray:
        """That hold what nothing holds, (n_rows,)."""
        return REGULAR * self.joints.length * self.joints.size

    def _force(self, at: JointsAt) -> float:
        """n₀, the mean load of a point."""
        program, n = at.joints.program, max(self.joints.n_points, 1)
        dead, live = (float(np.abs(load).sum()) / n for load in (program.dead_load, program.live_load))
        return dead or abs(self.factor) * live or 1.0

    def _moved(self, at: JointsAt) -> float:
        """Displacement that the live work stands for."""
        return abs(self.work) / max(float(np.abs(at.joints.program.live_load).sum()), 1e-300)

    def _size(self, u: FloatArray) -> float:
        return greatest_motion(self.joints, self.joints.twists(u))

    def _to(self, step: JointStep, state: StepState, sigma: float, *, aimed: bool) -> tuple[StepState, int] | None:
        """A state with products σ, and directions to it; None where the way is blocked.

        aimed : whether products are larger at first and choose by how much they fall
        """
        residual, fits = residual_of(step, state), CLOSED * self._force(self.start) / self.joints.length
        for number in range(1, (DIRECTIONS if aimed else FEW) + 1):
            last = not aimed or residual.products.mean(step.joints) < CLOSE * sigma
            found = direction_of(step, state, residual, sigma) if last else aimed_direction(step, state, residual)
            self.spent += 1
            if found is None or found[1] < 1e-4:
                return None
            state = state.plus(found[0], length_of(found[1]))
            if not aimed and not self._size(state.u) < FARTHEST:
                return None
            residual = residual_of(step, state)
            off = max(float(np.abs(each).max(initial=0.0)) for each in (residual.normal, residual.shear))
            done = last and found[1] >= REACHED and off < fits and float(np.abs(residual.balance[:-1]).max()) < LOOSE
            if done and float(residual.products.normal.max(initial=0.0)) < EVEN * sigma:
                return (state, number) if self._size(state.u) < FARTHEST else None
        return None

    def _measured(self, at: JointsAt, u: FloatArray, factor: float, done: float) -> tuple[Found, FloatArray]:
        """What a pose leaves without balance."""
        memory, program = self.memory(at), at.joints.program
        forces = joint_forces(at.joints, np.vstack([memory.normal, memory.shear]))
        left = at.joints.carried(forces.normal, forces.shear) + program.dead_load + factor * program.live_load
        left = left - self._held * u
        off = float(np.abs(left).max(initial=0.0))
        missing = 0.0
        if self.driven:  # of a support that is held, over what its joints store
            size = max(abs(self.work), self._force(at) ** 2 / self.joints.length)
            missing = BALANCED * abs(self.work - done) / (WORKS * size)
        measure = max(off, missing)
        measure = measure if np.isfinite(measure) else np.inf
        return Found(at, forces, u, factor, done, off, measure), left

    def _newton(self, at: JointsAt, u: FloatArray, factor: float, done: float) -> Found | None:
        """The best that Newton's method comes to from a pose; None where there are no numbers."""
        best: Found | None = None
        for number in range(NEWTON + 1):
            found, left = self._measured(at, u, factor, done)
            if not np.isfinite(found.measure):
                return best
            worse = best is not None and number >= 2 and found.measure > WORSE * best.measure
            best = found if best is None or found.measure < best.measure else best
            if best.solved or worse or number == NEWTON:
                return best
            further = geometric(self.joints, at, found.forces.normal, found.forces.shear)
            tangent, fixed = joint_stiffness(at.joints, found.forces, self.joints.length), not self.driven
            for firm in FIRM:
                springs = firm * self.joints.length * self.joints.size + self._held
                stiffness = at.joints.matrix.factorized(tangent, springs, fixed_load=fixed, further=further)
                self.spent += 1
                if stiffness is None:
                    return best
                change = stiffness(np.append(-left, 0.0 if fixed else self.work - done))
                du, by = change[:-1], 0.0 if fixed else float(change[-1])
                if self._size(du) < NEARBY:
                    break
            else:
                return best
            done += 0.0 if fixed else float(at.joints.program.live_load @ du)
            u, factor = u + du, factor + by
            at = self.joints.there(self.joints.after(at.pose, du), factor)
        return best

    def _primal(
        self, at: JointsAt, u: FloatArray, factor: float, done: float, number: int, before: StepState | None
    ) -> Found | None:
        """Ever smaller products at a pose, from a smoothed state where there is one, and Newton's method from there."""
        step, force = self._from(at, u, done), self._force(at)
        overlap = force / self.joints.length
        sigma = LATER * force * overlap if number else OVERLAP * force * max(overlap, OVERLAP * self._moved(at))
        if not self.driven and not number:
            sigma = force * overlap
        state = on_central_path(step, sigma, factor)
        if before is not None:
            state = gone_on(step, replace(before, factor=factor), 0.0, LATER * force * overlap)
        for count in range(DIRECTIONS):
            residual = residual_of(step, state)
            if residual.products.mean(step.joints) < LEAST * force * overlap:
                break
            if count and self._left(step, state) < NEAR[min(number, 1)]:
                break
            found = aimed_direction(step, state, residual)
            self.spent += 1
            if found is None or found[1] < 1e-6:
                break
            state = state.plus(found[0], length_of(found[1]))
        if not self._size(state.u) < 4.0 * FARTHEST:
            return None
        done += float(at.joints.program.live_load @ state.u) if self.driven else 0.0
        there = self.joints.there(self.joints.after(at.pose, state.u), state.factor)
        return self._newton(there, u + state.u, state.factor, done)

    def _left(self, step: JointStep, state: StepState) -> float:
        """Largest unbalanced force of the law itself for the motion of a state."""
        joints, program, forces = step.joints, step.joints.program, forces_by_law(step, state.u)
        left = joints.carried(forces.normal, forces.shear) + program.dead_load + state.factor * program.live_load
        return float(np.abs(left - step.held * state.u).max(initial=0.0))


def greatest_motion(joints: MovedJoints, twists: FloatArray) -> float:
    """Of twists, (n_solids, 6): greatest motion over the size of the solid, and rotation."""
    moved = np.linalg.norm(twists[:, :3], axis=1) / joints.structure.solids.model.blocks.sizes
    return float(max(moved.max(initial=0.0), np.linalg.norm(twists[:, 3:], axis=1).max(initial=0.0)))


def turned_on(twists: FloatArray, share: float) -> FloatArray:
    """Twists of a step that goes on as the one before, (n_solids, 6): velocities turn with their solids."""
    turn, _ = paths_of(twists[:, 3:])
    return np.hstack([np.einsum("nij,nj->ni", turn, twists[:, :3]), twists[:, 3:]]) * share
