"""Rows of interfaces with a motion of their own behind those of the blocks of a program."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.law.interface_law import InterfaceLaw, InterfaceState

ROUNDING = 1e-11
"""Force, in mean loads of a block, up to which an interface is within its bounds."""


@dataclass(frozen=True)
class InterfaceRows:
    """Rows Σ J r − R x = 0 with the laws that their resultants r have.

    resultants : R, (n_rows, components n_points)
    laws       : side by side
    released   : (n_points,) points that have no limit of compression of their own
    motions    : (6 n_interfaces, n_rows) from velocities of the rows to motions of the interfaces of the model
    """

    resultants: sp.csr_array
    laws: tuple[InterfaceLaw, ...]
    released: BoolArray
    motions: sp.csr_array

    @property
    def crush(self) -> bool:
        """Whether they are those of crushing, whose motion stays, and not of torsion."""
        return self.laws[0].conditions.remembers

    @property
    def n_interfaces(self) -> int:
        """Of the model."""
        return self.motions.shape[0] // 6

    def at_rest(self, normal: FloatArray, shear: FloatArray) -> tuple[InterfaceState, ...] | None:
        """What contact forces make of each law where no interface moves; None where one is beyond its bounds, or where
        several pieces share its resultants.

        Two laws that bound one resultant share it by what each can carry: one of many ways.

        normal, shear : (n_points,), (components − 1, n_points)
        """
        carried = self.resultants @ np.vstack([normal[None], shear]).T.ravel()
        states = []
        for law in self.laws:
            share = law.conditions.share_at_rest(normal)
            if share is None:
                return None
            resultants = share * (law.rows.T @ carried).reshape(share.shape[::-1]).T
            with np.errstate(over="ignore"):  # of interfaces that are open
                values = law.conditions.values(resultants, normal)
            if not ((values > -ROUNDING).all(axis=0) | (resultants == 0.0).all(axis=0)).all():
                return None
            states.append(InterfaceState(resultants, np.zeros_like(values)))
        return tuple(states)

    def moved(self, velocities: FloatArray) -> FloatArray:
        """Motions of the interfaces of the model, (n_interfaces, 6), by velocities of the rows, (n_rows,)."""
        return np.asarray((self.motions @ velocities).reshape(-1, 6))

    def carried_on(self, motions: Sequence[FloatArray]) -> FloatArray:
        """Of the rows, (n_rows,), from motions of what carries the resultants of each law, (components, m) each."""
        pairs = [(law.rows, of_law.T.ravel()) for law, of_law in zip(self.laws, motions, strict=True)]
        total = np.sum([rows @ values for rows, values in pairs], axis=0)
        alike = np.sum([rows @ np.ones_like(values) for rows, values in pairs], axis=0)
        return np.asarray(total / np.maximum(alike, 1.0))


def with_rows(program: Program, rows: Sequence[InterfaceRows]) -> Program:
    """The program of the same points with the rows behind those of the blocks."""
    if not rows:
        return program
    released = np.any([one.released for one in rows], axis=0)
    limits = replace(program.limits, compression=np.where(released, np.inf, program.limits.compression))
    matrix = sp.vstack([program.equilibrium_matrix, *(-one.resultants for one in rows)])
    return _longer(replace(program, limits=limits), sp.csr_array(matrix))


def with_resultants(program: Program, rows: Sequence[InterfaceRows]) -> Program:
    """That program with the resultants as further points behind its own, for its tangents."""
    if not rows:
        return program
    acts = sp.block_diag([sp.hstack([law.rows for law in one.laws]) for one in rows])
    n_others = program.equilibrium_matrix.shape[0] - acts.shape[0]
    matrix = sp.hstack([program.equilibrium_matrix, sp.vstack([sp.csr_array((n_others, acts.shape[1])), acts])])
    none = np.zeros(acts.shape[1] // program.components)
    limits = YieldLimits(**{name: np.append(values, none) for name, values in vars(program.limits).items()})
    return replace(program, limits=limits, equilibrium_matrix=sp.csr_array(matrix))


def _longer(program: Program, matrix: sp.csr_array) -> Program:
    """With a matrix of more rows, on which nothing acts."""
    none = np.zeros(matrix.shape[0] - len(program.dead_load))

    def longer(load: FloatArray) -> FloatArray:
        return np.concatenate([load, none])

    return replace(
        program,
        equilibrium_matrix=matrix,
        dead_load=longer(program.dead_load),
        live_load=longer(program.live_load),
    )
