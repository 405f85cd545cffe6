"""Distances, front and advice on figures made by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mbla.sweeps.tradeoff.settings import Setting
from mbla.sweeps.tradeoff.trade import Advice, CaseTrade, advice
from tests.sweeps.tradeoff.hand_made import Row, row, rows_of_a_study, trade_of


def rung_of(one: Advice) -> str:
    return "" if one.setting is None else one.setting.name


def names_on_front(trade: CaseTrade) -> set[str]:
    return {setting.name for setting, best in zip(trade.settings, trade.front, strict=True) if best}


def test_front_of_points() -> None:
    """Of points that are the same in both every one is on the front."""
    points = [(1.0, 1e-3), (2.0, 1e-3), (2.0, 1e-6), (0.5, 1e-2), (3.0, 1e-5), (9.0, 0.0), (0.5, 1e-2)]
    rows = [row(f"x: {n}", 1 + error, seconds) for n, (seconds, error) in enumerate(points)]
    rows[5] = row("accuracy: reference", 1.0, 9.0)
    assert trade_of(rows).front.tolist() == [True, False, True, True, False, True, True]


def test_distances_and_front_of_the_ladder() -> None:
    trade = trade_of(rows_of_a_study())
    assert trade.reference is not None
    assert trade.settings[trade.reference].name == "accuracy: reference"
    assert trade.certain
    assert trade.resolution == 1e-9
    assert trade.distance.tolist() == pytest.approx([2e-5, 0.0, 1e-3, 4e-5, 0.0, 0.0], abs=1e-12)
    assert names_on_front(trade) == {"accuracy: standard", "accuracy: reference", "accuracy: draft"}


def test_distances_below_the_accuracy_of_the_reference_are_the_same() -> None:
    runs = [row("accuracy: reference", 0.5, 2.0), row("solver: mbla", 0.5 + 1e-11, 1.0)]
    trade = trade_of(runs)
    assert names_on_front(trade) == {"solver: mbla"}


@pytest.mark.parametrize(
    ("wanted", "setting"), [(1e-2, "accuracy: draft"), (1e-4, "accuracy: standard"), (1e-6, "accuracy: reference")]
)
def test_the_fastest_that_is_near_enough_is_advised(wanted: float, setting: str) -> None:
    chosen = advice([trade_of(rows_of_a_study())], wanted)
    assert rung_of(chosen) == setting
    assert chosen.setting is not None
    assert chosen.setting.settings == {"analysis.accuracy": setting.removeprefix("accuracy: ")}


def test_words_of_the_advice() -> None:
    words = advice([trade_of(rows_of_a_study())], 1e-4).sentence
    assert words == "For an error of 0.0001 take accuracy: standard (0.8 s, within 2.0e-05 of the reference)."


def test_no_finer_advice_than_the_reference_is_good_for() -> None:
    chosen = advice([trade_of(rows_of_a_study())], 1e-10)
    assert chosen.setting is None
    assert "the reference itself is good to 1.0e-09" in chosen.sentence


def test_a_preset_is_preferred_within_the_noise_of_time() -> None:
    runs = [*rows_of_a_study(), row("solver: x", 0.50001, 0.76)]
    assert rung_of(advice([trade_of(runs)], 1e-4)) == "accuracy: standard"
    runs = [*rows_of_a_study(), row("solver: x", 0.50001, 0.5)]
    assert rung_of(advice([trade_of(runs)], 1e-4)) == "solver: x"


def test_hundredths_of_a_second_are_no_reason_to_leave_the_standard() -> None:
    times = {"accuracy: standard": 0.06, "accuracy: reference": 0.04, "solver: mbla": 0.035}
    runs = [row(name, 0.5, wall) for name, wall in times.items()]
    assert rung_of(advice([trade_of(runs)], 1e-4)) == "accuracy: standard"


def test_the_sharpest_verified_takes_the_place_of_a_reference_that_is_not() -> None:
    runs = rows_of_a_study()
    runs[1] = row("accuracy: reference", 0.5, 2.0, status="approximate", verified=False)
    runs[3] = row("solver: mbla", 0.50002, 1.5, accuracy=1e-10)
    trade = trade_of(runs)
    assert trade.reference is not None
    assert trade.settings[trade.reference].name == "solver: mbla"
    assert trade.certain


def test_without_a_verified_run_there_is_no_front_and_no_advice() -> None:
    runs = [
        row("accuracy: reference", 0.5, 2.0, status="approximate", verified=False, accuracy=1e-3),
        row("accuracy: draft", 0.51, 0.2, status="approximate", verified=False, accuracy=1e-2),
        row("flow_rule: associative", 0.6, 0.1, model="flow_rule"),
    ]
    trade = trade_of(runs)
    assert not trade.certain
    assert not names_on_front(trade)
    assert trade.distance[1] == pytest.approx(0.02)
    assert "no setting is verified for push" in advice([trade], 0.1).sentence


def test_a_draft_as_sharp_as_it_asks_for_is_advised_but_is_no_reference() -> None:
    draft = row("accuracy: draft", 0.5005, 0.2, status="approximate", accuracy=1e-3)
    runs = [row("accuracy: reference", 0.5, 2.0), draft]
    assert names_on_front(trade_of(runs)) == {"accuracy: reference", "accuracy: draft"}
    assert rung_of(advice([trade_of(runs)], 1e-2)) == "accuracy: draft"
    alone = trade_of([draft])
    assert not alone.certain
    assert not names_on_front(alone)
    assert rung_of(advice([alone], 1e-2)) == ""


def test_nothing_to_compare_with() -> None:
    trade = trade_of([Row(Setting("accuracy: reference"), math.nan, math.nan, math.nan, "", False)])
    assert trade.reference is None
    assert advice([trade], 0.1).setting is None


NONE = row("accuracy: reference", math.nan, 1.0, status="no_equilibrium", accuracy=math.nan)


def test_verdicts_without_a_figure() -> None:
    others = [replace(NONE, verified=False), row("solver: mbla", 0.5, 1.0)]
    assert trade_of([NONE, *others]).distance.tolist() == pytest.approx([0.0, math.nan, math.nan], nan_ok=True)
    runs = [NONE, replace(NONE, setting=Setting("accuracy: draft"), seconds=0.1)]
    assert names_on_front(trade_of(runs)) == {"accuracy: draft"}
    assert rung_of(advice([trade_of(runs)], 1e-4)) == "accuracy: draft"


def test_a_load_factor_of_nothing_is_compared_with_the_least_that_counts() -> None:
    zero, near = row("accuracy: reference", 0.0, 1.0), row("accuracy: draft", 1e-9, 1.0)
    assert trade_of([zero, near], least=1e-3).distance[1] == pytest.approx(1e-6)


def test_advice_for_several_load_cases_must_hold_in_each() -> None:
    other = [replace(each, answer=2 * each.answer) for each in rows_of_a_study()]
    other[0] = row("accuracy: standard", 1.1, 0.8)
    trades = [trade_of(rows_of_a_study()), trade_of(other, "lift")]
    assert rung_of(advice(trades[:1], 1e-4)) == "accuracy: standard"
    both = advice(trades, 1e-4)
    assert rung_of(both) == "solver: mbla"
    assert both.seconds == pytest.approx(3.0)
