"""What the listing says of a case's figure: unique or not, how far tries differ, what hangs by self-stress."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import Message
from mbla.model.model import Settlement, Tilt
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.listing.answers import answer_columns
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import WIDTH
from mbla.results.listing.verdict_words import SCHEMES, known_words, uniqueness_words, verdict
from mbla.results.records.json_record import results_json
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Standing, StandingResult, Status
from tests.results.synthetic import full_results, tower_mechanics, tower_results

NAN = float("nan")
RESULTS = tower_results()
MODEL, FIRST = RESULTS.model, RESULTS.cases[0]


def case_with(status: Status = Status.SOLVED, **changes: Any) -> CaseResult:
    solution = replace(FIRST.solution, **changes.get("solution", {}))
    checks = replace(FIRST.checks, **changes.get("checks", {}))
    return replace(FIRST, status=status, solution=solution, checks=checks)


def text_of(case: CaseResult) -> str:
    """The listing of a run of that case, runs of spaces as one."""
    lines = listing(replace(RESULTS, cases=(case,)))
    assert max(map(len, lines.splitlines())) <= WIDTH
    return " ".join(lines.split())


@pytest.mark.parametrize(
    ("lower", "upper", "words"),
    [
        (0.45, 0.52, "not unique: for this mechanism alone there are forces that fit the law at every factor"),
        (0.45, 0.52, "from 0.45 g to 0.52 g"),
        (0.5, 0.5, "every distribution of forces has the same load factor; without normality another mechanism"),
        (0.45, NAN, "only one end is verified: at least 0.45"),
        (NAN, 0.52, "only one end is verified: at most 0.52"),
        (NAN, NAN, "need not be unique, and its range is not known"),
    ],
)
def test_whether_the_factor_is_unique(lower: float, upper: float, words: str) -> None:
    case = case_with(solution={"associative": tower_mechanics(0.625)}, checks={"lower": lower, "upper": upper})
    text = text_of(case)
    assert words in text
    assert "the associative factor, 0.625 g, is an upper limit to all" in text


def test_the_associative_factor_needs_no_such_words() -> None:
    assert uniqueness_words(MODEL, tower_results("associative").cases[0]) == ""


def test_a_verified_range_stands_among_the_figures_and_in_the_summary() -> None:
    case = case_with(checks={"lower": 0.45, "upper": 0.52}, solution={"scheme": "proximal"})
    text = text_of(case)
    assert "range for this mechanism 0.45 .. 0.52 (verified)" in text
    assert "scheme proximal load factor, non_associative 0.5 " in text
    assert "load factor, least found 0.45 load factor, greatest found 0.52" in text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"checks": {"lower": 0.45, "upper": 0.52}},
            "collapses between 0.45 g (least found) and 0.52 g (greatest found); the state told here at 0.5 g, "
            "verified",
        ),
        (
            {"checks": {"lower": 0.45}, "solution": {"spread": (0.44, 0.5)}},
            "collapses between 0.44 g (least found) and 0.5 g (greatest found); the state told here at 0.5 g, verified",
        ),
        (
            {"checks": {"lower": 0.45, "upper": np.inf}},
            "collapses from 0.45 g (least found) up without limit; the state told here at 0.5 g, verified",
        ),
        (
            {"checks": {"lower": 0.45, "upper": 0.52, "peak_load_factor": 0.6}},
            "collapses at 0.6 g, the peak of its load path; once moving it carries between 0.45 g (least found) and "
            "0.52 g (greatest found); the state told here at 0.5 g, verified",
        ),
        ({"solution": {"spread": (0.499, 0.501)}, "checks": {"slip_residual": 5e-3}}, "collapses at 0.5 g, verified"),
        ({"checks": {"lower": 0.5, "upper": 0.5}}, "collapses at 0.5 g, verified"),
    ],
)
def test_the_sentence_begins_with_the_least_that_was_found_and_the_greatest(
    changes: dict[str, Any], words: str
) -> None:
    """Figures that lie no further apart than the residual of the state are one."""
    assert verdict(MODEL, case_with(**changes)) == words


@pytest.mark.parametrize(
    ("upper", "words"),
    [
        (0.52, "between a reaction of 19.6 N (least found) and a reaction of 21 N (greatest found); the state told"),
        (np.inf, "from a reaction of 21 N (greatest found) down without limit; the state told"),
    ],
)
def test_of_a_support_that_gives_way_the_least_is_the_least_reaction(upper: float, words: str) -> None:
    """reaction = 30 - 20 load factor."""
    case = case_with(checks={"lower": 0.45, "upper": upper})
    case = replace(case, load_case=replace(case.load_case, settlement=SETTLEMENT))
    assert verdict(MODEL, case).startswith(f"follows its support {words}")


def test_the_table_has_the_least_and_the_greatest_where_a_case_has_several() -> None:
    ranged = case_with(checks={"lower": 0.45, "upper": 0.52})
    heads, rows = answer_columns(MODEL, [FIRST, ranged, RESULTS.cases[1]])
    assert heads == ["load factor", "least found", "greatest found", "associative"]
    assert [row[:3] for row in rows] == [["0.5", "0.5", "0.5"], ["0.5", "0.45", "0.52"], ["-", "-", "-"]]
    assert answer_columns(MODEL, [FIRST])[0] == ["load factor", "associative"]
    table = summary_lines(replace(RESULTS, cases=(ranged,)))
    assert table[1].split() == ["load", "case", "status", *" ".join(heads).split()]
    assert table[2].split()[2:5] == ["0.5", "0.45", "0.52"]


def test_a_range_that_was_not_verified_says_so() -> None:
    case = case_with(solution={"lower": tower_mechanics(0.45), "upper": tower_mechanics(0.52)})
    assert "range for this mechanism 0.45 .. 0.52 (NOT verified)" in text_of(case)


def test_tries_that_did_not_agree() -> None:
    text = text_of(case_with(Status.APPROXIMATE, solution={"spread": (0.49, 0.51)}))
    assert "Several tries did not agree: they ended between 0.49 g and 0.51 g." in text
    assert "spread of several tries 0.49 .. 0.51" in text


@pytest.mark.parametrize("scheme", sorted(SCHEMES))
def test_what_is_known_of_a_scheme_is_said(scheme: str) -> None:
    assert " ".join(SCHEMES[scheme].split()) in text_of(case_with(solution={"scheme": scheme}))


def test_other_schemes_have_no_known_bias() -> None:
    assert not any(words in text_of(case_with(solution={"scheme": "interior"})) for words in SCHEMES.values())


def test_remarks_of_the_solver_end_as_sentences() -> None:
    assert "The factor is the peak of the path." in known_words(
        MODEL, case_with(solution={"remarks": (Message("peak-on-path", "The factor is the peak of the path"),)})
    )


def test_what_stands_only_by_self_stress_does_not_collapse_at_a_load_factor() -> None:
    standing = StandingResult(Standing.SELF_STRESS, 1, "the tower hangs between two walls")
    case = case_with(solution={"standing": standing})
    assert verdict(MODEL, case).startswith("no collapse load: it stands only by self-stress")
    text = text_of(case)
    assert "stands under dead load only by self-stress: tower[0] would fall first" in text
    assert "WARNING: the load factor presumes forces locked in" in text
    assert "warning [only-by-self-stress]" in text
    assert "collapses at 0.5 g" not in text
    assert "best iterate, non_associative 0.5 (no load factor)" in text


def test_the_associative_factor_of_what_hangs_by_self_stress_keeps_its_value_with_the_warning() -> None:
    standing = StandingResult(Standing.SELF_STRESS, 1, "the tower hangs between two walls")
    case = tower_results("associative").cases[0]
    text = text_of(replace(case, solution=replace(case.solution, standing=standing)))
    assert "collapses at 0.5 g, verified" in text
    assert "warning [only-by-self-stress]" in text


@pytest.mark.parametrize(
    ("outer", "status", "words"),
    [
        (0.55, Status.SOLVED, "collapses between 0.5 g and 0.55 g, with the inscribed and the circumscribed"),
        (0.55, Status.SOLVED, "polyhedron, verified"),
        (0.55, Status.APPROXIMATE, "polyhedron, approximate"),
        (0.5 + 1e-8, Status.SOLVED, "collapses at 0.5 g, verified"),
    ],
)
def test_a_bracket_is_not_told_as_one_factor(outer: float, status: Status, words: str) -> None:
    case = tower_results("associative").cases[0]
    bracket = replace(case.solution, outer=tower_mechanics(outer), sides=8)
    assert words in verdict(MODEL, replace(case, status=status, solution=bracket))


def test_everything_together_keeps_to_the_width_and_names_everything() -> None:
    results: Results = full_results()
    text = " ".join(listing(results).split())
    for words in (
        "inscribed polyhedron 0.55",
        "circumscribed polyhedron 0.56 (8 sides; the cone lies between)",
        "solved as planar, 2 free blocks, 4 contact points (4 more left out), 1 mirror plane used, "
        "3 parts solved apart",
        "Load path of 3 steps: its peak, a reaction of 18 N at step 1, is a limit point",
        "Normal forces that are possible at this load factor",
        "tension violation 1.0e-09",
        "slip residual 2.0e-09",
        "One more.",
    ):
        assert words in text
    assert max(map(len, listing(results).splitlines())) <= WIDTH


def test_what_locks_a_structure_is_listed() -> None:
    lock = full_results().cases[0].solution.lock
    case = case_with(
        Status.UNBOUNDED, solution={"mechanics": None, "associative": None, "lock": lock, "flow_rule": "associative"}
    )
    assert "Locked: these forces, within the strength of the joints, balance the live load alone" in text_of(case)


def test_everything_reads_the_same_from_the_file(tmp_path: Path) -> None:
    results = full_results()
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(results))
    back = read_results_hdf5(path)
    assert listing(back) == listing(results)
    assert results_json(back) == results_json(results)


SETTLEMENT = Settlement(np.array([0]), np.array([[0.0, 0, -1, 0, 0, 0]]), False, "settlement of base[0]", 30.0, 20.0)
TILT = Tilt(np.array([0.0, 1.0, 0.0]), np.zeros((3, 6)), np.zeros((3, 6)), np.zeros((3, 6)), NAN, True, np.inf)


@pytest.mark.parametrize(
    ("load", "solution", "words"),
    [
        (
            {"settlement": SETTLEMENT},
            {},
            "no least reaction: the structure holds the support back however hard that pulls away from it",
        ),
        (
            {"tilt": TILT},
            {"flow_rule": "associative"},
            "no angle of collapse: it bears gravity turned by every angle up to 180 degrees",
        ),
        (
            {"tilt": TILT},
            {"lock": np.ones((8, 3))},
            "no angle of collapse: it bears gravity turned by every angle up to 180 degrees",
        ),
        (
            {"tilt": TILT},
            {},
            "no angle of collapse: it bears gravity turned by every angle up to 180 degrees by associative flow; "
            "undecided for non-associative flow",
        ),
    ],
)
def test_what_no_settlement_and_no_tilt_brings_down_is_told(
    load: dict[str, Any], solution: dict[str, Any], words: str
) -> None:
    case = case_with(Status.UNBOUNDED, solution={"mechanics": None, **solution})
    case = replace(case, load_case=replace(case.load_case, **load))
    assert verdict(MODEL, case) == words


def test_an_angle_without_bounds_stands_alone() -> None:
    """Nothing is proved of associative flow: no line of bounds, no nan."""
    case = case_with(solution={"associative": None})
    text = text_of(replace(case, load_case=replace(case.load_case, tilt=TILT)))
    assert "angle 26.565051 degrees" in text
    assert "angle, associative bounds" not in text
