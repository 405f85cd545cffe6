"""Recorded figures: rows replaced and added, exponents of growth."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.performance import recording
from tests.performance.recording import read_rows, record
from tests.performance.tables import exponent, growth_table


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(recording, "RESULTS", tmp_path)
    monkeypatch.setattr(recording, "versions", lambda: "mbla 1")
    return tmp_path


def measure(case: str, seconds: float, **more: object) -> None:
    record("sweep", {"sweep": case, "way": "shared", "points": 1, "seconds": seconds, **more})


def test_what_is_measured_again_replaces_the_row_of_that_release(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for case, seconds in (("a", 1.0), ("b", 4.0), ("a", 1.5)):
        measure(case, seconds)
    monkeypatch.setattr(recording, "versions", lambda: "mbla 2")
    measure("b", 5.0)
    found = [(row["sweep"], row["seconds"], row["versions"]) for row in read_rows(folder / "sweep.csv")]
    assert found == [("b", "4", "mbla 1"), ("a", "1.5", "mbla 1"), ("b", "5", "mbla 2")]


def test_a_row_of_other_columns_is_refused_and_the_file_stays(folder: Path) -> None:
    measure("a", 1.0)
    before = (folder / "sweep.csv").read_bytes()
    with pytest.raises(ValueError, match="has the columns"):
        measure("a", 1.0, clock=2.0)
    assert (folder / "sweep.csv").read_bytes() == before


def test_a_power_law_gives_its_exponent() -> None:
    blocks = [100.0, 200.0, 500.0, 10_000.0]
    slope, left = exponent(blocks, [3e-4 * n**1.5 for n in blocks])
    assert slope == pytest.approx(1.5, rel=1e-12)
    assert left == pytest.approx(0.0, abs=1e-12)


def test_growth_rests_on_walls_that_came_to_their_end() -> None:
    sizes = {10: 105, 20: 410, 40: 1620, 60: 3630}
    rows = [
        {"structure": f"wall, planar, {side} x {side}", "flow_rule": "associative", "blocks": str(blocks)}
        | {"status": "solved", "programs": str(blocks**2), "processor": str(blocks)}
        for side, blocks in sizes.items()
    ]
    rows[-1] |= {"status": "stopped", "programs": ""}
    assert list(growth_table(rows))[2:] == ["| wall, planar | associative | 105 to 1620 | 2.00 ± 0.00 | 1.00 ± 0.00 |"]
    assert len(list(growth_table(rows[:2]))) == 2
