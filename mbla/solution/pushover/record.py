"""What a pushover leaves of its rows: poses, contact points as material points of their bodies, forces, history."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.pose import Pose, paths_of


@dataclass(frozen=True)
class RowPoints:
    """Contact points of one row, its ties last, of which ``bodies`` are −1 and only forces and history count.

    bodies  : (n, 2) solids, then grounds; −1 of ties
    host    : (n,) whether b is the host, in whose frame the frame is
    arms    : (n, 2, 3) m, of the points of a and b from the centroids of their solids, as built
    frames  : (n, 3, 3) in the frame of the host
    laws    : (n,) rows of the joint laws of the model; of ties their rows
    areas   : (n, 2) m² that count for strength and for stiffness
    history : (n, 3) N that a point would have at offset 0: normal force and shear
    forces  : (n, 3) N, T1, T2 [N]
    """

    bodies: IntArray
    host: BoolArray
    arms: FloatArray
    frames: FloatArray
    laws: IntArray
    areas: FloatArray
    history: FloatArray
    forces: FloatArray

    @staticmethod
    def none() -> RowPoints:
        """Of row 0, whose forces are those of the load factor."""
        whole, no = np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.bool_)
        shapes = ((0, 2, 3), (0, 3, 3), (0, 2), (0, 3), (0, 3))
        arms, frames, areas, history, forces = (np.zeros(shape) for shape in shapes)
        return RowPoints(whole.reshape(0, 2), no, arms, frames, whole, areas, history, forces)


@dataclass(frozen=True)
class PushedRows:
    """What the rows of a pushover follow from; n of them, of which row 0 is the structure as it starts to move.

    load_factors : (n,)
    shifts, turns : (n, n_blocks, 3) m, rotation vectors
    fallen       : (n, n_blocks) blocks that are debris
    energies     : (n, 5) J since the structure was at rest, as the run went: work of the live load, dissipated in
                   sliding and by ties, gained by the dead load
    errors       : (n,) estimated error of the load factor, nan where it is not known
    jumps, unsolved : (n,) jumps, and rows that were not found, since the row before
    point_start  : (n + 1,) points of row k are point_start[k]:point_start[k + 1] of ``points``
    stiffness    : (2,) of joints across and along, force per volume
    """

    load_factors: FloatArray
    shifts: FloatArray
    turns: FloatArray
    fallen: BoolArray
    energies: FloatArray
    errors: FloatArray
    jumps: IntArray
    unsolved: IntArray
    point_start: IntArray
    points: RowPoints
    stiffness: FloatArray

    def __len__(self) -> int:
        return len(self.load_factors)

    @property
    def poses(self) -> Iterator[Pose]:
        """Where the blocks are in every row."""
        for shift, turn in zip(self.shifts, self.turns, strict=True):
            yield Pose(shift, paths_of(turn)[0])

    def points_of(self, row: int) -> RowPoints:
        """Those of one row."""
        own = slice(int(self.point_start[row]), int(self.point_start[row + 1]))
        return RowPoints(**{name: values[own] for name, values in vars(self.points).items()})

    def with_errors(self, errors: FloatArray) -> PushedRows:
        """The same with estimated errors of its load factors, (n,)."""
        return replace(self, errors=errors)


@dataclass(frozen=True)
class RecordedRow:
    """One row to be recorded: load factor, pose of the blocks, those that are debris, energies so far, points; jumps,
    and rows that were not found, since the row before.
    """

    load_factor: float
    pose: Pose
    fallen: BoolArray
    energies: tuple[float, float, float, float, float]
    points: RowPoints
    jumps: int = 0
    unsolved: int = 0


def recorded(rows: Sequence[RecordedRow], stiffness: tuple[float, float]) -> PushedRows:
    """The record of rows."""
    names = RowPoints.__dataclass_fields__
    every = {name: np.concatenate([getattr(row.points, name) for row in rows]) for name in names}
    return PushedRows(
        load_factors=np.array([row.load_factor for row in rows]),
        shifts=np.stack([row.pose.shift for row in rows]),
        turns=np.stack([row.pose.rotation_vectors for row in rows]),
        fallen=np.stack([row.fallen for row in rows]),
        energies=np.array([row.energies for row in rows]),
        errors=np.full(len(rows), np.nan),
        jumps=np.array([row.jumps for row in rows]),
        unsolved=np.array([row.unsolved for row in rows]),
        point_start=starts(np.array([len(row.points.forces) for row in rows])),
        points=RowPoints(**every),
        stiffness=np.array(stiffness),
    )
