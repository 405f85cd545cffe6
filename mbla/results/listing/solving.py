"""How a case was solved, in words: solver, programs, reductions, load path."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from mbla.model.model import Model
from mbla.results.listing.answers import status_name
from mbla.results.listing.text import MOST_ROWS, counted, entry, number, sentence, small, table
from mbla.results.listing.verdict_words import load_factor_words
from mbla.results.results import CaseResult
from mbla.solution.solution import PathPoint, ProgramRecord, Solution

METHODS = {
    "mbla": ("mbla", "condensed interior point"),
    "clarabel": ("clarabel", "interior point"),
    "highs": ("HiGHS", "interior point and crossover"),
}
"""How a solver writes its name, and its method, by its key in a deck."""

FIRST = "associative"
"""Kind of the program that every flow rule begins with."""


def solver_json(solution: Solution) -> dict[str, Any]:
    """The solver asked for, those that took the cone programs, and the libraries that factorised for them."""
    return {
        "asked": solution.solver or None,
        "used": _distinct(program.solver for program in solution.programs),
        "factorization": _distinct(program.factorization for program in solution.programs),
    }


def solver_lines(solution: Solution) -> list[str]:
    """Who solved the associative program, and who others where that is not the same."""
    first = _distinct(solver_words(program) for program in solution.programs if program.kind == FIRST)
    others = [words for words in _distinct(map(solver_words, solution.programs)) if words not in first]
    lines = entry("solver", ", ".join(first)) if first else []
    return lines + (entry("other programs", ", ".join(others)) if others else [])


def solver_words(program: ProgramRecord) -> str:
    """Solver, method and factorisation of a program, ``mbla (condensed interior point, qdldl)``; empty without one."""
    if not program.solver:
        return ""
    name, method = METHODS[program.solver]
    return f"{name} ({', '.join(part for part in (method, program.factorization) if part)})"


def _distinct(names: Iterable[str]) -> list[str]:
    """Each once, in the order of their first appearance, none empty."""
    return [name for name in dict.fromkeys(names) if name]


# --- The programs of a solution as a table, and what each was for ---------------------------------------------------


PURPOSES = {
    "associative": "associative",
    "reverse": "reversed live load",
    "published": "reduced dilatancy",
    "gravity": "dead load alone",
    "proximal": "step without dilatancy",
    "exact law": "exact joint law",
    "exact step": "step of the exact law",
    "convex step": "step with given friction",
    "interior": "path inside the cones",
    "path": "step of the load path",
    "load path": "load path to its peak",
    "dilatancy": "step of the dilatancy",
    "livesley": "corrected mechanism",
    "range, lower": "range, lower end",
    "range, upper": "range, upper end",
    "lower": "search for a lower factor",
    "lowest": "search for a lower factor",
    "polyhedral, inscribed": "inscribed polyhedron",
    "polyhedral, circumscribed": "circumscribed polyhedron",
    "convex": "interface resultants",
    "force range": "range of normal forces",
    "least normal force": "least normal force",
    "greatest normal force": "greatest normal force",
    "standing": "does it stand",
}
"""what a program is for, in words, by its kind"""
MOST_PROGRAMS = 40
"""programs of a table; a long sequence is shown by its beginning and its end"""


def program_lines(solution: Solution) -> list[str]:
    """What each program gave; of a long sequence the first and the last ones."""
    programs = solution.programs
    if not programs:
        return []
    total = sum(program.iterations for program in programs)
    rows = [
        [
            str(program.program),
            PURPOSES.get(program.kind, program.kind),
            status_name(program.status),
            number(program.load_factor),
            small(program.change),
            str(program.iterations),
            f"{program.seconds:.3f}",
        ]
        for program in programs
    ]
    says = f"{counted(len(rows), 'program')}, {counted(total, 'iteration')}, {solution.seconds:.3f} s:"
    if len(rows) > MOST_PROGRAMS:
        left_out = len(rows) - MOST_PROGRAMS
        rows[MOST_PROGRAMS // 2 : -MOST_PROGRAMS // 2] = [["...", f"{left_out} more", "", "", "", "", ""]]
    head = ["program", "for", "status", "load factor", "change", "iterations", "seconds"]
    lines = ["", *sentence(says), *table(head, rows, left=3)]
    if any(program.kind == "reverse" for program in programs):
        lines += sentence("The program with the live load reversed shows whether the dead load alone is carried.")
    return lines


# --- What each reduction left out of a load case, as a table: what is solved after each of them ---------------------


# --- The load path in words -----------------------------------------------------------------------------------------


BELOW_PEAK = 1e-6
"""share by which the last load factor lies below the greatest one where the path is said to have a peak"""


def path_lines(model: Model, case: CaseResult) -> list[str]:
    """Peak and end of the path, and a table of the steps that matter; nothing where no path was followed."""
    path = case.solution.path
    if not path:
        return []
    peak = max(path, key=lambda point: point.load_factor)
    last = path[-1]
    highest, ended = (load_factor_words(model, case.load_case, point.load_factor) for point in (peak, last))
    says = f"Load path of {counted(len(path), 'step')}"
    if peak.load_factor - last.load_factor > BELOW_PEAK * abs(peak.load_factor):
        says += f": its peak, {highest} at step {peak.step}, is a limit point; it ended below, at {ended}."
    else:
        says += f": it rose to {ended}, without a peak before its end."
    shown = _steps_that_matter(path)
    rows = [
        [str(point.step), number(point.load_factor), str(point.open), str(point.slide), small(point.residual)]
        for point in shown
    ]
    lines = ["", *sentence(says), *table(["step", "load factor", "points open", "sliding", "residual"], rows)]
    more = len(path) - len(shown)
    return lines + (sentence(f"and {counted(more, 'step')} more; the result files hold them all") if more else [])


def _steps_that_matter(path: Sequence[PathPoint]) -> list[PathPoint]:
    """First, peak and last step, and those at which modes change, evenly thinned where they are many."""
    peak = max(range(len(path)), key=lambda i: path[i].load_factor)
    changes = [i for i in range(1, len(path)) if (path[i].open, path[i].slide) != (path[i - 1].open, path[i - 1].slide)]
    kept = {0, peak, len(path) - 1}
    room = MOST_ROWS - len(kept)
    others = [i for i in changes if i not in kept]
    if len(others) > room:
        others = [others[i * len(others) // room] for i in range(room)]
    return [path[i] for i in sorted(kept | set(others))]
