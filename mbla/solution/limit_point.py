"""Limit points: whether the load rises above the load factor found before the structure comes to rest there.

The state in which forces and mechanism fit the joint law may lie below a peak of the load path: forces that friction
holds after the dead load was applied are lost as joints slide, and the load that the structure still carries falls.
Under a given load it collapses at the peak. The path is followed from the gravity state by steps of the exact law
(:mod:`mbla.solution.law_steps`), each prescribing the live load's power, so that it passes peaks. Every state of it
balances the loads within the yield conditions, which shows that the peak is carried; that the path turns there is shown
by the steps after it. Steps are divided by ten until the peak moves by less than a thousandth.

The steps of the scheme that finds the load factor are a hundred times larger and jump over peaks. Measured on a plank
clamped in a wall and pulled out (associative 3.2304, at rest 0.9596): steps of ε = 0.03 / 0.3 / 3 / 30 / 300 show a
greatest load factor of 0.9596 / 1.9458 / 2.1430 / 2.1503 / 2.1523. Walls pushed in their plane rise to the load factor
found without a peak. The peak belongs to joints of equal stiffness and to the least forces as the state before.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.cone_solution import ConeSolution, Log
from mbla.solution.gravity import gravity_forces
from mbla.solution.law_state import LawState, law_state
from mbla.solution.law_steps import Step, Stepper, next_step
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.stiffness import stiffness_of
from mbla.solution.weakening import Weakening

STEPS = (3.0, 30.0, 300.0)
"""ε of the steps relative to the gravity state: the first sees whether there is a peak, the others where it is."""

MOST_STEPS = (60, 300, 1500)
"""Steps of each size before the path is given up."""

PEAK = 1e-3
"""Share by which a peak must lie above the load factor found, and to which its height is wanted."""

FALL = 1e-2
"""Share of the peak by which the path must have fallen before it counts as past it."""

AT_REST = 1e-9
"""Residual at which a state of the path is one at rest."""


@dataclass(frozen=True)
class LimitPoint:
    """What the load path from the gravity state says about the load factor found.

    peak    : state with the greatest load factor of the path, in equilibrium and within yield but not at rest; None
              where the path has no peak above the load factor found
    change  : of the peak at the last division of the steps, relative
    remark  : what a reader must know, one sentence; empty where there is nothing to say
    """

    peak: LawState | None
    change: float
    programs: tuple[ProgramRecord, ...]
    remark: str = ""


def limit_point(
    program: Program,
    state: LawState,
    settings: SolverSettings,
    log: Log,
    first_program: int,
    associative: float = np.inf,
    known: Weakening | None = None,
) -> LimitPoint:
    """Peak of the load path above the load factor of a state at rest, without dilatancy.

    first_program : number of the first program in the records
    associative   : load factor that nothing within the yield conditions exceeds; next to it there is no room for a peak
    known         : state of the stress-free assembly under the dead load where it was found before
    """
    if associative <= _least_peak(program, state.load_factor):
        return LimitPoint(None, np.nan, ())
    stepper = Stepper(stiffness_of(program), np.zeros(program.n_points), settings, log)
    gravity = gravity_forces(program, settings, log, [], known)
    if isinstance(gravity, ConeSolution):
        return LimitPoint(None, np.nan, (), "the load path was not followed: no gravity state was found to start from")
    records: list[ProgramRecord] = []
    peak, change, least = None, np.nan, _least_peak(program, state.load_factor)
    for size, most in zip(STEPS, MOST_STEPS, strict=True):
        started = time.perf_counter()
        path = _follow(stepper, gravity, size, most, first_program + len(records))
        found = path.peak
        records.append(_record(program, first_program + len(records), path, time.perf_counter() - started))
        if found is None or not path.fell or found.load_factor <= least:
            break
        change = np.nan if peak is None else abs(found.load_factor - peak.load_factor) / _size(program, found)
        peak = found
        if change <= PEAK:
            break
    remark = path.words(state) if peak is None else _words(program, state, peak, change)
    return LimitPoint(peak, change, tuple(records), remark)


def _least_peak(program: Program, load_factor: float) -> float:
    """Load factor that a peak must exceed."""
    return load_factor + PEAK * max(abs(load_factor), PEAK * program.dead_over_live)


def _size(program: Program, state: LawState) -> float:
    """What differences of a load factor are relative to."""
    return max(abs(state.load_factor), PEAK * program.dead_over_live)


@dataclass
class _Path:
    """The load path as far as it was followed.

    peak  : the state with the greatest load factor; None where not even the first step was found
    last  : load factor of the last step; nan likewise
    rests : the path came to rest
    fell  : it went down from the peak, so far that the peak is behind it
    """

    program: Program
    peak: LawState | None = None
    last: float = np.nan
    rests: bool = False
    fell: bool = False
    work: int = 0

    def words(self, state: LawState) -> str:
        """What keeps the path from saying that there is no peak; empty where it says so."""
        if self.rests or self.fell or self.last >= state.load_factor - PEAK * _size(self.program, state):
            return ""
        reached = f"the load path was followed to {self.last * self.program.scaling.live:.6g} only"
        if self.peak is None:
            reached = "not even the first step of the load path from the dead load was found"
        return f"whether the load rises above the load factor on the way to it was not seen: {reached}"


def _follow(stepper: Stepper, gravity: FloatArray, size: float, most: int, number: int) -> _Path:
    """The path from the gravity state in steps of one size until it has fallen from a peak, rests or is given up."""
    program, settings = stepper.program, stepper.settings
    rho = size * program.own_unit / max(float((gravity**2).sum()), 1e-300)
    path, anchor, before = _Path(program), gravity, None
    for _ in range(most):
        step = next_step(stepper, anchor, rho, before, number)
        if step is None or not step.exact:
            break
        state = law_state(program, 0.0, step.forces, step.velocities, step.load_factor)
        if path.peak is None:  # the path begins at the dead load alone, which carries nothing of the live load
            path.peak = law_state(program, 0.0, gravity, step.velocities, 0.0)
        _add(path, step, state)
        if path.rests or path.fell or (settings.deadline is not None and time.monotonic() > settings.deadline):
            break
        anchor, before = step.forces, replace(step, by_continuation=False)  # else steps grow and jump over peaks
    return path


def _add(path: _Path, step: Step, state: LawState) -> None:
    assert path.peak is not None
    path.last, path.work = step.load_factor, path.work + step.work
    if step.load_factor > path.peak.load_factor:
        path.peak = state
    fall = path.peak.load_factor - step.load_factor
    path.rests = state.residual <= AT_REST
    path.fell = fall > (PEAK if path.rests else FALL) * _size(path.program, path.peak)


def _record(program: Program, number: int, path: _Path, seconds: float) -> ProgramRecord:
    value = np.nan if path.peak is None else program.scaling.load_factor(path.peak.load_factor)
    status = Status.SOLVED if path.rests or path.fell else Status.APPROXIMATE
    return ProgramRecord(number, "load path", status, value, np.nan, path.work, seconds)


def _words(program: Program, state: LawState, peak: LawState, change: float) -> str:
    rest = f"{state.load_factor * program.scaling.live:.6g}"
    if peak.load_factor <= 0.0:
        return f"the load path falls from the dead load alone on, to {rest}: no live load is carried"
    height = f"{peak.load_factor * program.scaling.live:.6g}"
    known = "its accuracy not known" if np.isnan(change) else f"to within {max(change, 1e-4):.1g}"
    return (
        f"the load path from the dead load rises to {height} ({known}) and falls from there to {rest}: "
        "the peak is the collapse load, the lower figure what is left while the structure moves"
    )
