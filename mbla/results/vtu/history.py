"""States of a structure in time as meshes: blocks with their velocity, contact points with the forces of the step."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.motion import history_motion
from mbla.results.record.scene import Scene
from mbla.results.vtu.meshes import Mesh, frame_mesh
from mbla.solution.time_history.frames import Frames
from mbla.solution.verification.in_time.bodies import MovedSolids, Solids, solids_of


@dataclass(frozen=True)
class HistoryStates:
    """Of a load case; places are relative to the base."""

    scene: Scene
    frames: Frames
    solids: Solids

    @staticmethod
    def of(scene: Scene, frames: Frames) -> HistoryStates:
        """With the bodies whose contact points these are."""
        return HistoryStates(scene, frames, solids_of(scene.assembly, scene.solved.load_case))

    def blocks(self, state: int) -> Mesh:
        """Blocks where they are."""
        mesh, blocks = frame_mesh(self.scene, history_motion(self.frames, state)), self.scene.model.blocks
        of_vertex = blocks.block_of_vertex
        motion = self.frames.velocities[state][of_vertex]
        arms = mesh.points - (blocks.centroids + self.frames.shifts[state])[of_vertex]
        velocity = motion[:, :3] + np.cross(motion[:, 3:], arms)
        return replace(mesh, point_data=mesh.point_data | {"velocity": velocity})

    def end(self, motion: FloatArray) -> Mesh:
        """Blocks after the motion to the end, (n_blocks, 6); no velocity is known after it."""
        mesh = frame_mesh(self.scene, motion)
        return replace(mesh, point_data=mesh.point_data | {"velocity": np.full_like(mesh.points, np.nan)})

    def forces(self, state: int) -> Mesh | None:
        """Contact points that press or pull; None where there are none."""
        frames = self.frames
        points, forces = frames.sets[int(frames.set_of_frame[state])], frames.forces[frames.values(state)]
        acts = (points.bodies[:, 0] >= 0) & np.any(forces != 0.0, axis=1)
        if not acts.any():
            return None
        there = MovedSolids(self.solids, frames.shifts[state], frames.turns[state])
        bodies, own = points.bodies[acts], forces[acts]
        host = np.where(points.host[acts], bodies[:, 1], bodies[:, 0])
        turned = there.turned(host, points.frames[acts])
        slave = np.where(points.host[acts], bodies[:, 0], bodies[:, 1])
        arms = np.where(points.host[acts][:, None], points.arms[acts, 0], points.arms[acts, 1])
        places = there.points(slave, arms)
        data = {
            "contact_force": np.einsum("nk,nkj->nj", own, turned),
            "normal_force": own[:, 0],
            "shear_force": np.hypot(own[:, 1], own[:, 2]),
        }
        return Mesh(places, [("vertex", np.arange(len(places))[:, None], slice(None))], data, {})
