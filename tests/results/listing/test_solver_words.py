"""Who solved the programs of a case is said by name in the record and in one line of the listing."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import pytest

from mbla.deck.sections.analysis import AnalysisSection
from mbla.results.listing.listing import listing
from mbla.results.listing.solving import METHODS, solver_json, solver_lines, solver_words
from mbla.results.records.json_record import results_json
from mbla.results.results import Results
from mbla.solution.solution import ProgramRecord
from tests.results.synthetic import tower_results

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


def test_every_solver_of_a_deck_has_its_words() -> None:
    assert {"auto", *METHODS} == set(get_args(AnalysisSection.model_fields["solver"].annotation))


@pytest.mark.parametrize(
    ("solver", "factorization", "words"),
    [
        ("mbla", "cholmod", "mbla (condensed interior point, cholmod)"),
        ("clarabel", "mkl", "clarabel (interior point, mkl)"),
        ("highs", "", "HiGHS (interior point and crossover)"),
        ("", "", ""),
    ],
)
def test_one_program_in_words(solver: str, factorization: str, words: str) -> None:
    assert solver_words(taken(("associative", solver, factorization))[0]) == words


def test_each_name_once_in_the_order_of_the_programs() -> None:
    programs = taken(
        ("associative", "mbla", "cholmod"),
        ("reverse", "clarabel", "qdldl"),
        ("exact step", "", ""),
        ("second opinion", "highs", ""),
        ("range, lower", "mbla", "qdldl"),
    )
    assert solver_json(replace(FIRST, solver="auto", programs=programs)) == {
        "asked": "auto",
        "used": ["mbla", "clarabel", "highs"],
        "factorization": ["cholmod", "qdldl"],
    }
    assert " ".join(" ".join(solver_lines(replace(FIRST, programs=programs))).split()) == (
        "solver mbla (condensed interior point, cholmod) other programs clarabel (interior point, qdldl), "
        "HiGHS (interior point and crossover), mbla (condensed interior point, qdldl)"
    )


def test_the_listing_says_it_in_one_line_where_one_solver_took_all() -> None:
    lines = listing(
        with_programs(("associative", "mbla", "qdldl"), ("reverse", "mbla", "qdldl"), ("exact step", "", ""))
    ).splitlines()
    assert [line for line in lines if "condensed interior point" in line] == [
        line for line in lines if line.split() == ["solver", "mbla", "(condensed", "interior", "point,", "qdldl)"]
    ]
    assert not any("other programs" in line for line in lines)


def test_a_case_without_cone_programs_has_no_solver() -> None:
    results = with_programs(("exact step", "", ""))
    assert solver_lines(results.cases[0].solution) == []
    assert results_json(results)["cases"][0]["solver"] == {"asked": "auto", "used": [], "factorization": []}
