"""Both ends of a force as one answer: in words, JSON, expectations and exit status, in files, sweeps and pictures."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.questions.force import Objective
from mbla.results.exit_status import differences, exit_code
from mbla.results.force_range import force_ranges_of
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.listing.answers import range_words
from mbla.results.listing.listing import listing
from mbla.results.outcome import answer_bounds, figure_of
from mbla.results.pictures.marks.forces import force_texts, thrust_lines
from mbla.results.pictures.marks.loads import live_marks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of
from mbla.results.record.json_record import results_json
from mbla.results.results import Results
from mbla.run import RunOptions, run
from mbla.solution.solution import Status
from mbla.sweeps.results import result_fault, result_places, values_of
from mbla.verify import verify_file

DECK = """
mbla: 1
materials: {stone: {density: 1000}}
joints: {dry: {friction: 0.5}}
contacts: {joint: dry}
blocks:
  - box: {group: walls, material: stone, min: [-1, 0, 0], max: [0, 1, 1], repeat: {count: 2, translate: [2, 0, 0]}}
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: stone, material: stone, min: [9, 0, 0], max: [10, 1, 1]}
supports: [{ground: {z: 0}}, {blocks: walls}]
load_cases:
  left: {objective: {force: {from: {group: walls, index: 0}, direction: [1, 0, 0]}}}
  all: {live: [{acceleration: [0, 0, -1]}], at: 0.5, objective: {force: {on: block, direction: [0, 0, 1]}}}
  lifted: {dead: [{gravity: none}, {force: [0, 0, 1], on: stone}],
           objective: {force: {on: stone, direction: [0, 0, 1]}}}
  push: {live: [{force: [0, 0, -1], on: block}]}
expected:
  left: {least: 0, status: unbounded, source: closed form}
  all: {least: 14715, greatest: 14715, status: solved, source: closed form}
  lifted: {status: no_equilibrium, source: nothing holds it}
  push: {status: unbounded, source: closed form}
"""
WEIGHT = 9810.0


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> tuple[Results, Path]:
    folder = tmp_path_factory.mktemp("forces")
    path = folder / "forces.yaml"
    path.write_text(DECK, encoding="utf-8")
    return run(path, RunOptions(folder=folder / "out")), folder / "out"


def test_values_and_bounds(solved: tuple[Results, Path]) -> None:
    left, every, lifted = force_ranges_of(solved[0].cases)
    assert left.status is Status.UNBOUNDED
    assert figure_of(left.ends["greatest"]) == math.inf
    assert every.status is Status.SOLVED
    for case in every.ends.values():
        low, high = answer_bounds(case)
        assert figure_of(case) == pytest.approx(1.5 * WEIGHT, rel=1e-7)
        assert low <= high * (1 + 1e-9)
        assert high - low <= 1e-6 * WEIGHT
    assert lifted.status is Status.NO_EQUILIBRIUM


def test_the_record_has_both_ends_and_null_without_limit(solved: tuple[Results, Path]) -> None:
    left, every, lifted = results_json(solved[0])["objectives"]
    assert left["status"] == "unbounded"
    assert left["greatest"]["value"] is None
    assert left["greatest"]["case"] == "left@greatest"
    assert (every["name"], every["at"]) == ("all", 0.5)
    assert every["least"]["lower_bound"] == pytest.approx(1.5 * WEIGHT, rel=1e-6)
    assert lifted["least"]["value"] is None
    assert lifted["status"] == "no_equilibrium"


def test_a_sweep_has_them_by_the_name_of_the_deck(solved: tuple[Results, Path]) -> None:
    paths = ("status", "least.value", "greatest.value", "verified")
    assert not any(result_fault(path) for path in paths)
    values = values_of(results_json(solved[0]), result_places(paths, ("all", "left")))
    assert values["all.least.value"] == pytest.approx(1.5 * WEIGHT)
    assert values["all.status"] == "solved"
    assert values["left.status"] == "unbounded"
    assert values["left.greatest.value"] is None


def test_words(solved: tuple[Results, Path]) -> None:
    results = solved[0]
    left, every, lifted = (range_words(results.model, each) for each in force_ranges_of(results.cases))
    assert left == "left: force of 1 block on all other blocks along (1, 0, 0): least 0 N, greatest without limit"
    assert every.endswith("along (0, 0, 1) at load factor 0.5: least 14715 N, greatest 14715 N")
    assert lifted.endswith("none, the structure does not carry these loads")
    text = listing(results)
    for words in ("Force left", "sought   ", "its bounds   ", "least force 14715 N, verified", "without limit"):
        assert words in text


def test_expectations_and_exit_status(solved: tuple[Results, Path]) -> None:
    """Forces without limit are an answer, loads that are not carried are none; `push` locks."""
    results, folder = solved
    expected = read_deck(folder.parent / "forces.yaml").content.expected
    assert differences(results.cases, expected) == []
    wrong = {"all": expected["all"].model_copy(update={"greatest": 1.0, "least": 14715.001})}
    assert [text.split(",")[0] for text in differences(results.cases, wrong)] == ["all: greatest 14715"]
    none = {"left": expected["left"].model_copy(update={"greatest": 1.0, "status": "solved"})}
    found = differences(results.cases, none)
    assert [text.split(" ")[1] for text in found] == ["status", "greatest"]
    assert exit_code([case for case in results.cases if case.load_case.deck_name == "left"]) == 0
    assert exit_code([case for case in results.cases if case.load_case.deck_name == "lifted"]) == 5


def test_what_a_file_says_is_found_again(solved: tuple[Results, Path]) -> None:
    path = solved[1] / "forces.h5"
    again, disagreements = verify_file(path)
    assert disagreements == ()
    assert [case.status for case in again.cases] == [case.status for case in solved[0].cases]
    stored = read_results_hdf5(path).case("left@least").load_case.question.record(Objective)
    assert stored is not None
    assert (stored.series, stored.end, stored.sides.tolist()) == ("left", "least", [-1, 1, 1, 1, 0])


STILL = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: one, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: two, material: stone, min: [1, 0, 0], max: [2, 1, 1]}
  - box: {group: top, material: stone, min: [0, 0, 1], max: [2, 1, 1.5]}
  - box: {group: column, material: stone, min: [0.2, 0.3, 1.5], max: [0.5, 0.6, 2.5]}
contacts: {joint: dry%s}
supports: [{ground: {z: 0}}]
load_cases:
  along: {objective: {force: {direction: [1, 1, 0], from: column, on: top}}}
analysis: {contact_model: convex}
"""


@pytest.mark.parametrize("glue", ["", ", overrides: [{joint: glued, between: [one, two]}]"], ids=["dry", "glued"])
def test_of_a_force_that_statics_alone_gives_no_joint_moves(tmp_path: Path, glue: str) -> None:
    """Nothing pushes the column: what joints move as the load cell does is what the solver leaves."""
    path = tmp_path / "still.yaml"
    path.write_text(STILL % glue, encoding="utf-8")
    results = run(path, RunOptions(folder=tmp_path / "out"))
    for case in results.cases:
        assert case.status is Status.SOLVED
        assert figure_of(case) == pytest.approx(0.0, abs=1e-2)  # N, of a weight of 60 kN
        assert case.solution.mechanics is not None
        assert not case.solution.mechanics.modes.any()
    assert verify_file(tmp_path / "out" / "still.h5")[1] == ()


def test_a_picture_of_forces_has_both_lines_of_thrust(solved: tuple[Results, Path]) -> None:
    results = solved[0]
    scene = scene_of(results, results.case("all@least"), PictureOptions(), "forces")
    assert [mark.name for mark in thrust_lines(scene, force_texts(scene))] == [
        "line of thrust, least force",
        "line of thrust, greatest force",
    ]
    assert live_marks(scene, results.case("all@least").load_case, "live load", "#000000") == []
