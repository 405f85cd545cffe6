"""Ties, rings, struts and strips: forces in lines between blocks, or to what does not move outside of the model.

The force τ of a tie, tension positive, lies between ``least`` and ``greatest``. It pulls at each of its points along a
unit direction, or where it passes along the sum of two::

    first point e₁     passed (e₂ − e₁) ...     last point −eₙ

with e the direction of each stretch: one force all along, without friction where it passes. A closed tie passes all of
its points. A strip pulls together the two faces of each joint that it crosses, along itself. What fill does on a face
is a tie of the form ``fill``, whose force is the push, negative, between passive and active pressure, and one of the
form ``cohesion``, if there is any.

Its elongation rate is −Σ pull · v over the velocities v of its points: normality asks that it is at ``greatest`` where
it gets longer, and at ``least`` where it gets shorter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.model.solids.ragged import items_of_rows

FILL = "fill"
"""form of what fill does on a face: a push between two limits, from outside of the model"""
COHESION = "cohesion"
"""form of what its cohesion adds, where the face moves into it"""
OF_FILL = (FILL, COHESION)
AT_ONE_PLACE = ("strip", *OF_FILL)
"""forms whose points lie at one place, and whose direction is that of their pulls"""
ONE_PLACE = 1e-9
"""length of a stretch over that of its line that is none"""
OF_TIES, OF_POINTS = ("closed", "least", "greatest", "prestress", "breaks_at"), ("bodies", "places", "pulls")
"""arrays of ``Ties`` with a row for each tie, and for each point"""
OUTSIDE = -1
"""stands for a block where a tie is held outside of the model"""


@dataclass(frozen=True)
class Ties:
    """All ties of a model, n of them with m points.

    names     : of each
    forms     : tie, strut, bar, ring, strip, fill or cohesion
    closed    : (n,) its last point is joined to the first one
    start     : (n + 1,) points of tie k are rows start[k]:start[k + 1] of the next three
    bodies    : (m,) block at each point, or ``OUTSIDE``
    places    : (m, 3) m
    pulls     : (m, 3) force on the block there for a tension of 1
    least, greatest : (n,) N, of its force, tension positive
    prestress : (n,) N, its force when it was fitted
    breaks_at : (n,) elongation over length at which it breaks; inf: it yields without end
    """

    names: tuple[str, ...]
    forms: tuple[str, ...]
    closed: IntArray
    start: IntArray
    bodies: IntArray
    places: FloatArray
    pulls: FloatArray
    least: FloatArray
    greatest: FloatArray
    prestress: FloatArray
    breaks_at: FloatArray

    def __len__(self) -> int:
        return len(self.names)

    @property
    def tie_of_point(self) -> IntArray:
        """(m,)."""
        return row_of_item(self.start)

    @property
    def lengths(self) -> FloatArray:
        """Of the lines of ties, (n,) m; nothing where their points lie at one place."""
        ends = self.stretches
        length = np.linalg.norm(self.places[ends[:, 1]] - self.places[ends[:, 0]], axis=1)
        return np.asarray(np.bincount(self.tie_of_point[ends[:, 0]], length, len(self)), dtype=np.float64)

    @property
    def of_fill(self) -> BoolArray:
        """Which are what fill does on faces, (n,)."""
        return np.array([form in OF_FILL for form in self.forms], dtype=bool)

    @property
    def lengths_known(self) -> BoolArray:
        """Which are lines between places; those at one place are not, (n,)."""
        return np.array([form not in AT_ONE_PLACE for form in self.forms], dtype=bool)

    @property
    def stretches(self) -> IntArray:
        """Points that stretches of ties lead from and to, (n_stretches, 2), of a closed tie back to the first."""
        first = np.setdiff1d(np.arange(len(self.bodies)), self.start[1:] - 1)
        back = np.flatnonzero(self.closed)
        pairs = np.vstack(
            [np.column_stack([first, first + 1]), np.column_stack([self.start[1:][back] - 1, self.start[back]])]
        )
        return np.asarray(pairs[np.argsort(self.tie_of_point[pairs[:, 0]], kind="stable")], dtype=np.int64)

    def links(self, outside: int) -> IntArray:
        """Pairs of bodies that ties link, (n, 2); ``outside`` is the number of what does not move."""
        bodies = np.where(self.bodies == OUTSIDE, outside, self.bodies)
        return np.column_stack([bodies[self.start[:-1]][self.tie_of_point], bodies])

    def take(self, rows: IntArray) -> Ties:
        """Some of the ties, (k,), in that order."""
        points = items_of_rows(self.start, rows)
        return Ties(
            names=tuple(self.names[row] for row in rows.tolist()),
            forms=tuple(self.forms[row] for row in rows.tolist()),
            start=starts(np.diff(self.start)[rows]),
            **{name: getattr(self, name)[rows] for name in OF_TIES},
            **{name: getattr(self, name)[points] for name in OF_POINTS},
        )

    def measured_by(self, rows: IntArray, body: int, pull: FloatArray) -> Ties:
        """The same, some of which, (k,), pull at one more body too, along (3,), amid their points."""
        own, first = self.tie_of_point, self.start[rows]
        middles = np.stack([self.places[own == row].mean(axis=0) for row in rows])
        return replace(
            self,
            start=starts(np.diff(self.start) + np.isin(np.arange(len(self)), rows)),
            bodies=np.insert(self.bodies, first + 1, body),
            places=np.insert(self.places, first + 1, middles, axis=0),
            pulls=np.insert(self.pulls, first + 1, pull, axis=0),
        )

    def with_bodies(self, bodies: IntArray) -> Ties:
        """The same ties on other blocks, (m,)."""
        return replace(self, bodies=bodies)


def joined_ties(parts: list[Ties]) -> Ties:
    """The ties of several lists, in order."""
    if not parts:
        return NO_TIES
    return Ties(
        names=tuple(name for part in parts for name in part.names),
        forms=tuple(form for part in parts for form in part.forms),
        start=starts(np.concatenate([np.diff(part.start) for part in parts])),
        **{name: np.concatenate([getattr(part, name) for part in parts]) for name in (*OF_TIES, *OF_POINTS)},
    )


def pulls_along(places: FloatArray, *, closed: bool) -> FloatArray:
    """Force on each point of a line, (m, 3), for a tension of 1.

    Two points at one place, on two blocks between which it bends, pull at each other midway between its directions.
    """
    ahead = np.roll(places, -1, axis=0) - places
    length = np.linalg.norm(ahead, axis=1)
    there = length > ONE_PLACE * length.sum()
    ahead[there] /= length[there, None]
    ahead[~there] = 0.0
    middle = (np.roll(ahead, 1, axis=0) + np.roll(ahead, -1, axis=0))[~there]
    ahead[~there] = middle / np.maximum(np.linalg.norm(middle, axis=1), ONE_PLACE)[:, None]
    behind = np.roll(ahead, 1, axis=0)
    if not closed:
        ahead[-1], behind[0] = 0.0, 0.0
    return np.asarray(ahead - behind)


_NONE = np.zeros(0)
NO_TIES = Ties(
    (), (), _NONE.astype(np.int64), np.zeros(1, np.int64), _NONE.astype(np.int64), np.zeros((0, 3)), np.zeros((0, 3)),
    _NONE, _NONE, _NONE, _NONE,
)  # fmt: skip
"""of a model without any"""
