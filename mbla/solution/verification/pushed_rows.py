"""Rows of a pushover found again: gaps, the law of elastic joints and balance at the pose of each, from what is stored.

A contact point is a material point of one body, the slave, on a face of the other, the host. With its places on both
bodies at the pose, x_a and x_b, and the frame F that turns with the host::

    w = F (x_b − x_a),   N = m_N − k_N w_N within −f_t … f_c,   T = m_T − k_T w_T, shortened to μN + c

m are the forces that the point would have at w = 0, k the stiffness by its share of the area. Forces act at the slave's
point. No code of the step is used, nor any matrix of the program stage.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose, moved_case, moved_model
from mbla.model.ties.moved import moved_ties, tie_lengths
from mbla.model.ties.ties import OUTSIDE, Ties
from mbla.questions.tilt import Tilt
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.solution.verification.points_on_bodies import distances_from_bodies
from mbla.solution.verification.statics import left_to_balance

AWAY = 0.05
"""Distance of a contact point from its body, over the size of the body, beyond which it is not on the body."""


@dataclass(frozen=True)
class RowResidual:
    """How far a row is from what it should be.

    law     : largest force that is off the law, over the largest force or the mean weight of a point
    balance : largest unbalanced force, or moment over size, of a solid over the mean load of one
    overlap : m, of bodies at a point that is pressed
    away    : largest distance of a point that is pressed from a body of its pair, over the size of that
    """

    law: float
    balance: float
    overlap: float
    away: float = 0.0

    @property
    def largest(self) -> float:
        """Of law and balance; of points that are on no body as well."""
        return max(self.law, self.balance, self.away if self.away > AWAY else 0.0)


@dataclass(frozen=True)
class _Moved:
    """Solids at a pose: places and rotations, the grounds behind them as one that does not move."""

    centroids: FloatArray
    rotation: FloatArray

    @staticmethod
    def of(solids: RigidBodies, pose: Pose) -> _Moved:
        first = solids.first_blocks
        turn = pose.rotation[first]
        centres = solids.model.blocks.centroids + pose.shift[first]
        arms = solids.arms[first]
        centres = centres + arms - np.einsum("nij,nj->ni", turn, arms)
        return _Moved(np.vstack([centres, np.zeros((1, 3))]), np.concatenate([turn, np.eye(3)[None]]))

    def place(self, bodies: np.ndarray, arms: FloatArray) -> FloatArray:
        """Of points of bodies, (n, 3)."""
        own = np.minimum(bodies, len(self.rotation) - 1)
        return np.asarray(self.centroids[own] + np.einsum("nij,nj->ni", self.rotation[own], arms))


def row_residuals(assembly: Assembly, case: LoadCase, flow_rule: str, rows: PushedRows) -> list[RowResidual]:
    """Of each row; of row 0, which has no points of its own, none."""
    model, solids = assembly.model.of_case(case), assembly.glued(case)
    away = _away(solids, rows)
    return [
        replace(_residual(model, solids, case, flow_rule, rows, row, pose), away=away[row])
        if row
        else RowResidual(0.0, 0.0, 0.0)
        for row, pose in enumerate(rows.poses)
    ]


def _away(solids: RigidBodies, rows: PushedRows) -> FloatArray:
    """Largest distance of points that are pressed from their bodies, of each row."""
    count = len(rows.load_factors)
    bodies, arms, of_row = [np.zeros(0, dtype=np.int64)], [np.zeros((0, 3))], [np.zeros(0, dtype=np.int64)]
    for row in range(1, count):
        points = rows.points_of(row)
        on = (points.bodies[:, 0] >= 0) & (points.forces[:, 0] > 0.0)
        for side in (0, 1):
            bodies.append(points.bodies[on, side])
            arms.append(points.arms[on, side])
            of_row.append(np.full(int(on.sum()), row))
    found = distances_from_bodies(solids.model.blocks, np.concatenate(bodies), np.concatenate(arms))
    away = np.zeros(count)
    np.maximum.at(away, np.concatenate(of_row), found)
    return away


def _residual(
    model: Model, solids: RigidBodies, case: LoadCase, flow_rule: str, rows: PushedRows, row: int, pose: Pose
) -> RowResidual:
    points, fallen = rows.points_of(row), rows.fallen[row]
    surface = points.bodies[:, 0] >= 0
    there = _Moved.of(solids, pose)
    bodies = points.bodies[surface]
    ends = [there.place(bodies[:, side], points.arms[surface, side]) for side in (0, 1)]
    host = np.where(points.host[surface], bodies[:, 1], bodies[:, 0])
    turn = there.rotation[np.minimum(host, len(there.rotation) - 1)]
    frames = np.einsum("nij,nkj->nki", turn, points.frames[surface])
    offsets = np.einsum("nij,nj->ni", frames, ends[1] - ends[0])
    places = np.where(points.host[surface][:, None], *ends)
    ties = moved_ties(model.ties, model.blocks, pose)
    own = points.laws[~surface]
    n = int(surface.sum())
    every = np.zeros((len(surface), 3))
    every[:n] = offsets
    every[n:, 0] = -_senses(model.ties)[own] * (tie_lengths(ties) - tie_lengths(model.ties))[own]
    law, largest = _off_law(model, points, surface, every, rows.stiffness, flow_rule)
    dead = case.dead_load[~model.fixed & ~fallen][:, :3]
    weight = float(np.abs(dead).sum()) / max(len(surface), 1)
    left = _unbalanced(model, solids, there, case, pose, rows.load_factors[row], fallen)
    forces = np.einsum("nk,nkj->nj", points.forces[surface], frames)
    for side, sign in ((0, -1.0), (1, 1.0)):
        _add(left, there, bodies[:, side], places, sign * forces)
    for tie, force in zip(own.tolist(), points.forces[~surface, 0].tolist(), strict=True):
        _add_tie(left, there, solids, ties, tie, force * float(_senses(model.ties)[tie]))
    free = ~solids.model.fixed
    free[solids.label[fallen]] = False
    size = solids.model.blocks.sizes
    first = solids.first_blocks
    of_solids = Pose(there.centroids[:-1] - solids.model.blocks.centroids, pose.rotation[first])
    left = left_to_balance(moved_model(solids.model, of_solids), left, size)
    off = np.hstack([left[:, :3], left[:, 3:] / size[:, None]])[free]
    load = float(np.linalg.norm(dead, axis=1).mean()) if len(dead) else 1.0
    pressed = points.forces[:n, 0] > 0.0
    overlap = -float(np.min(offsets[pressed, 0], initial=0.0))
    return RowResidual(
        law / max(largest, weight, 1e-300), float(np.abs(off).max(initial=0.0)) / max(load, 1e-300), overlap
    )


def _off_law(
    model: Model,
    points: RowPoints,
    surface: BoolArray,
    offsets: FloatArray,
    stiffness: FloatArray,
    flow_rule: str,
) -> tuple[float, float]:
    """Largest force off the law, and largest force."""
    laws = list(model.joints.values())
    area = points.areas[:, 0]

    def of_law(name: str) -> FloatArray:
        values = np.array([getattr(law, name) for law in laws])
        return np.where(surface, values[np.where(surface, points.laws, 0)], 0.0)

    with np.errstate(invalid="ignore"):
        crush = np.where(surface, of_law("compressive_strength"), 0.0)
        crush = np.where(np.isinf(crush), np.inf, crush * area)
    tension, cohesion, friction = of_law("tensile_strength") * area, of_law("cohesion") * area, of_law("friction")
    ties, own = model.ties, points.laws[~surface]
    senses = _senses(ties)[own]
    ends = np.sort(senses[:, None] * np.column_stack([ties.least, ties.greatest])[own], axis=1)
    tension[~surface], crush[~surface] = -ends[:, 0], ends[:, 1]
    dilates = {"associative": friction, "dilatancy": of_law("dilatancy")}.get(flow_rule, np.zeros_like(friction))
    k_n, k_t = points.areas[:, 1] * stiffness[0], points.areas[:, 1] * stiffness[1]
    trial = points.history - np.column_stack([k_n, k_t, k_t]) * offsets
    trial[~surface, 1:] = 0.0
    normal, shear = points.forces[:, 0], points.forces[:, 1:]
    strength = np.maximum(friction * normal + cohesion, 0.0)
    size = np.hypot(trial[:, 1], trial[:, 2])
    along = trial[:, 1:] * np.where(size > strength, strength / np.maximum(size, 1e-300), 1.0)[:, None]
    slid = np.hypot(*(trial[:, 1:] - along).T)
    across = np.clip(trial[:, 0] + k_n / k_t * dilates * slid, -tension, crush)
    off = np.hypot(across - normal, np.hypot(*(along - shear).T))
    return float(off.max(initial=0.0)), float(np.abs(points.forces).max(initial=0.0))


def _unbalanced(
    model: Model, solids: RigidBodies, there: _Moved, case: LoadCase, pose: Pose, factor: float, fallen: BoolArray
) -> FloatArray:
    """Loads on the solids there, (n_solids, 6), about their centroids; of a tilting table at the angle ``factor``."""
    moved = moved_case(case, pose)
    loads = moved.dead_load + factor * moved.live_load
    if tilt := moved.question.record(Tilt):
        loads = tilt.loads_at(float(np.degrees(factor)))
    loads[fallen] = 0.0
    centres = (model.blocks.centroids + pose.shift) - there.centroids[solids.label]
    loads[:, 3:] += np.cross(centres, loads[:, :3])
    total = np.zeros((len(solids.model.blocks), 6))
    np.add.at(total, solids.label, loads)
    return total


def _add(left: FloatArray, there: _Moved, bodies: np.ndarray, places: FloatArray, forces: FloatArray) -> None:
    """Forces on bodies at places; on grounds nothing."""
    on = bodies < len(left)
    arms = places[on] - there.centroids[bodies[on]]
    np.add.at(left, bodies[on], np.hstack([forces[on], np.cross(arms, forces[on])]))


def _add_tie(left: FloatArray, there: _Moved, solids: RigidBodies, ties: Ties, tie: int, force: float) -> None:
    own = slice(int(ties.start[tie]), int(ties.start[tie + 1]))
    on = ties.bodies[own] != OUTSIDE
    bodies = solids.label[ties.bodies[own][on]]
    _add(left, there, bodies, ties.places[own][on], force * ties.pulls[own][on])


def _senses(ties: Ties) -> FloatArray:
    """1 where a positive force is a tension, −1 of what can only push."""
    return np.where(ties.greatest > 0.0, 1.0, -1.0)
