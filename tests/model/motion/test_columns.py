"""Columns of times and values, as programs and spreadsheets write them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from mbla.model.motion.columns import read_columns
from mbla.model.tables import TableRefused
from tests.model.motion.files import written

PLAIN = "0,0.1\n0.5,0.2\n1.0,-0.3\n"


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (PLAIN, None),
        (PLAIN, [1, 2]),
        ("t,a\n" + PLAIN, None),
        ("t,a\n" + PLAIN, ["t", "a"]),
        ("T,A\n" + PLAIN, ["t", "a"]),
        ("\ufeffTime [s],Acc [g]\r\n" + PLAIN.replace("\n", "\r\n"), ["Time [s]", "Acc [g]"]),
        ('"t","a"\n' + PLAIN, ["t", "a"]),
        ("# a record, of some station\n# t,a\n" + PLAIN, ["t", "a"]),
        ("% t,a\n" + PLAIN + "# the end\n", ["t", "a"]),
        ("Station 12\n3 values, each 0.5 s\n\nt,a\n(s),(g)\n" + PLAIN, ["t", "a"]),
        ("t;a\n0;0,1\n0,5;0,2\n1,0;-0,3\n", ["t", "a"]),
        ("t a\n  0   0.1\n 0.5   0.2\n 1.0e0  -3.e-1\n", ["t", "a"]),
        ("Time (s)   Acc x (g)\n0\t0.1\n0.5\t0.2\n1.0\t-0.3\n", ["Time (s)", "Acc x (g)"]),
        ("n,t,a,remark\n1,0,0.1,first\n2,0.5,0.2,\n3,1,-0.3,last\n", ["t", "a"]),
        ("n,t,a,remark\n1,0,0.1,first\n2,0.5,0.2,\n3,1,-0.3,last\n", [2, 3]),
        ("a,t\n0.1,12.5\n0.2,13.0\n-0.3,13.5\n", ["t", "a"]),
    ],
)
def test_every_way_of_writing_them(tmp_path: Path, text: str, wanted: Sequence[str | int] | None) -> None:
    record = read_columns(written(tmp_path, text), wanted)
    assert record.times.tolist() == [0.0, 0.5, 1.0]
    assert record.values.tolist() == [[0.1], [0.2], [-0.3]]
    assert (record.file, record.unit, record.jumps) == ("record.csv", "", 0)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("EVENT: 12\nSAMPLING_INTERVAL_S: 0.5\n0.1\n0.2\n-0.3\n", None),
        ("t,a\n0,0.1\n0,0.2\n0,-0.3\n", ["a"]),
        ("1 0.1\n2 0.2\n3 -0.3\n", [2]),
    ],
)
def test_a_file_without_times(tmp_path: Path, text: str, wanted: Sequence[str | int] | None) -> None:
    record = read_columns(written(tmp_path, text), wanted, 0.5)
    assert record.times.tolist() == [0.0, 0.5, 1.0]
    assert record.values.tolist() == [[0.1], [0.2], [-0.3]]


def test_three_columns_of_values(tmp_path: Path) -> None:
    record = read_columns(written(tmp_path, "t,x,y,z\n0,1,2,3\n1,4,5,6\n"), ["t", "z", "x", "y"])
    assert record.values.tolist() == [[3.0, 1.0, 2.0], [6.0, 4.0, 5.0]]


def test_a_time_that_is_there_twice_is_a_jump(tmp_path: Path) -> None:
    record = read_columns(written(tmp_path, "0,1\n1,1\n1,-1\n1,-1\n3,-1\n"), None)
    assert record.jumps == 1
    assert record.steps.tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("text", "wanted", "words"),
    [
        ("0,1\n1,x\n2,\n", None, "record.csv:2: column 2 = x: must be a finite number"),
        ("t,a\n0,1\n1 s,2\n", ["t", "a"], "record.csv:3: t = 1 s: must be a finite number"),
        ("0 1\n1 1_000\n", None, "record.csv:2: column 2 = 1_000: must be a finite number"),
        ("t,acc\n0,1\n1,2\n", ["t", "ac"], "record.csv:1: no column ac; did you mean acc? its header has t and acc"),
        ("\n# nothing\n", None, "record.csv: is empty"),
        ("0,1\n2,1\n1,1\n0,1\n", None, "record.csv:3: the time 1 comes after 2: times must not fall; 1 more do"),
        ("0,1\n", None, "record.csv: has 1 row with numbers"),
        ("0,1\n1e8,2\n", None, "record.csv: lasts 1e+08 s: times are in seconds"),
        ("0,1\n1,2e40\n", None, "record.csv: its values reach 2.0e+40"),
        ("0,0\n1,0\n", None, "record.csv: every value is 0"),
        ("# \n%,\n;;\n", None, "record.csv: is empty"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, wanted: Sequence[str | int] | None, words: str) -> None:
    with pytest.raises(TableRefused) as refused:
        read_columns(written(tmp_path, text), wanted)
    assert str(refused.value.faults[0]).startswith(words)


def test_a_long_record_is_read_quickly(tmp_path: Path) -> None:
    times = np.arange(60_000) * 0.005
    values = np.sin(times)
    text = "".join(f"{time:.3f} {value:.8e}\n" for time, value in zip(times, values, strict=True))
    record = read_columns(written(tmp_path, text), None)
    assert record.times == pytest.approx(times)
    assert record.values[:, 0] == pytest.approx(values)
