"""Travelling loads and tilting tables from the deck to the files and back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import UsageError
from mbla.results.exit_status import differences
from mbla.results.listing.answers import standing_words
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.outcome import answer_bounds, answer_of, figure_of
from mbla.results.record.json_record import results_json
from mbla.results.results import CaseResult, Results
from mbla.results.series import chosen_cases, detailed_cases, series_of
from mbla.run import RunOptions, run
from mbla.solution.solution import Status
from tests.results.synthetic import standing_at, tower_results

DECK = """mbla: 1
materials: {stone: {unit_weight: 25000}}
joints: {dry: {friction: 0.6}, mortar: {friction: 0.6, cohesion: 100}}
blocks:
  - box: {group: pier, material: stone, min: [2, 0, 0], max: [2.5, 0.5, 2]}
  - box: {group: pier, material: stone, min: [5.5, 0, 0], max: [6, 0.5, 2]}
  - box: {group: beam, material: stone, min: [0, 0, 2], max: [8, 0.5, 2.4]}
contacts: {joint: JOINT}
supports: [{blocks: pier}]
load_cases:
  crane: {live: [{travel: {force: [0, 0, -10000], path: [[8, 0.25, 3], [0, 0.25, 3]], positions: 5}}]}
  table: {live: [{tilt: {axis: [0, 1, 0]}}]}
analysis: {flow_rule: associative}
output: {vtu: false}
expected:
  crane: {load_factor: 4, position: 1, status: solved, source: closed form}
  table: {angle: 30.963757, source: closed form}
"""


@pytest.fixture(scope="module", params=["dry", "mortar"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("series")
    (path / "beam.yaml").write_text(DECK.replace("JOINT", request.param), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def results(folder: Path) -> Results:
    return run(folder / "beam.yaml", RunOptions())


def test_a_load_factor_for_each_position_and_the_worst(results: Results) -> None:
    (series,) = series_of(results.cases)
    assert series.complete
    assert [case.load_case.name for case in series.cases] == [f"crane@{number}" for number in range(1, 6)]
    assert figure_of(series.cases[0]) == pytest.approx(4, rel=1e-2)
    assert math.isinf(figure_of(series.cases[2]))
    assert series.worst is series.cases[0]  # of equal ones the first


def test_the_worst_is_not_claimed_where_a_position_has_no_result(results: Results) -> None:
    cases = (results.cases[0], replace(results.cases[4], status=Status.NOT_VERIFIED))
    (series,) = series_of(cases)
    assert series.worst is None
    assert not series.complete
    lines = " ".join(" ".join(summary_lines(replace(results, cases=cases))).split())
    assert "the worst position is not known, for there is no load factor at crane@5" in lines


def test_the_angle(results: Results) -> None:
    angle = answer_of(results.cases[-1])
    if "mortar" in results.model.joints and results.contacts.joint_names == ("mortar",):
        # W sin t = mu W cos t + c A with W/A = 25000 * 8 * 0.2/0.5 on the two heads of the piers
        expected = math.atan(0.6) + math.asin(100 * 0.5 * math.cos(math.atan(0.6)) / (25000 * 8 * 0.5 * 0.4))
    else:
        expected = math.atan(0.6)
    assert angle == pytest.approx(math.degrees(expected), rel=1e-8)
    low, high = answer_bounds(results.cases[-1])
    assert low <= math.degrees(expected) * (1 + 1e-10)
    assert high >= math.degrees(expected) * (1 - 1e-10)


def test_what_differs_from_what_is_expected(results: Results, folder: Path) -> None:
    from mbla.deck import read_deck

    expected = read_deck(folder / "beam.yaml").content.expected
    strict = results.contacts.joint_names == ("dry",)
    assert (differences(results.cases, expected) == []) == strict
    other = {name: item.model_copy(update={"position": 3, "angle": 40.0}) for name, item in expected.items()}
    found = differences(results.cases, other)
    assert "crane: worst at position 1, expected 3 (closed form)" in found
    assert any(text.startswith("table: angle 3") and "expected 40" in text for text in found)
    assert "crane: not every position was solved (closed form)" in differences(results.cases[:2], expected)


def train(statuses: Sequence[Status], factors: Sequence[float]) -> tuple[CaseResult, ...]:
    """A position of a travelling load for each status, with that load factor."""
    case = tower_results("associative").cases[0]
    assert case.solution.mechanics is not None
    cases = []
    for i, (status, factor) in enumerate(zip(statuses, factors, strict=True), start=1):
        load_case = replace(case.load_case, name=f"train@{i}", question=standing_at(i, len(statuses), [i, 0, 0], i))
        mechanics = replace(case.solution.mechanics, load_factor=factor)
        solution = replace(case.solution, mechanics=mechanics, associative=mechanics)
        cases.append(replace(case, load_case=load_case, status=status, solution=solution))
    return tuple(cases)


S, U, N = Status.SOLVED, Status.UNBOUNDED, Status.NOT_VERIFIED


@pytest.mark.parametrize(
    ("statuses", "factors", "told"),
    [
        ((S, S, U), (0.5, 0.4, 9.0), [2]),
        ((S, N, S), (0.5, 0.1, 0.4), [2, 3]),
        ((U, U), (9.0, 9.0), [1]),
        ((N, N), (0.1, 0.2), [1, 2]),
    ],
    ids=[
        "the worst",
        "what may be worse, and the least known",
        "the first where nothing falls",
        "all without a result",
    ],
)
def test_positions_told_in_full(statuses: Sequence[Status], factors: Sequence[float], told: list[int]) -> None:
    other = tower_results().cases[1]
    found = detailed_cases((*train(statuses, factors), other))
    assert [case.load_case.name for case in found] == [*(f"train@{number}" for number in told), other.load_case.name]


@pytest.mark.parametrize(
    ("behind", "words"),
    [
        ((), "at (7, 0, 3) m"),
        ((1.5,), "first axle at (7, 0, 3) m, 9 m along the path, with only axle 1 of 2 on it"),
    ],
)
def test_a_vehicle_stands_where_its_first_axle_is(behind: Any, words: str) -> None:
    assert standing_words(tower_results().model, standing_at(1, 9, [7, 0, 3], 9.0, behind).place) == words


@pytest.mark.long
def test_a_vehicle_beyond_the_end_of_its_path(tmp_path: Path) -> None:
    """One table of its positions, and everything else of the worst, which is told where the vehicle stands."""
    deck = Path("decks/regressions/vehicle_beside_its_path.yaml")
    results = run(deck, RunOptions(folder=tmp_path))
    lines = summary_lines(results)
    assert len(lines) < 15
    text = " ".join(" ".join(lines).split())
    assert (
        "worst at position 12 of 12, first axle at (-3, 0.25, 3) m, 11 m along the path, with only axle 3 of 3 on it: "
        "load factor 2" in text
    )
    assert "brings the structure down at 8 of 12 positions, at load factors from 2 to 16; at 4 no multiple does" in text
    told = listing(results)
    assert told.count("Load case lorry@") == 1
    assert [f"lorry@{number:02d}" in told for number in range(1, 13)] == [True] * 12
    assert {name.split("@")[1][:2] for name in results.files if "@" in name} == {"12"}
    table = (tmp_path / "vehicle_beside_its_path_positions.csv").read_text().splitlines()
    assert len(table) == 13
    assert table[12].startswith("lorry,lorry@12,12,12,-3.0,0.25,3.0,11.0,,11 9.5 8,solved,")
    axles = results_json(results)["series"][0]["worst"]["axles"]
    assert [(axle["point"][0], axle["distance"], axle["block"]) for axle in axles] == [
        (-3.0, 11.0, None),
        (-1.5, 9.5, None),
        (0.0, 8.0, "beam[0]"),
    ]
    everything = run(
        deck, RunOptions(folder=tmp_path, force=True, overrides=("output.positions=all", "output.frames=2"))
    )
    assert len({name.split("@")[1][:2] for name in everything.files if "@" in name}) == 12
    assert (tmp_path / "vehicle_beside_its_path.lst").read_text().count("Load case lorry@") == 12
    run(deck, RunOptions(folder=tmp_path, force=True))
    assert not list(tmp_path.glob("*lorry@01*"))


def test_cases_come_in_the_order_of_the_deck() -> None:
    results = tower_results()
    assert chosen_cases(results, None) == results.cases
    assert chosen_cases(results, ["fall", "push_x"]) == results.cases
    assert chosen_cases(results, ["fall"]) == results.cases[1:]


def test_a_case_that_is_not_there_is_named_with_those_that_are() -> None:
    with pytest.raises(UsageError, match=r"^no load case pull in the result; it has push_x, fall$"):
        chosen_cases(tower_results(), ["push_x", "pull"])
