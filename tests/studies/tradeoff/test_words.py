"""What the terminal says of a study made by hand."""

from __future__ import annotations

from dataclasses import replace

from mbla.deck.units import Units
from mbla.studies.tradeoff.advice import advice
from mbla.studies.tradeoff.ladder_run import Limits, RungRun
from mbla.studies.tradeoff.rung import Rung
from mbla.studies.tradeoff.study import Study
from mbla.studies.tradeoff.trade import case_trades
from mbla.studies.tradeoff.words import study_lines
from tests.studies.tradeoff.hand_made import ladder, measured, run_of

WIDE = 100
"""columns of a terminal in which the tables of verified runs do not wrap"""


def study_of(runs: list[RungRun]) -> Study:
    trades = case_trades([("push", 0)], runs)
    return Study(
        deck="a.yaml", title="A", overrides=(), units=Units(), flow_rule="associative", wanted=1e-4, limits=Limits(),
        runs=tuple(runs), trades=trades, advices=(advice(trades, 1e-4),), seconds=1.0, provenance={},
    )  # fmt: skip


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
