"""JSON records and tables of sweeps against schemas/results.md: its tables name their keys, and no others."""

from __future__ import annotations

import csv
import json
import re
from contextlib import chdir
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from mbla.deck.content import OutputSection
from tests.line import BLOCK, HEAD
from tests.model.soil.decks import BACKFILL, GROUND, TEXT, WALL
from tests.results.json_keys import values_below
from tests.results.outputs import write_outputs
from tests.results.results_md import table
from tests.results.synthetic import full_results
from tests.results.test_results_page import PUSHED

FOUND = "find: {parameter: parameters.mu, target: {load_factor: 0.3}, bounds: [0.1, 1.0]}\n"
LONELY = HEAD + (
    "joints: {dry: {friction: 0.5}}\nsupports: [{ground: {z: 0}}]\n"
    "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
    "blocks:\n  - box: {group: a, material: stone, min: [0, 0, 0], max: [1, 1, 1]}\n"
    "  - box: {group: b, material: stone, min: [3, 0, 2], max: [4, 1, 3]}\n"
)
SWEEP = """\
mbla_sweep: 1
deck: deck.yaml
parameters:
  mu: {key: parameters.mu, normal: {mean: 0.4, deviation: 0.05, min: 0.3}}
  b: {key: parameters.b, values: [1.0, 1.1]}
design: [{random: {of: [mu], points: 3, seed: 1}}, {grid: {of: [b]}}]
fragility: {demand: [0.4]}
"""
LEDGE = BLOCK.replace("live:", "dead: [{gravity: [2.4, 0, -9.81]}], live:")
"""stands where its friction is above 2.4/9.81"""
QUESTIONS = """\
mbla: 1
materials: {stone: {density: 2000, tensile_strength: 50000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
blocks:
  - box: {group: left, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: right, material: stone, min: [3, 0, 0], max: [4, 1, 1]}
  - box: {group: beam, material: stone, min: [0, 0, 1], max: [4, 1, 1.5]}
supports: [{blocks: [left, right]}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  turn: {live: [{tilt: {axis: [0, 1, 0]}}]}
  sink: {settlement: {on: right, direction: [0, 0, -1]}}
  drive: {live: [{travel: {force: [1000, 0, -1000], path: [[1.5, 0.5, 1.5], [2, 0.5, 1.5]], positions: 2}}]}
  thrust: {objective: {force: {on: beam, from: left, direction: [0, 0, 1]}}}
"""
IN_TIME = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
blocks: [{box: {group: a, material: stone, min: [0, 0, 0], max: [1, 1, 1]}}]
supports: [{ground: {z: 0}}]
load_cases:
  shake:
    modes: 1
    time_history:
      motion: {pulse: half_sine, amplitude: 0.3 g, duration: 0.02, direction: x}
      duration: 0.06
      check: true
      record: {points: {top: {on: a}}, interfaces: {foot: {between: [a, ground]}}}
"""
COHESIVE = BACKFILL.replace("friction_angle: 30", "friction_angle: 30, cohesion: 10 kPa, tensile_strength: 5 kPa")
SOIL = TEXT.format(blocks=f"  - {WALL}\n  - {COHESIVE}", contacts="", supports=GROUND, fill="")
JSON_TYPES: dict[str, tuple[type, ...]] = {
    "integer": (int,),
    "number": (int, float),
    "string": (str,),
    "boolean": (bool,),
    "object": (dict,),
    "list": (list,),
    "any": (int, float, str, bool),
}
OF_LARGER_RUNS = (
    *("cases[].mechanism.cracks[]", "cases[].mechanism.yield_lines[]", "cases[].assessment.figures[]"),
    *("cases[].time_history.broken_ties", "cases[].time_history.yielded_ties"),
)
"""keys whose lists are empty here: ``test_files_of_runs`` and ``test_history_damage`` have runs that fill them"""
OF_RECORDS = ("fragility[].limits[]", "fragility_curves[]")
"""keys of a sweep over records: ``tests/sweeps/test_fragility_in_time.py`` has such"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the decks of small runs, the results of two of them, and results in which everything has a value."""
    folder = tmp_path_factory.mktemp("runs")
    decks = {"deck": BLOCK + FOUND, "ledge": LEDGE, "lonely": LONELY, "sweep": SWEEP}
    for name, deck in (decks | {"pushed": PUSHED, "questions": QUESTIONS, "soil": SOIL, "in_time": IN_TIME}).items():
        (folder / f"{name}.yaml").write_text(deck, encoding="utf-8")
    with chdir(folder):
        assert main(["run", "pushed.yaml"]) == 0
        assert main(["run", "questions.yaml"]) == 0
        assert main(["run", "soil.yaml"]) == 0
        assert main(["run", "in_time.yaml"]) == 0
    write_outputs(full_results(), folder / "tower.out", "tower", force=False, output=OutputSection(vtu=False))
    return folder


@pytest.fixture
def answered(folder: Path, capsys: pytest.CaptureFixture[str]) -> Any:
    """What a command prints with --json in that folder."""

    def answer(*arguments: str) -> dict[str, Any]:
        with chdir(folder):
            main([*arguments, "--json"])
        record: dict[str, Any] = json.loads(capsys.readouterr().out)
        return record

    return answer


Keys = dict[str, tuple[str, str]]


def walk(record: dict[str, Any], known: Keys, seen: set[str]) -> None:
    """Every key of a record is on the page, with its type, or is named in the words on what holds it."""
    for path, value in values_below(record, known):
        if path in known:
            kind = re.sub(r" \[.*\]$", "", known[path][0])
            right = kind.endswith("?") if value is None else type(value) in JSON_TYPES[kind.rstrip("?")]
            assert right, f"{path} is {value!r}, on the page {kind}"
            seen.add(path)
        elif not path.endswith("[]"):
            owner, _, key = path.rpartition(".")
            within = any(other.startswith(f"{path}.") for other in known)
            assert within or f"`{key}`" in known.get(owner, ("", ""))[1], f"{path} is not on the page"


def keys_of(title: str) -> Keys:
    return {path: (kind, words) for path, kind, words in table(title)}


def unseen(known: Keys, *records: dict[str, Any]) -> set[str]:
    """Keys of the page that no record has; each record has none but those."""
    seen: set[str] = set()
    for record in records:
        walk(record, known, seen)
    return set(known) - seen


def test_json_of_runs_and_checks(folder: Path, answered: Any) -> None:
    paths = [folder / f"{name}.out" / f"{name}.json" for name in ("tower", "pushed", "questions", "soil", "in_time")]
    runs = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    checked = [answered("check", "deck.yaml"), answered("check", "lonely.yaml")]
    without = unseen(keys_of("JSON record"), *runs, *checked)
    assert not {key for key in without if not key.startswith(OF_LARGER_RUNS)}
    assert not {"cases", "series", "files"} & checked[0].keys()


def test_json_of_verify(answered: Any) -> None:
    known, own = keys_of("JSON record"), keys_of("JSON record of `mbla verify`")
    record = answered("verify", "pushed.out/pushed.h5", "--again")
    assert record["agrees"]
    assert unseen(known | own, record) & own.keys() == set()


def test_json_of_find(answered: Any) -> None:
    known = keys_of("JSON record of `mbla find`")
    stands = ("--parameter", "parameters.mu", "--target", "stands", "--bounds", "0.1", "1")
    assert unseen(known, answered("find", "deck.yaml"), answered("find", "ledge.yaml", *stands)) == set()


def test_table_and_record_of_a_sweep(folder: Path, answered: Any) -> None:
    record = answered("sweep", "sweep.yaml")
    without = unseen(keys_of("JSON record of a sweep"), record)
    assert {key for key in without if not key.startswith(("notices[]", *OF_RECORDS))} <= {"design.places[]"}
    with (folder / "sweep.out" / "sweep.csv").open(encoding="utf-8", newline="") as file:
        head = [re.sub(r" \[.*\]$", "", name) for name in next(csv.reader(file))]
    told = [name for name, *_ in table("Table of a sweep")]
    first, last = told.index("…"), len(told) - 1 - told[::-1].index("…")
    assert head[:first] == told[:first]
    assert head[len(head) - (len(told) - last - 1) :] == told[last + 1 :]
    assert told[first + 1 : last] == ["state"]
    assert "state" in head


def test_record_of_a_diagram(answered: Any) -> None:
    record = answered("interact", "deck.yaml", "--directions", "4")
    known = keys_of("JSON record of a sweep") | keys_of("JSON record of a diagram")
    assert not {key for key in unseen(known, record) if key.startswith("interaction.")}
