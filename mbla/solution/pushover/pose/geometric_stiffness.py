"""What forces that keep their size do to the balance as their frames and levers turn with the bodies."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.stiffness import Entries
from mbla.solution.pushover.pose.moved_joints import JointsAt, MovedJoints


def geometric(joints: MovedJoints, at: JointsAt, normal: FloatArray, shear: FloatArray) -> list[Entries]:
    """−∂(A x)/∂q for forces that stay in their frames, which turn with their hosts, as entries of the matrix."""
    forces = joints.forces(np.vstack([normal[None], shear]))[: len(at.placed.points)]
    largest = np.abs(forces).max(initial=0.0)
    on = np.flatnonzero(np.abs(forces).max(axis=1, initial=0.0) > 1e-9 * largest)
    points, x = joints.touching.points, at.placed.points[on]
    host, slave = points.hosts[on], points.slaves[on]
    sign = np.where(points.host[on], -1.0, 1.0)[:, None, None]  # the force acts on b
    f = _cross(np.einsum("nk,nkj->nj", forces[on], at.placed.frames[on])) * sign
    of_slave = _cross(x - points.centres(at.pose, slave))
    of_host = _cross(x - points.centres(at.pose, host))
    entries = np.zeros((len(on), 2, 6, 2, 6))
    entries[:, 0, :3, 1, 3:] -= f
    entries[:, 0, 3:, 0, 3:] += f @ of_slave
    entries[:, 0, 3:, 1, 3:] -= of_slave @ f
    entries[:, 1, :3, 1, 3:] += f
    entries[:, 1, 3:, 0, :3] += f
    entries[:, 1, 3:, 0, 3:] -= f @ of_slave
    entries[:, 1, 3:, 1, :3] -= f
    entries[:, 1, 3:, 1, 3:] += of_host @ f
    number = joints.row_of_solid
    who = np.column_stack([number[slave], number[host]])
    rows = 6 * who[:, :, None] + np.arange(6)
    row = np.broadcast_to(rows[:, :, :, None, None], entries.shape)
    column = np.broadcast_to(rows[:, None, None, :, :], entries.shape)
    free = (who[:, :, None] >= 0) & (who[:, None, :] >= 0)
    free = np.broadcast_to(free[:, :, None, :, None], entries.shape)
    row, column, values = row[free], column[free], entries[free]
    values = values * joints.full.scaling.row[row] * (joints.full.scaling.row * joints.full.scaling.live)[column]
    n = len(joints.full.scaling.row)
    way = joints.ways[0]
    reduced = sp.coo_array(way.T @ sp.csr_array(sp.coo_array((values, (row, column)), shape=(n, n))) @ way)
    kept = np.abs(reduced.data) > 1e-13 * np.abs(reduced.data).max(initial=0.0)
    row, column = (each[kept] for each in reduced.coords)
    return [Entries(at.joints.matrix.places(row, column), -reduced.data[kept])]


def _cross(vectors: FloatArray) -> FloatArray:
    """Matrices of a × , (n, 3, 3)."""
    found = np.zeros((len(vectors), 3, 3))
    found[:, 0, 1], found[:, 0, 2], found[:, 1, 2] = -vectors[:, 2], vectors[:, 1], -vectors[:, 0]
    return np.asarray(found - found.transpose(0, 2, 1))
