"""The listing and the summary: figures, tables and structure; their sentences are in ``texts.txt``."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mbla
from mbla.questions.angle import Angle
from mbla.questions.reaction import Reaction, Settlement
from mbla.questions.tilt import Tilt
from mbla.results.listing.answers import answer_columns
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import WIDTH
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.line import BLOCK
from tests.results.synthetic import tower_results

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


def with_case(results: Results, **changes: Any) -> Results:
    """Results whose first case has another status, solution or checks."""
    first = results.cases[0]
    solution = replace(first.solution, **changes.pop("solution", {}))
    checks = replace(first.checks, **changes.pop("checks", {}))
    return replace(results, cases=(replace(first, solution=solution, checks=checks, **changes),))


def test_no_status_but_solved_reads_as_a_plain_collapse(results: Results) -> None:
    for status in set(Status) - {Status.SOLVED}:
        assert "0.5 g, verified" not in listing(with_case(results, status=status))


def test_the_table_has_the_least_where_a_search_found_one() -> None:
    searched = with_case(RESULTS, checks={"least_load_factor": 0.45}).cases[0]
    heads, rows = answer_columns(MODEL, [FIRST, searched, RESULTS.cases[1]])
    assert heads == ["load factor", "least found", "associative"]
    assert [row[:2] for row in rows] == [["0.5", "-"], ["0.5", "0.45"], ["-", "-"]]
    assert answer_columns(MODEL, [FIRST])[0] == ["load factor", "associative"]
    table = summary_lines(replace(RESULTS, cases=(searched,)))
    assert table[1].split() == ["load", "case", "status", *" ".join(heads).split()]
    assert table[2].split()[2:4] == ["0.5", "0.45"]


# ---  ---------------------------------------------------------------------------------------------------------------


def summary(results: Results) -> str:
    """The lines of the summary with runs of spaces as one."""
    lines = summary_lines(results)
    assert max(map(len, lines)) <= WIDTH
    return " ".join(" ".join(lines).split())


def with_further_results(results: Results, tangent: bool = True, factor: float = 0.5) -> Results:
    """The tower pushed, settling (reaction 30 - 20 x factor) and on a tilting table."""
    case = results.cases[0]
    assert case.solution.mechanics is not None
    solution = replace(case.solution, mechanics=replace(case.solution.mechanics, load_factor=factor))
    settlement = Settlement(np.array([0]), np.array([[0.0, 0, -1, 0, 0, 0]]), False, "sinks", 30.0, 20.0)
    nothing = np.zeros((3, 6))
    tilt = Tilt(np.array([0.0, 1.0, 0.0]), nothing, nothing, nothing, 12.5, tangent, np.inf)
    settling = replace(case.load_case, name="sinks", question=Reaction(settlement))
    tilted = replace(case.load_case, name="tilted", question=Angle(tilt))
    cases = tuple(replace(case, load_case=each, solution=solution) for each in (settling, tilted))
    return replace(results, cases=(case, *cases))


def test_what_the_load_factor_stands_for_is_shown_in_its_place(results: Results) -> None:
    head, *rows = (line.split("  ") for line in summary_lines(with_further_results(results))[1:5])
    columns = [word.strip() for word in head if word.strip()]
    assert columns == ["load case", "status", "load factor", "reaction [N]", "angle [degree]", "associative"]
    shown = [[word.strip() for word in row if word.strip()] for row in rows]
    assert shown == [
        ["push_x", "solved", "0.5", "0.5"],
        ["sinks", "solved", "20", "20"],
        ["tilted", "solved", "26.5651", "26.5651"],
    ]


@pytest.mark.parametrize(("factor", "angle"), [(1.0, "12.5"), (0.7, "-")])
def test_angle_of_a_table_whose_load_factor_is_no_tangent(results: Results, factor: float, angle: str) -> None:
    tilted = with_further_results(results, tangent=False, factor=factor)
    lines = summary_lines(replace(tilted, cases=tilted.cases[2:]))
    assert lines[1].split() == ["load", "case", "status", "angle", "[degree]", "associative"]
    assert lines[2].split() == ["tilted", "solved", angle, "-"]


def test_in_space_a_least_is_found_where_the_deck_says_how_far_to_search() -> None:
    """A block pushed aslant, of which nothing lower is looked for unless asked."""
    live: list[dict[str, Any]] = [{"acceleration": [1, 0.3, 0]}]
    changes: dict[str, object] = {"analysis.flow_rule": "non_associative", "load_cases.push.live": live}
    plain, searched = (mbla.run(BLOCK, set=changes | more).summary for more in ({}, {"analysis.search": 1}))
    assert "least found" not in plain
    assert "least found: " in searched
