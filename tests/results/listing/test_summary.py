import re
from dataclasses import replace

import numpy as np
import pytest

from mbla.errors import Message, Notice
from mbla.model.model import Settlement, Tilt
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import WIDTH
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def summary(results: Results) -> str:
    """The lines of the summary with runs of spaces as one."""
    lines = summary_lines(results)
    assert max(map(len, lines)) <= WIDTH
    return " ".join(" ".join(lines).split())


def test_warnings_but_no_notices(results: Results) -> None:
    text = summary(results)
    assert "near-miss" in text
    assert "faces-turned-outwards" not in text


def test_associative_flow_needs_no_second_column(results: Results) -> None:
    cases = tuple(replace(case, solution=replace(case.solution, flow_rule="associative")) for case in results.cases)
    assert summary_lines(replace(results, cases=cases))[1].split() == ["load", "case", "status", "load", "factor"]


@pytest.mark.parametrize("status", [Status.NOT_VERIFIED, Status.TIME_LIMIT, Status.ITERATION_LIMIT])
def test_a_value_that_is_no_result_is_not_in_the_table(results: Results, status: Status) -> None:
    first = results.cases[0]
    checks = replace(first.checks, kinematic_bound=0.4, failures=(Message("yield-violation", "residual 0.1"),))
    unsure = replace(results, cases=(replace(first, status=status, checks=checks),))
    assert re.search(r"[A-Z ]+ +- +0\.5$", summary_lines(unsure)[2])
    text = summary(unsure)
    assert "no load factor; the best iterate, 0.5 g" in text
    assert "no more than 0.4 g" in text
    assert "hinge" not in text


def test_no_bound_is_claimed_where_there_is_none(results: Results) -> None:
    first = results.cases[0]
    checks = replace(first.checks, kinematic_bound=np.nan)
    unsure = replace(first, status=Status.NOT_VERIFIED, checks=checks)
    assert "no more than" not in summary(replace(results, cases=(unsure,)))


def test_a_reason_that_is_also_a_failure_stands_once(results: Results) -> None:
    first = results.cases[0]
    changed = replace(
        first,
        status=Status.TIME_LIMIT,
        solution=replace(first.solution, mechanics=None, reason="the time limit was reached"),
        checks=replace(first.checks, failures=(Message("time-limit", "the time limit was reached"),)),
    )
    assert summary(replace(results, cases=(changed,))).count("the time limit was reached") == 1


def with_answers(results: Results, tangent: bool = True, factor: float = 0.5) -> Results:
    """The tower pushed, settling (reaction 30 - 20 x factor) and on a tilting table."""
    case = results.cases[0]
    assert case.solution.mechanics is not None
    solution = replace(case.solution, mechanics=replace(case.solution.mechanics, load_factor=factor))
    settlement = Settlement(np.array([0]), np.array([[0.0, 0, -1, 0, 0, 0]]), False, "sinks", 30.0, 20.0)
    nothing = np.zeros((3, 6))
    tilt = Tilt(np.array([0.0, 1.0, 0.0]), nothing, nothing, nothing, 12.5, tangent, np.inf)
    settling = replace(case.load_case, name="sinks", settlement=settlement)
    tilted = replace(case.load_case, name="tilted", tilt=tilt)
    cases = tuple(replace(case, load_case=each, solution=solution) for each in (settling, tilted))
    return replace(results, cases=(case, *cases))


def test_what_the_load_factor_stands_for_is_shown_in_its_place(results: Results) -> None:
    head, *rows = (line.split("  ") for line in summary_lines(with_answers(results))[1:5])
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
    tilted = with_answers(results, tangent=False, factor=factor)
    lines = summary_lines(replace(tilted, cases=tilted.cases[2:]))
    assert lines[1].split() == ["load", "case", "status", "angle", "[degree]", "associative"]
    assert lines[2].split() == ["tilted", "solved", angle, "-"]


def test_a_result_without_cases_has_its_model_alone(results: Results) -> None:
    lines = summary_lines(replace(results, cases=(), notices=()))
    assert lines == ["tower.yaml: 3 blocks, 2 interfaces, 8 contact points, weight 65 N"]


def test_what_a_fall_may_come_from_is_told_before_it() -> None:
    """A contact that is missed explains a lack of equilibrium, and is a remark like others where there is none."""
    results = tower_results()
    missed = replace(results, notices=(Notice("warning", "near-misses", "1 pair of bodies nearly touch"),))
    for cases, first in ((results.cases, True), (results.cases[:1], False)):
        lines = summary_lines(replace(missed, cases=cases))
        at = [line.startswith("  warning [near-misses]") for line in lines].index(True)
        assert (at == 1) is first
        assert sum("[near-misses]" in line for line in lines) == 1
