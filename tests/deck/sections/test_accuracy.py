"""One word sets every knob; a knob that the deck gives wins."""

from __future__ import annotations

from dataclasses import asdict, fields
from typing import Any, get_args

import pytest

from mbla.deck.sections.accuracy import PRESETS, Accuracy, Knobs, knobs_of
from mbla.deck.sections.analysis import AnalysisSection
from tests.line import WALL, line_of

OTHER: dict[str, Any] = {
    "tolerance": 1e-5,
    "gap": 1e-4,
    "residual": 1e-5,
    "search": 2.0,
    "range": False,
    "peak": False,
    "standing": False,
}
"""A value of each knob that no preset has, or standard has not."""


@pytest.mark.parametrize("accuracy", get_args(Accuracy))
def test_a_preset_sets_every_knob(accuracy: Accuracy) -> None:
    section = AnalysisSection(accuracy=accuracy, flow_rule="associative")
    assert knobs_of(section) == PRESETS[accuracy]


@pytest.mark.parametrize("knob", [field.name for field in fields(Knobs)])
@pytest.mark.parametrize("accuracy", ["standard", "reference"])
def test_a_knob_that_is_given_wins_and_turns_alone(accuracy: Accuracy, knob: str) -> None:
    line = line_of(WALL, f"analysis.accuracy={accuracy}", f"analysis.{knob}={str(OTHER[knob]).lower()}")
    assert asdict(knobs_of(line.deck.analysis)) == asdict(PRESETS[accuracy]) | {knob: OTHER[knob]}


def test_presets_go_from_rough_to_sharp() -> None:
    draft, standard, reference = (PRESETS[name] for name in ("draft", "standard", "reference"))
    for knob in ("tolerance", "gap", "residual"):
        assert getattr(draft, knob) > getattr(standard, knob) > getattr(reference, knob)


def test_a_draft_assesses_the_standing_where_its_claim_depends_on_it() -> None:
    assert not knobs_of(AnalysisSection(accuracy="draft", flow_rule="associative")).standing
    assert knobs_of(AnalysisSection(accuracy="draft", flow_rule="non_associative")).standing
    assert not knobs_of(AnalysisSection(accuracy="draft", flow_rule="non_associative", standing=False)).standing


def test_every_description_says_what_the_presets_set() -> None:
    words = {name: AnalysisSection.model_fields[name].description or "" for name in asdict(PRESETS["draft"])}
    assert all("set by accuracy unless given: draft " in text for text in words.values())
    assert words["gap"].endswith("draft 0.001, standard 3e-07, reference 5e-08")
    assert words["range"].endswith("draft false, standard true, reference true")
