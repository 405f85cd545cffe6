"""A of a structure at any pose: every entry of A of the program that is solved is a fixed sum of entries at points.

The ways of the reductions, u = S q and x = P y, stay: a new pose costs the geometry of its points and one product.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.carried import Placed
from mbla.model.solids.ragged import ranges
from mbla.model.ties.ties import Ties
from mbla.program.program import Program
from mbla.solution.pushover.pose.ties_at_pose import TiesAtPose


@dataclass(frozen=True)
class MatrixAtPose:
    """Entries of A at points of surfaces and of ties, and their sums.

    bodies       : (n_points of the surfaces, 2)
    row_of_solid : number among the free solids, (n_solids + grounds + 1,); −1 of the others
    full         : the program of all points
    reduced      : that of what is solved, Sᵀ A P
    """

    bodies: IntArray
    row_of_solid: IntArray
    ties: TiesAtPose
    full: Program
    reduced: Program

    @property
    def numbered(self) -> sp.csr_array:
        """Aᵀ of the program that is solved with its entries numbered from 1, by rows."""
        return self._pattern[0]

    def entries(self, placed: Placed, ties: Ties, centres: FloatArray) -> FloatArray:
        """Of Aᵀ of the program that is solved, by rows, for centroids of the solids, (n_solids, 3)."""
        return np.asarray(
            self._pattern[1] @ np.concatenate([self._entries(placed, centres), self.ties.entries(ties, centres)])
        )

    @cached_property
    def _sides(self) -> list[tuple[IntArray, float, IntArray]]:
        """Points of the surfaces with a free body on each side: their numbers, sign and bodies."""
        bodies, number = self.bodies, self.row_of_solid
        found = []
        for side, sign in ((0, -1.0), (1, 1.0)):
            on = np.flatnonzero(number[bodies[:, side]] >= 0)
            found.append((on, sign, np.asarray(bodies[on, side])))
        return found

    def _entries(self, placed: Placed, centres: FloatArray) -> FloatArray:
        """Of A of the surfaces, six rows of each of three components of each point, side by side."""
        values = []
        for on, sign, body in self._sides:
            found = np.empty((len(on), 3, 6))
            found[:, :, :3] = force = sign * placed.frames[on]
            arm, turn = placed.points[on] - centres[body], np.zeros((len(on), 3, 3))
            turn[:, 2, 0], turn[:, 0, 1], turn[:, 1, 2] = arm[:, 1], arm[:, 2], arm[:, 0]
            turn[:, 1, 0], turn[:, 2, 1], turn[:, 0, 2] = -arm[:, 2], -arm[:, 0], -arm[:, 1]
            found[:, :, 3:] = force @ turn  # arm × force
            values.append(found.ravel())
        return np.concatenate(values)

    @cached_property
    def _places(self) -> tuple[IntArray, IntArray]:
        """Rows and columns of the full A of all entries, in their order."""
        rows, columns = [], []
        for on, _, body in self._sides:
            shape = (len(on), 3, 6)
            rows.append(np.broadcast_to((6 * self.row_of_solid[body])[:, None, None] + np.arange(6), shape).ravel())
            columns.append(np.broadcast_to((3 * on[:, None] + np.arange(3))[:, :, None], shape).ravel())
        if self.ties.contacts.ties is not None:
            places, bodies = self.ties.places, self.ties.bodies
            tie = self.ties.built.tie_of_point[places]
            rows.append((6 * self.row_of_solid[bodies][:, None] + np.arange(6)).ravel())
            columns.append(np.repeat(3 * (len(self.bodies) + tie), 6))
        return np.concatenate(rows), np.concatenate(columns)

    @cached_property
    def _pattern(self) -> tuple[sp.csr_array, sp.csr_array]:
        """Aᵀ of the program that is solved with entries numbered from 1, and these as sums of entries of the full A."""
        row, column = self._places
        lift, n = self.reduced.lift, len(self.reduced.dead_load)
        entry, at_row, at_column, value = spread(lift.velocities, lift.forces, row, column)
        value = value * self.full.scaling.row[row[entry]] * self.full.scaling.force
        keys = at_column * n + at_row
        every, place = np.unique(keys, return_inverse=True)
        summing = sp.csr_array(sp.coo_array((value, (place.ravel(), entry)), shape=(len(every), len(row))))
        shape = (self.reduced.components * self.reduced.n_points, n)
        numbered = sp.coo_array((np.arange(1.0, len(every) + 1.0), (every // n, every % n)), shape=shape)
        return sp.csr_array(numbered), summing


def spread(
    first: sp.csr_array, second: sp.csr_array, rows: IntArray, columns: IntArray
) -> tuple[IntArray, IntArray, IntArray, FloatArray]:
    """Entries of Sᵀ X P that entries of X, (m,), go to: number of the entry, row, column and factor of each.

    first, second : S and P, by rows
    rows, columns : (m,) of X
    """
    of_row, of_column = np.diff(first.indptr)[rows], np.diff(second.indptr)[columns]
    size = of_row * of_column
    entry = np.repeat(np.arange(len(rows)), size)
    within = ranges(np.zeros_like(size), size)
    one = first.indptr[rows[entry]] + within // of_column[entry]
    other = second.indptr[columns[entry]] + within % of_column[entry]
    places = first.indices[one].astype(np.int64), second.indices[other].astype(np.int64)
    return entry, *places, first.data[one] * second.data[other]
