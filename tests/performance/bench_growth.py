"""How the time grows with the number of blocks; to results/growth.csv and results/growth_exponents.csv.

::

    python -m tests.performance.bench_growth [--most BLOCKS] [--limit SECONDS] [--budget SECONDS] [--only FAMILY]
                                              [--flow-rule RULE]

Walls from 100 to 10,000 blocks, in their plane and in space, with associative flow and then without dilatancy,
everything else by default. Each run has a process of its own on one thread; one that takes more seconds of the
processor than the limit, or than is left of the budget of all, is stopped and recorded as such, and larger ones of its
family are not begun. ``solver`` is seconds of the processor in the solver stage, ``total`` from the deck to the
verified answer (result files have a benchmark of their own, ``bench_results``), ``clock`` the same by the clock,
``cone_programs`` the seconds by the clock in cone programs alone.

The exponent is the slope of log time over log blocks by least squares, ``deviation`` the root mean square of what the
line leaves of log time. It rests on the sizes that were solved, whose range is recorded with it, and is said with it:
where the largest walls were stopped it is one of the smaller ones.
"""

from __future__ import annotations

import argparse
import math
import resource
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import solids_of
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import select_cases
from mbla.program.build import build_program
from mbla.solution.settings import solver_settings
from mbla.solution.solve import solve
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.performance.child import answer_as_child, in_child
from tests.performance.recording import record
from tests.performance.standard_set import DECKS, FLOW_RULES, SPATIAL

SIDES = (10, 20, 40, 60, 100)
"""Units in length and courses: 105, 410, 1,620, 3,630 and 10,050 blocks."""

LIMIT = 1200.0
"""Seconds of the processor for one run."""

BUDGET = 3600.0
"""Seconds of the processor for all runs: an hour on an idle machine. Associative ones come first, the cheap ones."""

LEAST = 10.0
"""Seconds left of the budget below which no run is begun."""

ENDED = ("solved", "approximate")
"""States of runs that did all of their work: what breaks off early would flatter the exponent. Larger walls of a family
are not begun after one that did not."""

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
    program = build_program(solids_of(model, contacts), load_case, deck.analysis)
    before = time.process_time()
    solution = solve(program, deck.analysis, solver_settings(deck.analysis))
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
    """A row for each time, from the runs that came to their end, and a sentence with the sizes it rests on."""
    ended = [row for row in rows if row["status"] in ENDED]
    blocks = [float(str(row["blocks"])) for row in ended]
    for column in TIMES:
        slope, left = exponent(blocks, [float(str(row[column])) for row in ended])
        row = {"family": family, "flow_rule": flow_rule, "time": column, "sizes": len(blocks)}
        row |= {"fewest_blocks": min(blocks, default=0.0), "most_blocks": max(blocks, default=0.0)}
        row |= {"exponent": slope, "deviation": left}
        record("growth_exponents", row)
        sys.stdout.write(sentence(row) + "\n")


def sentence(row: Mapping[str, object]) -> str:
    """What an exponent says, and of which sizes."""
    who = f"{row['family']}, {row['flow_rule']}, {row['time']}"
    sizes = f"{row['sizes']} sizes from {row['fewest_blocks']:,.0f} to {row['most_blocks']:,.0f} blocks"
    if math.isnan(float(str(row["exponent"]))):
        return f"{who}: no exponent, only {row['sizes']} of the sizes came to their end"
    return f"{who}: time grows with blocks to the power {row['exponent']:.2f} (± {row['deviation']:.2f}), {sizes}"


@dataclass
class Budget:
    """Seconds of the processor that are left for all runs; what a child has taken is seen when it has ended."""

    left: float

    def run(self, what: Sequence[str], limit: float) -> dict[str, object]:
        """Figures of a run within the limit and what is left; no more than its status where it is not begun."""
        if self.left < LEAST:
            return {"status": "not begun: no time left"}
        before = _taken()
        found = in_child(MODULE, what, min(limit, self.left))
        self.left -= _taken() - before
        return found


def _taken() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure(family: str, flow_rule: str, sides: Sequence[int], limit: float, budget: Budget) -> None:
    """All sizes of one family, the smallest first, up to the first that does not come to a result."""
    rows = []
    for side in sides:
        row: dict[str, object] = {"family": family, "flow_rule": flow_rule, "blocks": blocks_of(side), "status": ""}
        found = budget.run([family, flow_rule, str(side)], limit)
        rows.append(row | dict.fromkeys(FIGURES, "") | found)
        record("growth", rows[-1])
        if rows[-1]["status"] not in ENDED:
            break
    record_exponents(family, flow_rule, rows)


def main(arguments: list[str]) -> None:
    """All families, or one."""
    if answer_as_child(arguments, measured):
        return
    parser = argparse.ArgumentParser(prog="python -m tests.performance.bench_growth")
    parser.add_argument("--most", type=int, default=blocks_of(SIDES[-1]), metavar="BLOCKS", help="no larger walls")
    parser.add_argument("--limit", type=float, default=LIMIT, metavar="SECONDS", help="of the processor for one run")
    parser.add_argument("--budget", type=float, default=BUDGET, metavar="SECONDS", help="of the processor for all runs")
    parser.add_argument("--only", choices=FAMILIES, help="only this family")
    parser.add_argument("--flow-rule", choices=FLOW_RULES, help="only this flow rule")
    options = parser.parse_args(arguments)
    sides = [side for side in SIDES if blocks_of(side) <= options.most]
    budget = Budget(options.budget)
    for flow_rule in [options.flow_rule] if options.flow_rule else FLOW_RULES:
        for family in [options.only] if options.only else FAMILIES:
            measure(family, flow_rule, sides, options.limit, budget)


if __name__ == "__main__":
    main(sys.argv[1:])
