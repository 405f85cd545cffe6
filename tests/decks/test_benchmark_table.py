from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.deck import read_deck
from tests.decks import benchmark_table
from tests.decks.benchmark_cases import CASES, FORMULATIONS, formulation
from tests.decks.benchmark_table import (
    HEAD,
    INTERNAL,
    README,
    Refused,
    figures_of,
    rows_in,
    run_case,
    table,
    watched,
    with_table,
)
from tests.decks.folder import DECKS, deck_of

STATUS, FACTOR = HEAD.index("status") - 2, HEAD.index("load factor") - 2
PAGE = README.read_text(encoding="utf-8")


def listed() -> set[tuple[str, str]]:
    return {(case.name, name) for case in CASES for name in case.formulations}


def test_the_page_has_the_rows_that_the_list_says_or_why_not() -> None:
    assert set(rows_in(PAGE)) == listed(), "python -m tests.decks.benchmark_table writes it again"


def test_every_row_has_every_figure() -> None:
    for key, figures in rows_in(PAGE).items():
        assert len(figures) in (1, len(HEAD) - 2), key  # a reason, or the figures


def test_every_formulation_is_compared_somewhere_and_every_case_exists() -> None:
    assert {name for case in CASES for name in case.formulations} == {each.name for each in FORMULATIONS}
    assert len({case.name for case in CASES}) == len(CASES)
    for case in CASES:
        assert case.load_case in deck_of(DECKS / "benchmarks" / f"{case.deck}.yaml").content.load_cases, case.name


@pytest.mark.parametrize("name", ["block pushed at 30 degrees", "Oppenheim's arch"])
def test_a_small_case_gives_the_row_that_stands_there(name: str) -> None:
    case = next(case for case in CASES if case.name == name)
    result = run_case(case, formulation("associative, kinematic form"))
    assert not isinstance(result, Refused)
    found, printed = figures_of(result), rows_in(PAGE)[name, "associative, kinematic form"]
    assert found[STATUS] == printed[STATUS] == "solved"
    assert float(found[FACTOR]) == pytest.approx(float(printed[FACTOR]), rel=1e-6)


def test_what_is_written_is_read_back_and_is_what_the_run_gave() -> None:
    case = replace(CASES[0], formulations=("associative, kinematic form", "auto"))
    told: list[str] = []
    text = table((case,), told.append)
    rows = rows_in(with_table(PAGE, text))
    assert set(rows) == {(case.name, name) for name in case.formulations}
    assert float(rows[case.name, "auto"][FACTOR]) == pytest.approx(0.4, rel=1e-6)  # its friction
    assert told == [f"{case.name}, {name}: solved" for name in case.formulations]


def test_an_option_that_nothing_reads_is_no_row() -> None:
    """The friction cone means nothing to a key of the deck that the solver stage never looks at."""
    ignored = replace(FORMULATIONS[0], overrides=(*FORMULATIONS[0].overrides, "max_iterations=50", "path.steps=7"))
    result = run_case(CASES[0], ignored)
    assert isinstance(result, Refused)
    assert result.reason == "analysis.path is not read by the solver stage"


def test_a_solution_that_does_not_bear_the_mark_is_no_row() -> None:
    result = run_case(CASES[0], replace(FORMULATIONS[0], shows=lambda solution: False))
    assert isinstance(result, Refused)
    assert "does not bear its mark" in result.reason


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (("flow_rule=plastic",), "analysis.flow_rule = plastic: "),
        (("flow_rule=associative", "solver=highs"), "analysis.solver = highs solves linear programs only"),
    ],
)
def test_an_error_is_no_row_and_its_words_are_told(
    overrides: tuple[str, ...], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the deck refuses, and what the solver stage refuses: friction in space is no linear program."""
    bad = replace(FORMULATIONS[0], overrides=overrides)
    monkeypatch.setattr(benchmark_table, "formulation", lambda name: bad)
    told: list[str] = []
    text = table((replace(CASES[0], formulations=(bad.name,)),), told.append)
    name = f"{CASES[0].name}, {bad.name}: {words}"
    assert told[0].startswith(name)
    assert f"- Not in the table: {CASES[0].name} / {bad.name}: {words}" in text
    assert str(DECKS) not in text


def test_an_internal_error_costs_its_own_row_only(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise KeyError("scheme")

    monkeypatch.setattr(benchmark_table, "solve_case", broken)
    result = run_case(CASES[0], FORMULATIONS[0])
    assert isinstance(result, Refused)
    assert result.reason == f"{INTERNAL} (KeyError: 'scheme')"


def test_a_watched_deck_is_the_same_deck() -> None:
    deck = read_deck(DECKS / "benchmarks" / "groove.yaml", ["analysis.scheme=published"])
    again, read = watched(deck)
    assert read == set()
    assert again.analysis.scheme == "published"
    assert again.analysis.published.tolerance == deck.analysis.published.tolerance == 1e-6
    assert {"scheme", "published"} <= read
    assert "interior" not in read


@pytest.mark.long
def test_the_whole_table_is_what_the_runs_give() -> None:
    printed = rows_in(PAGE)
    for case in CASES:
        for name in case.formulations:
            result, row = run_case(case, formulation(name)), printed[case.name, name]
            if isinstance(result, Refused):
                assert row == (result.reason,)
                continue
            found = figures_of(result)
            assert found[STATUS] == row[STATUS], (case.name, name)
            if found[STATUS] == "solved":
                tolerance = 1e-6 if result.solution.flow_rule == "associative" else 1e-4
                if name == "lowest":
                    tolerance = 1e-2  # a search by the clock goes as far as the machine is fast
                assert float(found[FACTOR]) == pytest.approx(float(row[FACTOR]), rel=tolerance), (case.name, name)
