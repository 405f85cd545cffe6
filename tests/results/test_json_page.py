"""JSON records and tables of sweeps against schemas/results.md: its tables name their keys, and no others.

Those of runs and checks: ``test_files_of_runs``, by the table from which that of the page is written.
"""

from __future__ import annotations

import csv
import json
import re
from contextlib import chdir
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from tests.line import BLOCK
from tests.results.json_keys import values_below
from tests.results.results_md import table
from tests.results.test_results_page import PUSHED

FOUND = "find: {parameter: parameters.mu, target: {load_factor: 0.3}, bounds: [0.1, 1.0]}\n"
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
JSON_TYPES: dict[str, tuple[type, ...]] = {
    "integer": (int,),
    "number": (int, float),
    "string": (str,),
    "boolean": (bool,),
    "object": (dict,),
    "list": (list,),
    "any": (int, float, str, bool),
}
OF_RECORDS = ("fragility[].limits[]", "fragility_curves[]")
"""keys of a sweep over records: ``tests/sweeps/test_fragility_in_time.py`` has such"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the decks of small runs, and the results of one of them."""
    folder = tmp_path_factory.mktemp("runs")
    for name, deck in {"deck": BLOCK + FOUND, "ledge": LEDGE, "sweep": SWEEP, "pushed": PUSHED}.items():
        (folder / f"{name}.yaml").write_text(deck, encoding="utf-8")
    with chdir(folder):
        assert main(["run", "pushed.yaml"]) == 0
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
