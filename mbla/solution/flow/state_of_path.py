"""The state of a part at the greatest load of its path: forces, motion, and the history that relates them.

Where only the moving part was followed, the other blocks do not move in the step: their forces, and their history, are
the least that carry their loads and the forces of the moving part.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import ChosenPart, selection
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.flow.followed import AtRest
from mbla.solution.flow.path_of_part import WHAT_MOVES, Extent, PathOfPart
from mbla.solution.flow.peak_step import PeakStep
from mbla.solution.flow.resting_forces import resting_forces, rows_not_carried
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.collapse_state import CollapseState, StepHistory, collapse_state
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.standing import least_forces


def path_with_state(
    program: Program,
    along: Callable[[Extent], PathOfPart],
    state_on: Callable[[PathOfPart], CollapseState | None],
    interfaces: Interfaces,
) -> tuple[PathOfPart, CollapseState | None]:
    """The path of what moves, with what does not carry what is passed on to it, or of the whole; and its state.

    along    : the path of more or less
    state_on : its state
    """
    extent = WHAT_MOVES
    for grown in itertools.count():
        found = along(extent)
        state = state_on(found)
        if state is not None or found.rest is None or not found.lets_rest:
            return found, state
        left = _not_carried(program, found, interfaces) if grown < found.rest.settings.grown else None
        if left is None:
            break
        extent = Extent(besides=left if extent.besides is None else left | extent.besides)
    found = along(Extent(whole=True))
    return found, state_on(found)


def state_of_path(
    program: Program, found: PathOfPart, settings: SolverSettings, log: Log, interfaces: Interfaces = NONE
) -> CollapseState | None:
    """The state, with the misfit of the law as its residual.

    interfaces : of the model that have a law of their own

    None where the path has no step that counts, or no forces carry what rests.
    """
    if found.path is None or found.path.peak is None or found.rest is None:
        return None
    peak, rest = found.path.peak, found.rest
    forces, history, velocities = _of_followed(program, peak, rest)
    motions, history = _of_interfaces(peak, history)
    if found.lets_rest:
        beside = _what_rests(program, peak, rest, forces)
        carried = resting_forces(beside.program, interfaces, settings, log)
        if carried is None:
            return None
        forces[beside.points] = history.remembered[beside.points] = carried
    return CollapseState(forces, velocities, rest.begins + peak.state.factor, peak.misfit, motions, history)


def _not_carried(program: Program, found: PathOfPart, interfaces: Interfaces) -> BoolArray | None:
    """Rows of the blocks at rest that do not carry what is passed on to them, (n_rows,); None where not known."""
    if found.path is None or found.path.peak is None or found.rest is None:
        return None
    forces, _, _ = _of_followed(program, found.path.peak, found.rest)
    return rows_not_carried(_what_rests(program, found.path.peak, found.rest, forces), interfaces)


def state_at_once(
    program: Program, associative: CollapseState | None, slope: FloatArray, settings: SolverSettings, log: Log
) -> CollapseState | None:
    """The state of what moves under any live load, by the associative mechanism; None without, or without forces.

    slope : (n_points,) tangent of the dilatancy angle
    """
    if associative is None:
        return None
    none = np.zeros((program.n_points, program.components))
    forces = least_forces(program, settings, log) if np.any(program.dead_load) else none
    if isinstance(forces, ConeSolution):
        return None
    return collapse_state(program, slope, forces, associative.velocities, 0.0)


def _of_followed(program: Program, peak: PeakStep, rest: AtRest) -> tuple[FloatArray, StepHistory, FloatArray]:
    """Forces, history and velocities of all, those of what rests left at nothing and as stiff as the mean."""
    step, state, joints = peak.step, peak.state, peak.step.joints
    points = np.arange(program.n_points) if rest.part is None else rest.part.points
    shape = program.n_points, program.components
    forces, remembered = np.zeros(shape), np.zeros(shape)
    forces[points] = state.forces
    remembered[points] = step.memory.forces
    normal, shear = (np.full(program.n_points, values.mean() * step.length) for values in (joints.normal, joints.shear))
    normal[points], shear[points] = joints.normal * step.length, joints.shear * step.length
    velocities = state.u[: len(program.dead_load)]  # those of interfaces are behind
    if rest.part is not None:
        velocities = rest.part.lifted(state.u[: rest.part.velocities.shape[1]])
    return forces, StepHistory(remembered, normal, shear), velocities


def _of_interfaces(peak: PeakStep, history: StepHistory) -> tuple[FloatArray | None, StepHistory]:
    """Motions of the interfaces of the model by torsion and by crushing, (n_interfaces, 2, 6), None where no interface
    has any; and the history with how far they had crushed before.
    """
    joints, step = peak.step.joints, peak.step
    if not joints.rows:
        return None, history
    motions, before = np.zeros((joints.rows[0].n_interfaces, 2, 6)), iter(step.memory.interfaces)
    first = len(peak.state.u) - sum(rows.motions.shape[1] for rows in joints.rows)
    for rows in joints.rows:
        last = first + rows.motions.shape[1]
        motions[:, int(rows.crush)] = rows.moved(peak.state.u[first:last])
        own, first = [next(before) for _ in rows.laws], last
        if rows.crush:
            history = replace(history, motions=rows.moved(rows.carried_on(own) / step.length))
    return motions, history


def _what_rests(program: Program, peak: PeakStep, rest: AtRest, forces: FloatArray) -> ChosenPart:
    """Points that were not followed, under loads and what the forces of others, (n_points, components), do to them."""
    assert rest.part is not None
    factor, resting = rest.begins + peak.state.factor, np.setdiff1d(np.arange(program.n_points), rest.part.points)
    passed = program.equilibrium_matrix @ forces.ravel() + program.dead_load + factor * program.live_load
    chosen = selection(resting, program.n_points, program.components)
    size = 3 if program.components == 2 else 6
    sums = np.asarray(abs(program.equilibrium_matrix @ chosen).sum(axis=1))
    touched: BoolArray = np.asarray(sums.reshape(-1, size).any(axis=1), dtype=np.bool_)
    return ChosenPart.of(replace(program, dead_load=passed, live_load=np.zeros_like(passed)), touched, resting)
