"""mbla beside what a user would take instead, on the same contacts; to results/rivals.csv.

::

    python -m tests.performance.bench_rivals [STRUCTURE ...] [--rival RIVAL ...] [--limit SECONDS]

The structures are walls of 5 × 5, 10 × 10 and 20 × 20 units and arches of 20, 50 and 100 voussoirs of the standard set,
in their plane and in space, with associative flow. The rivals (:mod:`tests.performance.rivals`): the cone program
through cvxpy, plain, and with the care that it takes; linear programs through ``scipy.optimize.linprog``; one
equilibrium check of compas_cra, for structures in space. ``pip install 'mbla[benchmark]'`` brings cvxpy and compas_cra.

Each runs in a process of its own on one thread, from the contacts to its answer, imports and contacts not counted; one
that takes longer than the limit is stopped and recorded as such. ``processor`` and ``clock`` are the shortest of a few
runs, ``solver`` the seconds of the processor in the solver alone; ``ratio`` and ``solver_ratio`` are these over those
of mbla: of ``mbla``, or of ``mbla, standing`` for a check without load factor, so that above 1 mbla is the faster.

``error`` is the relative distance of the load factor from ``reference``, the middle of the bounds that mbla proves with
``accuracy: reference``, which are ``bracket`` apart; ``residual`` the largest lack of balance or excess over friction
of the rival's own forces, over the mean block weight; the two bounds are those that come proved with the answer.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from tests.performance.recording import record
from tests.performance.rivals import coupled_blocks, cvxpy_models, linear_programs, own
from tests.performance.rivals.answer import Answer
from tests.performance.rivals.statement import Statement, statement_of
from tests.performance.rivals.structure import Structure, compared, structure_of

LIMIT = 300.0
"""Seconds by the clock for all runs of one rival on one structure."""

ENOUGH = 3.0
"""Seconds after which a run is not repeated."""

RUNS = 3
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")
LOAD_FACTOR, STANDS = "load factor", "stands"
EXTRA = "pip install 'mbla[benchmark]'"


@dataclass(frozen=True)
class Rival:
    """A way to the answer.

    question : that it answers
    versions : of its libraries; raises ImportError where one is missing
    spatial  : only for structures in space
    """

    solve: Callable[[Structure], Answer]
    question: str
    versions: Callable[[], str]
    spatial: bool = False


def from_statement(solve: Callable[[Statement], Answer]) -> Callable[[Structure], Answer]:
    """A rival that begins with writing the statement."""

    def run(structure: Structure) -> Answer:
        contacts, case = structure.contacts, structure.load_case
        return solve(statement_of(structure.model, contacts, case, planar=structure.planar))

    return run


def _own_version() -> str:
    return ""


RIVALS = {
    "mbla": Rival(own.whole, LOAD_FACTOR, _own_version),
    "mbla, load factor alone": Rival(own.load_factor_alone, LOAD_FACTOR, _own_version),
    "mbla, standing": Rival(own.standing, STANDS, _own_version),
    "cvxpy": Rival(from_statement(cvxpy_models.plain), LOAD_FACTOR, cvxpy_models.cvxpy_version),
    "cvxpy, scaled": Rival(from_statement(cvxpy_models.scaled), LOAD_FACTOR, cvxpy_models.cvxpy_version),
    "cvxpy, kinematic": Rival(from_statement(cvxpy_models.kinematic), LOAD_FACTOR, cvxpy_models.cvxpy_version),
    "linprog": Rival(from_statement(linear_programs.by_default), LOAD_FACTOR, linear_programs.highs_version),
    "linprog, interior point": Rival(
        from_statement(linear_programs.interior), LOAD_FACTOR, linear_programs.highs_version
    ),
    "compas_cra, rbe_solve": Rival(coupled_blocks.rbe, STANDS, coupled_blocks.compas_version, spatial=True),
    "compas_cra, cra_solve": Rival(coupled_blocks.cra, STANDS, coupled_blocks.compas_version, spatial=True),
    "compas_cra, cra_solve, density in kg": Rival(
        coupled_blocks.cra_with_density, STANDS, coupled_blocks.compas_version, spatial=True
    ),
}
MEASURE = {LOAD_FACTOR: "mbla", STANDS: "mbla, standing"}
"""What a rival is measured against, by its question."""


def installed(names: list[str]) -> list[str]:
    """Rivals whose libraries are there; the others are said, one line each library."""
    found, missing = [], {}
    for name in names:
        try:
            RIVALS[name].versions()
            found.append(name)
        except ImportError as absent:
            missing[str(absent)] = [*missing.get(str(absent), []), name]
    for reason, without in missing.items():
        sys.stdout.write(f"left out: {', '.join(without)}: {reason}; {EXTRA}\n")
    return found


def measured(name: str, rival: str) -> dict[str, object]:
    """One rival on one structure, in this process: figures of its row."""
    standard, planar = compared()[name]
    structure = structure_of(standard, planar=planar)
    way, clock, processor = RIVALS[rival], [], []
    answer = way.solve(structure)  # first calls import and prepare; they do not count unless they are long
    begun = time.perf_counter()
    for _ in range(RUNS):
        started = time.perf_counter(), time.process_time()
        again = way.solve(structure)
        clock.append(time.perf_counter() - started[0])
        processor.append(time.process_time() - started[1])
        if again.solver is not None and answer.solver is not None:
            answer = again if again.solver < answer.solver else answer
        if time.perf_counter() - begun > ENOUGH:
            break
    solver = answer.solver
    if rival.startswith("mbla") and way.question == LOAD_FACTOR:
        solver = min(own.cone_program_seconds(structure) for _ in range(RUNS))
    static, kinematic = answer.bounds or (None, None)
    return {
        "blocks": len(structure.model.free),
        "interfaces": len(structure.contacts),
        "status": answer.status,
        "load_factor": answer.load_factor,
        "residual": answer.residual,
        "static_bound": static,
        "kinematic_bound": kinematic,
        "processor": min(processor),
        "clock": min(clock),
        "solver": solver,
    }


def reference_of(name: str) -> dict[str, object]:
    """Bounds of the load factor, as close as they come."""
    standard, planar = compared()[name]
    static, kinematic = own.reference(structure_of(standard, planar=planar))
    return {"static": static, "kinematic": kinematic}


def in_child(what: list[str], limit: float) -> dict[str, object] | None:
    """The figures that a process of its own finds on one thread; None where it had to be stopped."""
    command = [sys.executable, "-m", "tests.performance.bench_rivals", "--one", *what]
    environment = os.environ | dict.fromkeys(THREADS, "1")
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=limit, env=environment)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        return {"status": f"failed: {last}"}
    figures: dict[str, object] = json.loads(done.stdout.splitlines()[-1])
    return figures


EMPTY = dict.fromkeys(
    (
        "blocks",
        "interfaces",
        "status",
        "load_factor",
        "residual",
        "static_bound",
        "kinematic_bound",
        "processor",
        "clock",
        "solver",
    )
)


def compare(name: str, rivals: list[str], limit: float) -> None:
    """All rivals on one structure, a row each."""
    planar = compared()[name][1]
    reference = in_child(["reference", name], limit) or {}
    taken: dict[str, dict[str, object]] = {}
    for rival in rivals:
        way = RIVALS[rival]
        if way.spatial and planar:
            continue
        found = in_child([name, rival], limit)
        taken[rival] = EMPTY | ({"status": f"stopped after {limit:g} s"} if found is None else found)
        against = taken.get(MEASURE[way.question], {})
        row = row_of(name, rival, taken[rival], against, reference)
        record("rivals", {key: _text(key, value) for key, value in row.items()})


def row_of(
    name: str,
    rival: str,
    figures: Mapping[str, object],
    against: Mapping[str, object],
    reference: Mapping[str, object],
) -> dict[str, object]:
    """A row with what follows from the figures: error against the reference, ratios against mbla."""
    row: dict[str, object] = {"structure": name, "rival": rival, "libraries": RIVALS[rival].versions(), **figures}
    row |= {"reference": None, "bracket": None, "error": None}
    if "static" in reference:
        static, kinematic = float(str(reference["static"])), float(str(reference["kinematic"]))
        middle = 0.5 * (static + kinematic)
        row |= {"reference": middle, "bracket": abs(kinematic - static) / abs(middle)}
        if figures.get("load_factor") is not None:
            row["error"] = float(str(figures["load_factor"])) / middle - 1.0
    row["ratio"] = _ratio(figures, against, "processor")
    row["solver_ratio"] = _ratio(figures, against, "solver")
    return row


def _ratio(figures: Mapping[str, object], against: Mapping[str, object], column: str) -> float | None:
    mine, theirs = against.get(column), figures.get(column)
    return None if mine is None or theirs is None else float(str(theirs)) / float(str(mine))


DIGITS = {"load_factor": 10, "static_bound": 10, "kinematic_bound": 10, "reference": 10}
"""Of load factors, which differ in the ninth; of other numbers four."""


def _text(name: str, value: object) -> object:
    if value is None:
        return ""
    return f"{value:.{DIGITS[name]}g}" if name in DIGITS else value


def main(arguments: list[str]) -> None:
    """All structures and rivals, or those named."""
    if arguments[:1] == ["--one"]:
        what = arguments[1:]
        figures = reference_of(what[1]) if what[0] == "reference" else measured(*what)
        sys.stdout.write(json.dumps(figures) + "\n")
        return
    parser = argparse.ArgumentParser(prog="python -m tests.performance.bench_rivals")
    parser.add_argument("structures", nargs="*", metavar="STRUCTURE", help=f"of: {'; '.join(compared())}")
    parser.add_argument("--rival", action="append", choices=tuple(RIVALS), help="only this, and what it is measured by")
    parser.add_argument("--limit", type=float, default=LIMIT, help="seconds for one rival on one structure")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.structures) - set(compared()))
    if unknown:
        parser.error(f"unknown structure: {', '.join(unknown)}")
    chosen = options.rival or list(RIVALS)
    wanted = [name for name in RIVALS if name in chosen or name in {MEASURE[RIVALS[c].question] for c in chosen}]
    rivals = installed(wanted)
    for name in options.structures or compared():
        compare(name, rivals, options.limit)


if __name__ == "__main__":
    main(sys.argv[1:])
