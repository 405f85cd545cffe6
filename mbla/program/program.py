"""The load-factor problem of one load case in non-dimensional form, with the map back to the model.

Statement (static form; Portioli et al. 2014, doi:10.1016/j.compstruc.2014.07.010, with the signs of ``mbla``)::

    max λ   subject to   A x + f_D + λ f_L = 0,   every contact force x_k = (N, T1, T2) within its yield conditions

x_k acts on body b along the frame of the point and on body a against it. Its dual is the kinematic form::

    min −f_D·u + dissipation(v)   subject to   f_L·u = 1,   v = Aᵀu compatible with the yield conditions
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.conditions import Conditions
from mbla.program.facts import ModelFacts
from mbla.program.lift import Lift
from mbla.program.yield_conditions.limits import YieldLimits


@dataclass(frozen=True)
class Scaling:
    """Units of the non-dimensional program.

    force : one unit of force (mean load of a free block)
    units : (n_points,) of the forces at each contact point, over that: less than 1 at light blocks with units of their
            own (:mod:`mbla.program.assemble`); 1 where there are none
    live  : factor on the live load that brings it to that size
    row   : (6 n_free,) factor from the rows of equilibrium in the deck's units to those of the program:
            1/force for forces, 1/(force × length of the block) for moments, with force in the unit of the block
    """

    force: float
    live: float
    row: FloatArray
    units: FloatArray | float = 1.0

    def load_factor(self, scaled: float) -> float:
        """Load factor of the model from that of the program."""
        return scaled * self.live

    def forces(self, scaled: FloatArray) -> FloatArray:
        """Contact forces in the deck's unit of force, (n_points, 3)."""
        return scaled.reshape(-1, 3) * (self.force * np.reshape(self.units, (-1, 1)))

    def scaled_forces(self, forces: FloatArray) -> FloatArray:
        """Contact forces of the program, (n_points, 3), from those in the deck's unit."""
        return forces / (self.force * np.reshape(self.units, (-1, 1)))

    def velocities(self, scaled: FloatArray) -> FloatArray:
        """Velocities of the free blocks for unit live load power, (n_free, 6)."""
        return (scaled * self.row * self.live).reshape(-1, 6)


@dataclass(frozen=True)
class Program:
    """One load case, non-dimensional.

    equilibrium_matrix : (n_rows, components n_points); in a spatial program the rows are force and moment x, y, z of
                         each free block
    dead_load, live_load : (n_rows,)
    limits             : yield limits of the contact points, forces in the units of ``scaling``
    facts              : of the model
    components         : of the force at a contact point: 3 (N, T1, T2), or 2 (N, T) in a planar program
    reduction          : the way back to the program of the full model; None for that itself
    of_blocks          : the way back to the program whose rows are those of blocks, where guides or a plane of symmetry
                         leave fewer; None where its own are
    guided             : it is in motions that guides allow
    conditions         : on the resultants of interfaces; None where there are none
    """

    equilibrium_matrix: sp.csr_array
    dead_load: FloatArray
    live_load: FloatArray
    limits: YieldLimits
    scaling: Scaling
    facts: ModelFacts
    components: int = 3
    reduction: Lift | None = None
    of_blocks: Lift | None = None
    guided: bool = False
    conditions: Conditions | None = None

    def contact_velocities(self, velocities: FloatArray) -> FloatArray:
        """Aᵀu, (n_points, components), from (n_rows,)."""
        return np.asarray((self.equilibrium_matrix.T @ velocities).reshape(-1, self.components))

    @property
    def with_own_motions(self) -> Program:
        """The program with the unknowns of its conditions behind the velocities of the blocks: v = Aᵀu − RᵀGᵀζ."""
        conditions = self.conditions
        if conditions is None:
            return self
        return replace(
            self,
            equilibrium_matrix=sp.csr_array(sp.vstack([self.equilibrium_matrix, -conditions.velocities.T])),
            dead_load=np.concatenate([self.dead_load, -conditions.cost]),
            live_load=np.concatenate([self.live_load, np.zeros(len(conditions.cost))]),
            conditions=None,
        )

    @property
    def lift(self) -> Lift:
        """The way back to the program of the full model, from that one too."""
        return Lift.identity(self) if self.reduction is None else self.reduction

    @property
    def full(self) -> Program:
        """The program of the full model."""
        return self if self.reduction is None else self.reduction.full

    def without_live_load(self) -> Program:
        """The part of it that does not depend on the live load, and ways back to what does not."""

        def without(lift: Lift | None) -> Lift | None:
            return None if lift is None else replace(lift, full=lift.full.without_live_load())

        return replace(
            self,
            live_load=np.zeros_like(self.live_load),
            scaling=replace(self.scaling, live=1.0),
            reduction=without(self.reduction),
            of_blocks=without(self.of_blocks),
        )

    def in_unit_of_force(self, unit: float) -> Program:
        """The same with forces in a unit given in its own; velocities for unit live power stay."""
        scaling = self.scaling
        return replace(
            self,
            dead_load=self.dead_load / unit,
            limits=self.limits.scaled(1.0 / unit),
            scaling=replace(scaling, force=scaling.force * unit, live=scaling.live * unit, row=scaling.row / unit),
        )

    @property
    def n_points(self) -> int:
        """Number of contact points."""
        return len(self.limits.friction)

    @property
    def dead_over_live(self) -> float:
        """Size of the dead load over that of the live load: a measure of load factors where they are near zero."""
        return float(np.linalg.norm(self.dead_load) / np.linalg.norm(self.live_load))

    @property
    def own_unit(self) -> float:
        """Load factor that is the unit of this part: mean dead load of a block over root mean square of the live loads.

        1 for the program of the full model. What depends on the size of load factors must not change because parts
        that cannot interact are solved together or apart.
        """
        dead, live = (np.linalg.norm(self._of_blocks(load), axis=1) for load in (self.dead_load, self.live_load))
        if not np.any(dead) or not np.any(live):
            return 1.0
        return float(dead[dead > 0].mean() / np.sqrt(np.mean(live**2)))

    def moved_over_live(self, velocities: FloatArray) -> float:
        """Size of the dead load that velocities, (n_rows,) for unit live load power, move over that of the live load.

        As ``dead_over_live``, which it does not exceed, but where light blocks move it is theirs.
        """
        dead, moved = self._of_blocks(self.dead_load), self._of_blocks(velocities)
        power = float(np.linalg.norm(dead, axis=1) @ np.linalg.norm(moved, axis=1))
        live = float(np.linalg.norm(self.live_load))
        return min(power, self.dead_over_live) if live > 0.0 else power

    def _of_blocks(self, values: FloatArray) -> FloatArray:
        """Loads or velocities, (n_rows,), a row for each block; of guided blocks what does work in their ways."""
        values = values if self.of_blocks is None else self.of_blocks.motion(values)
        return values.reshape(-1, 3 if self.components == 2 else 6)

    def mechanism(self, scaled: FloatArray) -> FloatArray:
        """Velocities of all blocks, fixed ones at rest, (n_blocks, 6), from those of the program, (n_rows,)."""
        if self.reduction is not None:
            return self.reduction.full.mechanism(self.reduction.motion(scaled))
        full = np.zeros((self.facts.n_blocks, 6))
        full[self.facts.free] = self.scaling.velocities(scaled)
        return full

    def velocities(self, mechanism: FloatArray) -> FloatArray:
        """The way back from ``mechanism``: (n_rows,) from (n_blocks, 6), as near to it as its motions come."""
        if self.reduction is not None:
            return self.reduction.motion_within(self.reduction.full.velocities(mechanism))
        return np.asarray(mechanism[self.facts.free].ravel() / (self.scaling.row * self.scaling.live))
