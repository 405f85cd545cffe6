"""Conditions on the resultants of whole interfaces in a program, beside those of its contact points.

A condition says that vectors G r + g + H y lie in cones C (second-order cones and half-lines, which are their own
duals), r = R x being resultants of the contact forces x and y auxiliary variables. With multipliers ζ in C and Hᵀζ = 0
any admissible r has

    −r·v ≤ −r·(v − Gᵀζ) + g·ζ

so that an interface that moves by v may move by Gᵀζ at the power g·ζ, and its points by the rest, v − RᵀGᵀζ. The
equation Hᵀζ = 0 is solved beforehand: ζ = cones @ ψ with free unknowns ψ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.ragged import items_of_rows


@dataclass(frozen=True)
class Conditions:
    """Conditions on the interfaces of a program, reduced or not.

    velocities : (components n_points, n_unknowns) RᵀGᵀζ, what they take off the velocities of the contact points
    cost       : (n_unknowns,) g·ζ
    cones      : (n_cone_rows, n_unknowns) ζ
    cone_sizes : (n_cones,) dimensions of the cones in their order, 1 for half-lines
    motions    : (2, 6 n_interfaces, n_unknowns) motions of the interfaces of the model by torsion and by crushing, dual
                 to their resultants about their centroids, in the unit of force of the program of the full model
    """

    velocities: sp.csr_array
    cost: FloatArray
    cones: sp.csr_array
    cone_sizes: IntArray
    motions: tuple[sp.csr_array, sp.csr_array]

    def of_points(self, numbers: IntArray) -> tuple[Conditions, IntArray]:
        """Those of interfaces with some of the numbers of contact forces, (n,), alone; rows of their cones, (n_rows,).

        The others hold where these forces are all there are.
        """
        kept = self.velocities[numbers]
        n, (rows, columns) = len(self.cost), sp.coo_array(self.cones).coords
        first, other = sp.coo_array(sp.csr_array(abs(self.velocities).T @ abs(self.velocities))).coords
        head = np.repeat(np.cumsum(self.cone_sizes) - self.cone_sizes, self.cone_sizes)
        beside = n + np.arange(len(head))
        ends = np.concatenate([columns, first, n + head]), np.concatenate([n + rows, other, beside])
        size = n + self.cones.shape[0]
        label = connected_components(sp.coo_array((np.ones(len(ends[0])), ends), shape=(size, size)), directed=False)[1]
        own = np.isin(label, label[:n][np.diff(sp.csc_array(kept).indptr) > 0])
        unknowns, of_rows = np.flatnonzero(own[:n]), np.flatnonzero(own[n:])
        chosen = Conditions(
            velocities=sp.csr_array(kept[:, unknowns]),
            cost=self.cost[unknowns],
            cones=sp.csr_array(self.cones[of_rows][:, unknowns]),
            cone_sizes=self.cone_sizes[own[n:][np.cumsum(self.cone_sizes) - self.cone_sizes]],
            motions=(sp.csr_array(self.motions[0][:, unknowns]), sp.csr_array(self.motions[1][:, unknowns])),
        )
        return chosen, of_rows

    def moved(self, unknowns: FloatArray) -> FloatArray:
        """Motions of the interfaces of the model, (n_interfaces, 2, 6), from the unknowns, (n_unknowns,)."""
        return np.stack([(of_kind @ unknowns).reshape(-1, 6) for of_kind in self.motions], axis=1)


def joined(parts: Sequence[Conditions]) -> Conditions | None:
    """Several conditions as one, half-lines first; None where there are none."""
    if not parts:
        return None
    sizes = np.concatenate([part.cone_sizes for part in parts])
    order = np.argsort(sizes, kind="stable")
    rows = items_of_rows(np.concatenate([[0], np.cumsum(sizes)]), order)
    cones = sp.csr_array(sp.block_diag([part.cones for part in parts]))[rows]
    by_torsion, by_crushing = (sp.csr_array(sp.hstack([part.motions[kind] for part in parts])) for kind in (0, 1))
    return Conditions(
        velocities=sp.csr_array(sp.hstack([part.velocities for part in parts])),
        cost=np.concatenate([part.cost for part in parts]),
        cones=cones,
        cone_sizes=sizes[order],
        motions=(by_torsion, by_crushing),
    )
