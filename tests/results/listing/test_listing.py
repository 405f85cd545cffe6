import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import Message
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.listing.listing import check_listing, listing, verification_lines
from mbla.results.listing.text import WIDTH
from mbla.results.needs import CaseNeeds
from mbla.results.record.quantity import CLAIMED, COURSE, TIMES, VERSIONS, WORDS
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.results.synthetic import tower_mechanics, tower_results


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


def test_width(text: str) -> None:
    assert max(map(len, text.splitlines())) <= WIDTH


def test_listing_is_the_same_from_the_file(tmp_path: Path, results: Results, text: str) -> None:
    path = tmp_path / "tower.h5"
    path.write_bytes(write_results_hdf5(results))
    assert listing(read_results_hdf5(path)) == text


@pytest.mark.parametrize(
    ("title", "words"),
    [
        ("Model", ["3, of them 2 free and 1 fixed", "11.5 m3", "65 N", "unlimited"]),
        ("Supports", ["rigid ground z = 0 with joint law dry", "under 1 block only", "1 block of group base fixed"]),
        ("Loads", ["gravity (0, 0, -9.81) m/s2", "acceleration (1, 0, 0) g"]),
        ("Contacts", ["dry", "total"]),
        ("Remarks", ["notice [faces-turned-outwards]", "warning [near-miss]"]),
        (
            "Load case push_x",
            [
                "Collapses at 0.5 g, verified: 1 hinge; 1 of 2 free blocks moves.",
                "The mechanism is global: 1 of 2 free blocks, 50 % of the weight, moves as one rigid part.",
                "1: tower[0]  turns about +y at (1, 0.5, 1)       1          10",
                "x 0 .. 1, z 1 .. 3 m), turns about +y, its centroid moving",
                "base[0]/tower[0]  1/0    (1, 0, 1)  1           +y     +x",
                "100.0 % goes into the dead load, 0.0 % into friction",
                "2 programs, 23 iterations",
            ],
        ),
        (
            "Load case fall",
            ["No equilibrium", "moves downwards, along -z, without turning.", "1: tower[0]  moves along -z"],
        ),
        ("Summary", ["1 load case of the deck not run", "2 warnings:", "exit status 5"]),
    ],
)
def test_sections(text: str, title: str, words: Any) -> None:
    found = section(text, title)
    for each in words:
        assert each in found or each in " ".join(found.split())


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


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"status": Status.APPROXIMATE, "solution": {"reason": "did not settle"}},
            "collapses at about 0.5 g, approximate",
        ),
        ({"status": Status.APPROXIMATE, "solution": {"reason": "did not settle"}}, "did not settle"),
        (
            {
                "status": Status.NOT_VERIFIED,
                "checks": {"verified": False, "failures": (Message("yield-violation", "residual 0.1"),)},
            },
            "NOT VERIFIED",
        ),
        (
            {
                "status": Status.NOT_VERIFIED,
                "checks": {"verified": False, "failures": (Message("yield-violation", "residual 0.1"),)},
            },
            "residual 0.1",
        ),
        ({"status": Status.UNBOUNDED, "solution": {"mechanics": None, "flow_rule": "associative"}}, "no collapse: no"),
        ({"status": Status.UNBOUNDED, "solution": {"mechanics": None}}, "no collapse: no"),
        (
            {"status": Status.UNBOUNDED, "solution": {"mechanics": None, "flow_rule": "dilatancy"}},
            "undecided for dilatancy flow",
        ),
        (
            {"status": Status.NOT_VERIFIED, "solution": {"mechanics": None, "lock": np.ones((8, 3))}},
            "NOT VERIFIED: that no load brings the structure down could not be confirmed",
        ),
        (
            {"status": Status.NOT_VERIFIED, "solution": {"mechanics": None, "certificate": np.ones((3, 6))}},
            "NOT VERIFIED: the lack of equilibrium could not be confirmed",
        ),
        ({"status": Status.NOT_VERIFIED, "solution": {"mechanics": None}}, "NOT VERIFIED: no load factor."),
        ({"status": Status.UNBOUNDED, "solution": {"mechanics": None, "reason": "locked"}}, "locked"),
        ({"status": Status.TIME_LIMIT, "solution": {"mechanics": None}}, "out of time"),
        (
            {"status": Status.TIME_LIMIT},
            "NOT SOLVED (out of time): no load factor; the best iterate, 0.5 g, is not confirmed",
        ),
        (
            {"status": Status.NOT_VERIFIED, "checks": {"slip_residual": 0.1}},
            "NOT VERIFIED: no load factor; the best iterate, 0.5 g, misses the law by 1.0e-01",
        ),
        ({"status": Status.ITERATION_LIMIT, "solution": {"mechanics": None}}, "out of iterations"),
        ({"status": Status.NUMERICAL_ERROR, "solution": {"mechanics": None}}, "numerical failure"),
    ],
)
def test_every_status_has_its_words(results: Results, changes: dict[str, Any], words: Any) -> None:
    changed = with_case(
        results, **{key: dict(value) if isinstance(value, dict) else value for key, value in changes.items()}
    )
    assert words in listing(changed)


def test_no_status_but_solved_reads_as_a_plain_collapse(results: Results) -> None:
    for status in set(Status) - {Status.SOLVED}:
        assert "0.5 g, verified" not in listing(with_case(results, status=status))


def test_factors_of_both_flow_rules_stand_side_by_side(results: Results) -> None:
    changed = with_case(results, solution={"associative": tower_mechanics(0.625)})
    found = section(listing(changed), "Load case push_x")
    assert re.search(r"load factor, non_associative +0\.5\n", found)
    assert re.search(r"load factor, associative +0\.625   \(the one above differs by -20\.00 %\)", found)


def test_force_as_live_load_is_not_in_g(results: Results) -> None:
    first = results.cases[0]
    case = replace(first, load_case=replace(first.load_case, live_words=("force (1, 0, 0) N on tower[0]",)))
    assert "Collapses at 0.5 times the live load" in listing(replace(results, cases=(case,)))


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


def test_a_value_that_is_no_result_says_so(results: Results) -> None:
    failed = {"verified": False, "failures": (Message("yield-violation", "residual 0.1"),), "kinematic_bound": 0.4}
    found = section(listing(with_case(results, status=Status.NOT_VERIFIED, checks=failed)), "Load case push_x")
    assert re.search(r"best iterate, non_associative +0\.5   \(no load factor\)", found)
    assert not re.search(r"load factor, non_associative", found)
    assert "collapses at no more than 0.4 g" in found


def test_residuals_say_what_they_are_relative_to(text: str) -> None:
    found = section(text, "Load case push_x")
    assert re.search(r"equilibrium residual +\S+   of the mean load of a block\n", found)


def test_check_listing_has_no_results(results: Results) -> None:
    text = check_listing(replace(results, cases=()), {"push": CaseNeeds({"unknown_velocities": 12, "cones": 8})})
    assert "Nothing was solved." in text
    assert re.search(r"unknown velocities +12", text)
    assert "Load case" not in text.replace("Needed for load case push", "")


def test_verification_names_what_differs(results: Results) -> None:
    assert "agrees" in verification_lines(results, ())[-1]
    lines = verification_lines(results, ("push_x: static bound is 1 recomputed, the file says 2",))
    assert "differs: push_x: static bound is 1" in lines[-1]
    text = " ".join(" ".join(lines).split())
    assert f"not verified, but as the run told it: {VERSIONS}; {TIMES}; {CLAIMED}; {COURSE}; {WORDS}" in text
