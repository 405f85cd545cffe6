"""Probabilities below a demand, from outcomes whose probabilities are known."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pytest
from scipy.stats import binomtest, lognorm, norm

from mbla.arrays import FloatArray
from mbla.deck.units import Units
from mbla.results.record.json_values import json_line
from mbla.sweeps.design.design import Design, DesignDimension, DesignPoint, SweepColumn
from mbla.sweeps.fragility import Asked, fragility_csv, fragility_lines, fragility_of, interval
from mbla.sweeps.plan import DONE, FAILED, PointOutcome
from mbla.sweeps.results import result_columns
from mbla.sweeps.tables.sweep_table import SweepTable, sweep_table

RESULTS = ("status", "load_factor", "mechanism.class", "mechanism.moving_weight_share")
Found = tuple[str, str, float | None]
"""state, status, load factor of a point"""


def table_of(
    points: Sequence[Sequence[Found]],
    sampling: str = "random",
    thickness: Sequence[float] = (),
    asked: Sequence[str] = RESULTS,
) -> SweepTable:
    """A table of samples, one row of points for each thickness, or for none."""
    thick = list(thickness) or [0.0]
    outside = [SweepColumn("t", "m", "thickness", "float", "parameter", "t")] if thickness else []
    columns = (*outside, SweepColumn("mu", "", "friction", "float", "parameter", "sample", random=True))
    dimensions = (*([DesignDimension("t", len(thick))] if thickness else []), DesignDimension("sample", len(points[0])))
    design: list[DesignPoint] = []
    outcomes: dict[str, PointOutcome] = {}
    for row, each in enumerate(points):
        for place, (state, status, factor) in enumerate(each):
            key = f"{row} {place}"
            results = {"status": status, "load_factor": factor, "mechanism.moving_weight_share": factor}
            outcomes[key] = PointOutcome(key, state, 0, "", results, 1, 0.1)
            at, values = ((row,), (thick[row],)) if thickness else ((), ())
            design.append(DesignPoint(len(design) + 1, (*at, place), (*values, 0.5), {}))
    levels = (*([tuple(thick)] if thickness else []), (0.5,) * len(points[0]))
    return sweep_table(
        "",
        Design(columns, dimensions, tuple(design), levels, 0, "sample", sampling),
        result_columns(asked, ("push",), Units()),
        outcomes,
        list(outcomes),
    )


def found_of(table: SweepTable, result: str, demands: Sequence[float], confidence: float) -> list[dict[str, Any]]:
    """Of the random sample of a table."""
    return fragility_of(table, Asked(result, tuple(demands), (), table.samples, table.sampling, "", confidence))


def solved(factors: FloatArray | Sequence[float]) -> list[Found]:
    return [(DONE, "solved", float(factor)) for factor in factors]


# --- a sliding block: the load factor is the friction -------------------------------------------------------------

MEAN, DEVIATION, DEMAND, POINTS = 0.6, 0.12, 0.45, 60
SPREAD = np.sqrt(np.log(1 + (DEVIATION / MEAN) ** 2))
FRICTION = lognorm(s=SPREAD, scale=MEAN * np.exp(-(SPREAD**2) / 2))
EXACT = float(FRICTION.cdf(DEMAND))


def coverage(samples: Sequence[FloatArray], confidence: float) -> float:
    """Share of samples whose interval holds the exact probability."""
    below = [int((sample < DEMAND).sum()) for sample in samples]
    ends = {count: interval(count, 0, POINTS, confidence) for count in set(below)}
    return float(np.mean([ends[count][0] <= EXACT <= ends[count][1] for count in below]))


def test_the_probability_of_a_sliding_block() -> None:
    """P(mu < demand) of a lognormal friction; a large sample comes near, and its interval holds it."""
    factors = FRICTION.rvs(4000, random_state=np.random.default_rng(1))
    (found,) = found_of(table_of([solved(factors)]), "load_factor", (DEMAND,), 0.99)
    assert pytest.approx(norm.cdf((np.log(DEMAND / MEAN) + SPREAD**2 / 2) / SPREAD)) == EXACT
    (one,) = found["demands"]
    lower, upper = one["interval"]
    assert lower < EXACT < upper < lower + 0.03
    assert one["probability"] == [np.mean(factors < DEMAND)] * 2


@pytest.mark.parametrize("confidence", [0.5, 0.9, 0.95, 0.99])
def test_the_interval_holds_its_confidence_over_many_samples(confidence: float) -> None:
    """At least as often as it says: 4000 samples, three standard errors of that count."""
    draws = FRICTION.rvs((4000, POINTS), random_state=np.random.default_rng(2))
    scatter = 3 * np.sqrt(confidence * (1 - confidence) / 4000)
    assert coverage(list(draws), confidence) >= confidence - scatter


@pytest.mark.parametrize(("below", "points"), [(0, 20), (1, 20), (7, 20), (20, 20), (3, 500)])
def test_the_interval_is_that_of_clopper_and_pearson(below: int, points: int) -> None:
    expected = binomtest(below, points).proportion_ci(0.95, "exact")
    assert interval(below, 0, points, 0.95) == pytest.approx((expected.low, expected.high), rel=1e-9)


def below_of(found: Mapping[str, Any]) -> list[int]:
    return [one["below"] for one in found["demands"]]


# --- answers that are no load factor ------------------------------------------------------------------------------

MIXED: list[Found] = [
    (DONE, "solved", 0.2),
    (DONE, "solved", 0.4),
    (DONE, "no_equilibrium", None),
    (DONE, "unbounded", None),
    (FAILED, "not_verified", None),
]


def test_a_share_has_no_side_for_what_does_not_stand() -> None:
    (found,) = found_of(table_of([MIXED], asked=RESULTS[1:]), "mechanism.moving_weight_share", (0.3,), 0.95)
    assert (below_of(found), found["unknown"]) == ([1], 3)


def test_what_does_not_stand_is_below_and_what_never_falls_above() -> None:
    (found,) = found_of(table_of([MIXED[:4]]), "load_factor", (0.1, 0.2, 0.3, 9.0), 0.95)
    assert below_of(found) == [1, 1, 2, 3]  # a load factor equal to the demand bears it
    assert found["unknown"] == 0


def test_what_never_falls_reaches_every_limit() -> None:
    table = table_of([MIXED])
    (found,) = fragility_of(table, Asked("load_factor", (), (0.2, 0.3, 9.0), table.samples, table.sampling))
    assert [one["passing"] for one in found["limits"]] == [3, 2, 1]
    assert (found["unknown"], found["demands"], found["sampling"]) == (1, [], "random")


def test_a_failed_point_is_counted_both_ways() -> None:
    table = table_of([MIXED])
    (found,) = found_of(table, "load_factor", (0.3,), 0.95)
    assert (below_of(found), found["unknown"], found["points"]) == ([2], 1, 5)
    assert found["demands"][0]["probability"] == [0.4, 0.6]
    ends = [binomtest(count, 5).proportion_ci(0.95, "exact") for count in (2, 3)]
    assert found["demands"][0]["interval"] == pytest.approx([ends[0].low, ends[1].high])
    text = " ".join(" ".join(fragility_lines([found], table)).split())
    assert "load_factor 0.3 5 2 1 0.4 0.6 " in text
    assert "counted both as below and as above a demand" in text


# --- words and files ----------------------------------------------------------------------------------------------


def test_each_combination_of_what_is_not_sampled_stands_by_itself() -> None:
    table = table_of([solved([0.1, 0.2]), solved([0.3, 0.4])], "sobol", (0.25, 1 / 3))
    found = found_of(table, "load_factor", (0.15, 0.35), 0.9)
    assert [one["at"] for one in found] == [{"t": 0.25}, {"t": 1 / 3}]
    assert list(map(below_of, found)) == [[1, 2], [0, 1]]
    json_line({"fragility": found})
    assert found[1]["demands"][1]["probability"] == [0.5, 0.5]
    rows = list(csv.DictReader(fragility_csv(found, table).splitlines()))
    assert [(float(row["t [m]"]), float(row["demand"]), int(row["below"])) for row in rows] == [
        (0.25, 0.15, 1),
        (0.25, 0.35, 2),
        (1 / 3, 0.15, 0),
        (1 / 3, 0.35, 1),
    ]
    lines = fragility_lines(found, table)
    assert " ".join(lines[1].split()) == "result t [m] demand points below unknown at least at most from to"
    assert lines[2].split() == ["load_factor", "0.25", "0.15", "2", "1", "0", "0.5", "0.5", "0.02532", "0.9747"]
    assert "sobol" in " ".join(lines[6:])


def test_a_value_that_is_the_demand_but_for_rounding_bears_it() -> None:
    table = table_of([solved([0.3 * (1 - 1e-9), 0.3 * (1 - 1e-5)])])
    (found,) = found_of(table, "load_factor", (0.3,), 0.95)
    assert below_of(found) == [1]
