"""The condensed interior-point method beside clarabel at equal proved accuracy; to results/cone_solvers.csv.

::

    python -m tests.performance.bench_cone_solvers [MODEL ...]

The associative program of each model is solved by either at tolerances that become smaller until the bounds that its
solution proves (``certified_gap``) are within 1e-7 of the load factor; the row is that of the
first that does, of the smallest gap where none does. clarabel is run with qdldl;
the condensed method with every factorisation that is installed. ``seconds`` is the shortest of a few runs in seconds of
the processor on one thread, everything from the cone program on counted; ``factorizing`` the share of that in the
factorisation; ``gap`` the proved one; ``error`` the distance of the load factor from the middle of the tightest bounds
of all rows of the model; ``memory_mb`` the most that the process took, the model included. Every row has a process of
its own. At the end: how many times faster the fastest of the condensed method is than the fastest of clarabel.
"""

from __future__ import annotations

import json
import resource
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.kinematic import KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.program.reductions import reduce_program, unreduced
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.bounds import certified_gap
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.linear_algebra import Factorization, best_library, installed
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from tests.decks.folder import BENCHMARKS
from tests.line import HEAD, line_of, line_of_file
from tests.performance.bench_solver import SLAB, wall
from tests.performance.recording import record

WANTED = 1e-7
"""Proved relative distance of the bounds that is asked of either."""

TOLERANCES = (1e-7, 1e-8, 1e-9)

ARCH = (
    HEAD
    + """\
parameters: {n: 20}
joints: {dry: {friction: 0.7}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 10, thickness: 1.5, width: 1, voussoirs: "=n"}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)
DECKS = Path(__file__).parents[2] / "decks"


@dataclass(frozen=True)
class Model:
    """The text of a deck, or its file, with overrides; spatial: without reductions."""

    deck: str | Path
    overrides: tuple[str, ...] = ()
    spatial: bool = True

    def program(self) -> Program:
        """Of its first load case."""
        overrides = ("analysis.flow_rule=associative", *self.overrides)
        deck = self.deck
        line = line_of(deck, *overrides) if isinstance(deck, str) else line_of_file(deck, *overrides)
        if self.spatial:
            return unreduced(line.program, line.contacts).parts[0]
        return reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False).parts[0]


def _wall(m: int, n: int, spatial: bool) -> Model:
    return Model(SLAB, wall(m, n), spatial)


MODELS = {
    **{f"wall {m} x {n}, spatial": _wall(m, n, True) for m, n in ((10, 10), (20, 20), (40, 25), (60, 60))},
    **{f"wall {m} x {n}": _wall(m, n, False) for m, n in ((10, 10), (20, 20), (40, 25), (60, 60), (100, 100))},
    **{f"arch of {n} voussoirs": Model(ARCH, (f"parameters.n={n}",), False) for n in (20, 100, 500)},
    **{f"arch of {n} voussoirs, spatial": Model(ARCH, (f"parameters.n={n}",)) for n in (20, 100, 500)},
    "cross vault": Model(DECKS / "tutorials" / "crossvault.yaml"),
    "dome": Model(BENCHMARKS["dome_24_voussoirs"]),
}
LARGE = {"wall 100 x 100, spatial": _wall(100, 100, True)}
"""only when named, and by the condensed method with the factorisation that it chooses"""

LARGEST = 60_300
"""Unknowns of that."""


def ways() -> list[tuple[str, str]]:
    """Solver and factorisation."""
    theirs = ["qdldl"]
    return [("clarabel", library) for library in theirs] + [("mbla", library) for library in installed()]


@dataclass
class TimedFactors:
    """A factorisation that counts its time."""

    held: Factorization
    seconds: float = 0.0
    library: str = field(init=False)

    def __post_init__(self) -> None:
        self.library = self.held.library

    def factorize(self, values: FloatArray) -> bool:
        started = time.process_time()
        done = self.held.factorize(values)
        self.seconds += time.process_time() - started
        return done

    def solve(self, rhs: FloatArray) -> FloatArray:
        return self.held.solve(rhs)


def silent(record: IterationRecord) -> None:
    pass


def solved(form: KinematicForm, solver: str, library: str, tolerance: float) -> tuple[ConeSolution, float, float]:
    """Solution, seconds, seconds of them in the factorisation (NaN for clarabel)."""
    settings = SolverSettings(tolerance, cholesky=library)
    started = time.process_time()
    if solver == "clarabel":
        solution = ClarabelProgram(form.cone_program, settings, silent).solve_once(1, 1.0)
        return solution, time.process_time() - started, float("nan")
    held = CondensedProgram(form.cone_program, settings, silent)
    condensation = held.prepared()[1]
    condensation.factors = timed = TimedFactors(condensation.factors)
    solution = held.solve_once(1, 1.0)
    return solution, time.process_time() - started, timed.seconds


def measured(name: str, solver: str, library: str) -> dict[str, object]:
    """One row: at the first tolerance that is good enough, or the best of all."""
    program = (MODELS | LARGE)[name].program()
    form = kinematic_form(program, program.limits)
    rows = []
    for tolerance in TOLERANCES:
        solution, seconds, factorizing = solved(form, solver, library, tolerance)
        if not np.isfinite(solution.objective):
            continue
        state = LawState(form.contact_forces(solution.z), form.velocities(solution.x), -float(solution.z[0]), np.nan)
        gap = certified_gap(program, state)
        rows.append(
            {
                "model": name,
                "solver": solver,
                "library": library,
                "blocks": len(program.free),
                "unknowns": len(form.cone_program.cost),
                "tolerance": tolerance,
                "seconds": seconds,
                "factorizing": factorizing / seconds,
                "iterations": solution.iterations,
                "status": solution.solver_status,
                "load_factor": solution.objective,
                "static": gap.static,
                "kinematic": gap.kinematic,
                "gap": gap.gap,
            }
        )
        if gap.gap <= WANTED:
            break
    row = min(rows, key=lambda found: (float(str(found["gap"])) > WANTED, float(str(found["gap"]))))
    for _ in range(3 if float(str(row["seconds"])) < 3.0 else 0):
        _, seconds, factorizing = solved(form, solver, library, float(str(row["tolerance"])))
        if seconds < float(str(row["seconds"])):
            row |= {"seconds": seconds, "factorizing": factorizing / seconds}
    return row | {"memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024}


def compare(name: str) -> float:
    """Measure a model in every way, record its rows, return how many times faster the condensed method is."""
    rows = []
    for solver, library in ways() if name in MODELS else [("mbla", best_library(LARGEST))]:
        command = [sys.executable, "-m", "tests.performance.bench_cone_solvers", "--one", name, solver, library]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        rows.append(json.loads(done.stdout.splitlines()[-1]))
    tightest = min(rows, key=lambda row: row["gap"])
    middle = 0.5 * (tightest["static"] + tightest["kinematic"])
    for row in rows:
        row["error"] = abs(row["load_factor"] - middle) / abs(middle)
        record("cone_solvers", {key: _text(row[key]) if key in BOUNDS else row[key] for key in row})
    if name in LARGE:
        return float("nan")
    best = {s: min(row["seconds"] for row in rows if row["solver"] == s) for s in ("clarabel", "mbla")}
    ratio = float(best["clarabel"] / best["mbla"])
    sys.stdout.write(f"{name}: {ratio:.2f} times faster\n")
    return ratio


BOUNDS = ("load_factor", "static", "kinematic")


def _text(value: float) -> str:
    return f"{value:.10g}"


def main() -> None:
    if sys.argv[1:2] == ["--one"]:
        sys.stdout.write(json.dumps(measured(*sys.argv[2:])) + "\n")
        return
    ratios = {name: compare(name) for name in sys.argv[1:] or MODELS}
    sys.stdout.write(f"median: {statistics.median(ratios.values()):.2f} times faster\n")


if __name__ == "__main__":
    main()
