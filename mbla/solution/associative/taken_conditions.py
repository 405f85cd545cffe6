"""Conditions on interfaces that crush, taken into the associative program where its forces need them.

Of every piece of an interface the condition that the forces exceed most is taken in, and the program is solved again,
until its forces exceed none. Forces and mechanism then solve the program with all conditions: pieces whose conditions
were not taken in do not move.

Conditions that are no function of the forces alone are taken in from the beginning: torsion, and pieces of interfaces
side by side.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.solution.proof.static_repair import FORCE_ROUNDING, INSIDE


@dataclass(frozen=True)
class TakenConditions:
    """Conditions of a program, some of which are taken in.

    whole : the program with all
    taken : (n_unknowns,) of its conditions; empty where it has none
    """

    whole: Program
    taken: BoolArray

    @classmethod
    def least(cls, whole: Program) -> TakenConditions:
        """With those alone that are taken in from the beginning."""
        conditions = whole.conditions
        return cls(whole, np.zeros(0, dtype=bool) if conditions is None else conditions.single < 0)

    @cached_property
    def program(self) -> Program:
        """The program with what is taken in."""
        conditions = self.whole.conditions
        if conditions is None or self.taken.all():
            return self.whole
        return replace(self.whole, conditions=conditions.only(self.taken)[0] if self.taken.any() else None)

    @property
    def are_all(self) -> bool:
        """Whether all conditions are taken in."""
        return bool(self.taken.all())

    def with_all(self) -> TakenConditions:
        """With all conditions."""
        return replace(self, taken=np.ones_like(self.taken))

    def with_exceeded(self, forces: FloatArray) -> TakenConditions | None:
        """With what forces, (n_points, components), need besides; None where they keep within all conditions.

        Those that are taken in count as kept.
        """
        conditions = self.whole.conditions
        if conditions is None or self.are_all or not np.isfinite(forces).all():
            return None
        is_in = np.zeros(conditions.n_single, dtype=bool)
        is_in[conditions.single[self.taken & (conditions.single >= 0)]] = True
        allowed = max(INSIDE, FORCE_ROUNDING * float(np.abs(forces).max(initial=0.0)))
        chosen, first = is_in.copy(), 0
        for reserves in conditions.reserves:
            left = reserves.of(forces)
            known = is_in[first : first + left.size].reshape(left.shape)
            left = np.where(known, np.inf, left)
            chosen[first : first + left.size] |= ((left < -allowed) & (left == left.min(axis=0))).ravel()
            first += left.size
        if (chosen == is_in).all():
            return None
        return replace(self, taken=self.taken | chosen[conditions.single])

    def keep(self, forces: FloatArray) -> bool:
        """Whether forces, (n_points, components), keep within all conditions; false where these are no functions."""
        conditions = self.whole.conditions
        if conditions is None:
            return True
        none = replace(self, taken=np.zeros_like(self.taken))
        return bool((conditions.single >= 0).all()) and none.with_exceeded(forces) is None

    def of_whole(self, velocities: FloatArray) -> FloatArray:
        """Velocities of the program, unknowns of conditions behind, as those of the program with all conditions."""
        blocks, unknowns = np.split(velocities, [len(self.whole.dead_load)])
        every = np.zeros(len(self.taken))
        every[self.taken] = unknowns
        return np.concatenate([blocks, every])

    def of_blocks(self, velocities: FloatArray) -> FloatArray:
        """Velocities of the blocks, (n_rows,), as those of the program with all conditions, none of which moves."""
        return np.append(velocities, np.zeros(len(self.taken)))
