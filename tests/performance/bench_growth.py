"""How the time grows with the number of blocks; to results/growth.csv and results/growth_exponents.csv.

::

    python -m tests.performance.bench_growth [--most BLOCKS] [--limit SECONDS] [--only FAMILY]

Walls of the standard set from 100 to 10,000 blocks, in their plane and in space, with associative flow and without
dilatancy, everything else by default. Each run has a process of its own on one thread; one that takes more seconds of
the processor than the limit is stopped and recorded as such, and larger ones of its family are not begun. ``solver`` is
seconds of the processor in the solver stage, ``total`` from the deck to the verified answer (result files have a
benchmark of their own, ``bench_results``), ``clock`` the same by the clock, ``cone_programs`` the seconds by the clock
in cone programs alone. The exponent is the slope of log time over log blocks by least squares, ``deviation`` the root
mean square of what the line leaves of log time.
"""

from __future__ import annotations

import argparse
import resource
import sys
import time
from collections.abc import Mapping, Sequence

import numpy as np

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program import assemble
from mbla.run_deck import contacts_of, reduced_program, select_cases
from mbla.solution import solve, verified_status, verify
from mbla.solution.settings import solver_settings
from tests.performance.child import answer_as_child, in_child
from tests.performance.recording import record
from tests.performance.standard_set import DECKS, FLOW_RULES, SPATIAL

SIDES = (10, 14, 20, 32, 45, 71, 100)
"""Units in length and courses: 105, 203, 410, 1,040, 2,047, 5,076 and 10,050 blocks."""

LIMIT = 1800.0
"""Seconds of the processor for one run."""

FAMILIES = ("wall, planar", "wall, spatial")
FEWEST = 3
"""Sizes below which there is no slope."""

TIMES = ("solver", "total")
FIGURES = ("load_factor", "programs", "iterations", "cone_programs", *TIMES, "clock", "memory_mb")
MODULE = "tests.performance.bench_growth"


def measured(family: str, flow_rule: str, side: int | str) -> dict[str, object]:
    """One run in this process."""
    started = time.perf_counter(), time.process_time()
    size = (f"parameters.m={side}", f"parameters.n={side}", f"analysis.flow_rule={flow_rule}")
    deck = read_deck(DECKS / "tradeoff" / "wall.yaml", (*size, *(SPATIAL if "spatial" in family else ())))
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    (load_case,) = select_cases(model, ["in_plane"])
    reduced = reduced_program(deck, model, contacts, assemble(model, contacts, load_case))
    before = time.process_time()
    solution = solve(reduced, deck.analysis, solver_settings(deck.analysis))
    solver = time.process_time() - before
    checks = verify(model, contacts, load_case, solution)
    return {
        "blocks": len(model.free),
        "status": str(verified_status(solution, checks)),
        "load_factor": None if solution.mechanics is None else solution.mechanics.load_factor,
        "programs": len(solution.programs),
        "iterations": sum(program.iterations for program in solution.programs),
        "cone_programs": sum(program.seconds for program in solution.programs if program.solver),
        "solver": solver,
        "total": time.process_time() - started[1],
        "clock": time.perf_counter() - started[0],
        "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def blocks_of(side: int) -> int:
    """Of a wall of so many units by so many courses: every other course has one more, two of them halves."""
    return side * side + side // 2


def exponent(blocks: Sequence[float], seconds: Sequence[float]) -> tuple[float, float]:
    """Slope of log time over log blocks by least squares, and the root mean square left; NaN below 3 sizes."""
    if len(blocks) < FEWEST:
        return float("nan"), float("nan")
    x, y = np.log(blocks), np.log(seconds)
    slope, offset = np.polyfit(x, y, 1)
    return float(slope), float(np.sqrt(np.mean((slope * x + offset - y) ** 2)))


def record_exponents(family: str, flow_rule: str, rows: Sequence[Mapping[str, object]]) -> None:
    """A row for each time, from the runs that came to their end."""
    ended = [row for row in rows if row["total"] != ""]
    blocks = [float(str(row["blocks"])) for row in ended]
    for column in TIMES:
        slope, left = exponent(blocks, [float(str(row[column])) for row in ended])
        row = {"family": family, "flow_rule": flow_rule, "time": column, "sizes": len(blocks)}
        row |= {"fewest_blocks": min(blocks, default=0), "most_blocks": max(blocks, default=0)}
        record("growth_exponents", row | {"exponent": slope, "deviation": left})


def measure(family: str, flow_rule: str, sides: Sequence[int], limit: float) -> None:
    """All sizes of one family, the smallest first, up to the first that does not come to its end."""
    rows = []
    for side in sides:
        row: dict[str, object] = {"family": family, "flow_rule": flow_rule, "blocks": blocks_of(side), "status": ""}
        found = in_child(MODULE, [family, flow_rule, str(side)], limit)
        rows.append(row | dict.fromkeys(FIGURES, "") | found)
        record("growth", rows[-1])
        if rows[-1]["total"] == "":
            break
    record_exponents(family, flow_rule, rows)


def main(arguments: list[str]) -> None:
    """All families, or one."""
    if answer_as_child(arguments, measured):
        return
    parser = argparse.ArgumentParser(prog="python -m tests.performance.bench_growth")
    parser.add_argument("--most", type=int, default=blocks_of(SIDES[-1]), metavar="BLOCKS", help="no larger walls")
    parser.add_argument("--limit", type=float, default=LIMIT, metavar="SECONDS", help="for one run")
    parser.add_argument("--only", choices=FAMILIES, help="only this family")
    options = parser.parse_args(arguments)
    sides = [side for side in SIDES if blocks_of(side) <= options.most]
    for family in [options.only] if options.only else FAMILIES:
        for flow_rule in FLOW_RULES:
            measure(family, flow_rule, sides, options.limit)


if __name__ == "__main__":
    main(sys.argv[1:])
