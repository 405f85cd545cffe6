"""Supports that give way together, each by its own amount, against closed forms of a beam on two piers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.results import CaseResult
from mbla.run import run
from mbla.solution.solution import Status
from mbla.verify import verify_file
from tests.asked import settlement_of
from tests.line import HEAD, case_of, cases_of

WEIGHT = 2000 * 2 * 0.5 * 0.3 * 9.81
BEAM = (
    HEAD
    + """\
joints: {dry: {friction: 0.6}}
supports: [{blocks: [left, right]}]
blocks:
  - box: {group: left, material: stone, min: [0, 0, -0.5], max: [0.5, 0.5, 0]}
  - box: {group: right, material: stone, min: [1.5, 0, -0.5], max: [2, 0.5, 0]}
  - box: {group: beam, material: stone, min: [0, 0, 0], max: [2, 0.5, 0.3]}
load_cases:
  sink: {settlement: [{on: left, direction: [0, 0, -1]LEFT}, {on: right, direction: [0, 0, -2]RIGHT}]}
"""
)


def settling(left: str, right: str) -> CaseResult:
    return case_of(BEAM.replace("LEFT", left).replace("RIGHT", right))[1]


def reaction_of(case: CaseResult) -> float:
    assert case.solution.mechanics is not None
    assert case.status is Status.SOLVED
    return settlement_of(case.load_case).reaction(case.solution.mechanics.load_factor)


def test_a_beam_on_two_piers_that_sink_by_different_amounts() -> None:
    """The beam tips onto the inner edge of the left pier and the outer edge of the right one: 2/3 and 1/3 of its
    weight; the right one goes twice as far: 1/2 of one and all of the other. Whichever is named first.
    """
    case = settling(", amount: 0.01, step: 0.01, error: false", ", amount: 0.02")
    assert reaction_of(case) == pytest.approx(2 / 3 * WEIGHT, rel=1e-6)
    turned = case_of(
        BEAM.split("load_cases")[0]
        + "load_cases: {sink: {settlement: [{on: right, direction: [0, 0, -1], amount: 0.02, step: 0.02, "
        "error: false}, {on: left, direction: [0, 0, -1], amount: 0.01}]}}\n"
    )[1]
    assert reaction_of(turned) == pytest.approx(reaction_of(case), rel=1e-9)


def test_without_amounts_they_go_as_far_as_each_other() -> None:
    """Then the beam only goes down: both carry it all the way."""
    case = settling("", "")
    assert reaction_of(case) == pytest.approx(WEIGHT, rel=1e-6)
    assert not case.solution.further.pushover.curve


def test_they_are_followed_by_their_amounts() -> None:
    """The right pier sinks against the left one by half of its own way: R = (R_left + 2 R_right) / 2."""
    case = settling(", amount: 0.1", ", amount: 0.2, step: 0.02, error: false")
    rows = case.solution.further.pushover.curve
    sunk = np.array([row.displacement for row in rows]) / 2
    turned = np.arcsin(sunk / 1.5)
    cos, sin = np.cos(turned), np.sin(turned)
    right = WEIGHT * (0.5 * cos + 0.15 * sin) / (1.5 * cos + 0.6 * sunk)
    reaction = np.array([row.reaction for row in rows])
    assert rows[-1].displacement == pytest.approx(0.2, rel=1e-6)
    assert reaction == pytest.approx((WEIGHT + right) / 2, rel=3e-4)
    assert max(row.residual for row in rows[1:]) < 1e-5


def test_one_in_a_list_is_that_one_alone() -> None:
    one = "{on: right, direction: [0, 0, -1]}"
    text = BEAM.split("load_cases")[0] + f"load_cases:\n  a: {{settlement: {one}}}\n  b: {{settlement: [{one}]}}\n"
    first, second = (reaction_of(case) for case in cases_of(text)[1])
    assert first == second == pytest.approx(WEIGHT / 3, rel=1e-6)


@pytest.mark.long
def test_a_result_file_has_them_and_is_verified(tmp_path: Path) -> None:
    (path := tmp_path / "beam.yaml").write_text(
        BEAM.replace("LEFT", ", amount: 0.02").replace("RIGHT", ", amount: 0.04"), encoding="utf-8"
    )
    results = run(path, RunOptions(folder=tmp_path / "out"))
    back, differences = verify_file(tmp_path / "out" / "beam.h5")
    assert not differences
    own, settlement = settlement_of(results.cases[0].load_case), settlement_of(back.cases[0].load_case)
    assert own is not None
    assert settlement is not None
    assert settlement.motions[:, 2] == pytest.approx([-0.5, -1.0])
    assert "by 0.02, and of 1 block along (0, 0, -2) by 0.04" in settlement.words
    assert settlement.words == own.words
