"""Full stress over the part of an interface that closes: what it carries.

An interface that closes by q, dual to (N', M_1/ρ, M_2/ρ), closes its points by c(x) = g·q, with g(x) = (1, x_2/ρ,
−x_1/ρ), x from the centroid. By normality it carries full stress where c > 0, none elsewhere: f_c ∫ g over c > 0.

Triangles make the outline up; over each the integral has a closed form.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.resultants.shapes import Fan, InterfaceShapes, corner_weights


@dataclass(frozen=True)
class StressFields:
    """Interfaces whose resultants (N', M_1/ρ, M_2/ρ) fields of stress carry, in triangles.

    strength : (n,) F [force]
    lengths  : (n,) ρ [m]
    owner    : (n_triangles,) interface of each
    force    : (n_triangles,) its share of the strength [force]
    arms     : (n_triangles, 3, 3) g with lengths over ρ at its corners
    """

    strength: FloatArray
    lengths: FloatArray
    owner: IntArray
    force: FloatArray
    arms: FloatArray

    @classmethod
    def of(cls, shapes: InterfaceShapes, rows: IntArray, strength: FloatArray) -> StressFields:
        """Interfaces ``rows``, (n,), of the given strengths, (n,)."""
        fan = Fan.of_some(shapes, rows)
        owner, x = fan.interface, shapes.corners[fan.corners]
        lengths = shapes.radii[rows]
        x = x / lengths[owner][:, None, None]
        arms = np.stack([np.ones(x.shape[:2]), x[..., 1], -x[..., 0]], axis=-1)
        return cls(strength, lengths, owner, strength[owner] * fan.share, arms)

    @property
    def scale(self) -> FloatArray:
        """From N', M_1, M_2 to forces, (n, 3)."""
        return np.column_stack([np.ones(len(self.lengths)), 1.0 / self.lengths, 1.0 / self.lengths])

    def carried(self, closing: FloatArray) -> FloatArray:
        """Forces of full stress where they close by q, (n, 3), dual to them, (n, 3)."""
        at_corners = np.einsum("tci,ti->tc", self.arms, closing[self.owner])
        carried = self.force[:, None] * np.einsum("tc,tci->ti", corner_weights(at_corners), self.arms)
        n = len(self.lengths)
        forces = np.stack([np.bincount(self.owner, carried[:, i], n) for i in range(3)], axis=1)
        return forces.astype(np.float64)

    def power(self, closing: FloatArray) -> FloatArray:
        """Power of full stress where they close by q, (n, 3), the most that any field of stress has, (n,)."""
        return np.asarray((self.carried(closing) * closing).sum(axis=1))
