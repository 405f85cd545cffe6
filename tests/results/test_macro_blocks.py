"""Decks of macro-blocks: the rigid parts of a mechanism as blocks have its load factor."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.cli import main
from mbla.deck import read_deck
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.macro_blocks import with_slopes_left
from mbla.results.outcome import answer_of, associative_of
from mbla.results.results import Results
from tests.decks.folder import DECKS

WITHIN = 1e-6
Written = Callable[..., tuple[Results, dict[str, Path]]]


@pytest.fixture
def written(tmp_path: Path) -> Written:
    """A function that runs a deck and writes its decks of macro-blocks: the result, and the decks by load case."""

    def write(deck: Path, *options: str, **values: object) -> tuple[Results, dict[str, Path]]:
        stem, folder = deck.stem, tmp_path / "out"
        mbla.run(deck, output=folder, set={"output.vtu": False, **values})
        assert main(["export", str(folder / f"{stem}.h5"), "--macro-blocks", *options]) == 0
        decks = {
            path.stem.removeprefix(f"{stem}_").removesuffix("_macro"): path for path in folder.glob("*_macro.yaml")
        }
        return read_results_hdf5(folder / f"{stem}.h5"), decks

    return write


def run_again(deck: Path) -> Results:
    """The result of a written deck, by which its own expectation is met."""
    run = mbla.run(deck, output=deck.parent / "again", expected=True)
    results = read_results_hdf5(deck.parent / "again" / f"{deck.stem}.h5")
    assert "not-as-expected" not in {notice.identifier for notice in results.notices}
    assert run.exit_code == 0
    return results


def free_solids(results: Results, name: str) -> int:
    """How many rigid bodies can move in a load case, a support that gives way not among them."""
    load_case = results.case(name).load_case
    fixed = results.assembly.glued(load_case).model.fixed
    return int(np.sum(~fixed)) - (not load_case.question.multiplies)


STRUCTURES = {
    "tutorials/wall.yaml": {"in_plane": 1, "out_of_plane": 1},
    "tutorials/arch.yaml": {},
    "tutorials/measured_arch.yaml": {"earth": 3, "earth_on_design": 3, "roller@2": 3},
    "benchmarks/closed_forms/barrel_vault.yaml": {"across": 3},
    "tutorials/dome.yaml": {},
    "tutorials/column.yaml": {},
    "tutorials/spiral_stair_round.yaml": {},
    "tutorials/obj_wall.yaml": {},
    "tutorials/half_of_a_front.yaml": {"inwards": 7, "outwards": 4},
}
"""deck -> parts of its load cases, of those whose number is known beforehand: a wall with a door, arches, a vault, a
dome, a column, a stair with fixed blocks of its own, meshes from a file, half of a symmetric structure"""


SLOW = [f"tutorials/{name}.yaml" for name in ("wall", "measured_arch", "dome", "obj_wall", "half_of_a_front", "arch")]


@pytest.mark.long
@pytest.mark.every(3)
@pytest.mark.parametrize("deck", [pytest.param(deck, marks=[pytest.mark.long] * (deck in SLOW)) for deck in STRUCTURES])
def test_macro_blocks_have_the_load_factor_of_the_blocks(written: Written, deck: str) -> None:
    results, decks = written(DECKS / deck, **{"analysis.flow_rule": "associative"})
    assert decks
    for name, path in decks.items():
        case, again = results.case(name), run_again(path)
        before, after = associative_of(case), associative_of(again.case(name))
        assert before is not None
        assert after is not None
        assert after.load_factor == pytest.approx(before.load_factor, rel=WITHIN)
        groups = read_deck(path).content.groups
        parts = len(groups) - ("at_rest" in groups)
        assert free_solids(again, name) == parts == STRUCTURES[deck].get(name, parts)
        assert len(again.model.blocks) == len(results.model.blocks)


@pytest.mark.long
def test_the_parts_of_a_support_that_gives_way_have_its_reaction(written: Written) -> None:
    results, decks = written(DECKS / "tutorials/settling_wall.yaml")
    assert set(decks) == {"sinks", "turns"}
    for name, path in decks.items():
        before, again = answer_of(results.case(name)), run_again(path)
        assert before is not None
        assert answer_of(again.case(name)) == pytest.approx(before, rel=WITHIN)
        groups = read_deck(path).content.groups
        assert free_solids(again, name) == len(groups) - ("at_rest" in groups)


DOOR = """mbla: 1
materials: {stone: {density: "=rho"}}
joints: {dry: {friction: 0.65}}
blocks:
  - wall:
      material: stone
      unit: [0.4, 0.2, 0.175]
      length: 2.4
      courses: 8
      openings: [{from: [0.8, 0], to: [1.2, 0.875]}]
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases:
  push_x: {live: [{acceleration: [1, 0, 0]}]}
  pushed: {live: [{table: loads/push.csv}]}
"""


@pytest.fixture
def door(tmp_path: Path) -> Path:
    """A wall with a door in two files, with a table of loads beside the second."""
    (tmp_path / "parts" / "loads").mkdir(parents=True)
    (tmp_path / "parts" / "wall.yaml").write_text(DOOR)
    (tmp_path / "parts" / "loads" / "push.csv").write_text("group,index,fx,fy,fz\nwall,40,1000,0,0\n")
    (tmp_path / "door.yaml").write_text("mbla: 1\ninclude: [parts/wall.yaml]\nparameters: {rho: 2000}\n")
    return tmp_path / "door.yaml"


def test_inclusions_overrides_and_files_are_in_the_written_deck(written: Written, door: Path) -> None:
    values = {"analysis.flow_rule": "associative", "joints.dry.friction": 0.5, "parameters.rho": 1800}
    results, decks = written(door, **values)
    for file in (door, door.parent / "parts" / "wall.yaml", door.parent / "parts" / "loads" / "push.csv"):
        file.unlink()
    assert (decks["pushed"].parent / "door_macro_1_push.csv").exists()
    for path in decks.values():
        again = run_again(path)
        assert set(again.model.joints) == set(results.model.joints)
        assert np.array_equal(again.model.blocks.masses, results.model.blocks.masses)


QUESTIONS = """
find: {parameter: joints.dry.friction, target: {load_factor: 0.3}, bounds: [0.1, 2], load_case: push_x}
strengthen:
  required: {push_x: 0.5, pushed: 0.1}
  candidates: [{through: [[0, 0.1, 1], [-1, 0.1, 1]], on: [{group: wall, index: 10}, ground]}]
analysis: {flow_rule: associative, sensitivity: [load_cases.push_x.live.0.acceleration.0]}
"""


def test_what_is_asked_of_the_whole_deck_is_left_out(written: Written, door: Path) -> None:
    (door.parent / "parts" / "wall.yaml").write_text(DOOR + QUESTIONS)
    _, decks = written(door)
    slopes = {}
    for name, path in decks.items():
        content = read_deck(path).content
        assert (content.find, content.strengthen) == (None, None)
        slopes[name] = content.analysis.sensitivity
    assert slopes == {"push_x": ["load_cases.push_x.live.0.acceleration.0"], "pushed": False}


def test_slopes_are_left_of_what_is_in_the_written_deck_as_before() -> None:
    left = ["load_cases.a.live.0.acceleration.0", "joints.dry.friction", "contacts.tolerance", "blocks.0.box.max.2"]
    others = ["load_cases.b.live.0.acceleration.0", "load_cases.a.pushover.step", "load_cases.a.pushover.error"]
    live = {"live": [{"acceleration": [1, 0, 0]}]}
    data = {
        "joints": {"dry": {"friction": 0.6}},
        "blocks": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}],
        "load_cases": {"a": live | {"pushover": {"step": 0.01}}, "b": live},
        "analysis": {"sensitivity": [*others, *left]},
    }
    content = data | {"load_cases": {"a": live}}
    assert with_slopes_left(data, content) == {"sensitivity": left}
    assert with_slopes_left(data | {"analysis": {"sensitivity": others}}, content) == {}
    assert with_slopes_left(data | {"analysis": {"sensitivity": True}}, content) == {"sensitivity": True}


def test_a_coarser_division_carries_more(written: Written) -> None:
    results, decks = written(DECKS / "tutorials/arch.yaml", **{"analysis.flow_rule": "associative"})
    path = decks["along"]
    assert list(read_deck(path).content.groups) == ["at_rest", "part_1", "part_2", "part_3"]
    text = path.read_text()
    between = "between: [part_1, part_1]"
    assert text.count(between) == 1
    path.write_text(text.replace(between, "between: [[part_1, part_2, part_3], [part_1, part_2, part_3]]"))
    run = mbla.run(path, output=path.parent / "again")
    before = associative_of(results.case("along"))
    assert before is not None
    assert run.load_factor > 1.1 * before.load_factor


@pytest.mark.long
def test_the_parts_of_associative_flow_prove_the_factor_of_a_deck_without_normality(
    written: Written, door: Path
) -> None:
    results, decks = written(door, "--associative", "--case", "push_x")
    assert set(decks) == {"push_x"}
    before, after = associative_of(results.case("push_x")), associative_of(run_again(decks["push_x"]).case("push_x"))
    assert before is not None
    assert after is not None
    assert after.load_factor == pytest.approx(before.load_factor, rel=WITHIN)


@pytest.mark.long
def test_the_parts_shown_of_a_deck_without_normality_carry_no_less(written: Written, door: Path) -> None:
    results, decks = written(door, "--case", "push_x")
    assert "expected" not in decks["push_x"].read_text()
    again = mbla.run(decks["push_x"], output=decks["push_x"].parent / "again")
    before = associative_of(results.case("push_x"))
    assert before is not None
    assert again.case("push_x").associative_load_factor >= (1 - WITHIN) * before.load_factor
    assert again.case("push_x").verified


@pytest.mark.long
def test_macro_blocks_of_macro_blocks_are_the_same(written: Written, door: Path) -> None:
    _, decks = written(door, **{"analysis.flow_rule": "associative"})
    first = decks["push_x"]
    again = run_again(first)
    folder = first.parent / "again"
    assert main(["export", str(folder / f"{first.stem}.h5"), "--macro-blocks"]) == 0
    second = folder / f"{first.stem}_push_x_macro.yaml"
    twice = run_again(second)
    assert read_deck(second).content.groups == read_deck(first).content.groups
    assert free_solids(twice, "push_x") == free_solids(again, "push_x")


def test_what_cannot_be_written_is_refused_and_leaves_nothing(
    written: Written, door: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _, decks = written(door, "--case", "push_x", **{"analysis.flow_rule": "associative"})
    before = {path: path.read_bytes() for path in decks["push_x"].parent.iterdir()}
    result = str(decks["push_x"].parent / "door.h5")
    assert main(["export", result, "--macro-blocks"]) == 6
    assert "[result-exists]" in capsys.readouterr().err
    assert main(["export", result, "--macro-blocks", "--case", "pull"]) == 2
    assert "[unknown-load-case]" in capsys.readouterr().err
    for options in (["--macro-blocks", "--csv"], ["--associative"]):
        assert main(["export", result, *options]) == 2
        assert "[command-line]" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in decks["push_x"].parent.iterdir()} == before


def test_without_a_mechanism_there_are_no_parts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mbla.run(DECKS / "benchmarks/closed_forms/groove_locked.yaml", output=tmp_path)
    assert main(["export", str(tmp_path / "groove_locked.h5"), "--macro-blocks"]) == 2
    assert "[no-mechanism]" in capsys.readouterr().err
