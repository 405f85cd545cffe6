"""mbla beside what a user would take instead, on the same contacts; to results/rivals.csv.

::

    python -m tests.performance.bench_rivals [STRUCTURE ...] [--rival RIVAL ...] [--limit SECONDS]

The structures are walls of 5 × 5, 10 × 10 and 20 × 20 units and arches of 20, 50 and 100 voussoirs of the standard set,
in their plane and in space, with associative flow. The rivals (:mod:`tests.performance.rivals`): the cone program
through cvxpy, plain, and with the care that it takes; linear programs through ``scipy.optimize.linprog``; one
equilibrium check of compas_cra, for structures in space. ``pip install 'mbla[benchmark]'`` brings cvxpy and compas_cra.

Each runs in a process of its own on one thread, from the contacts to its answer, imports and contacts not counted; one
that takes more seconds of the processor than the limit is stopped and recorded as such. ``processor`` and ``clock`` are
the shortest of a few runs, ``solver`` the seconds of the processor in the solver alone; ``ratio`` and ``solver_ratio``
are these over those of mbla: of ``mbla``, or of ``mbla, standing`` for a check without load factor, so that above 1
mbla is the faster.

``error`` is the relative distance of the load factor from ``reference``, the middle of the bounds that mbla proves with
``accuracy: reference``, which are ``bracket`` apart; ``residual`` the largest lack of balance or excess over friction
of the rival's own forces, over the mean block weight; the two bounds are those that come proved with the answer.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from tests.performance.child import answer_as_child, in_child
from tests.performance.recording import record
from tests.performance.rivals import coupled_blocks, cvxpy_models, linear_programs, own
from tests.performance.rivals.answer import Answer
from tests.performance.rivals.statement import Statement, statement_of
from tests.performance.rivals.structure import Structure, compared, structure_of

LIMIT = 300.0
"""Seconds of the processor for one rival on one structure, all its runs together."""

ENOUGH = 3.0
"""Seconds of the processor after which a run is not repeated."""

RUNS = 4
LOAD_FACTOR, STANDS = "load factor", "stands"
REFERENCE = "reference"
MODULE = "tests.performance.bench_rivals"
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
    found: list[str] = []
    missing: dict[str, list[str]] = {}
    for name in names:
        try:
            RIVALS[name].versions()
            found.append(name)
        except ImportError as absent:
            missing[str(absent)] = [*missing.get(str(absent), []), name]
    for reason, without in missing.items():
        sys.stdout.write(f"left out: {'; '.join(without)} ({reason}; {EXTRA})\n")
    return found


def measured(name: str, rival: str) -> dict[str, object]:
    """One rival on one structure, in this process: figures of its row."""
    standard, planar = compared()[name]
    structure = structure_of(standard, planar=planar)
    way = RIVALS[rival]
    way.versions()  # imports its libraries
    answers: list[Answer] = []
    clock: list[float] = []
    processor: list[float] = []
    while len(answers) < RUNS and sum(processor) < ENOUGH:
        started = time.perf_counter(), time.process_time()
        answers.append(way.solve(structure))
        clock.append(time.perf_counter() - started[0])
        processor.append(time.process_time() - started[1])
    answer = answers[-1]
    solver = min((found.solver for found in answers if found.solver is not None), default=None)
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


def one(what: str, rival: str) -> dict[str, object]:
    """What a process of its own does: the reference, or a rival on a structure."""
    return reference_of(what) if rival == REFERENCE else measured(what, rival)


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
    reference = in_child(MODULE, [name, REFERENCE], limit)
    taken: dict[str, dict[str, object]] = {}
    for rival in rivals:
        way = RIVALS[rival]
        if way.spatial and planar:
            continue
        taken[rival] = EMPTY | in_child(MODULE, [name, rival], limit)
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
    """Of the seconds of a column; None where either has none, as a check that needs no solver."""
    mine, theirs = against.get(column), figures.get(column)
    return None if not mine or theirs is None else float(str(theirs)) / float(str(mine))


DIGITS = {"load_factor": 10, "static_bound": 10, "kinematic_bound": 10, "reference": 10}
"""Of load factors, which differ in the ninth; of other numbers four."""


def _text(name: str, value: object) -> object:
    if value is None:
        return ""
    return f"{value:.{DIGITS[name]}g}" if name in DIGITS else value


def main(arguments: list[str]) -> None:
    """All structures and rivals, or those named."""
    if answer_as_child(arguments, one):
        return
    parser = argparse.ArgumentParser(prog="python -m tests.performance.bench_rivals")
    parser.add_argument("structures", nargs="*", metavar="STRUCTURE", help=f"of: {'; '.join(compared())}")
    parser.add_argument("--rival", action="append", choices=tuple(RIVALS), help="only this, and what it is measured by")
    parser.add_argument(
        "--limit", type=float, default=LIMIT, help="seconds of the processor for one rival on one structure"
    )
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
