"""Records of PEER, with their headers in several spellings."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.model.motion.at2 import read_at2
from mbla.model.tables import TableRefused
from tests.model.motion.files import written

ABOVE = "PEER NGA STRONG MOTION DATABASE RECORD\nLoma Prieta 10/18/89 00:05, GILROY ARRAY 1, 000\n"
UNITS = "ACCELERATION TIME SERIES IN UNITS OF G\n"
VALUES = "  .1000000E-02  -.2000000E-02   .3E-02\n  4.0D-03\n  .005\n"
SPELLINGS = (
    "NPTS=      5, DT=   .0050 SEC,",
    "NPTS=5, DT=0.005 SEC",
    "NPTS =   5 , DT =  5.0E-03 SEC",
    "npts: 5  dt: .005",
    "   5   0.0050   NPTS, DT",
    "5  .005  NPTS,DT",
    "NUMBER OF POINTS AND STEP: NPTS= 5 DT= .005",
)


@pytest.mark.parametrize("line", SPELLINGS)
def test_every_spelling_of_a_header(tmp_path: Path, line: str) -> None:
    record = read_at2(written(tmp_path, f"{ABOVE}{UNITS}{line}\n{VALUES}", "r.AT2"))
    assert record.times == pytest.approx([0.0, 0.005, 0.01, 0.015, 0.02])
    assert record.values[:, 0] == pytest.approx([0.001, -0.002, 0.003, 0.004, 0.005])
    assert record.unit == "g"


def test_a_header_without_a_unit(tmp_path: Path) -> None:
    assert read_at2(written(tmp_path, f"{ABOVE}{SPELLINGS[0]}\n{VALUES}", "r.AT2")).unit == ""


def test_points_and_step_on_two_lines(tmp_path: Path) -> None:
    record = read_at2(written(tmp_path, f"{ABOVE}NPTS= 5\nDT= .01\n{VALUES}", "r.AT2"))
    assert record.times[-1] == pytest.approx(0.04)


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ("NPTS= 5", "r.AT2: DT is not in its header"),
        ("DT= .005", "r.AT2: NPTS is not in its header"),
        ("", "r.AT2: NPTS and DT are not in its header"),
        ("NPTS= 4, DT= .005", "r.AT2:3: NPTS = 4, but 5 values follow, more than that"),
        ("NPTS= 6, DT= .005", "r.AT2:3: NPTS = 6, but 5 values follow, fewer than that"),
        ("NPTS= 1, DT= .005", "r.AT2:3: NPTS = 1: must be a number of values"),
        ("NPTS= 1e999, DT= .005", "r.AT2:3: NPTS = 1e999: must be a number of values"),
        ("NPTS= 5, DT= -.005", "r.AT2:3: DT = -.005: must be > 0"),
        ("DISPLACEMENT NPTS= 5, DT= .005", "r.AT2: is a record of displacement"),
    ],
)
def test_what_is_refused(tmp_path: Path, header: str, words: str) -> None:
    with pytest.raises(TableRefused) as refused:
        read_at2(written(tmp_path, f"{ABOVE}{header}\n{VALUES}", "r.AT2"))
    assert str(refused.value.faults[0]).startswith(words)
