"""What starting from the neighbour's solution saves the condensed method; to results/warm_start.csv.

::

    python -m tests.performance.bench_warm_start [MODEL ...]

Eight associative programs in a row, each solved from the usual start and from the solution of the one before:
``friction`` grows by a twentieth of the first each time, the live load turns by 0.05 (``direction``: part of the dead
load is added to it), or cohesion grows as in the published sequence (``cost``: the matrix stays). ``difference`` is the
largest relative one of the two load factors, ``cold`` and ``warm`` are in seconds of the processor.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.program.kinematic import kinematic_form
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.settings import SolverSettings
from tests.performance.bench_cone_solvers import MODELS, silent
from tests.performance.recording import record

NAMES = ("wall 10 x 10, spatial", "wall 20 x 20, spatial", "wall 40 x 25", "cross vault", "dome")
SETTINGS = SolverSettings(tolerance=1e-9)
COUNT = 8


def friction(program: Program, number: int) -> Program:
    limits = replace(program.limits, friction=program.limits.friction * (1.0 + 0.05 * number))
    return replace(program, limits=limits)


def direction(program: Program, number: int) -> Program:
    angle = 0.05 * number
    return replace(program, live_load=np.cos(angle) * program.live_load + 0.3 * np.sin(angle) * program.dead_load)


def cost(program: Program, number: int) -> Program:
    share = 0.02 * number
    limits = program.limits
    return replace(program, limits=replace(limits, cohesion=limits.cohesion + share * limits.friction))


def timed(held: CondensedProgram) -> tuple[ConeSolution, float]:
    started = time.process_time()
    solution = held.solve_once(1, 1.0)
    return solution, time.process_time() - started


def compare(name: str, kind: str, vary: Callable[[Program, int], Program]) -> None:
    """Record one row."""
    first = MODELS[name].program()
    seconds, iterations, difference = np.zeros(2), np.zeros(2, dtype=int), 0.0
    before: ConeSolution | None = None
    for number in range(COUNT):
        program = vary(first, number)
        form = kinematic_form(program, program.limits, reduce_dry=kind != "cost").cone_program
        cold, took = timed(CondensedProgram(form, SETTINGS, silent))
        near = CondensedProgram(form, SETTINGS, silent)
        if before is not None:
            near.start_near(before)
        warm, took_warm = timed(near)
        before = warm
        seconds += took, took_warm
        iterations += cold.iterations, warm.iterations
        difference = max(difference, abs(cold.objective - warm.objective) / abs(cold.objective))
    record(
        "warm_start",
        {
            "model": name,
            "sequence": kind,
            "programs": COUNT,
            "iterations_cold": iterations[0],
            "iterations_warm": iterations[1],
            "cold": seconds[0],
            "warm": seconds[1],
            "difference": difference,
        },
    )


def main() -> None:
    for name in sys.argv[1:] or NAMES:
        for kind, vary in (("friction", friction), ("direction", direction), ("cost", cost)):
            compare(name, kind, vary)


if __name__ == "__main__":
    main()
