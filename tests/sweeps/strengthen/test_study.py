"""``mbla strengthen`` from deck to strengthened deck; its program is tested in tests/analytic/test_strengthening.py."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import pytest

from mbla.cli import main
from mbla.deck import read_deck
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.movable_deck import movable_deck
from mbla.results.provenance import deck_record
from mbla.solution.solution import Status
from mbla.sweeps.strengthen import study
from mbla.sweeps.strengthen.ceiling import GREATEST, greatest_capacities, settled_factors, shortfall
from mbla.sweeps.strengthen.question import question_of
from mbla.verify import verify_file
from tests.analytic.test_strengthening import ALONE, ROD
from tests.analytic.test_ties import WEIGHT
from tests.decks.folder import DECKS

QUIET = "output: {vtu: false}\n"
DECK = ALONE + QUIET + f"strengthen: {{required: {{push: 0.5}}, candidates: [{ROD}]}}\n"
CAPACITY = WEIGHT * 0.3 / 1.6
HALF = "strengthen: {required: {push: 0.4}, catalogue: [2000, 5000], candidates: ["
WALL = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 1.2, courses: 5}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases:
  out: {live: [{acceleration: [0, 1, 0]}]}
  back: {live: [{acceleration: [0, -1, 0]}]}
output: {vtu: false}
strengthen:
  required: {out: 0.35, back: 0.35}
  candidates:
    - {name: bars, vertical: {down: wall, every: 0.4}, cost: 2}
    - {name: rod, through: [[0.6, 0, 0.9], [0.6, -2, 0.9]], on: [wall, ground]}
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK, encoding="utf-8")
    return path


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where the extra is not installed: drawing takes most of the time; one test has them."""
    monkeypatch.setattr(study, "find_spec", lambda name: None)


def told(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, dict[str, object]]:
    code = main(["strengthen", *arguments, "--json"])
    return code, json.loads(capsys.readouterr().out)


def test_the_strengthened_deck_carries_what_it_has_to(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, record = told(capsys, str(path))
    assert code == 0
    assert record["cost"] == pytest.approx(3 * CAPACITY, rel=2e-4)
    assert record["least_cost"] == pytest.approx(3 * CAPACITY, rel=1e-6)
    folder = path.parent / "deck.out"
    deck = read_deck(folder / "deck_strengthened.yaml")
    assert deck.content.strengthen is None
    assert [tie.capacity for tie in deck.content.ties] == pytest.approx([CAPACITY], rel=2e-4)
    results = read_results_hdf5(folder / "deck_strengthened.h5")
    assert results.cases[0].solution.mechanics is not None
    assert results.cases[0].solution.mechanics.load_factor == pytest.approx(0.5, rel=2e-4)
    assert verify_file(folder / "deck_strengthened.h5")[1] == ()
    table = (folder / "deck_strengthened.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(table))
    assert [row["name"] for row in rows] == ["through[0]"]


def test_the_structure_and_its_mechanism_are_drawn(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study, "find_spec", find_spec)
    assert main(["strengthen", str(path), "-q"]) == 0
    pictures = sorted(each.name for each in (path.parent / "deck.out").glob("*.png"))
    assert pictures == ["deck_strengthened_model.png", "deck_strengthened_push.png"]


def test_an_earlier_result_is_kept_without_force(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["strengthen", str(path), "-q"]) == 0
    assert main(["strengthen", str(path), "-q"]) == 6
    assert main(["strengthen", str(path), "-q", "--force"]) == 0
    assert "deck_strengthened" in capsys.readouterr().err


def test_files_that_the_deck_names_lie_beside_the_strengthened_one(path: Path) -> None:
    """Of the deck itself and of one that it includes; those of the deck are not needed any more."""
    parts = path.parent / "parts"
    parts.mkdir()
    parts.joinpath("case.yaml").write_text("load_cases: {side: {live: [{table: loads.csv}]}}\n", encoding="utf-8")
    contents = ["group,index,fx,fy,fz\nblock,0,100,0,0\n", "group,index,fx,fy,fz\nblock,0,1000,0,0\n"]
    files = [parts / "loads.csv", path.parent / "more.csv"]
    for file, content in zip(files, contents, strict=True):
        file.write_text(content, encoding="utf-8")
    text = DECK.replace("live: [{acceleration: [1, 0, 0]}]", "live: [{table: more.csv}]").replace("0.5}", "100}")
    path.write_text(f"include: [parts/case.yaml]\n{text}", encoding="utf-8")
    assert main(["strengthen", str(path), "-q"]) == 0
    for file in files:
        file.unlink()
    deck = read_deck(path.parent / "deck.out" / "deck_strengthened.yaml")
    assert len(deck.content.ties) == 1
    named = {side.value: deck.resolve_file(side.key, side.value).read_text("utf-8") for side in deck.side_files}
    assert named == dict(zip(["deck_strengthened_1_loads.csv", "deck_strengthened_2_more.csv"], contents, strict=True))
    assert verify_file(path.parent / "deck.out" / "deck_strengthened.h5")[1] == ()


@pytest.mark.long
def test_flow_without_dilatancy_decides_and_capacities_are_raised_for_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both ways: bars in the middle of the wall hold it, its own flow rule being without normality."""
    path = tmp_path / "wall.yaml"
    path.write_text(WALL, encoding="utf-8")
    code, record = told(capsys, str(path))
    assert code == 0
    cases = record["cases"]
    assert isinstance(cases, dict)
    assert all(case["load_factor"] >= 0.35 * (1 - 1e-5) for case in cases.values())
    assert isinstance(record["cost"], float)
    assert record["least_cost"] <= record["cost"] * (1 + 1e-6)  # type: ignore[operator]  # numbers of JSON


@pytest.mark.long
def test_the_facade_of_the_structures_carries_what_it_has_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What its comment says; capacities of the catalogue are raised past those that are a little too weak inwards."""
    path = DECKS / "structures" / "facade_to_strengthen.yaml"
    code, record = told(capsys, str(path), "-o", str(tmp_path), "--set", "output.vtu=false")
    assert code == 0
    assert record["verified"]
    cases, candidates = record["cases"], record["candidates"]
    assert isinstance(cases, dict)
    assert isinstance(candidates, list)
    assert all(case["load_factor"] >= 0.25 for case in cases.values())
    assert [case["load_factor"] for case in cases.values()] == pytest.approx([0.268, 0.266, 0.353, 0.336], abs=5e-3)
    used = {each["name"]: each["capacity"] for each in candidates if each["capacity"]}
    assert used == {"bar_0[0]": 150, "bar_1[0]": 150, "bar_2[0]": 60, "top_2[0]": 30}


def test_a_catalogue_leaves_out_what_is_hardly_used(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of two rods of one worth the program may share the force; one of the next size is enough."""
    two = ROD.replace("0.5,", "0.3,")
    path = tmp_path / "deck.yaml"
    path.write_text(ALONE + QUIET + HALF + f"{ROD}, {two}]}}\n", encoding="utf-8")
    code, record = told(capsys, str(path))
    assert code == 0
    candidates = record["candidates"]
    assert isinstance(candidates, list)
    assert sorted(each["capacity"] for each in candidates) == [0.0, 2000.0]


def test_two_of_the_catalogue_beside_each_other_are_as_much_as_is_allowed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where one of the greatest is too little, and two of it are more than is allowed."""
    great, small = 0.8 * CAPACITY, 0.3 * CAPACITY
    rod = ROD.replace("on:", f"most: {1.5 * CAPACITY}, on:")
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.replace(f"[{ROD}]", f"[{rod}], catalogue: [{small}, {great}]"), encoding="utf-8")
    code, record = told(capsys, str(path))
    assert code == 0
    assert record["cost"] == pytest.approx(3 * (great + small), rel=1e-8)


def test_where_nothing_has_to_be_added_it_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.replace("push: 0.5}", "push: 0.1}"), encoding="utf-8")
    assert main(["strengthen", str(path)]) == 0
    assert "nothing has to be added" in capsys.readouterr().out
    assert read_deck(tmp_path / "deck.out" / "deck_strengthened.yaml").content.ties == []


def test_a_load_case_without_limit_is_carried(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "deck.yaml"
    down = "  down: {live: [{force: [0, 0, -1], on: block, at: [0.2, 0.5, 2]}]}\n"
    text = DECK.replace("push: 0.5}", "push: 0.5, down: 2}").replace("analysis:", f"{down}analysis:")
    path.write_text(text, encoding="utf-8")
    code, record = told(capsys, str(path))
    assert code == 0
    assert record["cases"]["down"] == {"required": 2.0, "load_factor": None}  # type: ignore[index]  # of JSON


def test_bars_end_where_the_lowest_block_is_on_ground(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Over an upper block, down through the one below it; over air, none."""
    upper = (
        "blocks:\n  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 2]}\n"
        "  - box: {group: high, material: stone, min: [0, 0, 2], max: [2, 1, 3]}\n"
    )
    text = WALL[: WALL.index("blocks:")] + upper + WALL[WALL.index("contacts:") : WALL.index("    - {name: bars")]
    path = tmp_path / "deck.yaml"
    path.write_text(text.replace("0.35", "0.6") + "    - {vertical: {down: high, every: 1}}\n", encoding="utf-8")
    _, record = told(capsys, str(path))
    bars = record["candidates"]
    assert isinstance(bars, list)
    assert [each["to_body"] for each in bars] == ["ground"]
    assert bars[0]["from_place"] + bars[0]["to_place"] == pytest.approx([0.5, 0.5, 3.0, 0.5, 0.5, 0.0])


def test_where_no_ties_suffice_the_exit_status_is_5(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.replace("[-3, 0.5", "[3, 0.5"), encoding="utf-8")
    code, record = told(capsys, str(path))
    assert (code, record["status"]) == (5, "no_equilibrium")
    assert main(["strengthen", str(path)]) == 5
    assert "No strengthening" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "identifier"),
    [
        (ALONE, "no-strengthening"),
        (
            DECK.replace("live: [{acceleration: [1, 0, 0]}]", "live: [{tilt: {axis: [0, 1, 0]}}]"),
            "strengthen-not-possible",
        ),
        (DECK.replace("live: [{acceleration: [1, 0, 0]}]", "modes: 3"), "strengthen-not-possible"),
        (DECK + "symmetry: [{y: 0}]\n", "strengthen-not-possible"),
        (
            DECK.replace(
                "[{acceleration: [1, 0, 0]}]",
                "[{acceleration: [1, 0, 0]}], at: 0.1, objective: {force: {on: block, direction: [0, 0, 1]}}",
            ),
            "strengthen-not-possible",
        ),
    ],
)
def test_what_has_no_such_program_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, identifier: str
) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(text, encoding="utf-8")
    assert main(["strengthen", str(path)]) == 2
    assert f"[{identifier}]" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("candidate", "identifier"),
    [
        ("{vertical: {down: block, every: 1e-3}}", "too-many-candidates"),
        ("{across: {between: [block, block], z: [1], every: 50}}", "out-of-bounds"),
        (ROD.replace("on:", "most: 1, on:") + "], catalogue: [2", "out-of-bounds"),
    ],
)
def test_candidates_that_cannot_be_laid_out_are_faults_of_the_deck(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], candidate: str, identifier: str
) -> None:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.replace(ROD, candidate), encoding="utf-8")
    assert main(["strengthen", str(path)]) == 3
    assert f"[{identifier}]" in capsys.readouterr().err


def test_why_no_capacities_suffice_names_what_moves_and_ties_that_bear_less_than_they_could(path: Path) -> None:
    """Two blocks, a rod at the lower one: the upper one slides at the friction, whatever the rod bears."""
    path.write_text(
        """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.2}}
blocks:
  - box: {group: lower, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: upper, material: stone, min: [0, 0, 1], max: [1, 1, 1.5]}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
strengthen: {required: {push: 0.5}, candidates: [
  {name: rod, through: [[0, 0.5, 0.5], [-2, 0.5, 0.5]], on: [lower, ground]}]}
"""
    )
    deck = read_deck(path)
    model, candidates, question = question_of(deck, lambda record: None)
    capacities = greatest_capacities(question)
    weight = 1.5 * 2000 * 9.81
    assert capacities == pytest.approx([10 * weight * (1 + 0.5)])
    movable = movable_deck(deck, deck_record(deck).files, "tied")
    results = study._analysis(deck, movable, model, candidates.ties, capacities)
    factors = {"push": results.cases[0].checks.static_bound}
    says = shortfall(results, {"push": 0.5}, {"push": 0.2}, candidates.ties.names, GREATEST)
    assert factors["push"] == pytest.approx(0.2, rel=1e-3)
    assert "push carries 0.2, required 0.5" in says
    assert "upper" in says.partition("It fails so: ")[2]
    assert "Below their capacity are rod[0] (" in says
    assert shortfall(results, {"push": 0.2}, factors, candidates.ties.names, GREATEST) == ""
    assert settled_factors(results, {"push": 0.2}) == pytest.approx({"push": 0.2}, rel=1e-6)
    assert settled_factors(results, {"push": 0.3}) == {}, "smaller capacities carried more"
    (case,) = results.cases
    rough = replace(results, cases=(replace(case, status=Status.APPROXIMATE),))
    assert settled_factors(rough, {"push": 0.2}) == {}
