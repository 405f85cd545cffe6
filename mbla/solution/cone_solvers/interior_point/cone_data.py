"""A cone program as the method wants it: equations and cones apart, the cones component by component."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.interior_point.cones import ConeProduct


@dataclass(frozen=True)
class ConeData:
    """min c·x + ½ Σ q x²  s.t.  E x = e,  G x + s = h,  s in ``product``.

    order   : (size,) row of the cone program, behind its equations, at each component of s
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
        return replace(self, cost=program.cost, equation_rhs=program.rhs[:n_e], cone_rhs=program.rhs[n_e:][self.order])


def cone_data(program: ConeProgram) -> ConeData:
    """Take a cone program apart; one with ``further_cones`` does not fit."""
    n_e, product = program.n_equations, ConeProduct(program.n_half_lines, program.n_cones)
    heads = product.n_lines + 3 * np.arange(product.n_cones)
    order = np.concatenate([np.arange(product.n_lines), heads, heads + 1, heads + 2])
    rows = sp.csr_array(program.matrix)
    equations, cones = rows[:n_e], rows[n_e:][order]
    return ConeData(
        product=product,
        cost=program.cost,
        quadratic=np.zeros(len(program.cost)) if program.quadratic is None else program.quadratic,
        equations=equations,
        equations_t=sp.csr_array(equations.T),
        equation_rhs=program.rhs[:n_e],
        cone_matrix=cones,
        cone_matrix_t=sp.csr_array(cones.T),
        cone_rhs=program.rhs[n_e:][order],
        order=order,
        n_local=program.n_local,
    )


@dataclass(frozen=True)
class Units:
    """Half-lines and cones, numbered in this order, as sets of rows of the cone matrix.

    unit_of_row : (size,) number of the half-line or cone of each row
    place_of_row : (size,) component in it
    """

    unit_of_row: IntArray
    place_of_row: IntArray
    n_units: int

    @staticmethod
    def of(product: ConeProduct) -> Units:
        """Of a product of cones."""
        cones = product.n_lines + np.arange(product.n_cones)
        unit = np.concatenate([np.arange(product.n_lines), cones, cones, cones])
        place = np.concatenate([np.zeros(product.n_lines), np.repeat([0, 1, 2], product.n_cones)])
        return Units(unit, place.astype(np.int64), product.n_lines + product.n_cones)
