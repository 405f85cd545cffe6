"""Contact points and ties of a frame of a time history where they are: gaps, velocities, limits, law of joints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.model import Model
from mbla.model.ties.moved import moved_ties, tie_lengths
from mbla.model.ties.ties import Ties
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.verification.in_time.bodies import MovedSolids
from mbla.solution.verification.in_time.loads import add_forces, senses, tie_limits, tie_points


@dataclass(frozen=True)
class FrameContact:
    """Contact points and ties of a frame where they are; n of them, ties last.

    moved   : the bodies
    points  : as material points
    ends    : (n_surface, 3) places of a and b
    axes    : (n_surface, 3, 3) frames there
    gaps    : (n,) w_N; of ties by how much they are shorter than as built, or longer where they push
    closing : (n, 3) u; of ties along them alone
    ties    : the model's where they are
    remembered, forces : (n, 3)
    tension, crush : (n,) limits of the normal force; tension positive
    strength : (n, 2) friction and cohesion
    step    : h
    """

    moved: MovedSolids
    points: PointSet
    surface: BoolArray
    ends: tuple[FloatArray, FloatArray]
    axes: FloatArray
    gaps: FloatArray
    closing: FloatArray
    ties: Ties
    remembered: FloatArray
    forces: FloatArray
    tension: FloatArray
    crush: FloatArray
    strength: FloatArray
    step: float

    @staticmethod
    def of(frames: Frames, frame: int, moved: MovedSolids, motion: FloatArray | None = None) -> FrameContact:
        """Of a frame.

        motion : (n_blocks, 6) that ``closing`` is of; that after the step unless given
        """
        model, points = moved.solids.model, frames.sets[int(frames.set_of_frame[frame])]
        motion = frames.velocities[frame] if motion is None else motion
        surface = points.bodies[:, 0] >= 0
        bodies = points.bodies[surface]
        ends = moved.points(bodies[:, 0], points.arms[surface, 0]), moved.points(bodies[:, 1], points.arms[surface, 1])
        host = np.where(points.host[surface], bodies[:, 1], bodies[:, 0])
        axes = moved.turned(host, points.frames[surface])
        places = np.where(points.host[surface][:, None], *ends)
        speeds = [moved.velocities(bodies[:, side], places, motion) for side in (0, 1)]
        ties = moved_ties(model.ties, model.blocks, moved.pose)
        n, own = int(surface.sum()), points.laws[~surface]
        gaps, closing = np.zeros(len(surface)), np.zeros((len(surface), 3))
        gaps[:n] = np.einsum("nj,nj->n", axes[:, 0], ends[1] - ends[0])
        closing[:n] = np.einsum("nij,nj->ni", axes, speeds[1] - speeds[0])
        if len(own):
            sense = senses(model.ties)[own]
            gaps[n:] = -sense * (tie_lengths(ties) - tie_lengths(model.ties))[own]
            closing[n:, 0] = -sense * _lengthening(moved, ties, motion)[own]
        values = frames.values(frame)
        return FrameContact(
            moved, points, surface, ends, axes, gaps, closing, ties, frames.remembered[values], frames.forces[values],
            *_limits(model, points, surface), float(frames.lengths[frame]),
        )  # fmt: skip

    def off_law(self, fall: float) -> tuple[float, float]:
        """Largest force off the law, and largest velocity of a point that would explain one, over that of free fall."""
        k = self.points.stiffness
        room = k * (self.step + self.points.dashpot)[:, None]
        trial = self.remembered - room * self.closing
        trial[:, 0] -= k[:, 0] * self.gaps
        trial[~self.surface, 1:] = 0.0
        across = np.clip(trial[:, 0], -self.tension, self.crush)
        along = self._within(trial[:, 1:])
        off = np.column_stack([across, along]) - self.forces
        explained = np.abs(off) / np.maximum(room, 1e-300)
        explained[~self.surface, 1:] = 0.0
        largest = float(np.linalg.norm(off, axis=1).max(initial=0.0))
        return largest, float(explained.max(initial=0.0)) / fall

    def _within(self, shear: FloatArray) -> FloatArray:
        """Shear (n, 2) within the cone of the normal force that is there: an error across is no error along."""
        strength = np.maximum(self.strength[:, 0] * self.forces[:, 0] + self.strength[:, 1], 0.0)
        size = np.hypot(shear[:, 0], shear[:, 1])
        return np.asarray(shear * np.where(size > strength, strength / np.maximum(size, 1e-300), 1.0)[:, None])

    def friction_kept(self) -> FloatArray:
        """What the springs of the joints carry of shear after the step, (n, 2)."""
        springs = self.points.stiffness[:, 1:] * self.points.dashpot[:, None] * self.closing[:, 1:]
        return self._within(self.forces[:, 1:] + springs)

    def overlap(self) -> float:
        """Largest of bodies at a point that is pressed, over the size of the smaller of the two."""
        n, solids = len(self.axes), self.moved.solids
        bodies = self.points.bodies[self.surface]
        sizes = np.where(bodies < len(solids), solids.sizes[np.minimum(bodies, len(solids) - 1)], np.inf).min(axis=1)
        pressed = self.forces[:n, 0] > 0.0
        return -float(np.min((self.gaps[:n] / sizes)[pressed], initial=0.0))

    def add_to(self, total: FloatArray, between: float) -> None:
        """Add the impulses of all points and ties to those on bodies, (n_solids, 6) about mass centres.

        between : time from the middle of the step before to that of the step, in which forces act
        """
        n = len(self.axes)
        bodies = self.points.bodies[self.surface]
        places = np.where(self.points.host[self.surface][:, None], *self.ends)
        forces = between * np.einsum("nk,nkj->nj", self.forces[:n], self.axes)
        for side, sign in ((0, -1.0), (1, 1.0)):
            add_forces(total, self.moved, bodies[:, side], places, sign * forces)
        own = self.points.laws[~self.surface]
        if len(own):
            tension = np.zeros(len(self.ties))
            tension[own] = between * self.forces[n:, 0] * senses(self.ties)[own]
            body, on = tie_points(self.moved, self.ties, own)
            pulls = tension[self.ties.tie_of_point][on, None] * self.ties.pulls[on]
            add_forces(total, self.moved, body[on], self.ties.places[on], pulls)


def _lengthening(moved: MovedSolids, ties: Ties, motion: FloatArray) -> FloatArray:
    """Rate at which ties get longer, (n_ties,)."""
    body, on = tie_points(moved, ties, np.arange(len(ties)))
    speeds = moved.velocities(body[on], ties.places[on], motion)
    found = np.bincount(ties.tie_of_point[on], -(speeds * ties.pulls[on]).sum(axis=1), len(ties))
    return np.asarray(found, dtype=np.float64)


def _limits(model: Model, points: PointSet, surface: BoolArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Tension and compression that points bear, (n,), and friction and cohesion, (n, 2)."""
    laws, row = list(model.joints.values()), np.where(surface, points.laws, 0)

    def of_law(name: str, factor: FloatArray) -> FloatArray:
        values = np.array([getattr(law, name) for law in laws], dtype=float)[row]
        return np.where(
            surface, np.where(np.isinf(values), np.inf, np.where(np.isinf(values), 1.0, values) * factor), 0.0
        )

    tension, crush = of_law("tensile_strength", points.areas), of_law("compressive_strength", points.areas)
    strength = np.column_stack([of_law("friction", np.ones(len(row))), of_law("cohesion", points.areas)])
    ties, own = model.ties, points.laws[~surface]
    ends = tie_limits(ties)[own]
    tension[~surface], crush[~surface] = -ends[:, 0], ends[:, 1]
    return tension, crush, strength
