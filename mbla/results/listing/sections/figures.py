"""The figures of a case, one to a line: load factors, bounds, residuals, and how it was solved: programs, path."""

from __future__ import annotations

import numpy as np

from mbla.arrays import evenly
from mbla.model.model import Model
from mbla.results.listing.answers import (
    answer_facts,
    answer_figure,
    digits,
    status_name,
)
from mbla.results.listing.blocks import MOST_ROWS, Block, Fact, Paragraph, facts, table_of
from mbla.results.listing.places import block_words
from mbla.results.listing.text import counted, number, small
from mbla.results.listing.verdict_words import load_factor_words
from mbla.results.outcome import (
    FALLEN,
    RESIDUALS,
    associative_of,
    best_iterate,
    distinct,
    falls_while_moving,
    least_of,
    locked_in,
    result_of,
)
from mbla.results.results import CaseResult
from mbla.solution.flow.path_record import Stop
from mbla.solution.solution import Mechanics, ModelSize, Solution, Status
from mbla.solution.verification.verify_points import tolerances


def figures(model: Model, case: CaseResult) -> list[Fact]:
    """Load factors by both flow rules, bounds, size of the program, verdict of the verification."""
    question = case.load_case.question
    rows = [Fact("status", status_name(case.status))]
    rows += (answer_facts(model, case) if question.entries_first else []) + _factors(model, case) + _bounds(case)
    rows += _standing(model, case)
    if case.solution.size is not None:
        rows.append(Fact("solved as", size_words(case.solution.size, cells=bool(model.soils))))
    return [*rows, *solver_facts(case.solution), _verification(case)]


def figure_blocks(model: Model, case: CaseResult) -> list[Block]:
    """All of that, and the residuals."""
    head = ["residual", "relative to", "value", "at most", ""]
    return [*facts(figures(model, case)), *table_of(head, residual_rows(case), left=2)]


def _factors(model: Model, case: CaseResult) -> list[Fact]:
    """The factor by the deck's flow rule with all that surrounds it, then the associative one."""
    solution = case.solution
    own, best, associative = result_of(case), best_iterate(case), associative_of(case)
    rule = solution.flow_rule
    rows = [Fact("scheme", solution.scheme)] if solution.scheme else []
    if own is not None:
        rows.append(Fact(f"load factor, {rule}", number(own.load_factor)))
    if best is not None:
        rows.append(Fact(f"best iterate, {rule}", f"{number(best.load_factor)}   (no load factor)"))
    question = case.load_case.question
    rows += [] if question.entries_first else answer_facts(model, case)
    if not np.isnan(least_of(case)):
        head = f"{question.head(model.units)}, least found"
        rows.append(Fact(head, answer_figure(case.load_case, least_of(case))))
    if associative is not None and solution.flow_rule != "associative":
        rows.append(Fact("load factor, associative", _beside(associative, own)))
    return rows


def _bounds(case: CaseResult) -> list[Fact]:
    checks = case.checks
    if np.isnan(checks.static_bound) and np.isnan(checks.kinematic_bound):
        return []
    bounds = {"static": checks.static_bound, "kinematic": checks.kinematic_bound}
    return [Fact(f"associative, {name} bound", digits(value)) for name, value in bounds.items()]


def _beside(associative: Mechanics, own: Mechanics | None) -> str:
    text = number(associative.load_factor)
    if own is None or associative.load_factor == 0:
        return text
    difference = round(100 * (own.load_factor / associative.load_factor - 1), 2) + 0.0
    return f"{text}   (the one above differs by {difference:+.2f} %)" if difference else text


def residual_rows(case: CaseResult) -> list[list[str]]:
    """Every residual that there is, what it is relative to, what it may be at most, and whether it is."""
    checks, allowed = case.checks, tolerances(case.solution.flow_rule)
    found = {name: (getattr(checks, name), measure) for name, measure in RESIDUALS.items()}
    found["live_power"] = abs(checks.live_power - 1.0), "from 1"
    found["gap"] = checks.gap, "of the associative load factor"
    rows = []
    for name, (value, measure) in found.items():
        if not np.isnan(value):
            most = allowed.get(name, np.nan)
            verdict = "" if np.isnan(most) else "passed" if value <= most else "NOT PASSED"
            title = "relative gap" if name == "gap" else name.replace("_", " ")
            rows.append([title, measure, small(value), number(most), verdict])
    return rows


def _standing(model: Model, case: CaseResult) -> list[Fact]:
    """Whether it stands before any live load, and the block that falls."""
    standing = case.solution.standing
    if standing is None:
        return []
    block = "" if standing.block is None else f": {block_words(model, standing.block)} would fall first"
    locked = locked_in(case) and case.solution.mechanics is not None
    warning = "WARNING: the load factor presumes a self-stressed state; it is no collapse load" * locked
    notes = (standing.reason, warning)
    return [Fact("stands under dead load", f"{standing.verdict.value}{block}", tuple(filter(None, notes)))]


def size_words(size: ModelSize, *, cells: bool = False) -> str:
    """What reached the solver; cells of soil are counted with the blocks where there are any."""
    words = ["planar" if size.dimension == 2 else "spatial"]
    dropped = f" ({size.dropped_points} more left out)" if size.dropped_points else ""
    bodies = f"{size.free_blocks} free blocks and cells" if cells else counted(size.free_blocks, "free block")
    words += [bodies, counted(size.contact_points, "contact point") + dropped]
    if size.mirror_planes:
        words.append(f"{counted(size.mirror_planes, 'mirror plane')} used")
    if size.parts > 1:
        words.append(f"{size.parts} independent parts")
    return ", ".join(words)


def _verification(case: CaseResult) -> Fact:
    """``passed`` for an answer; for a case that has none only that its status is confirmed."""
    if not case.checks.verified:
        failures = (text for text in case.checks.failures if text != case.solution.reason)
        return Fact("verification", "NOT PASSED", tuple(failures))
    if case.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        return Fact("verification", f"confirmed: {status_name(case.status)}")
    if case.solution.mechanics is None:
        return Fact("verification", "nothing contradicts the status")
    return Fact("verification", "passed: everything recomputed from model, contacts and solution")


def solver_facts(solution: Solution) -> list[Fact]:
    """Who solved the cone programs, and what factorised for them."""
    used = [[program.solver, program.factorization] for program in solution.programs if program.solver]
    names = distinct(f"{solver} ({library})" if library else solver for solver, library in used)
    return [Fact("solver", ", ".join(names))] if names else []


# --- The programs of a solution as a table, and what each was for ---------------------------------------------------


def program_blocks(solution: Solution) -> list[Block]:
    """What each program gave."""
    programs = solution.programs
    if not programs:
        return []
    total = sum(program.iterations for program in programs)
    rows = [
        [
            str(program.program),
            program.kind,
            status_name(program.status),
            number(program.load_factor),
            small(program.change),
            str(program.iterations),
            f"{program.seconds:.3f}",
        ]
        for program in programs
    ]
    says = f"{counted(len(programs), 'program')}, {counted(total, 'iteration')}, {solution.seconds:.3f} s"
    head = ["program", "for", "status", "load factor", "change", "iterations", "seconds"]
    reverse = "The program with the live load reversed shows whether the dead load alone is carried."
    reversed_too = any(program.kind == "reverse" for program in programs)
    blocks = table_of(head, rows[:MOST_ROWS], left=3, caption=says, total=len(rows))
    return blocks + ([Paragraph(reverse)] if reversed_too else [])


# --- The path of elastic joints in words ----------------------------------------------------------------------------


ENDS = {
    Stop.FALLS: "from there it falls, to {}",
    Stop.FLAT: "there it stays",
    Stop.FAR: "it ends at one of {1:.3g}",
}
"""why a path with an answer ended, with the load factor there and the displacement"""


ROW_OFF = 1e-3
"""share by which the row of the greatest load lies off the load factor, from which that is explained"""


def path_blocks(model: Model, case: CaseResult) -> list[Block]:
    """Greatest load and end of the path, and a table of the steps that matter; nothing where no path was followed."""
    solution = case.solution
    path = solution.path
    if not path:
        return []
    top = max(range(len(path)), key=lambda row: (path[row].balanced, path[row].load_factor))
    peak, own = path[top], result_of(case)
    reached = peak.load_factor if own is None else own.load_factor  # a step of the path, and that step as it was solved
    highest, ended = (load_factor_words(model, case.load_case, value) for value in (reached, solution.path_last))
    breaks = peak.load_factor < reached - FALLEN * abs(reached)
    where = "within a step, in which a tie breaks" if breaks else f"at a displacement of {peak.displacement:.3g}"
    says = f"Path of elastic joints, {counted(len(path), 'step')}: it rises to {highest} {where}"
    says += " (displacements are over the elastic one of the structure at its associative load factor)"
    stop = Stop.FALLS if falls_while_moving(case) else solution.path_end
    end = next((words for ended_by, words in ENDS.items() if ended_by == stop), "it was followed no further")
    says += f"; {end.format(ended, path[-1].displacement)}."
    if stop == Stop.FAR:
        says += f" Of the load factor {100.0 * solution.path_gain:.2g} % were gained over its last half."
    shown = [path[row] for row in sorted({*evenly(len(path), MOST_ROWS - 1), top})]
    rows = [
        [
            str(point.step),
            f"{point.displacement:.4g}",
            number(point.load_factor) + ("" if point.balanced else " *"),
            str(point.open),
            str(point.slide),
        ]
        for point in shown
    ]
    if not breaks and abs(peak.load_factor - reached) > ROW_OFF * abs(reached):
        says += f" Rows are of steps on the way, smoothed; step {peak.step} solved until the law of its joints holds, "
        says += f"or one next to it, carries {highest}."
    head = ["step", "displacement", "load factor", "points open", "sliding"]
    rough = [] if all(point.balanced for point in shown) else [Paragraph("*: on the way, not in balance")]
    return [Paragraph(says), *table_of(head, rows, total=len(path)), *rough]
