"""What a report says: residuals judged exactly as the verification judges them, lines of the listing as blocks."""

from dataclasses import replace

import numpy as np
import pytest

from mbla.results.listing.text import entry, heading, sentence, table
from mbla.results.report.content import FAILED, NOT_JUDGED, PASSED, Block, blocks_of, checks_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Checks
from mbla.solution.verification.residuals import Residuals
from mbla.solution.verification.verify_points import Bounds, failures_of, tolerances
from tests.results.synthetic import tower_results

JUDGED = {
    "equilibrium_residual": "equilibrium",
    "yield_violation": "yielding",
    "penetration": "penetration",
    "complementarity_residual": "complementarity",
    "power_balance": "power_balance",
    "live_power": "live_power",
}


def case_with(flow_rule: str, **changes: float) -> CaseResult:
    case = tower_results(flow_rule).cases[0]
    return replace(case, checks=replace(case.checks, **changes))  # type: ignore[arg-type]


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
@pytest.mark.parametrize("name", JUDGED)
@pytest.mark.parametrize("share", [0.99, 1.01])
def test_each_residual_is_judged_as_by_the_verification(flow_rule: str, name: str, share: float) -> None:
    value = share * tolerances(flow_rule)[name]
    case = case_with(flow_rule, **{name: 1.0 + value if name == "live_power" else value})
    shown = {row.name.replace(" ", "_"): row for row in checks_of(case)}
    row = shown["deviation_of_the_live_power" if name == "live_power" else name]
    none = dict.fromkeys(Residuals.__dataclass_fields__, 0.0) | {"live_power": 1.0}
    residuals = Residuals(**(none | {JUDGED[name]: 1.0 + value if name == "live_power" else value}))
    failures = failures_of(residuals, case.solution, Bounds(0.5, 0.5, 0.5))
    assert row.verdict == (FAILED if failures else PASSED) == (FAILED if share > 1 else PASSED)
    assert [each.name for each in checks_of(case) if each.verdict == FAILED] == ([row.name] if failures else [])


def test_the_gap_counts_for_associative_flow_alone() -> None:
    for flow_rule, verdict in (("associative", FAILED), ("non_associative", NOT_JUDGED)):
        assert checks_of(case_with(flow_rule, gap=1e-3))[-1].verdict == verdict


def test_the_distance_of_polyhedra_is_no_error() -> None:
    case = case_with("associative", gap=1e-2)
    outer = replace(case.solution, outer=case.solution.mechanics, sides=8)
    assert checks_of(replace(case, solution=outer))[-1].verdict == NOT_JUDGED


def test_nothing_to_check_no_rows() -> None:
    case = tower_results().cases[1]
    assert np.isnan(case.checks.gap)
    assert checks_of(case) == []


def test_every_tolerance_has_its_row() -> None:
    names = {row.name.replace(" ", "_") for row in checks_of(tower_results("associative").cases[0])}
    renamed = {"live_power": "deviation_of_the_live_power", "gap": "gap_of_the_bounds"}
    assert {renamed.get(name, name) for name in tolerances("associative")} <= names
    assert set(tolerances("associative")) <= set(Checks.__dataclass_fields__)


# --- Lines of the listing as blocks of a page -----------------------------------------------------------------------


def test_a_sentence_with_a_colon_is_the_caption_of_its_table() -> None:
    lines = ["", *sentence("Hinges:"), *table(["interface", "at"], [["a/b", "1"], ["c/d", "2"]])]
    assert blocks_of(lines) == [Block("table", "Hinges", (("a/b", "1"), ("c/d", "2")), ("interface", "at"), 1)]


def test_tables_that_follow_each_other_stay_apart() -> None:
    first, second = table(["a"], [["1"]]), table(["a"], [["1"]])
    assert len(blocks_of([*first, *second])) == 2


def test_entries_gather_and_take_their_details_along() -> None:
    lines = [*entry("status", "solved"), *entry("stands", "yes"), *sentence("of itself", "    "), *entry("  x", "1")]
    assert blocks_of(lines) == [Block("entries", rows=(("status", "solved"), ("stands", "yes\nof itself"), ("x", "1")))]


def test_wrapped_lines_are_one_again() -> None:
    words = "word " * 60 + "end"
    assert blocks_of(sentence(words)) == [Block("paragraph", words)]
    assert blocks_of(entry("name", words)) == [Block("entries", rows=(("name", words),))]


def test_cells_that_the_listing_shortens_are_whole() -> None:
    long = "block" * 30
    assert blocks_of(table(["name", "x"], [[long, "1"]])) == [Block("table", "", ((long, "1"),), ("name", "x"), 1)]


def test_headings_and_lines_of_no_element() -> None:
    assert blocks_of([*heading("Model"), "  plain", ""]) == [Block("title", "Model"), Block("paragraph", "plain")]
