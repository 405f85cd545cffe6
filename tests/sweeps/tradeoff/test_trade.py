"""Distances, front and advice on figures made by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mbla.sweeps.measure.measurement import Measurement
from mbla.sweeps.tradeoff.advice import advice
from mbla.sweeps.tradeoff.ladder_run import RungRun
from mbla.sweeps.tradeoff.rung import Rung
from mbla.sweeps.tradeoff.trade import CaseTrade, case_trades, distance, on_front
from tests.sweeps.tradeoff.hand_made import ladder, measured, run_of


def trade_of(runs: list[RungRun], name: str = "push", positions: int = 0) -> CaseTrade:
    return case_trades([(name, positions)], runs)[0]


def names_on_front(trade: CaseTrade) -> set[str]:
    return {row.name for row in trade.rows if row.front}


def test_front_of_points() -> None:
    points = [(1.0, 1e-3), (2.0, 1e-3), (2.0, 1e-6), (0.5, 1e-2), (3.0, 1e-5), None, (0.5, 1e-2)]
    assert on_front(points) == [True, False, True, True, False, False, True]


def test_distances_and_front_of_the_ladder() -> None:
    trade = trade_of(ladder())
    assert trade.reference is not None
    assert trade.reference.name == "accuracy: reference"
    assert trade.verified
    assert trade.resolution == 1e-9
    assert [row.distance for row in trade.rows] == pytest.approx([2e-5, 0.0, 1e-3, 4e-5, 0.0, 0.0], abs=1e-12)
    assert names_on_front(trade) == {"accuracy: standard", "accuracy: reference", "accuracy: draft"}


def test_distances_below_the_accuracy_of_the_reference_are_the_same() -> None:
    runs = [run_of("accuracy: reference", measured(0.5, 2.0)), run_of("form: static", measured(0.5 + 1e-11, 1.0))]
    trade = trade_of(runs)
    assert trade.error(trade.rows[1]) == trade.error(trade.rows[0]) == 1e-9
    assert names_on_front(trade) == {"form: static"}


@pytest.mark.parametrize(
    ("wanted", "rung"), [(1e-2, "accuracy: draft"), (1e-4, "accuracy: standard"), (1e-6, "accuracy: reference")]
)
def test_the_fastest_that_is_near_enough_is_advised(wanted: float, rung: str) -> None:
    chosen = advice([trade_of(ladder())], wanted)
    assert chosen.rung == rung
    assert chosen.setting.overrides == (f"analysis.{rung.replace(': ', '=')}",)


def test_words_of_the_advice() -> None:
    words = advice([trade_of(ladder())], 1e-4).sentence
    assert words == "For an error of 1e-4 take accuracy: standard (0.8 s): 2.0e-05 from the reference."


def test_no_finer_advice_than_the_reference_is_good_for() -> None:
    chosen = advice([trade_of(ladder())], 1e-10)
    assert chosen.rung == ""
    assert "the reference itself is good to 1.0e-09" in chosen.sentence


def test_a_preset_is_preferred_within_the_noise_of_time() -> None:
    runs = [*ladder(), run_of("solver: mbla", measured(0.50001, 0.76))]
    assert advice([trade_of(runs)], 1e-4).rung == "accuracy: standard"
    runs = [*ladder(), run_of("solver: mbla", measured(0.50001, 0.5))]
    chosen = advice([trade_of(runs)], 1e-4)
    assert chosen.rung == "solver: mbla"
    assert "take solver: mbla (0.5 s; accuracy: standard 0.8 s)" in chosen.sentence  # what it gains


def test_hundredths_of_a_second_are_no_reason_to_leave_the_standard() -> None:
    times = {"accuracy: standard": 0.06, "accuracy: reference": 0.04, "form: static": 0.035}
    runs = [run_of(name, measured(0.5, wall)) for name, wall in times.items()]
    assert advice([trade_of(runs)], 1e-4).rung == "accuracy: standard"


def test_the_sharpest_verified_takes_the_place_of_a_reference_that_is_not() -> None:
    runs = ladder()
    runs[1] = run_of("accuracy: reference", measured(0.5, 2.0, status="approximate", verified=False))
    runs[3] = run_of("form: static", measured(0.50002, 1.5, accuracy=1e-10))
    trade = trade_of(runs)
    assert trade.reference is not None
    assert trade.reference.name == "form: static"
    assert trade.verified


def test_without_a_verified_run_there_is_no_front_and_no_advice() -> None:
    runs = [
        run_of("accuracy: reference", measured(0.5, 2.0, status="approximate", verified=False, accuracy=1e-3)),
        run_of("accuracy: draft", measured(0.51, 0.2, status="approximate", verified=False, accuracy=1e-2)),
        run_of("flow_rule: associative", measured(0.6, 0.1), model="flow_rule"),
    ]
    trade = trade_of(runs)
    assert not trade.verified
    assert not names_on_front(trade)
    assert trade.rows[1].distance == pytest.approx(0.02)
    assert "no setting is verified for push" in advice([trade], 0.1).sentence


def test_a_draft_as_sharp_as_it_asks_for_is_advised_but_is_no_reference() -> None:
    draft = run_of("accuracy: draft", measured(0.5005, 0.2, status="approximate", accuracy=1e-3))
    runs = [run_of("accuracy: reference", measured(0.5, 2.0)), draft]
    assert names_on_front(trade_of(runs)) == {"accuracy: reference", "accuracy: draft"}
    assert advice([trade_of(runs)], 1e-2).rung == "accuracy: draft"
    alone = trade_of([draft])
    assert not alone.verified
    assert not names_on_front(alone)
    assert advice([alone], 1e-2).rung == ""


def test_nothing_to_compare_with() -> None:
    runs = [RungRun(Rung("accuracy: reference"), (), "stopped", "stopped after 1 s")]
    trade = trade_of(runs)
    assert trade.reference is None
    assert advice([trade], 0.1).rung == ""


def test_verdicts_without_a_figure() -> None:
    none = measured(math.nan, 1.0, status="no_equilibrium", verdict="no_equilibrium", accuracy=math.nan)
    assert distance(none, none) == 0.0
    assert math.isnan(distance(replace(none, verified=False), none))
    assert math.isnan(distance(measured(0.5, 1.0), none))
    assert math.isnan(distance(measured(0.5, 1.0, kind="angle"), measured(0.5, 1.0)))
    runs = [run_of("accuracy: reference", none), run_of("accuracy: draft", replace(none, wall=0.1))]
    assert names_on_front(trade_of(runs)) == {"accuracy: draft"}
    words = advice([trade_of(runs)], 1e-4).sentence
    assert words == "Take accuracy: draft (0.1 s): it comes to the same verdict as the reference."


def test_a_load_factor_of_nothing_is_compared_with_the_least_that_counts() -> None:
    zero = measured(0.0, 1.0, least=1e-3)
    assert distance(measured(1e-9, 1.0, least=1e-3), zero) == pytest.approx(1e-6)


def test_a_travelling_load_counts_as_its_worst_position_and_errs_as_its_farthest() -> None:
    def positions(factors: tuple[float, ...], wall: float) -> list[Measurement]:
        return [measured(factor, wall, case=f"axle_{i}", series="axle") for i, factor in enumerate(factors)]

    unbounded = measured(math.nan, 1.0, case="axle_2", series="axle", status="unbounded", verdict="unbounded")
    runs = [
        run_of("accuracy: reference", *positions((3.0, 2.0), 1.0), unbounded),
        run_of("accuracy: draft", *positions((3.3, 2.0), 0.1), unbounded),
        run_of("form: static", *positions((3.0,), 0.1)),
    ]
    trade = trade_of(runs, "axle", 3)
    first, second, third = trade.rows
    assert first.measurement is not None
    assert (first.measurement.answer, first.measurement.wall, first.measurement.positions) == (2.0, 3.0, 3)
    assert first.measurement.status == "solved"  # a position that nothing brings down is no failure beside others
    assert second.distance == pytest.approx(0.1)
    assert third.measurement is None  # it was stopped on the way
    assert not third.sound


def test_advice_for_several_load_cases_must_hold_in_each() -> None:
    other = [
        replace(run, measurements=tuple(replace(m, case="lift", answer=2 * m.answer) for m in run.measurements))
        for run in ladder()
    ]
    other[0] = run_of("accuracy: standard", measured(1.1, 0.8, case="lift"))
    runs = [
        replace(one, measurements=one.measurements + two.measurements) for one, two in zip(ladder(), other, strict=True)
    ]
    trades = case_trades([("push", 0), ("lift", 0)], runs)
    assert advice(trades[:1], 1e-4).rung == "accuracy: standard"
    both = advice(trades, 1e-4)
    assert both.rung == "form: static"
    assert both.seconds == pytest.approx(3.0)
