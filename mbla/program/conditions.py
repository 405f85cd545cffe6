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
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.solids.ragged import items_of_rows
from mbla.program.resultants.stress_blocks import Pieces


@dataclass(frozen=True)
class Reserves:
    """Reserves of pieces of interfaces, each the only piece of its interface: values of their conditions under forces.

    resultants : (components m, components n_points) r of the m pieces from the contact forces
    pieces     : their conditions
    """

    resultants: sp.csr_array
    pieces: Pieces

    def of(self, forces: FloatArray) -> FloatArray:
        """Values of the conditions, (n_conditions, m), 0 or more within them, under (n_points, components)."""
        r = self.resultants @ forces.ravel()
        return self.pieces.values(r.reshape(len(self.pieces.owner), -1).T)


@dataclass(frozen=True)
class Conditions:
    """Conditions on the interfaces of a program, reduced or not.

    velocities : (components n_points, n_unknowns) RᵀGᵀζ, what they take off the velocities of the contact points
    cost       : (n_unknowns,) g·ζ
    cones      : (n_cone_rows, n_unknowns) ζ
    cone_sizes : (n_cones,) dimensions of the cones in their order, 1 for half-lines
    motions    : (2, 6 n_interfaces, n_unknowns) motions of the interfaces of the model by torsion and by crushing, dual
                 to their resultants about their centroids, in the unit of force of the program of the full model
    reserves   : of the conditions that are functions of forces, numbered kind by kind, condition by condition
    single     : (n_unknowns,) number of the condition to which an unknown belongs, −1 where it is none of these
    """

    velocities: sp.csr_array
    cost: FloatArray
    cones: sp.csr_array
    cone_sizes: IntArray
    motions: tuple[sp.csr_array, sp.csr_array]
    reserves: tuple[Reserves, ...]
    single: IntArray

    @property
    def n_single(self) -> int:
        """Number of the conditions that are functions of forces."""
        return sum(each.pieces.n_conditions * len(each.pieces.owner) for each in self.reserves)

    def of_points(self, numbers: IntArray) -> tuple[Conditions, IntArray]:
        """Those of interfaces with some of the numbers of contact forces, (n,), alone; rows of their cones, (n_rows,).

        The others hold where these forces are all there are.
        """
        kept = self.velocities[numbers]
        own = np.isin(self._interfaces, self._interfaces[np.diff(sp.csc_array(kept).indptr) > 0])
        chosen, rows = self.only(own)
        return replace(chosen, velocities=sp.csr_array(kept[:, own])), rows

    def only(self, unknowns: BoolArray) -> tuple[Conditions, IntArray]:
        """Those with some of the unknowns, (n_unknowns,), each with all of its own; rows of their cones, (n_rows,)."""
        cones = np.flatnonzero(self._in_cones[:, unknowns].sum(axis=1))
        rows = items_of_rows(starts(self.cone_sizes), cones)
        by_torsion, by_crushing = (sp.csr_array(of_kind[:, unknowns]) for of_kind in self.motions)
        chosen = Conditions(
            velocities=sp.csr_array(self.velocities[:, unknowns]),
            cost=self.cost[unknowns],
            cones=sp.csr_array(self.cones[rows][:, unknowns]),
            cone_sizes=self.cone_sizes[cones],
            motions=(by_torsion, by_crushing),
            reserves=self.reserves,
            single=self.single[unknowns],
        )
        return chosen, rows

    @property
    def _interfaces(self) -> IntArray:
        """Numbers of what shares points or cones, and so interfaces, (n_unknowns,)."""
        points, cones = abs(self.velocities), self._in_cones
        return np.asarray(connected_components(points.T @ points + cones.T @ cones, directed=False)[1])

    @property
    def _in_cones(self) -> sp.csr_array:
        """Which cones have which unknowns, (n_cones, n_unknowns), positive where they do."""
        n, rows = len(self.cone_sizes), np.arange(self.cones.shape[0])
        whole = sp.csr_array(
            (np.ones(len(rows)), (np.repeat(np.arange(n), self.cone_sizes), rows)), shape=(n, len(rows))
        )
        return sp.csr_array(whole @ abs(self.cones))

    def moved(self, unknowns: FloatArray) -> FloatArray:
        """Motions of the interfaces of the model, (n_interfaces, 2, 6), from the unknowns, (n_unknowns,)."""
        return np.stack([(of_kind @ unknowns).reshape(-1, 6) for of_kind in self.motions], axis=1)


def joined(parts: Sequence[Conditions]) -> Conditions | None:
    """Several conditions as one, half-lines first; None where there are none. At most one has reserves."""
    if not parts:
        return None
    sizes = np.concatenate([part.cone_sizes for part in parts])
    order = np.argsort(sizes, kind="stable")
    rows = items_of_rows(starts(sizes), order)
    cones = sp.csr_array(sp.block_diag([part.cones for part in parts]))[rows]
    by_torsion, by_crushing = (sp.csr_array(sp.hstack([part.motions[kind] for part in parts])) for kind in (0, 1))
    return Conditions(
        velocities=sp.csr_array(sp.hstack([part.velocities for part in parts])),
        cost=np.concatenate([part.cost for part in parts]),
        cones=cones,
        cone_sizes=sizes[order],
        motions=(by_torsion, by_crushing),
        reserves=tuple(reserves for part in parts for reserves in part.reserves),
        single=np.concatenate([part.single for part in parts]),
    )
