"""mbla beside what a user would take instead, on the same contacts; to results/rivals.csv.

::

    python -m tests.performance.bench_rivals [STRUCTURE ...] [--rival RIVAL ...] [--limit SECONDS]

The structures are walls of 5 × 5, 10 × 10 and 20 × 20 units and arches of 20, 50 and 100 voussoirs of the standard set,
in their plane and in space, with associative flow. The rivals (:mod:`tests.performance.rivals`): the cone program
through cvxpy, plain, and with the care that it takes; linear programs through ``scipy.optimize.linprog``; one
equilibrium check of compas_cra, for structures in space. ``pip install 'mbla[benchmark]'`` brings cvxpy and compas_cra.

Each runs in a process of its own on one thread, from the contacts to its answer, imports and contacts not counted; one
that takes more seconds of the processor than the limit is stopped and recorded as such. ``processor`` and ``clock`` are
the shortest of a few runs; ``ratio`` is the processor over that of ``mbla``, or of ``mbla, standing`` for a check
without load factor, so that above 1 mbla is the faster.

``error`` is the relative distance of the load factor from ``reference``, the middle of the bounds that mbla proves with
``accuracy: reference``, which are ``bracket`` apart; ``residual`` the largest lack of balance or excess over friction
of the rival's own forces, over the mean block weight; the two bounds are those that come proved with the answer.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from tests.performance.recording import record
from tests.performance.rivals import coupled_blocks, cvxpy_models, linear_programs, own
from tests.performance.rivals.statement import Statement, statement_of
from tests.performance.rivals.structure import Answer, Structure, compared, structure_of

LIMIT = 300
"""Seconds of the processor for one rival on one structure, all its runs together."""
PATIENCE = 20.0
"""By the clock a run may take so many times its limit: on a busy machine a second of the processor takes many."""
GRACE = 10
"""Seconds from the signal that ends a run at its limit to the one that it cannot ignore."""
ENOUGH = 3.0
"""Seconds of the processor after which a run is not repeated."""

RUNS = 4
ONE = "--one"
LOAD_FACTOR, STANDS = "load factor", "stands"
REFERENCE = "reference"
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")


@dataclass(frozen=True)
class Rival:
    """A way to the answer.

    question : that it answers
    versions : of its libraries; raises ImportError where one is missing
    spatial  : only for structures in space
    """

    solve: Callable[[Structure], Answer]
    question: str
    versions: Callable[[], str] = str
    spatial: bool = False


def from_statement(solve: Callable[[Statement], Answer]) -> Callable[[Structure], Answer]:
    """A rival that begins with writing the statement."""

    def run(structure: Structure) -> Answer:
        contacts, case = structure.contacts, structure.load_case
        return solve(statement_of(structure.model, contacts, case, planar=structure.planar))

    return run


RIVALS = {
    "mbla": Rival(own.whole, LOAD_FACTOR),
    "mbla, standing": Rival(own.standing, STANDS),
    "cvxpy": Rival(from_statement(cvxpy_models.plain), LOAD_FACTOR, cvxpy_models.cvxpy_version),
    "cvxpy, scaled": Rival(from_statement(cvxpy_models.scaled), LOAD_FACTOR, cvxpy_models.cvxpy_version),
    "linprog": Rival(from_statement(linear_programs.by_default), LOAD_FACTOR, linear_programs.highs_version),
    "linprog, interior point": Rival(
        from_statement(linear_programs.interior), LOAD_FACTOR, linear_programs.highs_version
    ),
    "compas_cra, rbe_solve": Rival(coupled_blocks.rbe, STANDS, coupled_blocks.compas_version, spatial=True),
    "compas_cra, cra_solve": Rival(coupled_blocks.cra, STANDS, coupled_blocks.compas_version, spatial=True),
}
MEASURE = {LOAD_FACTOR: "mbla", STANDS: "mbla, standing"}
"""What a rival is measured against, by its question."""
FIGURES = (
    *("blocks", "interfaces", "status", "load_factor", "residual"),
    *("static_bound", "kinematic_bound", "processor", "clock"),
)
DIGITS = {"load_factor": 10, "static_bound": 10, "kinematic_bound": 10, "reference": 10}
"""Of load factors, which differ in the ninth; of other numbers four."""


def installed(names: list[str]) -> list[str]:
    """Rivals whose libraries are there; the others are said."""
    found: list[str] = []
    for name in names:
        try:
            RIVALS[name].versions()
            found.append(name)
        except ImportError as absent:
            sys.stdout.write(f"left out: {name} ({absent}; pip install 'mbla[benchmark]')\n")
    return found


def measured(name: str, rival: str) -> dict[str, object]:
    """One rival on one structure, or the bounds of its load factor, in this process: figures of its row."""
    standard, planar = compared()[name]
    structure = structure_of(standard, planar=planar)
    if rival == REFERENCE:
        static, kinematic = own.reference(structure)
        return {"static": static, "kinematic": kinematic}
    way = RIVALS[rival]
    way.versions()  # imports its libraries
    answer = Answer("")
    clock: list[float] = []
    processor: list[float] = []
    while len(clock) < RUNS and sum(processor) < ENOUGH:
        started = time.perf_counter(), time.process_time()
        answer = way.solve(structure)
        clock.append(time.perf_counter() - started[0])
        processor.append(time.process_time() - started[1])
    bounds = answer.bounds or (None, None)
    sizes = len(structure.model.free), len(structure.contacts)
    times = min(processor), min(clock)
    figures = (*sizes, answer.status, answer.load_factor, answer.residual, *bounds, *times)
    return dict(zip(FIGURES, figures, strict=True))


def in_child(name: str, rival: str, limit: int) -> dict[str, Any]:
    """Figures by a process of its own on one thread; only ``status`` where it is stopped or fails."""
    command = [sys.executable, "-m", "tests.performance.bench_rivals", ONE, str(limit), name, rival]
    environment = os.environ | dict.fromkeys(THREADS, "1")
    stopped = {"status": f"stopped after {limit} s"}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE * limit, env=environment)
    except subprocess.TimeoutExpired:
        return stopped
    if done.returncode == -signal.SIGXCPU:
        return stopped
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        return {"status": f"failed: {last}"}
    figures: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return figures


def compare(name: str, rivals: list[str], limit: int) -> None:
    """All rivals on one structure, a row each."""
    reference = in_child(name, REFERENCE, limit)
    taken: dict[str, dict[str, object]] = {}
    for rival in rivals:
        way = RIVALS[rival]
        if not (way.spatial and compared()[name][1]):
            taken[rival] = dict.fromkeys(FIGURES) | in_child(name, rival, limit)
            row = row_of(name, rival, taken[rival], taken.get(MEASURE[way.question], {}), reference)
            record("rivals", {key: _text(key, value) for key, value in row.items()})


def row_of(
    name: str, rival: str, figures: Mapping[str, Any], against: Mapping[str, Any], reference: Mapping[str, Any]
) -> dict[str, object]:
    """A row with what follows from the figures: error against the reference, ratio against mbla."""
    row: dict[str, object] = {"structure": name, "rival": rival, "libraries": RIVALS[rival].versions(), **figures}
    row |= {"reference": None, "bracket": None, "error": None, "ratio": None}
    if "static" in reference:
        static, kinematic = reference["static"], reference["kinematic"]
        middle = 0.5 * (static + kinematic)
        row |= {"reference": middle, "bracket": abs(kinematic - static) / abs(middle)}
        if figures.get("load_factor") is not None:
            row["error"] = figures["load_factor"] / middle - 1.0
    if against.get("processor") and figures.get("processor"):
        row["ratio"] = figures["processor"] / against["processor"]
    return row


def _text(name: str, value: object) -> object:
    if value is None:
        return ""
    return f"{value:.{DIGITS[name]}g}" if name in DIGITS else value


def main(arguments: list[str]) -> None:
    """All structures and rivals, or those named; or one measurement, as a process of its own."""
    if arguments[:1] == [ONE]:
        limit, name, rival = int(arguments[1]), *arguments[2:]
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + GRACE))
        sys.stdout.write(json.dumps(measured(name, rival)) + "\n")
        return
    parser = argparse.ArgumentParser(prog="python -m tests.performance.bench_rivals")
    parser.add_argument("structures", nargs="*", metavar="STRUCTURE", help=f"of: {'; '.join(compared())}")
    parser.add_argument("--rival", action="append", choices=tuple(RIVALS), help="only this, and what it is measured by")
    parser.add_argument(
        "--limit", type=int, default=LIMIT, help="seconds of the processor for one rival on one structure"
    )
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.structures) - set(compared()))
    if unknown:
        parser.error(f"unknown structure: {', '.join(unknown)}")
    chosen = options.rival or list(RIVALS)
    rivals = installed([n for n in RIVALS if n in chosen or n in {MEASURE[RIVALS[c].question] for c in chosen}])
    for name in options.structures or compared():
        compare(name, rivals, options.limit)


if __name__ == "__main__":
    main(sys.argv[1:])
