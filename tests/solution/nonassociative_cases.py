"""Non-associative cases outside the usual ones, as deck texts; what share of them the path of elastic joints solves.

::

    python -m tests.solution.nonassociative_cases [NAME ...]

Random friction at every joint, pushes out of plane, rooms of interlocking bond, barrel vaults of staggered rows, domes,
flat arches and wedges, cohesion, tensile and compressive strength, joints without friction. Every random number comes
from the seed in the name of its case.
"""

from __future__ import annotations

import math
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.collapse_state import FlowResult
from mbla.solution.nonassociative.elastic import solve_by_elastic_path
from mbla.solution.settings import SolverSettings
from tests.line import line_of
from tests.solution.structures import barrel, dome, flat_arch, push, random_friction, room, wall, wedge

CASES: dict[str, Callable[[], str]] = {
    **{f"random friction in plane, seed {i}": partial(random_friction, i, 4, 6, push(0)) for i in range(1, 5)},
    **{f"random friction, pushed at 15 degrees, seed {i}": partial(random_friction, i, 5, 4, push(15)) for i in (5, 6)},
    "random friction, large, seed 7": partial(random_friction, 7, 7, 10, push(0)),
    "random friction, pushed upwards too, seed 8": partial(random_friction, 8, 4, 5, push(0, 0.3)),
    **{f"wall out of plane at {a} degrees": partial(wall, 4, 5, push(a), "friction: 0.65") for a in (30, 60, 85)},
    "wall out of plane, low friction": partial(wall, 4, 5, push(75), "friction: 0.2"),
    **{f"room L at {a} degrees": partial(room, "sw", 3, 3, 5, push(a)) for a in (0, 45, 225)},
    **{f"room U at {a} degrees": partial(room, "swe", 3, 2, 5, push(a)) for a in (0, 90, 270)},
    "room of four walls": partial(room, "swen", 3, 2, 5, push(20)),
    "room U, low friction": partial(room, "swe", 2, 2, 4, push(90), "friction: 0.3"),
    "barrel vault along its span": partial(barrel, 3, 9, 0.25, push(0)),
    "barrel vault, thin, along its span": partial(barrel, 2, 15, 0.18, push(0)),
    "barrel vault along its axis": partial(barrel, 3, 7, 0.25, push(90)),
    "barrel vault at 60 degrees": partial(barrel, 3, 7, 0.25, push(60)),
    "barrel vault, friction 0.84, along its axis": partial(barrel, 3, 9, 0.2, push(90), "friction: 0.84"),
    "dome": partial(dome, 3, 8, push(0)),
    "dome, friction 0.84": partial(dome, 3, 8, push(10), "friction: 0.84"),
    **{f"wedge in a groove, seed {i}": partial(wedge, i, 0.5) for i in (11, 12, 13)},
    "wedge in a groove, rough, seed 14": partial(wedge, 14, 0.9),
    "flat arch lifted and pushed sideways": partial(flat_arch, 5, push(0, 1.0), 0.6),
    "flat arch out of plane": partial(flat_arch, 7, push(90), 0.6),
    "flat arch lifted and pushed askew": partial(flat_arch, 5, push(60, 0.5), 0.4),
    "cohesion of a third of a unit's weight": partial(wall, 4, 6, push(0), "friction: 0.6, cohesion: 400"),
    "cohesion and tensile strength out of plane": partial(
        wall, 3, 5, push(70), "friction: 0.6, cohesion: 1500, tensile_strength: 800"
    ),
    "room U, mortar": partial(room, "swe", 2, 2, 4, push(90), "friction: 0.5, cohesion: 800, tensile_strength: 300"),
    "crushing": partial(wall, 4, 6, push(0), "friction: 0.65, compressive_strength: 150000"),
    "mortar that crushes, at 30 degrees": partial(
        wall, 3, 5, push(30), "friction: 0.6, cohesion: 500, tensile_strength: 100, compressive_strength: 120000"
    ),
    "barrel vault with cohesion": partial(barrel, 2, 9, 0.2, push(0), "friction: 0.5, cohesion: 500"),
}

SHORT = (
    "random friction, pushed at 15 degrees, seed 5",
    "wall out of plane at 60 degrees",
    "room U at 0 degrees",
    "wedge in a groove, seed 11",
    "flat arch lifted and pushed askew",
    "mortar that crushes, at 30 degrees",
)
"""Small ones for every run of the tests."""


def solved_case(name: str) -> tuple[FlowResult, float, float, float]:
    """Result of a case, its load factor, the associative one, and seconds of the processor."""
    line = line_of(CASES[name]())
    started = time.process_time()
    parts = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False).parts
    settings = SolverSettings(1e-8)
    program = max(parts, key=lambda part: part.n_points)
    associative = solve_associative(program, settings, lambda record: None)
    result = solve_by_elastic_path(program, associative, np.zeros(program.n_points), settings, lambda record: None)
    seconds = time.process_time() - started
    factors = [
        math.nan if state is None else program.scaling.load_factor(state.load_factor)
        for state in (result.state, associative.state)
    ]
    return result, factors[0], factors[1], seconds


def main(names: Sequence[str]) -> None:
    """A line for each case, and the share that comes within 1e-6 and 1e-4 of the law of elastic joints."""
    residuals = []
    for name in names or CASES:
        result, factor, associative, seconds = solved_case(name)
        residual = math.inf if result.state is None else result.state.residual
        residuals.append(residual)
        words = " ".join((result.reason, *result.remarks))
        sys.stdout.write(
            f"{name:48s} {result.status!s:12s} {factor:10.6f} (associative {associative:10.6f})"
            f"  residual {residual:.0e}  {len(result.programs):3d} programs  {seconds:6.2f} s  {words}\n"
        )
        sys.stdout.flush()
    for bound in (1e-6, 1e-4):
        share = statistics.mean(residual <= bound for residual in residuals)
        sys.stdout.write(f"{share:.0%} of {len(residuals)} within {bound:g}\n")


if __name__ == "__main__":
    main(sys.argv[1:])
