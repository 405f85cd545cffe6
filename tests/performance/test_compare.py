"""Release against release, on rows made by hand."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import pytest

from tests.performance import compare, recording
from tests.performance.all import benchmarks, minutes_of, total_of
from tests.performance.columns import COLUMNS, Columns, columns_of
from tests.performance.compare import TIMELESS, Row, compared, lines_of, main, read_rows

CASES = Columns(("case",), ("seconds",))


def row(case: str, seconds: str, date: str = "2026-01-01", versions: str = "mbla 1", machine: str = "here") -> Row:
    return {"date": date, "case": case, "seconds": seconds, "versions": versions, "machine": machine}


def ratios(*rows: Row, against: str = "") -> dict[str, float | None]:
    return {ratio.case: ratio.value for ratio in compared(rows, CASES, against).ratios}


def test_the_newest_rows_of_each_case_against_those_before() -> None:
    rows = (row("a", "1"), row("b", "2"), row("a", "3", date="2026-02-01"), row("b", "1", date="2026-02-01"))
    assert ratios(*rows) == {"a": 3.0, "b": 0.5}


def test_another_version_of_the_same_day_is_another_release() -> None:
    assert ratios(row("a", "1"), row("a", "4", versions="mbla 2")) == {"a": 4.0}


def test_the_shortest_of_several_rows_of_one_release_counts() -> None:
    assert ratios(row("a", "2"), row("a", "1"), row("a", "9", date="2"), row("a", "3", date="2")) == {"a": 3.0}


def test_only_the_machine_of_the_last_row_counts() -> None:
    rows = (row("a", "2"), row("a", "100", versions="mbla 2", machine="other"), row("a", "1", versions="mbla 3"))
    assert ratios(*rows) == {"a": 0.5}


def test_against_an_older_release() -> None:
    rows = [row("a", "8", versions="mbla 1"), row("a", "2", versions="mbla 2"), row("a", "1", versions="mbla 3")]
    assert ratios(*rows) == {"a": 0.5}
    assert ratios(*rows, against="mbla 1") == {"a": 0.125}
    assert ratios(*rows, against="mbla 4") == {}


def test_a_case_without_earlier_rows_is_counted_and_not_compared() -> None:
    comparison = compared([row("a", "1"), row("a", "1", date="2"), row("b", "1", date="2")], CASES)
    assert [ratio.case for ratio in comparison.ratios] == ["a"]
    assert comparison.alone == 1


def test_what_no_longer_comes_to_its_end_is_infinitely_slower() -> None:
    (ratio,) = compared([row("a", "1"), row("a", "", date="2")], CASES).ratios
    assert ratio.value == math.inf
    assert ratio.judged
    (ratio,) = compared([row("a", ""), row("a", "1", date="2")], CASES).ratios
    assert ratio.value is None


def test_very_short_times_are_shown_and_not_judged() -> None:
    comparison = compared([row("a", "0.001"), row("a", "0.004", date="2")], CASES)
    assert comparison.ratios[0].value == pytest.approx(4.0)
    assert comparison.values() == []
    lines = list(lines_of("x", comparison))
    assert lines[0].endswith("a: seconds  (not judged)")
    assert lines[1] == "x: nothing to compare (0 times)"


def test_worst_first_then_worst_and_median() -> None:
    rows = [row(case, "1") for case in "abc"] + [row(case, str(n), date="2") for n, case in enumerate("abc", 1)]
    lines = list(lines_of("x", compared(rows, CASES)))
    assert [line.split()[0] for line in lines[:3]] == ["3.00", "2.00", "1.00"]
    assert lines[3] == "x: worst 3.00, median 2.00 (3 times)"


def write(folder: Path, rows: list[Row]) -> None:
    with (folder / "x.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def test_exit_status_with_a_factor(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path, [row("a", "1"), row("b", "1"), row("a", "1.5", date="2"), row("b", "1", date="2")])
    assert main([], tmp_path) == 0
    assert main(["--fail", "1.6"], tmp_path) == 0
    assert main(["x", "--fail", "1.4"], tmp_path) == 1
    assert "1 times are more than 1.4 times as long" in capsys.readouterr().out
    with pytest.raises(SystemExit) as refused:
        main(["y"], tmp_path)
    assert refused.value.code == 2


@pytest.mark.parametrize("path", sorted(recording.RESULTS.glob("*.csv")), ids=lambda path: path.stem)
def test_every_recorded_benchmark_can_be_compared(path: Path) -> None:
    """Its columns are there, and its last row has a time: nothing of it would be left out in silence."""
    if path.stem in TIMELESS:
        return
    rows = read_rows(path)
    columns = columns_of(path.stem, list(rows[0]))
    assert columns.times
    assert set(columns.case + columns.times) <= set(rows[0])
    if path.stem not in COLUMNS:
        assert any(row[name] for row in rows for name in columns.times)
    compared(rows, columns)


def test_a_benchmark_without_times_says_so() -> None:
    with pytest.raises(ValueError, match="no column of seconds"):
        columns_of("other", ["date", "case", "ratio"])


def test_minutes_are_those_of_the_last_run_else_estimated(tmp_path: Path) -> None:
    assert set(benchmarks()) >= {"rivals", "growth", "solver"}
    assert minutes_of("rivals", tmp_path) == pytest.approx(30.0)
    assert minutes_of("unheard of", tmp_path) is None
    assert all(minutes_of(name, tmp_path) is not None for name in benchmarks())
    assert total_of([1.5, None, 3.0]) == "3 benchmarks, together about 4 minutes on an idle machine and those of 1 more"
    (tmp_path / "all.csv").write_text("date,benchmark,clock\n1,rivals,120\n2,rivals,180\n")
    assert minutes_of("rivals", tmp_path) == pytest.approx(3.0)


def test_a_row_with_other_columns_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "RESULTS", tmp_path)
    recording.record("x", {"case": "a", "seconds": 1.0})
    recording.record("x", {"case": "b", "seconds": 2.0})
    with pytest.raises(ValueError, match="the row has date, case, clock"):
        recording.record("x", {"case": "a", "clock": 1.0})
    assert [row["case"] for row in read_rows(tmp_path / "x.csv")] == ["a", "b"]
    assert compare.read_rows(tmp_path / "x.csv")[0]["versions"] == recording.versions()


def test_a_benchmark_that_cannot_be_compared_does_not_keep_the_others_from_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path, [row("a", "1"), row("a", "2", date="2")])
    (tmp_path / "other.csv").write_text("date,case,ratio,versions,machine\n1,a,2,mbla,here\n")
    assert main([], tmp_path) == 0
    out = capsys.readouterr().out
    assert "not compared: other: no column of seconds" in out
    assert "x: worst 2.00" in out
