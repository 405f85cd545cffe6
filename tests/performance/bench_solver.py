"""Cost of the solver stage: associative and non-associative, planar and spatial, side by side; to results/solver.csv.

::

    python -m tests.performance.bench_solver [NAME ...]

``associative`` is what an associative analysis takes (its cone program and the proof that the dead load is carried),
``non_associative`` everything that the default scheme adds to it, and ``ratio`` the second over the first, both in
seconds of the processor in one run. The median of the ratios is printed at the end.
"""

from __future__ import annotations

import statistics
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from mbla.program.reductions import reduce_program, unreduced
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.part import solve_part
from mbla.solution.settings import solver_settings
from mbla.solution.solution import IterationRecord
from tests.decks.folder import BENCHMARKS
from tests.line import HEAD, WALL, Line, line_of, line_of_file
from tests.performance.recording import record

SLAB = (
    HEAD
    + """\
parameters: {m: 20, n: 20}
joints: {dry: {friction: 0.65}}
blocks:
  - box: {group: slab, material: stone, min: [0, 0, -0.2], max: ["=0.4*m", 0.2, 0]}
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.175], length: "=0.4*m", courses: "=n"}
supports: [{blocks: slab}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)
"""Wall of m units by n courses on a fixed slab."""

ARCH = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 1.85, thickness: 0.15, width: 0.3, voussoirs: 27}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)


@dataclass(frozen=True)
class Case:
    """A deck text with overrides; spatial: without reductions."""

    deck: str | Path
    overrides: tuple[str, ...] = ()
    spatial: bool = False

    def line(self) -> Line:
        """Everything up to the program."""
        read = line_of_file if isinstance(self.deck, Path) else line_of
        return read(self.deck, "analysis.flow_rule=non_associative", *self.overrides)  # type: ignore[arg-type]


def wall(m: int, n: int) -> tuple[str, str]:
    """Overrides for a wall of m units by n courses."""
    return f"parameters.m={m}", f"parameters.n={n}"


CASES = {
    **{f"Ferris wall {number}": Case(BENCHMARKS[f"ferris_wall_{number}"]) for number in (1, 3, 5)},
    **{
        f"Ferris wall {number}, spatial": Case(BENCHMARKS[f"ferris_wall_{number}"], spatial=True)
        for number in (1, 3, 5)
    },
    "wall 5 x 5 on the ground": Case(WALL),
    "wall 10 x 10": Case(SLAB, wall(10, 10)),
    "wall 10 x 10, spatial": Case(SLAB, wall(10, 10), spatial=True),
    "wall 20 x 20": Case(SLAB, wall(20, 20)),
    "wall 20 x 20, spatial": Case(SLAB, wall(20, 20), spatial=True),
    "wall 40 x 25": Case(SLAB, wall(40, 25)),
    "arch of 27 voussoirs": Case(ARCH),
    "arch of 20 voussoirs": Case(BENCHMARKS["arch_20_voussoirs"]),
    "arch of 50 voussoirs": Case(BENCHMARKS["arch_50_voussoirs"]),
    "Oppenheim's arch": Case(BENCHMARKS["oppenheim_arch"]),
    "block in a groove": Case(BENCHMARKS["groove"]),
}
LARGE = {"wall 40 x 25, spatial": Case(SLAB, wall(40, 25), spatial=True)}
"""only when named"""


def measure(name: str, case: Case) -> float:
    """Solve both ways, record a row, return the ratio."""
    line = case.line()
    analysis = line.deck.analysis.model_copy(update={"standing": False, "range": False})
    settings = solver_settings(analysis)
    started = time.process_time()
    reduced = unreduced(line.program, line.contacts)
    if not case.spatial:
        reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False)
    (program,) = reduced.parts
    reducing = time.process_time() - started

    def silent(record: IterationRecord) -> None:
        pass

    associative, alone = solve_associative(program, settings, silent), []
    for _ in range(3):
        started = time.process_time()
        associative = solve_associative(program, settings, silent)
        alone.append(time.process_time() - started)
    first = associative.programs[0]
    started = time.process_time()
    result = solve_part(program, analysis, settings, silent)
    added = time.process_time() - started - min(alone)
    assert result.state is not None
    record(
        "solver",
        {
            "case": name,
            "dimension": program.components,
            "blocks": len(program.free),
            "points": program.n_points,
            "reducing": reducing,
            "associative": min(alone),
            "first_program": first.seconds,
            "iterations": first.iterations,
            "load_factor_associative": program.scaling.load_factor(associative.state.load_factor)
            if associative.state
            else "",
            "non_associative": added,
            "ratio": added / min(alone),
            "programs": len(result.programs),
            "load_factor": program.scaling.load_factor(result.state.load_factor),
            "residual": result.state.residual,
            "status": str(result.status),
        },
    )
    return added / min(alone)


def main(names: list[str]) -> None:
    """All cases but the large ones, or those named."""
    known = CASES | LARGE
    chosen = {name: known[name] for name in names} if names else CASES
    ratios = [measure(name, case) for name, case in chosen.items()]
    sys.stdout.write(f"median ratio {statistics.median(ratios):.3g}\n")


if __name__ == "__main__":
    main(sys.argv[1:])
