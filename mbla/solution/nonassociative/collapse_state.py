"""States of a non-associative sequence, and how badly they fit the joint law."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.condition_cones import ConditionCones
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.solution import PathByStiffness, PathPoint, ProgramRecord, Status
from mbla.solution.thresholds import NEAR_ZERO, STILL


@dataclass(frozen=True)
class StepHistory:
    """What elastic joints remember from before a step, and how stiff they are in it.

    remembered : (n_points, components) forces n̄ and t̄ that they would have if they did not move in the step
    normal, shear : (n_points,) k_N h and k_T h, force for a velocity
    motions    : (n_interfaces, 6) by which interfaces of the model have crushed before, over the length of the step;
                 None where none does
    """

    remembered: FloatArray
    normal: FloatArray
    shear: FloatArray
    motions: FloatArray | None = None


@dataclass(frozen=True)
class CollapseState:
    """A state of the non-dimensional program, and how badly it fits the law.

    forces     : (n_points, components)
    velocities : (n_rows,)
    residual   : largest of the relative residuals, see ``collapse_state``
    motions    : (n_interfaces, 2, 6) of the interfaces by torsion and by crushing, where there are conditions on them
    history    : of elastic joints, by which the forces follow from the velocities; None where rigid joints fit them
    """

    forces: FloatArray
    velocities: FloatArray
    load_factor: float
    residual: float
    motions: FloatArray | None = None
    history: StepHistory | None = None

    def forces_between(self, below: tuple[FloatArray, float], load_factor: float) -> FloatArray:
        """Forces at a load factor between those of this state and others, (n_points, components), at a lower one."""
        share = (load_factor - below[1]) / (self.load_factor - below[1])
        return (1.0 - share) * below[0] + share * self.forces


@dataclass(frozen=True)
class FlowResult:
    """Best state of a sequence; status SOLVED where it converged, APPROXIMATE where not.

    remarks : what a reader of the figure must know
    path    : of elastic joints, where it was followed, load factors of the model
    path_end, path_gain, path_last : why it ended, share of the load factor gained over its last half, and load factor
              of the model at its end
    by_stiffness : load factors of the model on paths of joints of other stiffnesses that were followed as well
    """

    status: Status
    state: CollapseState | None
    reason: str
    programs: tuple[ProgramRecord, ...]
    remarks: tuple[Message, ...] = ()
    path: tuple[PathPoint, ...] = ()
    path_end: str = ""
    path_gain: float = math.nan
    path_last: float = math.nan
    by_stiffness: tuple[PathByStiffness, ...] = ()


def broken_off(
    solution: ConeSolution, programs: Sequence[ProgramRecord], best: CollapseState | None = None, reason: str = ""
) -> FlowResult:
    """What is left of a sequence whose last program, one of ``programs``, ended without a solution.

    That a fictitious program has none is not said of the structure. ``reason`` replaces the common words.
    """
    of_program = solution.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
    words = f"program {len(programs)} of the sequence ended without a solution ({solution.verdict})"
    status = Status.NOT_VERIFIED if of_program else solution.status
    return FlowResult(status, best, reason or words, tuple(programs))


def collapse_state(
    program: Program, slope: FloatArray | float, forces: FloatArray, velocities: FloatArray, load_factor: float
) -> CollapseState:
    """A state with its residual, the largest of three.

    Excess over the yield conditions, in mean block loads; closing velocity over the largest contact speed, where the
    joint cannot crush; share of the power balance that the law (dilatancy ``slope``, a tangent) does not explain. A
    joint under force that lifts by less than its sliding takes part in the last; what normal forces do where joints
    close is of second order close to the law, and left out.

    Where interfaces move by their conditions, the first has the excess over these that are functions of forces, the
    second what motions lack in their cones, the third the power of the motions that the conditions do not explain.

    slope      : (n_points,) or one for all
    forces     : (n_points, components)  non-dimensional, compression positive
    velocities : (n_rows,)  non-dimensional; unknowns of conditions on interfaces behind where they move
    """
    limits = program.limits
    v, surplus, unexplained, balance = _unexplained(program, slope, forces, velocities, load_factor)
    crushable = np.isfinite(limits.compression)
    capacity = np.where(crushable, limits.compression, forces[:, 0])
    unexplained += np.abs((capacity - forces[:, 0]) * np.maximum(-surplus, 0.0))
    blocks, unknowns = np.split(velocities, [len(program.dead_load)])
    speed = max(float(np.linalg.norm(program.contact_velocities(blocks), axis=1).max(initial=0.0)), 1e-300)
    closes = np.maximum(-v[:, 0], 0.0)
    unexplained += np.abs(forces[:, 0]) * np.where(crushable, 0.0, np.maximum(-surplus - closes, 0.0))
    closing = float(np.where(crushable, 0.0, closes).max(initial=0.0)) / speed
    excess = float(yield_violation(forces, limits).max(initial=0.0))
    residual = max(excess, closing, float(unexplained.sum()) / balance)
    conditions = program.conditions if len(unknowns) else None
    if conditions is None:
        return CollapseState(forces, velocities, load_factor, residual)
    further = ConditionCones.of(program)
    lack = float(further.lack(further.held.T @ velocities).max(initial=0.0)) / speed
    beyond = max((-float(reserves.of(forces).min(initial=0.0)) for reserves in conditions.reserves), default=0.0)
    own = abs(float((conditions.velocities.T @ forces.ravel() + conditions.cost) @ unknowns))
    residual = max(residual, beyond, lack, (float(unexplained.sum()) + own) / balance)
    return CollapseState(forces, blocks, load_factor, residual, conditions.moved(unknowns))


def _unexplained(
    program: Program, slope: FloatArray | float, forces: FloatArray, velocities: FloatArray, load_factor: float
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Power in sliding and opening joints that the law does not explain, (n_points,), and what it comes from.

    Contact velocities, (n_points, components); their normal part beyond dilatancy, (n_points,); that power; the largest
    power of the balance, with a floor where load factor and friction are next to nothing.
    """
    limits = program.limits
    moving = program if len(velocities) == len(program.dead_load) else program.with_own_motions
    v, velocities = moving.contact_velocities(velocities), velocities[: len(program.dead_load)]
    still = STILL * float(np.abs(velocities).max(initial=0.0))
    if np.abs(v).max(initial=0.0) <= still:
        v = np.zeros_like(v)
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    strength = limits.friction * forces[:, 0] + limits.cohesion
    surplus = v[:, 0] - slope * sliding
    unexplained = np.abs(strength * sliding + (forces[:, 1:] * v[:, 1:]).sum(axis=1))
    unexplained += np.abs((forces[:, 0] + limits.tension) * np.maximum(surplus, 0.0))
    frictional, dead_power = float(np.abs(strength) @ sliding), abs(float(program.dead_load @ velocities))
    rounding = still * float(np.abs(program.dead_load).max(initial=0.0))
    least = max(NEAR_ZERO * program.moved_over_live(velocities), rounding)
    return v, surplus, unexplained, max(abs(load_factor), frictional, dead_power, least, 1e-300)
