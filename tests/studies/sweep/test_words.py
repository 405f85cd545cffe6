"""The range of a result in words."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.results.words.text import WIDTH
from mbla.studies.sweep.tables.sweep_table import SweepColumn, SweepTable
from mbla.studies.sweep.words import result_lines


def words_of(values: list[float], name: str = "load_factor", unit: str = "") -> list[str]:
    """The lines on a result with these values at points of friction 0.1, 0.2, ..."""
    columns = (
        SweepColumn("point", "", "", "int", "point", ""),
        SweepColumn("mu", "", "", "float", "parameter", "mu"),
        SweepColumn(name, unit, "", "float", "result", ""),
    )
    numbers = np.arange(1, len(values) + 1)
    table = SweepTable("", columns, (numbers, numbers / 10, np.array(values)), (), (numbers - 1)[:, np.newaxis])
    return [str(line) for line in result_lines(table, columns[2])]


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        ([0.3, 0.2, 0.4], "0.2 (point 2: mu 0.2) to 0.4 (point 3: mu 0.3)"),
        ([0.2, np.nan, 0.4], "0.2 (point 1: mu 0.1) to 0.4 (point 3: mu 0.3); 1 point without"),
        ([np.nan, 0.2], "0.2 (point 2: mu 0.2); 1 point without"),
        ([np.nan, np.nan], "no value"),
        ([0.25, 0.25, 0.25], "0.25 at all 3 points"),
        # the solver's last digits do not make one point the weakest
        ([0.25 + 1e-9, 0.25, 0.25 - 1e-9], "0.25 at all 3 points"),
        ([0.25, np.nan, 0.25], "0.25 at each of 2 points; 1 point without"),
    ],
)
def test_the_range_of_a_result(values: list[float], shown: str) -> None:
    assert " ".join(" ".join(words_of(values)).split()) == f"load_factor {shown}"


def test_the_unit_stands_with_the_value() -> None:
    assert words_of([2.0, 2.0], unit="kN")[0].split(maxsplit=1)[1] == "2 kN at all 2 points"


def test_a_long_name_does_not_push_the_values_out_of_their_column() -> None:
    name = "surcharge.reactions.supports.ground z = 0.force.2"
    lines = words_of([0.2, 0.4], name)
    assert lines[0] == f"  {name}"
    assert lines[1] == f"{'':34}0.2 (point 1: mu 0.1) to 0.4 (point 2: mu 0.2)"
    assert max(map(len, lines)) <= WIDTH
