"""Shares of records with which a structure in time falls or moves too far, from outcomes that are known."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.stats import norm

from mbla.deck.units import Units
from mbla.results.record.json_values import json_line
from mbla.sweeps.design.design import Design, DesignDimension, DesignPoint, SweepColumn
from mbla.sweeps.file.content import FragilitySection
from mbla.sweeps.fragility import Asked, asked_of, fragility_csv, fragility_lines, fragility_of
from mbla.sweeps.fragility_curve import curve_lines, fragility_curves, lognormal_fit, probability
from mbla.sweeps.plan import DONE, FAILED, Plain, PointOutcome
from mbla.sweeps.results import result_columns
from mbla.sweeps.tables.sweep_table import SweepTable, sweep_table

RESULTS = ("status", "time_history.peak", "time_history.fallen")
Moved = tuple[str, float | None, int | None]
"""status, peak and blocks that fall, of a point"""
FALLS, DOES_NOT_STAND, NOTHING = ("solved", 0.4, 1), ("no_equilibrium", None, None), ("time_limit", None, None)
SCALES = (0.5, 1.0, 2.0)


def moves(peak: float) -> Moved:
    return ("solved", peak, 0)


def shaken(points: Sequence[Sequence[Moved]], scales: Sequence[float] = SCALES) -> SweepTable:
    """A row of points for each scale, one for each record."""
    records = [f"record_{number}.csv" for number in range(len(points[0]))]
    columns = (
        SweepColumn("scale", "", "scale", "float", "parameter", "scale"),
        SweepColumn("record", "", "record", "text", "parameter", "record"),
    )
    design, outcomes = list[DesignPoint](), dict[str, PointOutcome]()
    for row, each in enumerate(points):
        for place, (status, peak, fallen) in enumerate(each):
            results: dict[str, Any] = {"status": status, "time_history.peak": peak, "time_history.fallen": fallen}
            state = FAILED if status == "time_limit" else DONE
            outcomes[f"{row} {place}"] = PointOutcome(f"{row} {place}", state, 0, "", results, 1, 0.1)
            design.append(DesignPoint(len(design) + 1, (row, place), (scales[row], records[place]), {}))
    dimensions = (DesignDimension("scale", len(scales)), DesignDimension("record", len(records)))
    made = Design(columns, dimensions, tuple(design), (tuple(scales), tuple(records)), 0)
    return sweep_table("", made, result_columns(RESULTS, ("quake",), Units()), outcomes, list(outcomes))


def asked(table: SweepTable, limits: Sequence[float | str] = (0.1, "falls"), over: str | None = "scale") -> Asked:
    return asked_of(FragilitySection(result="time_history.peak", limit=list(limits), sample="record", over=over), table)


TABLE = shaken(
    [
        [moves(0.01), moves(0.02), moves(0.03), moves(0.1)],
        [moves(0.05), moves(0.2), FALLS, moves(0.05)],
        [FALLS, moves(0.3), NOTHING, DOES_NOT_STAND],
    ]
)


def test_what_still_moves_at_its_end_may_fall_later() -> None:
    """It is unknown for limits that it has not reached."""
    outcomes = [("a", 0.05, 0, True), ("b", 0.2, 0, True), ("c", 0.05, 0, False), ("d", 0.4, 1, False)]
    names, paths = [name for name, *_ in outcomes], (*RESULTS, "time_history.still_moves")
    points, design = dict[str, PointOutcome](), list[DesignPoint]()
    for place, (name, *values) in enumerate(outcomes):
        results: dict[str, Plain] = dict(zip(paths, ("solved", *values), strict=True))
        points[name] = PointOutcome(name, DONE, 0, "", results, 1, 0.1)
        design.append(DesignPoint(place + 1, (place,), (f"{name}.csv",), {}))
    column = SweepColumn("record", "", "record", "text", "parameter", "record")
    made = Design((column,), (DesignDimension("record", 4),), tuple(design), (tuple(names),), 0)
    table = sweep_table("", made, result_columns(paths, ("quake",), Units()), points, names)
    (one,) = fragility_of(table, asked(table, over=None))
    assert [each["passing"] for each in one["limits"]] == [2, 1]
    assert [each["probability"] for each in one["limits"]] == [[0.5, 0.75], [0.25, 0.75]]


def test_what_falls_passes_every_limit() -> None:
    """A limit is reached by what is on it; what does not stand falls at once; what was not solved is unknown."""
    found = fragility_of(TABLE, asked(TABLE))
    assert [one["at"] for one in found] == [{"scale": scale} for scale in SCALES]
    assert [[each["passing"] for each in one["limits"]] for one in found] == [[1, 0], [2, 1], [3, 2]]
    assert [each["limit"] for each in found[0]["limits"]] == [0.1, "falls"]
    assert [one["unknown"] for one in found] == [0, 0, 1]
    assert found[2]["limits"][1]["probability"] == [0.5, 0.75]
    assert {one["sampling"] for one in found} == {"values"}
    assert all(one["demands"] == [] for one in found)
    json_line(found[0])


def test_what_falls_passes_also_limits_beyond_its_last_place() -> None:
    (*_, last) = fragility_of(TABLE, asked(TABLE, limits=(5.0,)))
    assert last["limits"][0]["passing"] == 2


def test_the_table_of_shares() -> None:
    found = fragility_of(TABLE, asked(TABLE))
    rows = list(csv.DictReader(fragility_csv(found, TABLE).splitlines()))
    assert [row["limit [m]"] for row in rows[:2]] == ["0.1", "falls"]
    assert [row["passing"] for row in rows] == ["1", "0", "2", "1", "3", "2"]
    said = " ".join(" ".join(fragility_lines(found, TABLE)).split())
    assert "probability that a result reaches a limit" in said
    assert "the sample is a list of values" in said
    assert "as below and as above a limit" in said


# --- curves -------------------------------------------------------------------------------------------------------


def test_a_curve_is_the_likeliest() -> None:
    """Of many points drawn from a curve it comes near; likelihood has no slope there."""
    rng = np.random.default_rng(2)
    x = np.repeat(np.linspace(0.2, 3.0, 15), 400)
    passing = rng.uniform(size=len(x)) < probability(x, 1.1, 0.4)
    median, dispersion = lognormal_fit(x, passing)
    assert (median, dispersion) == pytest.approx((1.1, 0.4), rel=0.05)
    z = np.log(x / median) / dispersion
    slope = np.where(passing, norm.pdf(z) / norm.cdf(z), -norm.pdf(z) / norm.sf(z))
    assert abs(slope.sum()) < 1e-2
    assert abs((slope * z).sum()) < 1e-2


def test_a_curve_through_two_shares() -> None:
    """Two values of the parameter: the curve goes through both."""
    x, passing = np.repeat([1.0, 2.0], 10), np.tile(np.arange(10), 2) < np.repeat([2, 7], 10)
    median, dispersion = lognormal_fit(x, passing)
    assert probability(np.array([1.0, 2.0]), median, dispersion) == pytest.approx([0.2, 0.7], abs=1e-6)
    exact = brentq(lambda beta: norm.ppf(0.7) * beta - (math.log(2.0) + norm.ppf(0.2) * beta), 0.1, 5.0)
    assert dispersion == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize(
    "passing",
    [[0, 0, 0, 0], [1, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1], [1, 0, 0, 0]],
    ids=["none", "all", "a step", "a step at the last", "the weakest alone"],
)
def test_shares_without_a_curve(passing: list[int]) -> None:
    found = lognormal_fit(np.array([1.0, 2.0, 3.0, 4.0]), np.array(passing, dtype=bool))
    assert all(map(math.isnan, found))


def test_curves_of_a_table() -> None:
    found = fragility_curves(TABLE, asked(TABLE))
    assert [(one["limit"], one["points"], one["passing"], one["at"]) for one in found] == [
        (0.1, 11, 6, {}),
        ("falls", 11, 3, {}),
    ]
    assert 0.5 < found[0]["median"] < 2.0
    said = " ".join(" ".join(curve_lines(found, TABLE)).split())
    assert "lognormal curves over scale" in said
    json_line(found[0])
    assert fragility_curves(TABLE, asked(TABLE, over=None)) == []


def test_a_step_has_no_curve_and_says_so() -> None:
    table = shaken([[moves(0.01)] * 3, [FALLS] * 3], scales=(1.0, 2.0))
    found = fragility_curves(table, asked(table, limits=("falls",)))
    assert (found[0]["median"], found[0]["dispersion"]) == (None, None)
    assert "no curve" in " ".join(curve_lines(found, table))
