"""Where a structure that is pushed stands: places of its way, rows of its curve, and the energies of both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.lift import motions_of_blocks
from mbla.model.pose import Pose
from mbla.model.ties.moved import TieHistory
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.pushover.pose.moved_joints import History, JointsAt, MovedJoints
from mbla.solution.pushover.pose.pose_step import PoseStep
from mbla.solution.pushover.pose.smoothed_step import Smoothed
from mbla.solution.pushover.pose.solved_step import SolvedPose


@dataclass(frozen=True)
class Energy:
    """J since the structure was at rest.

    live           : work of the live load
    friction, ties, crushing : dissipated in sliding, by ties and in joints that crush
    potential      : gained by the dead load
    """

    live: float = 0.0
    friction: float = 0.0
    ties: float = 0.0
    crushing: float = 0.0
    potential: float = 0.0

    def after(self, step: PoseStep, at: JointsAt, end: FloatArray, u: FloatArray, load_factor: float) -> Energy:
        """After a step.

        end : (components, n_points) forces there; u : (n_rows,) displacements of it; load_factor : there
        """
        joints, scaling = step.joints, step.joints.full.scaling
        before, memory = step.start, step.memory(step.start)
        limits = at.joints.program.limits
        begun = np.vstack([np.clip(memory.normal, -limits.tension, limits.compression)[None], memory.shear])
        if at.joints.dilates:  # the smoothed law holds a joint that slides open, which is none of its force
            begun[0] = np.where(joints.is_tie, begun[0], end[0])
        moved = at.offsets - before.offsets
        work = -0.5 * (begun + end) * moved
        stiffness = np.vstack([at.joints.normal[None], np.tile(at.joints.shear, (joints.components - 1, 1))])
        stored = 0.5 * (end**2 - begun**2) / (joints.length * stiffness)
        lost = (work - stored) * scaling.live
        ties = joints.is_tie
        crushes = np.isfinite(limits.compression) & ~ties
        by = np.hstack([at.pose.shift - before.pose.shift, joints.twists(u)[:, 3:]])
        dead, live = (0.5 * float(np.vdot(one + other, by)) for one, other in zip(before.loads, at.loads, strict=True))
        mean = 0.5 * (step.factor * scaling.live + load_factor)
        return Energy(
            self.live + mean * live,
            self.friction
            + float(lost[1:][:, ~ties].sum())
            + float(np.where(at.joints.dilates, lost[0][~ties & ~crushes], 0.0).sum()),
            self.ties + float(lost[0][ties].sum()),
            self.crushing + float(lost[0][crushes].sum()),
            self.potential - dead,
        )


@dataclass(frozen=True)
class PushedPlace:
    """Where a smoothed step has led.

    state   : there; None at rest and where contacts are new
    factor  : load factor of the deck, smoothed
    twists  : (n_solids, 6) of the step, and its live work
    energy  : so far
    """

    at: JointsAt
    joints: MovedJoints
    history: History
    state: StepState | None
    factor: float
    twists: FloatArray
    work: float
    ties: TieHistory
    energy: Energy

    @property
    def pose(self) -> Pose:
        """There."""
        return self.at.pose


@dataclass(frozen=True)
class Row:
    """A place in equilibrium.

    forces  : (n_points, 3) N of all points of ``joints``
    history : before the step
    off     : largest unbalanced force, in mean loads of a block
    """

    pose: Pose
    joints: MovedJoints
    history: History
    forces: FloatArray
    load_factor: float
    off: float
    ties: TieHistory
    energy: Energy


def place_after(step: PoseStep, found: Smoothed, before: PushedPlace) -> PushedPlace:
    """Where a smoothed step has led."""
    joints, state = step.joints, found.state
    factor, twists = joints.full.scaling.load_factor(state.factor), joints.twists(found.u)
    ties = ties_after(before, found.at.pose, twists)
    history = step.after(found.at, state.normal)
    end = np.vstack([state.normal[None], history.values[1:]])
    energy = before.energy.after(step, found.at, end, found.u, factor)
    return PushedPlace(found.at, joints, history, state, factor, twists, step.work, ties, energy)


def row_after(step: PoseStep, found: SolvedPose, before: PushedPlace) -> Row:
    """The row of a step that is solved."""
    joints, pose = step.joints, found.at.pose
    end = np.vstack([found.forces.normal[None], found.forces.shear])
    factor = joints.full.scaling.load_factor(found.factor)
    ties = ties_after(before, pose, joints.twists(found.u))
    energy = before.energy.after(step, found.at, end, found.u, factor)
    return Row(pose, joints, step.history, joints.forces(end), factor, found.off, ties, energy)


def ties_after(place: PushedPlace, pose: Pose, twists: FloatArray) -> TieHistory:
    """History of ties at a pose to which twists of the solids, (n_solids, 6), have led from a place."""
    structure = place.joints.structure
    model = structure.model
    if not len(model.ties):
        return place.ties
    here = structure.blocks_at(place.pose).moved(model.blocks)
    motion = motions_of_blocks(structure.solids, twists)
    return place.ties.after(here, structure.ties_at(place.pose), motion, structure.ties_at(pose))
