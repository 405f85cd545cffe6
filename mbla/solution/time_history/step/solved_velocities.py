"""The equations of one step of time solved: by Newton's method on the law as it is, else by products of the law.

Joints that stay as they are need one or two iterations of Newton's method. Where many open, close or slide at once its
whole steps go round in circles, and shorter ones along the same directions come to the solution. Where none of these
leaves less, a primal–dual method goes there from the best motion seen, or from that without joints. What counts is the
balance of the forces of the law, as a velocity over that of free fall in the step::

    e = √(Fᵀ M⁻¹ F / m) / (g₀ h),   m the least mass of a body
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import Memory
from mbla.solution.law.exact_law import forces_by_law
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import aimed_direction, length_of
from mbla.solution.law.masses import MassPattern
from mbla.solution.law.return_map import JointForces, joint_stiffness
from mbla.solution.pushover.pose.step_states import on_central_path

BALANCED, WELL = 1e-3, 1e-6
"""e of a step that is solved, and with which Newton's method makes no iteration at all."""

NEWTON, PRODUCTS = 25, 25
"""Iterations of each method at most."""

ENOUGH, SHORTER, SHORTEST = 0.5, 0.7, 0.01
"""Share of e that a step of Newton's method may leave without a shorter one being tried, by what it is shortened, and
the least share of it."""

NEAR, FAR = 1e-2, 1.0
"""Products of the law that the primal–dual method begins with, over mean weight times free fall in the step: from the
best motion seen, and from the motion without joints."""


@dataclass(frozen=True)
class Solved:
    """The best motion found.

    u      : (n_rows,) displacements in the step
    forces : of the joints by their law
    error  : e
    spent  : factorisations
    """

    u: FloatArray
    forces: JointForces
    error: float
    spent: int


@dataclass
class StepEquations:
    """Of one step.

    step     : of the joint law
    pattern  : of its masses, and inverses of M/(h h̄) by its sets
    unit     : m (g₀ h)² h/h̄ of the least mass, in units of the program: h h̄ F·M⁻¹F over that is e²
    product  : mean weight times free fall in the step, in units of the program
    spent    : factorisations so far
    """

    step: JointStep
    pattern: MassPattern
    inverses: list[FloatArray]
    unit: float
    product: float
    spent: int = 0

    def solved(self, begin: FloatArray) -> Solved:
        """From displacements to begin with, (n_rows,)."""
        best = self._newton(begin)
        if best.error >= BALANCED:
            near = best.u if np.isfinite(best.error) else begin
            for start, product in ((near, NEAR), (self.alone, FAR)):
                found = self._products(start, product * self.product)
                best = found if found.error < best.error else best
                if best.error < BALANCED:
                    break
        return replace(best, spent=self.spent)

    @property
    def alone(self) -> FloatArray:
        """u_f, displacements without joints, (n_rows,)."""
        masses = self.step.masses
        assert masses is not None
        return self.pattern.solved(self.inverses, masses.free)

    def _measured(self, u: FloatArray) -> tuple[Solved, FloatArray]:
        """What a motion leaves of the balance, (n_rows,)."""
        forces = forces_by_law(self.step, u)
        masses = self.step.masses
        assert masses is not None
        left = self.step.joints.carried(forces.normal, forces.shear) - masses.resistance(u)
        square = float(left @ self.pattern.solved(self.inverses, left)) / self.unit
        error = float(np.sqrt(square)) if 0.0 <= square < np.inf else (0.0 if square < 0.0 else np.inf)
        return Solved(u, forces, error, self.spent), left

    def _newton(self, begin: FloatArray) -> Solved:
        """By Newton's method, as far as a direction leaves less of the balance."""
        best, left = self._measured(begin)
        masses = self.step.masses
        assert masses is not None
        for number in range(NEWTON):
            if best.error < (BALANCED if number else WELL) or not np.isfinite(best.error):
                break
            tangents = joint_stiffness(self.step.joints, best.forces, self.step.length)
            none = np.zeros_like(begin)
            solve = self.step.joints.matrix.factorized(tangents, none, fixed_load=True, further=[masses.entries])
            self.spent += 1
            found = None if solve is None else self._along(solve.unrefined(np.append(-left, 0.0))[:-1], best)
            if found is None:
                break
            best, left = found
        return best

    def _along(self, direction: FloatArray, before: Solved) -> tuple[Solved, FloatArray] | None:
        """The best on the way along a direction, whole at first; None where none is better than that before."""
        share, found = 1.0, self._measured(before.u + direction)
        while found[0].error >= ENOUGH * before.error and share > SHORTEST:
            share *= SHORTER
            nearer = self._measured(before.u + share * direction)
            if nearer[0].error < found[0].error:
                found = nearer
            elif found[0].error < before.error:
                break
        return found if found[0].error < before.error else None

    def _products(self, begin: FloatArray, sigma: float) -> Solved:
        """The best that ever smaller products come to from displacements, (n_rows,)."""
        rest = self._from(begin)
        state = on_central_path(rest, sigma, 0.0)
        best, _ = self._measured(begin)
        for _ in range(PRODUCTS):
            residual = residual_of(rest, state)
            found = aimed_direction(rest, state, residual)
            self.spent += 1
            if found is None or found[1] < LEAST:
                break
            state = state.plus(found[0], length_of(found[1]))
            there, _ = self._measured(begin + state.u)
            best = there if there.error < best.error else best
            if best.error < BALANCED:
                break
        return best

    def _from(self, u: FloatArray) -> JointStep:
        """The rest of the step from displacements on."""
        step, masses = self.step, self.step.masses
        assert masses is not None
        moved = step.joints.velocities(u)
        normal = step.memory.normal - moved[0] / step.normal_compliance
        memory = Memory(normal, step.memory.shear - moved[1:] / step.shear_compliance)
        return replace(step, memory=memory, masses=replace(masses, free=-masses.resistance(u)))


LEAST = 1e-8
"""Reach of a direction that leads nowhere."""
