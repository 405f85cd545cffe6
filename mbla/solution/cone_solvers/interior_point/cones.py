"""A product of half-lines and second-order cones of dimension 3, and its Jordan algebra, component by component.

A vector has the half-lines first, then the heads v₀ of all cones, then their first and their second tails, so that the
three components of all cones are the rows of one array (3, n_cones) and every operation is one on long vectors. With
J = diag(1, −1, −1) in each cone, e = 1 on half-lines and (1, 0, 0) in cones::

    u ∘ v = (u·v, u₀ v̄ + v₀ ū)        product; of half-lines u v
    det v = v₀² − ‖v̄‖²                 of which every vector inside has a positive one
    l ∖ r : l ∘ (l ∖ r) = r

Source: Alizadeh and Goldfarb 2003 (doi:10.1007/s10107-002-0339-5), sections 4 and 5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray


@dataclass(frozen=True)
class ConeProduct:
    """How many of each there are; vectors have ``size`` = n_lines + 3 n_cones components."""

    n_lines: int
    n_cones: int

    @property
    def size(self) -> int:
        """Components of a vector."""
        return self.n_lines + 3 * self.n_cones

    @property
    def degree(self) -> int:
        """e·e, by which s·z is divided to give the mean product μ."""
        return self.n_lines + self.n_cones

    def lines(self, v: FloatArray) -> FloatArray:
        """The half-lines of a vector, (n_lines,), not copied."""
        return v[: self.n_lines]

    def cones(self, v: FloatArray) -> FloatArray:
        """The cones of a vector, (3, n_cones), not copied."""
        return v[self.n_lines :].reshape(3, self.n_cones)

    def identity(self) -> FloatArray:
        """E."""
        e = np.zeros(self.size)
        e[: self.n_lines + self.n_cones] = 1.0
        return e

    def product(self, u: FloatArray, v: FloatArray) -> FloatArray:
        """U ∘ v."""
        result = np.empty_like(u)
        np.multiply(self.lines(u), self.lines(v), out=self.lines(result))
        a, b, out = self.cones(u), self.cones(v), self.cones(result)
        out[0] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
        out[1:] = a[0] * b[1:] + b[0] * a[1:]
        return result

    def quotient(self, divisor: FloatArray, v: FloatArray) -> FloatArray:
        """L ∖ v for a divisor l inside the cones."""
        result = np.empty_like(v)
        np.divide(self.lines(v), self.lines(divisor), out=self.lines(result))
        a, b, out = self.cones(divisor), self.cones(v), self.cones(result)
        across = a[1] * b[1] + a[2] * b[2]
        det = determinant(a)
        out[0] = (a[0] * b[0] - across) / det
        out[1:] = (b[1:] - a[1:] * out[0]) / a[0]
        return result

    def clipped(self, v: FloatArray, least: float, greatest: float) -> FloatArray:
        """V with its eigenvalues, v₀ ± ‖v̄‖ in cones, brought between two bounds."""
        result = np.empty_like(v)
        np.clip(self.lines(v), least, greatest, out=self.lines(result))
        cones, out = self.cones(v), self.cones(result)
        tail = np.hypot(cones[1], cones[2])
        low, high = np.clip(cones[0] - tail, least, greatest), np.clip(cones[0] + tail, least, greatest)
        out[0] = 0.5 * (low + high)
        out[1:] = cones[1:] * np.where(tail > 0.0, 0.5 * (high - low) / np.where(tail > 0.0, tail, 1.0), 0.0)
        return result

    def least_eigenvalue(self, v: FloatArray) -> float:
        """Least of v on half-lines and v₀ − ‖v̄‖ in cones: positive inside."""
        cones = self.cones(v)
        least = float(self.lines(v).min(initial=np.inf))
        return min(least, float((cones[0] - np.hypot(cones[1], cones[2])).min(initial=np.inf)))

    def longest_step(self, inside: FloatArray, step: FloatArray) -> float:
        """Largest t with inside + t step in the cones; infinite where there is none.

        In a cone with A = det step, B the mixed product and D = det inside: t = D / (√(B² − A D) − B) where positive.
        """
        lines, change = self.lines(inside), self.lines(step)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            ratio = np.where(change < 0.0, -lines / change, np.inf).min(initial=np.inf)
            a, b = self.cones(inside), self.cones(step)
            det, mixed = determinant(a), a[0] * b[0] - a[1] * b[1] - a[2] * b[2]
            root = np.sqrt(np.maximum(mixed**2 - determinant(b) * det, 0.0)) - mixed
            reach = np.where(root > 0.0, det / root, np.inf).min(initial=np.inf)
        return float(min(ratio, reach))


def dot(u: FloatArray, v: FloatArray) -> float:
    """u·v without the linear algebra library, whose threads cost more than they bring: 6 ms for 14,000 components."""
    return float(np.einsum("i,i->", u, v))


def determinant(cones: FloatArray) -> FloatArray:
    """v₀² − ‖v̄‖² of each cone, (n_cones,), from v (3, n_cones), without cancellation."""
    tail = np.hypot(cones[1], cones[2])
    return np.asarray((cones[0] - tail) * (cones[0] + tail))
