"""Files of real runs of every kind: nothing in them that schemas/results.md does not describe, and the reverse."""

from __future__ import annotations

import json
import re
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.check import check
from mbla.deck import read_deck
from mbla.results.hdf5.layout import text_of
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.quantities.registry import STORED
from mbla.results.record.check_record import check_json
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.run import RunOptions, run
from tests.decks.folder import BENCHMARKS
from tests.results.json_keys import values_below
from tests.results.results_page import RECORD
from tests.results.rocking import rocking_case
from tests.results.synthetic import full_results
from tests.results.test_history_damage import DECK as TIES_IN_TIME

ROOT = Path(__file__).parents[2]
TUTORIALS = ROOT / "decks" / "tutorials"
DECKS = {
    "beam_on_three_supports": "settlement",
    "beam_under_travelling_load": "travel",
    "tilting_block": "tilt",
    "glued_lintel": "glue",
    "ring_rope_and_strip": "ties",
    "eccentric_compression_convex": "convex contact model",
    "incline_too_steep": "no equilibrium, certificate",
    "groove_locked": "unbounded, lock",
    "ferris_wall_1_slope": "load path",
    "thrust_of_an_arch": "objective",
    "assessed_facade": "assessment, pushover",
    "active_earth_pressure": "soil of cells",
}
FEWER: dict[str, tuple[str, ...]] = {
    "beam_under_travelling_load": (
        "materials.stone.tensile_strength=1 kPa",  # its units may crack
        "load_cases.crane.live.0.travel.positions=3",
        "load_cases.lorry.live.0.travel.positions=3",
    ),
    "assessed_facade": ("load_cases.outwards.pushover.step=0.05",),
}
"""what is changed of a deck"""
TYPES: dict[str, tuple[type, ...]] = {
    "integer": (int,),
    "number": (int, float),
    "string": (str,),
    "boolean": (bool,),
    "object": (dict,),
    "list": (list,),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs")
    for name in DECKS:
        deck = BENCHMARKS.get(name, TUTORIALS / f"{name}.yaml")
        run(deck, RunOptions(folder=folder, overrides=("output.vtu=false", *FEWER.get(name, ()))))
    ties = folder / "ties_in_time.yaml"
    ties.write_text(TIES_IN_TIME, encoding="utf-8")
    run(ties, RunOptions(folder=folder, overrides=("output.vtu=false",)))
    return folder


def records(folder: Path) -> list[dict[str, Any]]:
    """Of the runs, of a check and of results with every field filled."""
    beam = BENCHMARKS["beam_under_travelling_load"]
    own = [json.loads((folder / f"{name}.json").read_text(encoding="utf-8")) for name in (*DECKS, "ties_in_time")]
    full = full_results()
    lonely = replace(full.contacts, report=replace(full.contacts.report, isolated=np.array([2])))
    checked = [
        check_json(*check(read_deck(beam), RunOptions(), vtu=False, started=time.perf_counter())),
        check_json(replace(full, assembly=replace(full.assembly, contacts=lonely)), {}),
    ]
    in_time = replace(full, cases=(rocking_case(full.cases[1]),))
    return [*own, *(json.loads(json_line(results_json(each))) for each in (full, in_time)), *checked]


def walk(record: dict[str, Any], known: dict[str, str], seen: set[str]) -> None:
    """Every key of a record is known, and its type is the one that is told."""
    for path, value in values_below(record, known):
        assert path in known, f"{path} is not described"
        kind = known[path]
        if value is None:
            assert kind.endswith("?"), f"{path} is null"
        else:
            assert type(value) in TYPES[kind.rstrip("?")], f"{path} is {value!r}"
        seen.add(path)


def test_every_key_of_the_records_is_described_and_the_reverse(folder: Path) -> None:
    known = {key.path: key.kind for key in RECORD}
    assert len(known) == len(RECORD)
    seen: set[str] = set()
    for record in records(folder):
        walk(record, known, seen)
    assert set(known) - seen == set()


@pytest.mark.every(4)
@pytest.mark.parametrize("name", DECKS)
def test_the_file_holds_the_whole_record(folder: Path, name: str) -> None:
    """``mbla show --json`` says what the run said."""
    told = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
    assert json.loads(json_line(results_json(read_results_hdf5(folder / f"{name}.h5")))) == told


@pytest.mark.every(4)
@pytest.mark.parametrize("name", DECKS)
def test_every_dataset_is_described(folder: Path, name: str) -> None:
    fields = {field.path: field for field in STORED}
    with h5py.File(folder / f"{name}.h5") as file:
        found: list[str] = []
        file.visititems(lambda path, item: found.append(path) if isinstance(item, h5py.Dataset) else None)
        for dataset in (file[path] for path in found if not file[path].is_scale):
            field = fields[re.sub(r"^/cases/[^/]+/", "cases/*/", dataset.name).lstrip("/")]
            standard = {"units", "long_name", "DIMENSION_LIST", "DIMENSION_LABELS"}
            of_text, not_verified = (
                {"_Encoding"} if field.kind == "text" else set(),
                {"verification"} if field.unproved(text_of(dataset[()])) else set(),
            )
            assert set(dataset.attrs) - standard == of_text | not_verified
            assert tuple(dimension.label for dimension in dataset.dims) == field.dims
