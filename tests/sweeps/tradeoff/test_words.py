"""What the terminal says of a study made by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mbla.sweeps.measure.measurement import Measurement
from mbla.sweeps.tradeoff.ladder_run import RungRun
from mbla.sweeps.tradeoff.rung import Rung
from mbla.sweeps.tradeoff.words import study_lines
from tests.sweeps.tradeoff.hand_made import ladder, measured, run_of, study_of

WIDE = 100
"""columns of a terminal in which the tables of verified runs do not wrap"""


def lines_of(runs: list[RungRun]) -> list[str]:
    return study_lines(study_of(runs))


def row_of(lines: list[str], name: str) -> str:
    return next(line for line in lines if line[2:].startswith(name + " "))


def test_marks_of_reference_front_and_what_is_not_verified() -> None:
    lines = lines_of(ladder())
    assert [line[0] for line in (row_of(lines, name) for name in ("accuracy: draft", "form: static"))] == ["*", " "]
    assert row_of(lines, "accuracy: reference").split()[8] == "ref."
    assert row_of(lines, "solver: clarabel").endswith("not verified")
    header = lines.index("  other models (flow_rule), whose difference is no error:")
    assert lines[header + 1].startswith("  flow_rule: associative")
    legend = " ".join(" ".join(lines).split())
    assert "*: no verified setting of the same model is both faster and nearer" in legend


def test_tables_fit_a_terminal_with_the_widest_of_usual_figures() -> None:
    figures = {"iterations": 1234, "memory": 123.4e6, "solver": 1234.0, "residual": 1e-10}
    wide = measured(0.3161938, 1234.5, lower_bound=0.3161937, upper_bound=0.3161939, **figures)
    near = replace(wide, answer=wide.answer * (1 + 1e-11))
    runs = [run_of("accuracy: reference", wide), run_of("accuracy: standard", near)]
    runs.append(run_of("flow_rule: associative", wide, model="flow_rule"))
    assert max(map(len, lines_of(runs))) <= WIDE


def test_a_long_name_of_a_setting_takes_more_lines() -> None:
    name = "every knob at once: tolerance, solver, form and scheme"
    fast = measured(0.5, 0.1, lower_bound=0.3161937, upper_bound=0.3161939, residual=1e-10)
    lines = lines_of([run_of("accuracy: reference", replace(fast, wall=0.2)), run_of(name, fast)])
    place = next(number for number, line in enumerate(lines) if line.startswith("* every knob at once:"))
    assert lines[place + 1 : place + 3] == ["    tolerance, solver, form", "    and scheme"]
    assert "0.100" in lines[place]
    assert max(map(len, lines)) <= WIDE


def test_what_was_not_run_is_told_once_and_why() -> None:
    runs = [
        *ladder(),
        RungRun(Rung("solver: highs"), (), "unfit", "highs solves linear programs only"),
        RungRun(Rung("polyhedron: 4 sides"), (), "unfit", "applies to flow_rule: associative only"),
        RungRun(Rung("polyhedron: 8 sides"), (), "unfit", "applies to flow_rule: associative only"),
        RungRun(Rung("scheme: path"), (), "failed", "broke"),
    ]
    told = lines_of(runs)
    assert "  solver: highs: does not apply: highs solves linear programs only" in told
    assert "  polyhedron: 4 sides, polyhedron: 8 sides: applies to flow_rule: associative only" in told
    assert "  scheme: path: failed: broke" in told


LOCKED = measured(math.nan, 1.0, verdict="locked_in", accuracy=math.nan)
"""A structure that stands only by self-stress."""


def heading(lines: list[str]) -> str:
    """What the distances are held against, on one line."""
    told = " ".join(" ".join(lines).split())
    return told[told.index("load case push") : told.index(" setting ")]


@pytest.mark.parametrize(
    ("reference", "words"),
    [
        (measured(0.5, 2.0), "errors are relative to accuracy: reference, good to 1.0e-09"),
        (measured(0.5, 2.0, range_lower=0.5, range_upper=0.5),
         "errors are relative to accuracy: reference, good to 1.0e-09"),
        (measured(0.5, 2.0, range_lower=0.4, range_upper=0.6),
         "errors are relative to accuracy: reference, good to 1.0e-09; its mechanism allows of load factors from 0.4 "
         "to 0.6, all within the joint law"),
        (measured(0.5, 2.0, verified=False, status="not_verified"),
         "errors are relative to accuracy: draft, the sharpest that is verified (accuracy: reference is not), good to "
         "1.0e-06"),
        (LOCKED, "all are held against accuracy: reference: stands only by self-stress"),
    ],
)  # fmt: skip
def test_what_errors_are_relative_to(reference: Measurement, words: str) -> None:
    draft = run_of("accuracy: draft", measured(0.5, 0.1, accuracy=1e-6))
    assert heading(lines_of([run_of("accuracy: reference", reference), draft])) == f"load case push: {words}"


def test_of_runs_that_are_not_verified_the_sharpest_is_named_and_that_it_is_not() -> None:
    """Beside what it says nothing is on the front."""
    doubtful = {"verified": False, "status": "approximate"}
    runs = [
        run_of("accuracy: reference", measured(0.5, 2.0, accuracy=1e-3, **doubtful)),
        run_of("accuracy: draft", measured(0.5, 0.1, accuracy=1e-2, **doubtful)),
    ]
    lines = lines_of(runs)
    assert heading(lines) == (
        "load case push: errors are relative to accuracy: reference, which is NOT VERIFIED, good to 1.0e-03"
    )
    assert row_of(lines, "accuracy: reference").endswith("approximate")
    assert not [line for line in lines if line.startswith("*")]


@pytest.mark.parametrize(
    ("reference", "other", "error", "mark"),
    [
        (measured(0.5, 2.0), measured(0.5, 1.0), "<1.0e-09", ""),
        (measured(0.5, 2.0), measured(0.5, 1.0, verified=False), "<1.0e-09", "not verified"),
        (measured(0.5, 2.0), measured(math.nan, 1.0, status="unbounded", verdict="unbounded"), "-", "unbounded"),
        (measured(0.5, 2.0), LOCKED, "-", "stands only by self-stress"),
        (measured(0.5, 2.0), replace(LOCKED, verified=False), "-", "stands only by self-stress, not verified"),
        (LOCKED, LOCKED, "same", "stands only by self-stress"),
    ],
)
def test_error_and_mark_of_a_run(reference: Measurement, other: Measurement, error: str, mark: str) -> None:
    lines = lines_of([run_of("accuracy: reference", reference), run_of("form: static", other)])
    row = row_of(lines, "form: static")
    assert row[2:].split()[7] == error
    assert row.endswith(mark or row.split()[-1])
    assert ("not verified" in row) == ("not verified" in mark)
