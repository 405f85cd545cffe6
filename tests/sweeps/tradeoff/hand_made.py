"""Measurements and runs made by hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from mbla.deck.units import Units
from mbla.sweeps.measure.measurement import Measurement
from mbla.sweeps.measure.setting import Setting
from mbla.sweeps.tradeoff.advice import advice
from mbla.sweeps.tradeoff.ladder_run import Limits, RungRun
from mbla.sweeps.tradeoff.rung import Rung
from mbla.sweeps.tradeoff.study import Study
from mbla.sweeps.tradeoff.trade import case_trades

SOLVED = Measurement("push", "solved", "answer", verified=True, answer=0.5, accuracy=1e-9, wall=1.0)


def measured(answer: float, wall: float, **changes: Any) -> Measurement:
    """A solved and verified load factor that took ``wall`` seconds."""
    return replace(SOLVED, answer=answer, wall=wall, **changes)


def run_of(name: str, *measurements: Measurement, model: str = "") -> RungRun:
    """A rung that was run to its end."""
    return RungRun(Rung(name, Setting((f"analysis.{name.replace(': ', '=')}",)), model=model), measurements, "done")


def ladder() -> list[RungRun]:
    """A preset of each kind, a fast one that is not verified, a dominated one and another model, faster and nearer."""
    return [
        run_of("accuracy: standard", measured(0.50001, 0.8)),
        run_of("accuracy: reference", measured(0.5, 2.0)),
        run_of("accuracy: draft", measured(0.5005, 0.2)),
        run_of("form: static", measured(0.50002, 1.5)),
        run_of("solver: clarabel", measured(0.5, 0.1, status="not_verified", verified=False)),
        run_of("flow_rule: associative", measured(0.5, 0.1), model="flow_rule"),
    ]


def study_of(runs: Sequence[RungRun], case: str = "push", positions: int = 0) -> Study:
    """The study of one load case that these runs make; with positions of a load that travels."""
    trades = case_trades([(case, positions)], runs)
    return Study(
        deck="a.yaml", title="A", overrides=(), units=Units(), flow_rule="associative", wanted=1e-4, limits=Limits(),
        runs=tuple(runs), trades=trades, advices=(advice(trades, 1e-4),), seconds=1.0, provenance={"mbla": "0"},
    )  # fmt: skip


def travelling(name: str, *factors: float) -> RungRun:
    """A rung under the positions of a load that travels."""
    return run_of(
        name, *(measured(factor, 1.0, case=f"axle_{i}", series="axle") for i, factor in enumerate(factors, 1))
    )
