"""Interfaces that slide and twist under uniform pressure: conditions on their shear and torsion in a step.

Two forces act side by side behind one motion (:mod:`mbla.program.resultants.twisting_interfaces`): r'' = (T'', m) with
the share R = V − S of the shear strength that acts as over the full area, and r' with the rest S::

    r'':  g = R ∓ m − ‖T''‖²/(R ± (1 − θ) m)         r':  g = S − ‖r'‖²/S,    S = √(S_0² + (ε V)²)

The product of both conditions on r'' is t² ≤ (R − m)(R + (1 − θ) m) in either sense of m. The third part of r' acts
nowhere and is zero. V and S are given by the normal forces, which do not follow slip and twist: no dilatancy. One
condition on T and m in the place of the two forces has a flat part on its bounds, and a path that hangs on rounding;
without ε the second force has no inside where the force point is in the middle: 0.1 % of torsion is lost by it there.
The condition on r' weighs as much as both on r''.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces, TwistingOfProgram, twisting_of
from mbla.solution.law.interface_law import Derivatives, InterfaceLaw
from mbla.solution.law.interface_rows import InterfaceRows

ROUNDED = 1e-3
"""ε."""

LEAST = 1e-6
"""Least R over V."""


@dataclass(frozen=True)
class Sizes:
    """R or S at some normal forces, (m,), and its derivatives by those of the points, (m, p)."""

    size: FloatArray
    slope: FloatArray


def rest_of(twisting: TwistingOfProgram, normal: FloatArray) -> Sizes:
    """S."""
    n = normal[twisting.points]
    total = np.maximum(twisting.cohesion + (twisting.pressing * n).sum(axis=1), 1e-300)
    offsets = np.einsum("mkp,mp->mk", twisting.offsets, n)
    rows, most = np.arange(len(total)), offsets.argmax(axis=1)
    off, of_off = offsets[rows, most], twisting.offsets[rows, most]
    size = np.hypot(off, ROUNDED * total)
    slope = (off[:, None] * of_off + (ROUNDED**2 * total)[:, None] * twisting.pressing) / size[:, None]
    cut = size > (1.0 - LEAST) * total
    slope[cut] = (1.0 - LEAST) * twisting.pressing[cut]
    return Sizes(np.where(cut, (1.0 - LEAST) * total, size), slope)


def rest_size(twisting: TwistingOfProgram, normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """S and V − S alone, (m,) each."""
    n = normal[twisting.points]
    total = np.maximum(twisting.cohesion + (twisting.pressing * n).sum(axis=1), 1e-300)
    off = np.matmul(twisting.offsets, n[:, :, None])[:, :, 0].max(axis=1)
    size = np.minimum(np.hypot(off, ROUNDED * total), (1.0 - LEAST) * total)
    return size, total - size


def share_of(twisting: TwistingOfProgram, normal: FloatArray) -> Sizes:
    """R = V − S."""
    rest = rest_of(twisting, normal)
    total = np.maximum(twisting.cohesion + (twisting.pressing * normal[twisting.points]).sum(axis=1), 1e-300)
    return Sizes(total - rest.size, twisting.pressing - rest.slope)


@dataclass(frozen=True)
class Shear:
    """Condition on r': the rest of the strength carries shear alone."""

    twisting: TwistingOfProgram

    weight = 2.0
    remembers = False

    @property
    def points(self) -> IntArray:
        """Whose normal forces give V and S, (m, p)."""
        return self.twisting.points

    @property
    def n_conditions(self) -> int:
        """One an interface."""
        return len(self.twisting.thetas)

    def only(self, chosen: IntArray) -> Shear:
        """Of some interfaces."""
        return Shear(self.twisting.only(chosen))

    def start(self, normal: FloatArray) -> FloatArray:
        """No force."""
        return np.zeros((3, len(self.twisting.thetas)))

    def share_at_rest(self, normal: FloatArray) -> FloatArray:
        """S/V of shear, nothing of torsion."""
        size, rest = rest_size(self.twisting, normal)
        share = size / (size + rest)
        return np.stack([share, share, np.zeros_like(share)])

    def values(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """g, (1, m)."""
        size, _ = rest_size(self.twisting, normal)
        return np.asarray(size - (resultants**2).sum(axis=0) / size)[None]

    def gradients(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """∇g, (1, 3, m)."""
        return np.asarray(-2.0 * resultants / rest_size(self.twisting, normal)[0])[None]

    def derivatives(self, resultants: FloatArray, normal: FloatArray) -> Derivatives:
        """All of them."""
        rest = rest_of(self.twisting, normal)
        over, slope = resultants / rest.size, rest.slope.T
        return Derivatives(
            values=self.values(resultants, normal),
            gradients=-2.0 * over[None],
            hessians=(-2.0 * np.eye(3)[:, :, None] / rest.size)[None],
            by_normal=((1.0 + (over**2).sum(axis=0)) * slope)[None],
            mixed=(2.0 * (over / rest.size)[:, None] * slope)[None],
        )


@dataclass(frozen=True)
class Twist:
    """Conditions on r'': torsion with what shear the full area carries beside it."""

    twisting: TwistingOfProgram

    weight = 1.0
    remembers = False

    @property
    def points(self) -> IntArray:
        """Whose normal forces give R, (m, p)."""
        return self.twisting.points

    @property
    def n_conditions(self) -> int:
        """Two an interface."""
        return 2 * len(self.twisting.thetas)

    def only(self, chosen: IntArray) -> Twist:
        """Of some interfaces."""
        return Twist(self.twisting.only(chosen))

    def start(self, normal: FloatArray) -> FloatArray:
        """No force."""
        return np.zeros((3, len(self.twisting.thetas)))

    def share_at_rest(self, normal: FloatArray) -> FloatArray:
        """R/V of shear, and torsion."""
        rest, size = rest_size(self.twisting, normal)
        share = size / (size + rest)
        return np.stack([share, share, np.ones_like(share)])

    def values(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """g, (2, m)."""
        one, other = self._forms(resultants, rest_size(self.twisting, normal)[1])
        shear = (resultants[:2] ** 2).sum(axis=0)
        return np.where(other > 0.0, one - shear / np.where(other > 0.0, other, 1.0), np.minimum(one, other))

    def gradients(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """∇g, (2, 3, m)."""
        _, other = self._forms(resultants, rest_size(self.twisting, normal)[1])
        return self._gradients(resultants[:2, None] / other)

    def derivatives(self, resultants: FloatArray, normal: FloatArray) -> Derivatives:
        """All of them."""
        share = share_of(self.twisting, normal)
        _, other = self._forms(resultants, share.size)
        over, slope = resultants[:2, None] / other, share.slope.T  # (2, 2, m): component, condition
        square, turn = (over**2).sum(axis=0), self._turn
        hessians = np.zeros((2, 3, 3, len(self.twisting.thetas)))
        hessians[:, 0, 0] = hessians[:, 1, 1] = -2.0 / other
        for i in (0, 1):
            hessians[:, i, 2] = hessians[:, 2, i] = 2.0 * over[i] * turn / other
        hessians[:, 2, 2] = -2.0 * square * turn**2 / other
        by_share = np.stack([2.0 * over[0] / other, 2.0 * over[1] / other, -2.0 * square * turn / other], axis=1)
        return Derivatives(
            values=self.values(resultants, normal),
            gradients=self._gradients(over),
            hessians=hessians,
            by_normal=(1.0 + square)[:, None] * slope,
            mixed=by_share[:, :, None] * slope,
        )

    def _forms(self, resultants: FloatArray, share: FloatArray) -> tuple[FloatArray, FloatArray]:
        """R ∓ m and R ± (1 − θ) m, (2, m) each."""
        twist = SENSES * resultants[2]
        return share - twist, share + (1.0 - self.twisting.thetas) * twist

    def _gradients(self, over: FloatArray) -> FloatArray:
        of_twist = -SENSES + (over**2).sum(axis=0) * self._turn
        return np.stack([-2.0 * over[0], -2.0 * over[1], of_twist], axis=1)

    @property
    def _turn(self) -> FloatArray:
        """± (1 − θ), (2, m)."""
        return SENSES * (1.0 - self.twisting.thetas)


SENSES = np.array([[1.0], [-1.0]])


def torsion_rows(program: Program, interfaces: TwistingInterfaces) -> InterfaceRows | None:
    """Of the interfaces of a program with torsion; None where there are none, or all is planar."""
    found = twisting_of(program, interfaces)
    if found is None:
        return None
    m = len(found.thetas)
    laws = (
        InterfaceLaw(Twist(found), sp.csr_array(sp.eye_array(3 * m))),
        InterfaceLaw(Shear(found), sp.csr_array(sp.diags_array(np.tile([1.0, 1.0, 0.0], m)))),
    )
    return InterfaceRows(found.resultants, laws, np.zeros(program.n_points, dtype=bool), found.motions)
