"""One implicit step of a structure in time.

Positions are those of the beginning and the end of a step, velocities hold in between. Frames, levers and gaps are
those of the beginning, inertia that of half a step ahead::

    M (v − v_f) = h̄ Gᵀ x,   M v_f = p + h̄ f − M ΔV_g,   h̄ = (h + h₋)/2,   ΔV_g = V_g(t + h/2) − V_g(t − h₋/2)
    c ← c + h v,   R ← exp(h [ω]×) R,   L = J ω

x are the forces of the joints (:mod:`mbla.solution.time_history.step.joints_in_step`). The velocities that count are
those of their impulses, so that momentum is kept whatever the equations are solved to (Moreau 1988,
doi:10.1007/978-3-7091-2624-0_1, for the velocity as unknown). h₋ is the step before, 0 at first: with h̄ in both a
structure at rest stays so when steps change their length.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.pose import Pose, paths_of
from mbla.model.ties.moved import TieHistory
from mbla.solution.law.masses import Masses
from mbla.solution.law.return_map import JointForces
from mbla.solution.linear_algebra.stiffness import Entries
from mbla.solution.pushover.place import Energy, PushedPlace, ties_after
from mbla.solution.pushover.pose.moved_joints import History, MovedJoints
from mbla.solution.time_history.step.energies import Energies, powers
from mbla.solution.time_history.step.joints_in_step import JointsInStep
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.solved_velocities import Solved, StepEquations
from mbla.solution.time_history.step.time_state import TimeState


@dataclass(frozen=True)
class FreeFlight:
    """What the bodies would do in a step without joints.

    matrices : (n_solids, 6, 6) M half a step ahead
    begun    : (n_solids, 6) velocities before the step, angular ones by that inertia
    free     : (n_solids, 6) v_f
    dead, force, base : (n_solids, 6) impulses of dead loads, forces over time and the base
    """

    matrices: FloatArray
    begun: FloatArray
    free: FloatArray
    dead: FloatArray
    force: FloatArray
    base: FloatArray


@dataclass(frozen=True)
class StepMade:
    """A step from a state to the next.

    forces : of the joints of the program; error : e; flight : without joints
    """

    before: TimeState
    after: TimeState
    joints: JointsInStep
    forces: JointForces
    error: float


def free_flight(bodies: MovingBodies, state: TimeState, h: float) -> FreeFlight:
    """The motion without joints in a step of length h; the force that ties always have is a dead load."""
    middle = paths_of(0.5 * h * state.velocities[:, 3:])[0] @ state.pose.rotation
    tensors = bodies.tensors_at(middle)
    matrices = np.zeros((len(tensors), 6, 6))
    matrices[:, [0, 1, 2], [0, 1, 2]], matrices[:, 3:, 3:] = bodies.masses[:, None], tensors
    begin, end = state.time - 0.5 * state.length, state.time + 0.5 * h
    dead = (end - begin) * (bodies.dead(state.pose) + state.at.loads[0])
    change = bodies.history.base_velocity(end) - bodies.history.base_velocity(begin)
    base = np.zeros_like(dead)
    base[:, :3] = -bodies.masses[:, None] * change
    force = bodies.impulses(state.pose, begin, end)
    begun, free = (
        bodies.velocities(momenta, middle) for momenta in (state.momenta, state.momenta + dead + base + force)
    )
    return FreeFlight(matrices, begun, free, dead, force, base)


def step_in_time(bodies: MovingBodies, state: TimeState, h: float, flight: FreeFlight | None = None) -> StepMade:
    """One step of length h; what it leaves of the balance says whether it is solved.

    flight : that of the step, where it is known
    """
    joints, at = state.joints, state.at
    flight = free_flight(bodies, state, h) if flight is None else flight
    in_step = JointsInStep.of(state, h)
    scaling, free = joints.full.scaling, joints.full.facts.free
    between = h_mean(state, h)
    values = joints.masses.entries(flight.matrices[free]) / (h * between)
    pattern = joints.masses.pattern
    matrix = pattern.filled(values)
    momentum = np.einsum("nij,nj->ni", flight.matrices[free], flight.free[free])
    masses = Masses(matrix, joints.masses.load(momentum) / between, Entries(joints.mass_places, values))
    inverses = pattern.inverses(values)
    fall = bodies.gravity * h
    unit = fall**2 / scaling.live
    least = float(bodies.masses[bodies.free].min()) if len(bodies.free) else 1.0
    mean = float(bodies.masses[bodies.free].mean())
    step = in_step.step(masses)
    equations = StepEquations(step, pattern, inverses, least * unit * h / between, mean * unit)
    found = equations.solved(joints.displacements(h * state.velocities))
    carried = at.joints.carried(found.forces.normal, found.forces.shear)
    u = pattern.solved(inverses, masses.free + carried)
    return _made(bodies, state, flight, in_step, found, u)


def _made(
    bodies: MovingBodies, state: TimeState, flight: FreeFlight, joints: JointsInStep, found: Solved, u: FloatArray
) -> StepMade:
    """The step with displacements of the program, (n_rows,)."""
    h, moved = joints.h, state.joints
    velocities = moved.twists(u) / h
    momenta = np.einsum("nij,nj->ni", flight.matrices, velocities)
    momenta[bodies.structure.solids.model.fixed] = 0.0
    turn = paths_of(h * velocities[:, 3:])[0]
    pose = Pose(state.pose.shift + h * velocities[:, :3], turn @ state.pose.rotation)
    slips = joints.at.joints.velocities(u)[1:]
    shear = joints.remembered(found.forces, slips)
    mean = 0.5 * (flight.begun + velocities)
    counts = replace(state.counts, factorisations=state.counts.factorisations + found.spent)
    after = replace(
        state,
        time=state.time + h,
        length=h,
        pose=pose,
        velocities=velocities,
        momenta=momenta,
        free=joints.free,
        shear=shear,
        ties=_ties(state, pose, h * velocities, joints.free),
        energies=state.energies.plus(_energies(bodies, state, flight, joints, found.forces, shear, velocities, mean)),
        counts=counts,
    )
    return StepMade(state, after, joints, found.forces, found.error)


def _energies(
    bodies: MovingBodies,
    state: TimeState,
    flight: FreeFlight,
    joints: JointsInStep,
    forces: JointForces,
    shear: FloatArray,
    velocities: FloatArray,
    mean: FloatArray,
) -> Energies:
    """Of a step: work of everything on the mean of the velocities before and after it, which adds up exactly."""
    moved, h, live = state.joints, joints.h, state.joints.full.scaling.live
    d = joints.at.joints.velocities(moved.displacements(h_mean(state, h) * mean))
    across, along = -forces.normal * d[0] * live, -(forces.shear * d[1:]).sum(axis=0) * live
    ties = moved.is_tie
    momenta = np.einsum("nij,nj->ni", flight.matrices, velocities)
    always = h_mean(state, h) * joints.at.loads[0]
    rest = flight.dead - always
    constant = np.zeros_like(rest)
    constant[:, :3] = h_mean(state, h) * bodies.constant
    path = 0.5 * (h * velocities[:, :3] + state.length * state.velocities[:, :3])
    numerical = 0.5 * (powers(state.momenta, flight.begun) - powers(state.momenta, state.velocities))
    fall = powers(bodies.constant, path)
    numerical += powers(constant, mean) - fall
    return Energies(
        kinetic=0.5 * powers(momenta, velocities),
        potential=-fall,
        elastic=joints.stored(forces, shear) * live,
        friction=float(along[~ties].sum()),
        contacts=float(across[~ties].sum()),
        ties=float((across + along)[ties].sum()) - powers(always, mean),
        base=powers(flight.base, mean),
        forces=powers(flight.force + rest - constant, mean),
        numerical=numerical,
    )


def h_mean(state: TimeState, h: float) -> float:
    """Time between the middles of the step before and of a step of length h."""
    return 0.5 * (state.length + h)


def _ties(state: TimeState, pose: Pose, twists: FloatArray, free: FloatArray) -> TieHistory:
    """History of ties after twists of the solids, (n_solids, 6): they yield by what their springs do not give."""
    joints = state.joints
    if not len(joints.structure.model.ties):
        return state.ties
    history = History(np.vstack([state.free[None], state.shear]), state.at.offsets[1:])
    place = PushedPlace(state.at, joints, history, None, 0.0, twists, 0.0, state.ties, Energy())
    yielded = state.ties.yielded.copy()
    yielded[joints.ties] = np.maximum(yielded[joints.ties], _yielded(joints, free))
    return replace(ties_after(place, pose, twists), yielded=yielded)


def _yielded(joints: MovedJoints, free: FloatArray) -> FloatArray:
    """Length that ties have got longer by, or shorter, at their capacity, (n_ties,) of those that are left, m.

    free : (n_points,) normal force at no gap: what a tie has yielded takes off its prestress
    """
    n, none = len(joints.areas), np.zeros((joints.components - 1, joints.n_points))
    lost = joints.forces(np.vstack([(joints.prestress - free)[None], none]))[n:, 0]
    return np.asarray(lost / (joints.structure.stiffness * joints.full.facts.areas[n:]))
