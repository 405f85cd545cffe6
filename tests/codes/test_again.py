"""A result that exists, assessed for another earthquake, by another code, or for the first time."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import mbla
from mbla import cli
from tests.codes.test_assessment import TEXT

CASE = "by_circular_of_2009"
A_G = f"load_cases.{CASE}.assessment.spectra.SLV.ntc_2018.a_g"
ASKED = "{spectra: {SLV: {en_1998: {a_g: 0.2, type: 1, soil: B}}}}"
WALL = """mbla: 1
parameters: {a_g: 0.2}
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks: [{box: {material: stone, min: [0, 0, 0], max: [0.5, 1, 2]}}]
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  other: {live: [{acceleration: [1, 0, 0]}]}
"""


def test_the_verdict_is_that_of_a_run_with_that_earthquake(tmp_path: Path) -> None:
    run = mbla.run(TEXT, cases=CASE, output=tmp_path)
    again = mbla.assess(tmp_path / "deck.h5", set={A_G: 0.1}).case(CASE).assessment
    assert again == mbla.run(TEXT, cases=CASE, set={A_G: 0.1}).case(CASE).assessment
    assert again is not None
    assert again != run.case(CASE).assessment
    assert mbla.assess(run).case(CASE).assessment == run.case(CASE).assessment
    assert mbla.read_results(tmp_path / "deck.h5").case(CASE).assessment == run.case(CASE).assessment


def test_a_result_is_assessed_for_the_first_time(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = mbla.run(WALL, output=tmp_path)
    assert run.case("push").assessment is None
    arguments = ["assess", str(tmp_path / "deck.h5"), "--set", f"load_cases.push.assessment={ASKED}"]
    assert cli.main(arguments) == 0
    text = capsys.readouterr().out
    assert "Load case push" in text
    assert "Load case other" not in text
    assert "SLV 1.54321 (q a_g,0/a_g, by alpha_0 alone), met." in " ".join(text.split())
    assert cli.main([*arguments, "--json"]) == 0
    first, second = json.loads(capsys.readouterr().out)["cases"]
    assert first["assessment_ratio_SLV"] == pytest.approx(2 * 0.25 / 1.35 / (1.2 * 0.2), rel=1e-5)
    assert second["assessment"] is None


def test_a_parameter_of_the_assessment_alone_may_change() -> None:
    asked = ASKED.replace("0.2", '"=a_g"')
    run = mbla.run(WALL.replace("push: {", f"push: {{assessment: {asked}, "))
    half = mbla.assess(run, set={"parameters.a_g": 0.1}).case("push").assessment
    whole = run.case("push").assessment
    assert whole is not None
    assert half is not None
    assert half.ratios["SLV"].value == pytest.approx(2 * whole.ratios["SLV"].value)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({}, "no load case with a result has an assessment"),
        ({"joints.dry.friction": 0.7, "load_cases.push.assessment": {}}, "spectra: is missing"),
        ({"joints.dry.friction": 0.7}, "for which the deck has to be run"),
        ({"load_cases.push.pushover": {"step": 0.1}}, "for which the deck has to be run"),
        ({"load_cases.new": {"live": [{"acceleration": [1, 0, 0]}]}}, "for which the deck has to be run"),
    ],
)
def test_what_is_no_assessment_is_refused(changes: dict[str, object], says: str) -> None:
    run = mbla.run(WALL, cases="push")
    with pytest.raises(mbla.MblaError, match=says):
        mbla.assess(run, set=changes)
