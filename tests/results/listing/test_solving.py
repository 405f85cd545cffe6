"""How a case was solved: solver, programs, reductions, path of elastic joints."""

from __future__ import annotations

from dataclasses import replace

from mbla.program.reductions import ReductionOutcome, ReductionStep
from mbla.program.reductions.steps import REDUCTIONS
from mbla.results.listing.blocks import MOST_ROWS, Fact
from mbla.results.listing.sections.figures import (
    path_blocks,
    program_blocks,
    solver_facts,
)
from mbla.results.listing.sections.model_words import FOUND, reduction_facts
from mbla.results.listing.text import lines_of
from mbla.results.record.json_record import results_json
from mbla.results.results import Results
from mbla.solution.solution import PathPoint, ProgramRecord
from tests.results.synthetic import STEP, tower_model, tower_results

FIRST = tower_results().cases[0].solution


def taken(*programs: tuple[str, str, str]) -> tuple[ProgramRecord, ...]:
    """Programs of that kind, solver and factorisation."""
    return tuple(
        replace(FIRST.programs[0], program=number, kind=kind, solver=solver, factorization=factorization)
        for number, (kind, solver, factorization) in enumerate(programs, 1)
    )


def with_programs(*programs: tuple[str, str, str]) -> Results:
    results = tower_results()
    case = replace(results.cases[0], solution=replace(FIRST, programs=taken(*programs)))
    return replace(results, cases=(case,))


def test_each_name_once_in_the_order_of_the_programs() -> None:
    results = with_programs(
        ("associative", "mbla", "cholmod"),
        ("reverse", "clarabel", "qdldl"),
        ("exact step", "", ""),
        ("flow programs", "mbla", "qdldl"),
    )
    assert results_json(results)["cases"][0]["solver"] == {
        "asked": "auto",
        "used": ["mbla", "clarabel"],
        "factorization": ["cholmod", "qdldl"],
    }
    said = [Fact("solver", "mbla (cholmod), clarabel (qdldl), mbla (qdldl)")]
    assert solver_facts(results.cases[0].solution) == said


def test_a_case_without_cone_programs_has_no_solver() -> None:
    results = with_programs(("exact step", "", ""))
    assert solver_facts(results.cases[0].solution) == []
    assert results_json(results)["cases"][0]["solver"] == {"asked": "auto", "used": [], "factorization": []}


def test_a_long_sequence_says_what_is_left_out() -> None:
    assert program_blocks(replace(FIRST, programs=())) == []
    programs = tuple(replace(FIRST.programs[1], program=i + 1) for i in range(MOST_ROWS + 7))
    lines = lines_of(program_blocks(replace(FIRST, programs=programs)))
    assert f"{MOST_ROWS + 7} programs" in lines[0]
    assert sum(line.split()[0].isdigit() for line in lines[2:]) == MOST_ROWS
    assert "and 7 more" in lines[-1]


# ---  ---------------------------------------------------------------------------------------------------------------


def test_every_reduction_has_its_words() -> None:
    assert set(FOUND) == {"glued", *REDUCTIONS}


def test_a_line_says_what_was_found_and_what_is_left() -> None:
    off = ReductionStep("mirror", ReductionOutcome.OFF, 0, STEP.after, STEP.after)
    words = "2 parts solved apart; 12 of 12 velocities left, 8 cones"
    assert reduction_facts((STEP, off)) == [Fact("reduction, parts", words)]


# ---  ---------------------------------------------------------------------------------------------------------------


MODEL = tower_model()
CASE = tower_results().cases[0]


def lines_of_path(*path: PathPoint) -> list[str]:
    return lines_of(path_blocks(MODEL, replace(CASE, solution=replace(CASE.solution, path=path))))


def test_a_long_path_is_thinned_but_keeps_its_greatest_load_and_ends() -> None:
    factors = [0.001 * i for i in range(300)]
    factors[150] = 1.0
    lines = lines_of_path(*(PathPoint(i, 0.1 * i, factor, i, 0, balanced=True) for i, factor in enumerate(factors)))
    rows = [line.split()[0] for line in lines if line.split() and line.split()[0].isdigit()]
    assert len(rows) == MOST_ROWS
    assert {"0", "150", "299"} <= set(rows)
    assert "and 280 more" in lines[-1]
