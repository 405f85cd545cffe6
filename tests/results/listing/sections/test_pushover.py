"""A pushover in words and in its table: jumps, stiffness of joints, energies."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.model import Model
from mbla.results.listing.sections.pushover import curve_blocks, curve_words, no_curve_words
from mbla.results.listing.text import lines_of
from mbla.results.results import CaseResult
from tests.line import BLOCK, HEAD, case_of
from tests.results.changed_files import with_curve

TABLE = (
    HEAD
    + """\
joints: {dry: {friction: 0.4}}
supports: [{blocks: stop}, {blocks: table}]
blocks:
  - box: {group: a, material: stone, min: [0, 0, 1], max: [0.2, 0.5, 1.2]}
  - box: {group: stop, material: stone, min: [0.2, 0, 1], max: [0.6, 0.5, 1.2]}
  - box: {group: table, material: stone, min: [0, 0, 0.9], max: [1.6, 0.5, 1]}
load_cases: {c: {settlement: {on: table, direction: [1, 0, 0], amount: 0.12, step: 0.04, error: false}}}
"""
)
"""A stone against a stop on a table that is drawn away under it: it falls as its centre loses its seat."""

PUSHED = "load_cases.push.pushover={step: 0.05, until: 0.1, error: false}"


@pytest.fixture(scope="module")
def drawn_away() -> tuple[Model, CaseResult]:
    return case_of(TABLE)


@pytest.fixture(scope="module")
def rocking() -> tuple[Model, CaseResult]:
    return case_of(BLOCK, PUSHED, "parameters.mu=0.8")


def words_of(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def test_a_jump_is_counted_in_the_row_behind_it(drawn_away: tuple[Model, CaseResult]) -> None:
    curve = drawn_away[1].solution.further.pushover.curve
    assert [row.displacement > 0.1 for row in curve if row.jumps] == [True]
    assert sum(row.jumps for row in curve) == 1


def test_jumps_are_said_and_marked(drawn_away: tuple[Model, CaseResult]) -> None:
    lines = lines_of(curve_blocks(*drawn_away))
    words = words_of(lines)
    assert "; 1 jump, the first behind 0.08 m" in words
    assert "no equilibrium is nearby: the structure moves in time to its next rest" in words
    assert len([line for line in lines if line.endswith(" jump")]) == 1


def test_a_row_behind_a_jump_is_shown_however_many_rows_there_are(rocking: tuple[Model, CaseResult]) -> None:
    model, case = rocking
    last = case.solution.further.pushover.curve[-1]
    curve = tuple(replace(last, step=row, jumps=int(row == 50), new_mechanism=False) for row in range(100))
    case = with_curve(case, curve)
    assert [line.split()[0] for line in lines_of(curve_blocks(model, case)) if line.endswith(" jump")] == ["50"]


def test_steps_that_were_not_found_are_said(rocking: tuple[Model, CaseResult]) -> None:
    model, case = rocking
    curve = (*case.solution.further.pushover.curve[:-1], replace(case.solution.further.pushover.curve[-1], unsolved=2))
    assert "2 steps between not found" in curve_words(model, with_curve(case, curve))


def test_a_curve_without_jumps_says_nothing_of_them(rocking: tuple[Model, CaseResult]) -> None:
    assert "jump" not in words_of(lines_of(curve_blocks(*rocking)))


def test_the_stiffness_of_joints_is_printed_with_its_unit(rocking: tuple[Model, CaseResult]) -> None:
    model, case = rocking
    assert case.solution.further.pushover.rows is not None
    across, along = case.solution.further.pushover.rows.stiffness
    words = f"as stiff as {across:.3g} N/m3 across and {along:.3g} along"
    assert words in words_of(lines_of(curve_blocks(model, case)))
    assert words not in curve_words(model, case)  # of a plane structure nothing depends on it


def test_in_space_the_stiffness_stands_with_the_figures(rocking: tuple[Model, CaseResult]) -> None:
    model, case = rocking
    assert case.solution.size is not None
    space = replace(case, solution=replace(case.solution, size=replace(case.solution.size, dimension=3)))
    assert "as stiff as" in curve_words(model, space)
    assert words_of(lines_of(curve_blocks(model, space))).count("as stiff as") == 1


def test_each_row_has_its_balance_of_energy(rocking: tuple[Model, CaseResult]) -> None:
    lines = lines_of(curve_blocks(*rocking))
    (head,) = (line for line in lines if line.split()[:1] == ["step"])
    end = head.index("left") + len("left")
    left = [float(line[:end].split()[-1]) for line in lines if line.split()[:1] in (["1"], ["2"])]
    assert len(left) == 2
    assert max(map(abs, left)) < 1e-3


def test_why_there_is_no_pushover_stands_in_the_summary() -> None:
    model, case = case_of(BLOCK, PUSHED, "load_cases.push.pushover.control={direction: [0, 1, 0]}")
    assert curve_words(model, case) == ""
    words = "There is no pushover: the control point does not move as the structure starts to: leave control out"
    assert no_curve_words(case).startswith(words)
