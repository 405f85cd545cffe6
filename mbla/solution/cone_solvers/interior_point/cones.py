"""A product of half-lines and second-order cones of one dimension d, and its Jordan algebra, component by component.

A vector has the half-lines first, then the heads v₀ of all cones, then their first, second … tails, so that the d
components of all cones are the rows of one array (d, n_cones) and every operation is one on long vectors. Cones of less
dimensions have tails that are zero. With J = diag(1, −1, −1 …) in each cone, e = 1 on half-lines and (1, 0, 0 …) in
cones::

    u ∘ v = (u·v, u₀ v̄ + v₀ ū)        product; of half-lines u v
    det v = v₀² − ‖v̄‖²                 of which every vector inside has a positive one
    l ∖ r : l ∘ (l ∖ r) = r

Source: Alizadeh and Goldfarb 2003 (doi:10.1007/s10107-002-0339-5), sections 4 and 5.

Nesterov–Todd scaling: the symmetric W with W z = W⁻¹ s = l, so that primal and dual look alike from the middle.

On a half-line W = √(s/z). In a cone, with s̄ = s/√det s, z̄ = z/√det z, γ = √((1 + s̄·z̄)/2)::

    w = (s̄ + J z̄) / (2 γ),   η = (det s / det z)^¼
    W = η [w₀  w̄ᵀ; w̄  I + w̄ w̄ᵀ/(1 + w₀)],   W⁻¹ = 1/η [w₀  −w̄ᵀ; −w̄  I + w̄ w̄ᵀ/(1 + w₀)]

W⁻¹ is applied twice rather than W⁻² once: near the border the eigenvalues of W⁻² lie 1e20 apart.

Source: Nesterov and Todd 1997 (doi:10.1287/moor.22.1.1); Vandenberghe, "The CVXOPT linear and quadratic cone program
solvers", 2010, section 4.

A cone program as the method wants it (``ConeData``): equations and cones apart, the cones component by component.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.cone_vectors import cones_to_boundary, lines_to_boundary


@dataclass(frozen=True)
class ConeProduct:
    """How many of each there are; vectors have ``size`` = n_lines + d n_cones components.

    dimension : d of the cones, 3 or more
    """

    n_lines: int
    n_cones: int
    dimension: int = 3

    @property
    def size(self) -> int:
        """Components of a vector."""
        return self.n_lines + self.dimension * self.n_cones

    @property
    def degree(self) -> int:
        """e·e, by which s·z is divided to give the mean product μ."""
        return self.n_lines + self.n_cones

    def lines(self, v: FloatArray) -> FloatArray:
        """The half-lines of a vector, (n_lines,), not copied."""
        return v[: self.n_lines]

    def cones(self, v: FloatArray) -> FloatArray:
        """The cones of a vector, (d, n_cones), not copied."""
        return v[self.n_lines :].reshape(self.dimension, self.n_cones)

    def identity(self) -> FloatArray:
        """The identity e, (n_lines + 3 n_cones,)."""
        e = np.zeros(self.size)
        e[: self.n_lines + self.n_cones] = 1.0
        return e

    def product(self, u: FloatArray, v: FloatArray) -> FloatArray:
        """The product u ∘ v; all are (n_lines + 3 n_cones,)."""
        result = np.empty_like(u)
        np.multiply(self.lines(u), self.lines(v), out=self.lines(result))
        a, b, out = self.cones(u), self.cones(v), self.cones(result)
        out[0] = a[0] * b[0] + along(a, b)
        out[1:] = a[0] * b[1:] + b[0] * a[1:]
        return result

    def quotient(self, divisor: FloatArray, v: FloatArray) -> FloatArray:
        """The quotient l ∖ v for a divisor l inside the cones; all are (n_lines + 3 n_cones,)."""
        result = np.empty_like(v)
        np.divide(self.lines(v), self.lines(divisor), out=self.lines(result))
        a, b, out = self.cones(divisor), self.cones(v), self.cones(result)
        det = determinant(a)
        out[0] = (a[0] * b[0] - along(a, b)) / det
        out[1:] = (b[1:] - a[1:] * out[0]) / a[0]
        return result

    def clipped(self, v: FloatArray, least: float, greatest: float) -> FloatArray:
        """The vector v, (n_lines + 3 n_cones,), with its eigenvalues, v₀ ± ‖v̄‖ in cones, brought between two bounds."""
        result = np.empty_like(v)
        np.clip(self.lines(v), least, greatest, out=self.lines(result))
        cones, out = self.cones(v), self.cones(result)
        tail = tails(cones)
        low, high = np.clip(cones[0] - tail, least, greatest), np.clip(cones[0] + tail, least, greatest)
        out[0] = 0.5 * (low + high)
        out[1:] = cones[1:] * np.where(tail > 0.0, 0.5 * (high - low) / np.where(tail > 0.0, tail, 1.0), 0.0)
        return result

    def least_eigenvalue(self, v: FloatArray) -> float:
        """Least of v, (n_lines + 3 n_cones,), on half-lines and v₀ − ‖v̄‖ in cones: positive inside."""
        cones = self.cones(v)
        least = float(self.lines(v).min(initial=np.inf))
        return min(least, float((cones[0] - tails(cones)).min(initial=np.inf)))

    def step_to_boundary(self, inside: FloatArray, step: FloatArray) -> float:
        """Largest t with inside + t step in the cones, infinite where there is none; both (n_lines + 3 n_cones,)."""
        a, b = self.cones(inside), self.cones(step)
        with np.errstate(over="ignore", invalid="ignore"):
            mixed = a[0] * b[0] - along(a, b)
            cones = cones_to_boundary(determinant(a), mixed, determinant(b))
        lines = lines_to_boundary(self.lines(inside), self.lines(step))
        return float(min(lines.min(initial=np.inf), cones.min(initial=np.inf)))


def dot(u: FloatArray, v: FloatArray) -> float:
    """u·v, (n,) each, without the linear algebra library, whose threads cost more than they bring."""
    return float(np.einsum("i,i->", u, v))


def along(u: FloatArray, v: FloatArray) -> FloatArray:
    """The products ū·v̄ of tails, from u and v (d, …), which are broadcast against each other."""
    total = u[1] * v[1]
    for one, other in zip(u[2:], v[2:], strict=True):
        total += one * other
    return np.asarray(total)


def tails(cones: FloatArray) -> FloatArray:
    """‖v̄‖ of each cone, (n_cones,), from v (d, n_cones)."""
    return np.asarray(reduce(np.hypot, cones[1:]))


def determinant(cones: FloatArray) -> FloatArray:
    """v₀² − ‖v̄‖² of each cone, (n_cones,), from v (d, n_cones), without cancellation."""
    tail = tails(cones)
    return np.asarray((cones[0] - tail) * (cones[0] + tail))


@dataclass(frozen=True)
class NesterovToddScaling:
    """W of one pair of vectors.

    line : (n_lines,) W on half-lines
    w    : (d, n_cones) unit vector of each cone
    eta  : (n_cones,)
    """

    product: ConeProduct
    line: FloatArray
    w: FloatArray
    eta: FloatArray

    @staticmethod
    def of(product: ConeProduct, s: FloatArray, z: FloatArray) -> NesterovToddScaling:
        """Of two vectors inside the cones, (n_lines + 3 n_cones,) each."""
        line = np.sqrt(product.lines(s) / product.lines(z))
        a, b = product.cones(s), product.cones(z)
        det_a, det_b = determinant(a), determinant(b)
        a, b = a / np.sqrt(det_a), b / np.sqrt(det_b)
        gamma = np.sqrt(0.5 * (1.0 + a[0] * b[0] + along(a, b)))
        w = np.empty_like(a)
        w[1:] = (a[1:] - b[1:]) / (2.0 * gamma)
        w[0] = np.sqrt(1.0 + along(w, w))
        return NesterovToddScaling(product, line, w, (det_a / det_b) ** 0.25)

    @staticmethod
    def identity(product: ConeProduct) -> NesterovToddScaling:
        """W = I."""
        w = np.zeros((product.dimension, product.n_cones))
        w[0] = 1.0
        return NesterovToddScaling(product, np.ones(product.n_lines), w, np.ones(product.n_cones))

    def times(self, v: FloatArray) -> FloatArray:
        """The product W v, (n_lines + 3 n_cones,)."""
        result = np.empty_like(v)
        np.multiply(self.product.lines(v), self.line, out=self.product.lines(result))
        boosted(self.w, self.product.cones(v), 1.0, self.product.cones(result))
        self.product.cones(result)[:] *= self.eta
        return result

    def inverse(self, v: FloatArray) -> FloatArray:
        """The product W⁻¹ v, (n_lines + 3 n_cones,)."""
        result = np.empty_like(v)
        np.divide(self.product.lines(v), self.line, out=self.product.lines(result))
        boosted(self.w, self.product.cones(v), -1.0, self.product.cones(result))
        self.product.cones(result)[:] /= self.eta
        return result


def boosted(w: FloatArray, v: FloatArray, sign: float, out: FloatArray) -> None:
    """W/η of v for sign 1, η W⁻¹ of v for sign −1; w and v (d, …) are broadcast against each other."""
    product = along(w, v)
    out[0] = w[0] * v[0] + sign * product
    factor = sign * v[0] + product / (1.0 + w[0])
    for j in range(1, len(v)):
        out[j] = v[j] + w[j] * factor


def largest_entry(v: FloatArray) -> float:
    """Largest size of an entry of a vector, (n,), zero of an empty one."""
    return float(np.abs(v).max(initial=0.0))


@dataclass(frozen=True)
class ConeData:
    """min c·x + ½ Σ q x²  s.t.  E x = e,  G x + s = h,  s in ``product``.

    order   : (size,) row of the cone program, behind its equations, at each component of s; one behind the last for
              those that smaller cones lack
    n_local : unknowns at the end that each belong to one contact point and to no equation
    """

    product: ConeProduct
    cost: FloatArray
    quadratic: FloatArray
    equations: sp.csr_array
    equations_t: sp.csr_array
    equation_rhs: FloatArray
    cone_matrix: sp.csr_array
    cone_matrix_t: sp.csr_array
    cone_rhs: FloatArray
    order: IntArray
    n_local: int = 0

    @property
    def is_linear(self) -> bool:
        """Whether the cost has no quadratic term."""
        return not self.quadratic.any()

    def changed(self, program: ConeProgram) -> ConeData:
        """With cost and right-hand side of another program of the same matrix."""
        n_e = program.n_equations
        return replace(
            self,
            cost=program.cost,
            equation_rhs=program.rhs[:n_e],
            cone_rhs=np.append(program.rhs[n_e:], 0.0)[self.order],
        )


def cone_data(program: ConeProgram) -> ConeData:
    """Take a cone program apart."""
    n_e = program.n_equations
    product, order = _order(program)
    rows = sp.csr_array(program.matrix)
    equations, cones = rows[:n_e], rows[n_e:]
    if order.max(initial=-1) == cones.shape[0]:
        cones = sp.csr_array(sp.vstack([cones, sp.csr_array((1, cones.shape[1]))]))
    cones = cones[order]
    return ConeData(
        product=product,
        cost=program.cost,
        quadratic=np.zeros(len(program.cost)) if program.quadratic is None else program.quadratic,
        equations=equations,
        equations_t=sp.csr_array(equations.T),
        equation_rhs=program.rhs[:n_e],
        cone_matrix=cones,
        cone_matrix_t=sp.csr_array(cones.T),
        cone_rhs=np.append(program.rhs[n_e:], 0.0)[order],
        order=order,
        n_local=program.n_local,
    )


def _order(program: ConeProgram) -> tuple[ConeProduct, IntArray]:
    """The product and, at each of its components, the row behind the equations."""
    sizes = np.array(program.further_cones, dtype=np.int64)
    first = program.n_half_lines + 3 * program.n_cones + np.cumsum(sizes) - sizes
    lines = np.concatenate([np.arange(program.n_half_lines), first[sizes == 1]])
    heads = np.concatenate([program.n_half_lines + 3 * np.arange(program.n_cones), first[sizes > 1]])
    each = np.concatenate([np.full(program.n_cones, 3), sizes[sizes > 1]])
    product = ConeProduct(len(lines), len(heads), int(each.max(initial=3)))
    behind = len(program.rhs) - program.n_equations
    tails_of = [np.where(j < each, heads + j, behind) for j in range(product.dimension)]
    return product, np.concatenate([lines, *tails_of]).astype(np.int64)
