"""The end of a pushover held against its rows, which are made up here."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.model.model import LoadCase
from mbla.solution.pushover.curve_rows import CurveEnd, CurveRow
from mbla.solution.pushover.ends import end_failure, end_shown
from tests.line import BLOCK, line_of

NAN = float("nan")
STEP = CurveRow(0, 0.0, 1.0, NAN, NAN, NAN, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, False, 0, 0, 0, 0)


def pushed_case(until: str = "1", steps: int = 50) -> LoadCase:
    asked = f"{{step: 0.1, until: {until}, steps: {steps}}}"
    return line_of(BLOCK, f"load_cases.push.pushover={asked}").load_case


def rows(*factors: float) -> tuple[CurveRow, ...]:
    """Rows 0.1 apart with these load factors."""
    return tuple(
        replace(STEP, step=row, displacement=0.1 * row, load_factor=factor) for row, factor in enumerate(factors)
    )


FALLING = rows(1.0, 0.6, 0.3, 0.1, -0.1)


@pytest.mark.parametrize(
    ("until", "steps", "curve", "end"),
    [
        ("1", 50, FALLING, CurveEnd.NOTHING_LEFT),
        ("0.4", 50, rows(1.0, 1.0, 1.0, 1.0, 1.0), CurveEnd.REACHED),
        ("0.4", 50, FALLING, CurveEnd.REACHED),
        ("1", 2, rows(1.0, 1.0, 1.0), CurveEnd.STEPS_DONE),
    ],
)
def test_an_end_that_the_rows_show_is_the_only_one(
    until: str, steps: int, curve: tuple[CurveRow, ...], end: CurveEnd
) -> None:
    case = pushed_case(until, steps)
    assert end_shown(case, curve) is end
    assert [each for each in CurveEnd if not end_failure(case, curve, each)] == [end]
    for shorter in range(1, len(curve)):
        assert "rows are missing" in end_failure(case, curve[:shorter], end)


def test_the_load_factor_asked_for_is_an_end_that_the_rows_show() -> None:
    asked = "{step: 0.1, until_load_factor: -0.1}"
    case, curve = line_of(BLOCK, f"load_cases.push.pushover={asked}").load_case, rows(1.0, 0.3, 0.0, -0.05, -0.1)
    assert end_shown(case, curve) is CurveEnd.FACTOR_REACHED
    assert "rows are missing" in end_failure(case, curve[:-1], CurveEnd.FACTOR_REACHED)
    assert "rows are missing" in end_failure(case, curve[:-2], CurveEnd.NOTHING_LEFT)


def test_rows_behind_an_end_are_too_many() -> None:
    case = pushed_case()
    assert "goes on after step 4" in end_failure(case, (*FALLING, *FALLING[:1]), CurveEnd.FALLS)
    assert "goes on after step 2" in end_failure(pushed_case("0.2"), FALLING, CurveEnd.NOTHING_LEFT)
