"""The exponent of growth, and how many blocks the walls have."""

from __future__ import annotations

import math

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
    rows: list[dict[str, object]] = [{"blocks": n, "solver": n**2 * 1e-6, "total": n * 1e-3} for n in (100, 200, 400)]
    rows.append({"blocks": 800, "solver": "", "total": ""})
    recorded: list[dict[str, object]] = []
    monkeypatch.setattr(bench_growth, "record", lambda name, row: recorded.append(row))
    record_exponents("wall, planar", "associative", rows)
    assert [(row["time"], row["sizes"], row["most_blocks"]) for row in recorded] == [
        ("solver", 3, 400.0),
        ("total", 3, 400.0),
    ]
    assert [row["exponent"] for row in recorded] == [pytest.approx(2.0), pytest.approx(1.0)]


def test_a_run_says_its_size_and_what_it_found() -> None:
    row = measured("wall, planar", "associative", 5)
    assert row["blocks"] == blocks_of(5) == 27
    assert row["status"] == "solved"
    assert row["load_factor"] == pytest.approx(0.65, rel=1e-6)
    assert float(str(row["solver"])) < float(str(row["total"]))
