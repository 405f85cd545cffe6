"""Nesterov–Todd scaling: the symmetric W with W z = W⁻¹ s = l, so that primal and dual look alike from the middle.

On a half-line W = √(s/z). In a cone, with s̄ = s/√det s, z̄ = z/√det z, γ = √((1 + s̄·z̄)/2)::

    w = (s̄ + J z̄) / (2 γ),   η = (det s / det z)^¼
    W = η [w₀  w̄ᵀ; w̄  I + w̄ w̄ᵀ/(1 + w₀)],   W⁻¹ = 1/η [w₀  −w̄ᵀ; −w̄  I + w̄ w̄ᵀ/(1 + w₀)]

W⁻¹ is applied twice rather than W⁻² once: near the border the eigenvalues of W⁻² lie 1e20 apart.

Source: Nesterov and Todd 1997 (doi:10.1287/moor.22.1.1); Vandenberghe, "The CVXOPT linear and quadratic cone program
solvers", 2010, section 4.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.cones import ConeProduct, determinant


@dataclass(frozen=True)
class Scaling:
    """W of one pair of vectors.

    line : (n_lines,) W on half-lines
    w    : (3, n_cones) unit vector of each cone
    eta  : (n_cones,)
    """

    product: ConeProduct
    line: FloatArray
    w: FloatArray
    eta: FloatArray

    @staticmethod
    def of(product: ConeProduct, s: FloatArray, z: FloatArray) -> Scaling:
        """Of two vectors inside the cones."""
        line = np.sqrt(product.lines(s) / product.lines(z))
        a, b = product.cones(s), product.cones(z)
        det_a, det_b = determinant(a), determinant(b)
        a, b = a / np.sqrt(det_a), b / np.sqrt(det_b)
        gamma = np.sqrt(0.5 * (1.0 + a[0] * b[0] + a[1] * b[1] + a[2] * b[2]))
        w = np.empty_like(a)
        w[1:] = (a[1:] - b[1:]) / (2.0 * gamma)
        w[0] = np.sqrt(1.0 + w[1] ** 2 + w[2] ** 2)
        return Scaling(product, line, w, (det_a / det_b) ** 0.25)

    @staticmethod
    def identity(product: ConeProduct) -> Scaling:
        """W = I."""
        w = np.zeros((3, product.n_cones))
        w[0] = 1.0
        return Scaling(product, np.ones(product.n_lines), w, np.ones(product.n_cones))

    def times(self, v: FloatArray) -> FloatArray:
        """W v."""
        result = np.empty_like(v)
        np.multiply(self.product.lines(v), self.line, out=self.product.lines(result))
        boosted(self.w, self.product.cones(v), 1.0, self.product.cones(result))
        self.product.cones(result)[:] *= self.eta
        return result

    def inverse(self, v: FloatArray) -> FloatArray:
        """W⁻¹ v."""
        result = np.empty_like(v)
        np.divide(self.product.lines(v), self.line, out=self.product.lines(result))
        boosted(self.w, self.product.cones(v), -1.0, self.product.cones(result))
        self.product.cones(result)[:] /= self.eta
        return result


def boosted(w: FloatArray, v: FloatArray, sign: float, out: FloatArray) -> None:
    """W/η of v for sign 1, η W⁻¹ of v for sign −1; w and v (3, …) are broadcast against each other."""
    along = w[1] * v[1] + w[2] * v[2]
    out[0] = w[0] * v[0] + sign * along
    factor = sign * v[0] + along / (1.0 + w[0])
    out[1] = v[1] + w[1] * factor
    out[2] = v[2] + w[2] * factor
