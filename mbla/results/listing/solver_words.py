"""Which solvers took the programs of a case: by name for the JSON record, in one line for the listing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from mbla.results.listing.text import entry
from mbla.solution.solution import ProgramRecord, Solution

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
