"""The programs of a solution as a table, and what each was for."""

from __future__ import annotations

from mbla.results.listing.answer_words import status_name
from mbla.results.listing.text import counted, number, sentence, small, table
from mbla.solution.solution import Solution

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
    "second opinion": "second solver",
    "convex": "interface resultants",
    "least forces": "least forces",
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
