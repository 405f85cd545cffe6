"""The exponent of growth, and how many blocks the walls have."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from tests.performance import bench_growth
from tests.performance.bench_growth import blocks_of, exponent, measured, record_exponents


def test_a_power_law_gives_its_exponent() -> None:
    blocks = [100.0, 200.0, 500.0, 10_000.0]
    slope, left = exponent(blocks, [3e-4 * n**1.5 for n in blocks])
    assert slope == pytest.approx(1.5, rel=1e-12)
    assert left == pytest.approx(0.0, abs=1e-12)


def test_scatter_is_told_as_deviation() -> None:
    """Half of the times a factor e above the line and half below: the slope stays, the deviation is 1."""
    blocks = [100.0, 100.0, 1000.0, 1000.0]
    slope, left = exponent(blocks, [n * math.exp(sign) for n, sign in zip(blocks, (1, -1, 1, -1), strict=True)])
    assert slope == pytest.approx(1.0)
    assert left == pytest.approx(1.0)


def test_two_sizes_have_no_exponent() -> None:
    assert all(math.isnan(value) for value in exponent([100.0, 200.0], [1.0, 2.0]))


def test_stopped_runs_do_not_enter_the_exponent(monkeypatch: pytest.MonkeyPatch) -> None:
    rows: list[dict[str, object]] = [
        {"blocks": n, "status": "solved", "solver": n**2 * 1e-6, "total": n * 1e-3} for n in (100, 200, 400)
    ]
    rows.append({"blocks": 600, "status": "numerical_error", "solver": 1e-3, "total": 2e-3})  # broke off early
    rows.append({"blocks": 800, "status": "stopped after 10 s", "solver": "", "total": ""})
    recorded: list[dict[str, object]] = []
    monkeypatch.setattr(bench_growth, "record", lambda name, row: recorded.append(row))
    record_exponents("wall, planar", "associative", rows)
    assert [(row["time"], row["sizes"], row["most_blocks"]) for row in recorded] == [
        ("solver", 3, 400.0),
        ("total", 3, 400.0),
    ]
    assert [row["exponent"] for row in recorded] == [pytest.approx(2.0), pytest.approx(1.0)]


def test_an_exponent_is_said_with_the_sizes_it_rests_on() -> None:
    row: dict[str, object] = {"family": "wall, spatial", "flow_rule": "associative", "time": "total", "sizes": 4}
    row |= {"fewest_blocks": 105.0, "most_blocks": 3630.0, "exponent": 1.234, "deviation": 0.05}
    said = bench_growth.sentence(row)
    assert "1.23" in said
    assert "4 sizes from 105 to 3,630 blocks" in said
    assert "no exponent, only 2" in bench_growth.sentence(row | {"sizes": 2, "exponent": math.nan})


def test_runs_share_a_budget_and_none_is_begun_without_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of these takes 40 s; 100 are left for all: the third gets 20 s, after which there is nothing."""
    taken, limits = [0.0], []

    def child(module: str, what: Sequence[str], limit: float) -> dict[str, object]:
        limits.append(limit)
        taken[0] += min(limit, 40.0)
        return {"status": "solved"}

    monkeypatch.setattr(bench_growth, "in_child", child)
    monkeypatch.setattr(bench_growth, "_taken", lambda: taken[0])
    budget = bench_growth.Budget(100.0)
    found = [str(budget.run(["wall"], 70.0)["status"]) for _ in range(4)]
    assert limits == [70.0, 60.0, 20.0]
    assert found == ["solved", "solved", "solved", "not begun: no time left"]


def test_a_run_says_its_size_and_what_it_found() -> None:
    row = measured("wall, planar", "associative", 5)
    assert row["blocks"] == blocks_of(5) == 27
    assert row["status"] == "solved"
    assert row["load_factor"] == pytest.approx(0.65, rel=1e-6)
    assert float(str(row["solver"])) < float(str(row["total"]))
