import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.listing.answers import answer_columns
from mbla.results.listing.listing import listing, verification_lines
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.verdict_words import uniqueness_words
from mbla.results.record.quantity import CLAIMED, COURSE, TIMES, VERSIONS, WORDS
from mbla.results.records.json_record import results_json
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.results.synthetic import full_results, tower_results

RESULTS = tower_results()
MODEL, FIRST = RESULTS.model, RESULTS.cases[0]


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


@pytest.fixture(scope="module")
def text(results: Results) -> str:
    return listing(results)


def section(text: str, title: str) -> str:
    """Lines below a heading up to the next one."""
    match = re.search(
        rf"^{re.escape(title)}\n-+\n(.*?)(?=\n\n[^\n ][^\n]*\n-+\n|\Z)", text, flags=re.MULTILINE | re.DOTALL
    )
    assert match, title
    return match[1]


def test_reactions_balance_in_print(text: str) -> None:
    rows = {line[:26].strip(): line[26:].split() for line in section(text, "Load case push_x").splitlines()}
    assert rows["base[0]"][:3] == ["-5", "0", "10"]
    assert rows["sum of reactions"][:3] == ["-10", "0", "20"]
    assert rows["out of balance"] == ["0"] * 6


def with_case(results: Results, **changes: Any) -> Results:
    """Results whose first case has another status, solution or checks."""
    first = results.cases[0]
    solution = replace(first.solution, **changes.pop("solution", {}))
    checks = replace(first.checks, **changes.pop("checks", {}))
    return replace(results, cases=(replace(first, solution=solution, checks=checks, **changes),))


def test_no_status_but_solved_reads_as_a_plain_collapse(results: Results) -> None:
    for status in set(Status) - {Status.SOLVED}:
        assert "0.5 g, verified" not in listing(with_case(results, status=status))


def test_a_fall_is_told_as_any_other_failure(results: Results) -> None:
    """The tower turns about its edge, pushed by nothing but its weight: by no load, and with no work known."""
    certificate = np.zeros((3, 6))
    certificate[1] = results.cases[0].solution.mechanics.mechanism[1]  # type: ignore[union-attr]
    case = results.cases[1]
    changed = replace(case, solution=replace(case.solution, certificate=certificate))
    found = section(listing(replace(results, cases=(changed,))), "Load case fall")
    assert "The mechanism is partial: 1 of 2 free blocks" in found or "The mechanism is global" in found
    assert "over base[0], on a hinge from (1, 0, 1) to (1, 1, 1)." in " ".join(found.split())
    assert "with the load" not in found
    assert "Nothing slides." in found
    assert "nan" not in found


def test_verification_names_what_differs(results: Results) -> None:
    assert "agrees" in verification_lines(results, ())[-1]
    lines = verification_lines(results, ("push_x: static bound is 1 recomputed, the file says 2",))
    assert "differs: push_x: static bound is 1" in lines[-1]
    text = " ".join(" ".join(lines).split())
    assert f"not verified, but as the run told it: {VERSIONS}; {TIMES}; {CLAIMED}; {COURSE}; {WORDS}" in text


def test_the_associative_factor_is_unique_without_words() -> None:
    assert uniqueness_words(MODEL, tower_results("associative").cases[0]) == ""


def test_the_table_has_the_least_and_the_greatest_where_a_case_has_several() -> None:
    ranged = with_case(RESULTS, checks={"lower": 0.45, "upper": 0.52}).cases[0]
    heads, rows = answer_columns(MODEL, [FIRST, ranged, RESULTS.cases[1]])
    assert heads == ["load factor", "least found", "greatest found", "associative"]
    assert [row[:3] for row in rows] == [["0.5", "0.5", "0.5"], ["0.5", "0.45", "0.52"], ["-", "-", "-"]]
    assert answer_columns(MODEL, [FIRST])[0] == ["load factor", "associative"]
    table = summary_lines(replace(RESULTS, cases=(ranged,)))
    assert table[1].split() == ["load", "case", "status", *" ".join(heads).split()]
    assert table[2].split()[2:5] == ["0.5", "0.45", "0.52"]


def test_everything_reads_the_same_from_the_file(tmp_path: Path) -> None:
    results = full_results()
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(results))
    back = read_results_hdf5(path)
    assert listing(back) == listing(results)
    assert results_json(back) == results_json(results)
