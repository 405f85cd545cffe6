"""The search for lower load factors is left out where nothing shows it, and every other value stays the same."""

from __future__ import annotations

import io
from typing import Any

import pytest

from mbla.deck import read_deck
from mbla.process.run_options import RunOptions
from mbla.results.record.json_record import RUN, results_json
from mbla.results.record.json_values import json_line
from mbla.results.record.objects import keys_of
from mbla.results.status_file import StatusFile
from mbla.run import solve_deck
from mbla.sweeps.engine.child import ON_REQUEST, PointRunner, requested_only
from mbla.sweeps.plan import Plan, Task, override_texts
from tests.sweeps.engine.sharing_decks import ARCH, DECKS, SMALL_ARCH, VARIED, Settings

PLANK = "benchmarks/closed_forms/plank_in_clamp.yaml"
"""carries more on its path than in its least state"""


def plan_of(deck: str, *results: str, keep: str = "none", cases: tuple[str, ...] = ()) -> Plan:
    return Plan(str(DECKS / deck), "", (), cases, results, keep, "", None, None, "")


def record_of(deck: str, settings: Settings, plan: Plan | None) -> dict[str, Any]:
    read = read_deck(DECKS / deck, override_texts(settings))
    asked = read if plan is None else requested_only(read, plan)
    results = solve_deck(asked, RunOptions(), StatusFile(io.StringIO(), ""), None, 0.0)
    return results_json(results)


def shown(record: dict[str, Any]) -> list[str]:
    """Every value that does not depend on the search, number by number."""
    cases = [{key: value for key, value in case.items() if key not in ON_REQUEST} for case in record["cases"]]
    return [json_line({"part": part}) for part in (record["model"], record["exit_code"], *cases)]


@pytest.mark.every(2)
@pytest.mark.parametrize(("deck", "settings"), [(ARCH, SMALL_ARCH), (PLANK, {})])
def test_nothing_else_changes_without_them(deck: str, settings: Settings) -> None:
    full, lean = record_of(deck, settings, None), record_of(deck, settings, plan_of(deck, "load_factor"))
    assert shown(full) == shown(lean)
    assert any(case["least_load_factor"] for case in full["cases"])
    assert not any(case["least_load_factor"] for case in lean["cases"])


@pytest.mark.long
def test_nothing_else_changes_in_any_deck() -> None:
    different = []
    for deck, variants in VARIED.items():
        for settings in variants:
            try:
                full = record_of(deck, settings, None)
            except Exception:  # refused decks are so before anything is asked
                continue
            if shown(full) != shown(record_of(deck, settings, plan_of(deck, "load_factor"))):
                different.append(f"{deck} {settings}")
    assert not different


@pytest.mark.parametrize(
    ("results", "keep"),
    [
        (("load_factor", "least_load_factor"), "none"),
        (("assessment_ratio",), "none"),
        (("remarks.0",), "none"),
        (("status",), "failed"),
    ],
)
def test_they_are_worked_out_where_they_are_shown_or_kept(results: tuple[str, ...], keep: str) -> None:
    deck = read_deck(DECKS / ARCH)
    assert requested_only(deck, plan_of(ARCH, *results, keep=keep)) is deck


def test_every_key_on_request_is_one_of_the_record() -> None:
    known = {key.path.removeprefix("cases[].").removeprefix("series[].").partition(".")[0] for key in keys_of(RUN)}
    assert known >= set(ON_REQUEST)


def test_a_column_of_the_least_shows_it() -> None:
    outcome = PointRunner(plan_of(PLANK, "load_factor", "least_load_factor", cases=("pull",))).run(Task("1", 1, {}))
    least, factor = (outcome.results[name] for name in ("least_load_factor", "load_factor"))
    assert isinstance(least, float)
    assert isinstance(factor, float)
    assert least < factor
