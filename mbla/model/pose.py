"""Poses of blocks in a finite displacement: where each block has moved to, and the model there.

Vertices always follow from the pose and the model as it was built, so that blocks stay rigid however many steps are
made. A step moves each block by the screw of its twist (v, ω) about its centroid, which keeps a resting axis where it
is: a block that rocks about an edge turns about it exactly, whatever the step::

    R ← exp([ω]×) R          shift ← shift + J(ω) v,     J = 1 + (1 − cos θ)/θ² [ω]× + (θ − sin θ)/θ³ [ω]×²
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray, row_of_item
from mbla.model.model import LoadCase, Model, Pushing
from mbla.model.solids.blocks import Blocks
from mbla.model.supports.guides import Guides
from mbla.model.ties.ties import NO_TIES
from mbla.questions.angle import Angle
from mbla.questions.tilt import Tilt


@dataclass(frozen=True)
class Pose:
    """Where every block is.

    shift    : (n_blocks, 3) m, displacement of the centroid
    rotation : (n_blocks, 3, 3), about the centroid
    """

    shift: FloatArray
    rotation: FloatArray

    @staticmethod
    def at_rest(n_blocks: int) -> Pose:
        """As built."""
        return Pose(np.zeros((n_blocks, 3)), np.broadcast_to(np.eye(3), (n_blocks, 3, 3)).copy())

    @staticmethod
    def of(motions: FloatArray) -> Pose:
        """After displacements of the centroids and rotation vectors, (n_blocks, 6)."""
        return Pose(motions[:, :3], screws(motions)[0])

    @property
    def rotation_vectors(self) -> FloatArray:
        """(n_blocks, 3) rad."""
        from scipy.spatial.transform import Rotation  # late: it takes 60 ms to import, and few load cases are pushed

        return np.asarray(Rotation.from_matrix(self.rotation).as_rotvec())

    def after(self, twists: FloatArray) -> Pose:
        """After twists about the centroids, velocity and rotation vector times the time they act, (n_blocks, 6)."""
        turn, travel = screws(twists)
        return Pose(self.shift + travel, turn @ self.rotation)

    def moved(self, blocks: Blocks) -> Blocks:
        """The blocks there; those are given as built."""
        of_vertex, of_face = row_of_item(blocks.vertex_start), blocks.block_of_face
        arms = blocks.vertices - blocks.centroids[of_vertex]
        centroids = blocks.centroids + self.shift
        mass_arms = blocks.added_mass_points - blocks.centroids
        return replace(
            blocks,
            vertices=centroids[of_vertex] + np.einsum("vij,vj->vi", self.rotation[of_vertex], arms),
            face_normals=np.einsum("fij,fj->fi", self.rotation[of_face], blocks.face_normals),
            centroids=centroids,
            added_mass_points=centroids + np.einsum("bij,bj->bi", self.rotation, mass_arms),
        )

    def motion_to(self, there: Pose) -> FloatArray:
        """Displacements and rotation vectors of blocks from here to another pose, (n_blocks, 6)."""
        by = Pose(there.shift - self.shift, there.rotation @ self.rotation.transpose(0, 2, 1))
        return np.hstack([by.shift, by.rotation_vectors])

    def displacements(self, blocks: Blocks, owners: IntArray, points: FloatArray) -> FloatArray:
        """Of points (n, 3) as built of the blocks ``owners``, (n,): (n, 3)."""
        arms = points - blocks.centroids[owners]
        return np.asarray(self.shift[owners] + np.einsum("nij,nj->ni", self.rotation[owners], arms) - arms)


def moved_case(case: LoadCase, pose: Pose) -> LoadCase:
    """The load case on blocks there: points of forces move along; forces and couples turn or keep their direction.

    Of a tilting table the loads of its ``Tilt``, whatever line of loads the case has for its live load.
    """
    push = case.pushover
    assert push is not None  # else its levers are not known
    dead = turned_load(case.dead_load, push.dead_levers, push.dead_following, pose)
    live = turned_load(case.live_load, push.live_levers, push.live_following, pose)
    tilt = case.question.record(Tilt)
    question = Angle(_moved_tilt(tilt, dead, push, pose)) if tilt else case.question
    return replace(case, dead_load=dead, live_load=live, question=question)


def _moved_tilt(tilt: Tilt, dead: FloatArray, push: Pushing, pose: Pose) -> Tilt:
    """With masses where they are there; gravity as it turns is the load across, a right angle further about the axis.

    dead : (n_blocks, 6) there
    """
    none, levers = np.zeros_like(push.live_following), push.live_levers.reshape(-1, 3, 3)
    turning = turned_load(tilt.turning, np.cross(tilt.axis, levers).reshape(-1, 9), none, pose)
    across = turned_load(tilt.across, push.live_levers, none, pose)
    return replace(tilt, fixed=dead - turning, turning=turning, across=across)


def turned_load(load: FloatArray, levers: FloatArray, following: FloatArray, pose: Pose) -> FloatArray:
    """Loads on blocks at a pose, (n_blocks, 6), from those as built.

    levers    : (n_blocks, 9) of what keeps its direction
    following : (n_blocks, 6) the part of the loads that turns with its block
    """
    parts = following.reshape(-1, 2, 3)
    load = load + (np.einsum("nij,nkj->nki", pose.rotation, parts) - parts).reshape(-1, 6)
    built = levers.reshape(-1, 3, 3)
    change = pose.rotation @ built - built
    moments = np.stack([change[:, j, k] - change[:, k, j] for j, k in ((1, 2), (2, 0), (0, 1))], axis=1)
    return np.hstack([load[:, :3], load[:, 3:] + moments])


def moved_model(model: Model, pose: Pose) -> Model:
    """The model with its blocks where a pose puts them; guides turn on about the same line, or slide the same way.

    Guides for which that is not the same are not followed (:func:`turns_and_slides`).
    """
    guides, turn = model.guides, pose.rotation[model.guides.blocks]
    turns = np.any(guides.motions[:, 3:] != 0.0, axis=1, keepdims=True)
    velocities = np.where(turns, np.einsum("mij,mjk->mik", turn, guides.motions[:, :3]), guides.motions[:, :3])
    motions = np.concatenate([velocities, guides.motions[:, 3:]], axis=1)
    return replace(
        model,
        blocks=pose.moved(model.blocks),
        interfaces=None,
        guides=replace(guides, motions=motions),
        ties=NO_TIES,  # those that are left are found with their history (:mod:`mbla.model.ties.moved`)
    )


def turns_and_slides(guides: Guides) -> bool:
    """Whether guided bodies turn about something that moves: they have a way to turn, not about their own centroid, and
    another way besides.
    """
    velocities, turns = guides.motions[:, :3], np.any(guides.motions[:, 3:] != 0.0, axis=1)
    elsewhere = np.any(turns & np.any(velocities != 0.0, axis=1), axis=1)
    ways = np.any(guides.motions != 0.0, axis=1).sum(axis=1)
    return bool(np.any(elsewhere & (ways > 1)))


def screws(motion: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotation matrices R, (n, 3, 3), and displacements V u of the centroids, (n, 3), of finite motions.

    With the angle θ and K of the unit axis: R = I + sin θ K + (1 − cos θ) K² (Rodrigues; scipy's rotations take 60 ms
    to import), V = I + (1 − cos θ)/θ K + (1 − sin θ/θ) K².
    """
    rotations, paths = paths_of(motion[:, 3:])
    return rotations, np.einsum("nij,nj->ni", paths, motion[:, :3])


def paths_of(vectors: FloatArray) -> tuple[FloatArray, FloatArray]:
    """R and V of rotation vectors, (n, 3, 3) each."""
    angles = np.linalg.norm(vectors, axis=1)
    axes = vectors / np.where(angles > 0, angles, 1.0)[:, None]
    cross = np.cross(axes[:, None, :], np.eye(3)).transpose(0, 2, 1)
    half = angles[:, None, None] / 2
    # (1 − cos θ)/θ and sin θ/θ without loss of digits near zero
    lag, share = np.sin(half) * np.sinc(half / np.pi), np.sinc(2 * half / np.pi)
    twice = cross @ cross
    rotations = np.eye(3) + np.sin(2 * half) * cross + 2 * np.sin(half) ** 2 * twice
    return rotations, np.asarray(np.eye(3) + lag * cross + (1 - share) * twice)
