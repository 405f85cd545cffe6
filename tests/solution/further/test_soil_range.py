"""Load factors of soil that slides with little dilatancy and with much, beside the associative one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.process.run_options import RunOptions
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.verdict_words import soil_range_words
from mbla.results.record.json_record import results_json
from mbla.results.results import Results
from mbla.run import run
from mbla.solution.further.soil_range.find import with_dilatancy
from mbla.verify import verify_file
from tests.line import BLOCK
from tests.results.changed_files import with_case, written

DECK = Path(__file__).parents[3] / "decks" / "tutorials" / "arch_in_soil.yaml"
RANGE = (
    "analysis.soil_range=true",
    "fill.soil.cells.size=0.8",
    "fill.soil.friction_angle=20",
    "fill.soil.wall.friction_angle=12",
)


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return run(DECK, RunOptions(folder=tmp_path_factory.mktemp("soil") / "out", overrides=RANGE))


def test_only_soil_dilates() -> None:
    model = build_model(read_deck(DECK))
    model = replace(model, joints=model.joints | {"dry": replace(model.joints["dry"], dilatancy=0.1)})
    joints = with_dilatancy(model, 0.5).joints
    assert joints["dry"].dilatancy == 0.0
    assert joints["soil"].dilatancy == 0.5 * joints["soil"].friction
    assert joints["soil.wall"].dilatancy == 0.5 * joints["soil.wall"].friction


def test_the_answer_is_the_associative_one_and_both_paths_lie_below_it(results: Results) -> None:
    (case,) = results.cases
    none, whole = case.solution.further.soil_range
    assert (none.share, whole.share) == (0.0, 1.0)
    assert none.status == whole.status == "solved"
    assert case.solution.flow_rule == "associative"
    assert 0.0 < none.load_factor <= whole.load_factor * (1.0 + 1e-6) <= case.checks.kinematic_bound * (1.0 + 2e-6)


def test_a_file_keeps_it_and_is_held_against_it(results: Results, tmp_path: Path) -> None:
    again, disagreements = verify_file(written(tmp_path, results))
    assert disagreements == ()
    assert again.cases[0].solution.further.soil_range == results.cases[0].solution.further.soil_range
    (case,) = results.cases
    none, whole = case.solution.further.soil_range
    for paths in ((), (none, replace(whole, load_factor=2.0 * whole.load_factor))):
        changed = replace(case.solution.further, soil_range=paths)
        other = with_case(results, further=changed)
        assert verify_file(written(tmp_path, other))[1]


def test_words_and_record_have_both(results: Results) -> None:
    (case,) = results.cases
    record = results_json(results)["cases"][0]["soil_range"]
    assert [each["share"] for each in record] == [0.0, 1.0]
    said = soil_range_words(results.model, case)
    assert all(f"{path.load_factor:.6g} times" in said for path in case.solution.further.soil_range)
    assert said in " ".join(" ".join(summary_lines(results)).split())


def test_elsewhere_the_key_has_no_effect(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    (notice,) = read_deck(deck, ["analysis.soil_range=true"]).notices
    assert notice.identifier == "key-idle"
