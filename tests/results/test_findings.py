"""What solver and verification say, as notices."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.errors import Message, Notice
from mbla.results.findings import found_notices
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.outcome import notices_of
from mbla.results.record.json_record import results_json
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from tests.results.synthetic import full_results, standing_at, tower_results


def push() -> CaseResult:
    return tower_results().cases[0]


def identifiers(case: CaseResult) -> list[str]:
    return [notice.identifier for notice in found_notices(case)]


def test_a_clean_case_has_none() -> None:
    assert found_notices(push()) == ()


@pytest.mark.parametrize("status", [status for status in Status if status is not Status.SOLVED])
def test_every_other_status_is_a_warning_with_its_reason(status: Status) -> None:
    case = replace(push(), status=status)
    (notice,) = found_notices(case)
    assert (notice.severity, notice.identifier, notice.case) == ("warning", status.value.replace("_", "-"), "push_x")
    assert len(notice.message) > len("push_x: ")
    said = replace(case, solution=replace(case.solution, reason="it rains"))
    assert found_notices(said)[0].message == "push_x: it rains"


def test_failures_and_remarks() -> None:
    case = push()
    failures = (Message("equilibrium-residual", "0.1"), Message("bounds-apart", "1 and 2"))
    remarks = (Message("load-factor-not-unique", "others"), Message("range-not-found", "no end"))
    case = replace(
        case, checks=replace(case.checks, failures=failures), solution=replace(case.solution, remarks=remarks)
    )
    assert identifiers(case) == [
        "equilibrium-residual",
        "bounds-apart",
        "load-factor-not-unique",
        "range-not-found",
    ]
    assert [notice.severity for notice in found_notices(case)] == ["warning", "warning", "notice", "warning"]


def test_a_failure_that_is_the_reason_is_told_once() -> None:
    case = replace(push(), status=Status.NOT_VERIFIED)
    reason = "the correction ended without a solution"
    case = replace(
        case,
        solution=replace(case.solution, reason=reason),
        checks=replace(case.checks, failures=(Message("not-verified", reason),)),
    )
    assert identifiers(case) == ["not-verified"]


def test_what_is_claimed_but_not_verified() -> None:
    case = full_results().cases[0]
    assert {"range-not-verified", "peak-not-verified"}.isdisjoint(identifiers(case))
    assert "tries-disagree" in identifiers(case)
    nan = float("nan")
    doubtful = replace(case, checks=replace(case.checks, lower=nan, upper=nan, peak_load_factor=nan))
    found = identifiers(doubtful)
    assert found.count("range-not-verified") == 2
    assert found.count("peak-not-verified") == 1


def test_harmless_positions_of_a_travelling_load_are_no_warnings() -> None:
    results = tower_results()
    position = standing_at(1, 2, results.model.blocks.centroids[1], 0.0)
    cases = tuple(replace(push(), load_case=replace(push().load_case, travel=position)) for _ in range(2))
    locked = replace(cases[0], status=Status.UNBOUNDED)

    def severities(*chosen: CaseResult) -> list[str]:
        found = notices_of(replace(results, notices=(), cases=chosen))
        return [notice.severity for notice in found if notice.identifier == "unbounded"]

    assert severities(locked, cases[1]) == ["notice"]
    assert severities(locked, locked) == ["warning", "warning"]


def test_warnings_end_the_listing_numbered_and_the_summary_names_them() -> None:
    results = tower_results()
    case = replace(push(), status=Status.APPROXIMATE)
    results = replace(results, cases=(case,), notices=(Notice("warning", "near-misses", "two blocks nearly touch"),))
    end = listing(results).split("Summary\n")[1]
    assert "2 warnings:" in end
    assert "1. warning [near-misses]: two blocks nearly touch" in end
    assert "2. warning [approximate]: push_x: verification confirms" in end
    assert "`mbla explain ID`" in end
    lines = summary_lines(results)
    assert lines[-1] == "  2 warnings: near-misses, approximate; mbla explain ID says more"
    assert "  warning [near-misses]: two blocks nearly touch" in lines
    without = replace(results, cases=(push(),), notices=())
    assert "mbla explain" not in listing(without)
    assert "0 warnings" in listing(without)
    assert not any("warning" in line for line in summary_lines(without))


def test_json_names_the_case() -> None:
    results = tower_results()
    notices = results_json(results)["notices"]
    assert [set(notice) for notice in notices[:2]] == [{"severity", "identifier", "message"}] * 2
    assert (notices[-1]["identifier"], notices[-1]["case"]) == ("no-equilibrium", "fall")


def test_what_is_said_twice_is_one_notice() -> None:
    """Two failures in the same words; a remark that is the reason of a case without an answer."""
    case = replace(push(), checks=replace(push().checks, failures=(Message("penetration", "it leaks"),) * 2))
    assert len(found_notices(case)) == 1
    solution = replace(
        push().solution,
        reason="it rains",
        remarks=(Message("law-missed", "it rains"), Message("law-missed", "it snows")),
    )
    stopped = replace(push(), status=Status.NOT_VERIFIED, solution=solution)
    assert [notice.message for notice in found_notices(stopped)] == ["push_x: it rains", "push_x: it snows"]
    solved = replace(push(), solution=solution)
    assert [notice.message for notice in found_notices(solved)] == ["push_x: it rains", "push_x: it snows"]
