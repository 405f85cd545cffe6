"""Recorded figures: rows replaced and added, release against release, exponents of growth."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tests.performance import recording
from tests.performance.compare import TIMES, compared, judged_values, lines_of, main
from tests.performance.recording import CASES, RESULTS, Row, read_rows, record
from tests.performance.tables import exponent, growth_table


def row(case: str, seconds: str, date: str = "2026-01-01", versions: str = "mbla 1", machine: str = "here") -> Row:
    figures = {"case": case, "stage": "read", "seconds": seconds, "processor_seconds": ""}
    return {"date": date, **figures, "versions": versions, "machine": machine}


def ratios(*rows: Row, against: str = "") -> dict[str, float | None]:
    return {ratio.case.split(",")[0]: ratio.value for ratio in compared(rows, "stages", against)}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(recording, "RESULTS", tmp_path)
    monkeypatch.setattr(recording, "versions", lambda: "mbla 1")
    return tmp_path


def measure(case: str, seconds: float, **more: object) -> None:
    record("stages", {"case": case, "stage": "read", "seconds": seconds, "processor_seconds": seconds, **more})


def test_what_is_measured_again_replaces_the_row_of_that_release(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for case, seconds in (("a", 1.0), ("b", 4.0), ("a", 1.5)):
        measure(case, seconds)
    monkeypatch.setattr(recording, "versions", lambda: "mbla 2")
    measure("b", 5.0)
    found = [(row["case"], row["seconds"], row["versions"]) for row in read_rows(folder / "stages.csv")]
    assert found == [("b", "4", "mbla 1"), ("a", "1.5", "mbla 1"), ("b", "5", "mbla 2")]


def test_a_row_of_other_columns_is_refused_and_the_file_stays(folder: Path) -> None:
    measure("a", 1.0)
    before = (folder / "stages.csv").read_bytes()
    with pytest.raises(ValueError, match="has the columns"):
        measure("a", 1.0, clock=2.0)
    assert (folder / "stages.csv").read_bytes() == before


def test_the_newest_rows_of_each_case_against_those_before() -> None:
    rows = (row("a", "1"), row("b", "2"), row("a", "3", date="2026-02-01"), row("b", "1", versions="mbla 2"))
    assert ratios(*rows, row("c", "1")) == {"a": 3.0, "b": 0.5}  # nothing to compare the last one with


def test_only_the_machine_of_the_last_row_counts() -> None:
    rows = (row("a", "2"), row("a", "100", versions="mbla 2", machine="other"), row("a", "1", versions="mbla 3"))
    assert ratios(*rows) == {"a": 0.5}


def test_against_an_older_release() -> None:
    rows = [row("a", "8", versions="mbla 1"), row("a", "2", versions="mbla 2"), row("a", "1", versions="mbla 3")]
    assert ratios(*rows) == {"a": 0.5}
    assert ratios(*rows, against="mbla 1") == {"a": 0.125}
    assert ratios(*rows, against="mbla 4") == {}


def test_what_no_longer_comes_to_its_end_is_infinitely_slower() -> None:
    assert ratios(row("a", "1"), row("a", "", date="2")) == {"a": math.inf}
    assert ratios(row("a", ""), row("a", "1", date="2")) == {"a": None}


def test_worst_first_and_very_short_times_are_not_judged() -> None:
    rows = [row(case, "1") for case in "ab"] + [row("c", "0.001")]
    rows += [row("a", "1", date="2"), row("b", "2", date="2"), row("c", "0.009", date="2")]
    found = compared(rows, "stages")
    assert sorted(judged_values(found)) == [1.0, 2.0]
    lines = list(lines_of("stages", found))
    assert [line.split()[0] for line in lines[:3]] == ["9.00", "2.00", "1.00"]
    assert lines[0].endswith("c, read: seconds  (not judged)")
    assert lines[3] == "stages: worst 2.00, median 1.50 (2 times)"


def test_exit_status_with_a_factor(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = (",".join(each.values()) for each in (row("a", "1"), row("a", "1.5", date="2")))
    (folder / "stages.csv").write_text("\n".join([",".join(row("a", "1")), *lines]))
    assert main([], folder) == main(["--fail", "1.6"], folder) == 0
    assert main(["stages", "--fail", "1.4"], folder) == 1
    assert "1 times are more than 1.4 times as long" in capsys.readouterr().out
    with pytest.raises(SystemExit) as refused:
        main(["y"], folder)
    assert refused.value.code == 2


@pytest.mark.parametrize("path", sorted(RESULTS.glob("*.csv")), ids=lambda path: path.stem)
def test_every_recorded_benchmark_can_be_compared(path: Path) -> None:
    rows = read_rows(path)
    assert set(CASES[path.stem]) <= set(rows[0])
    assert set(TIMES) & set(rows[0])
    compared(rows, path.stem)


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
