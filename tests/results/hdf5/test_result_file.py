"""Result files: what is written comes back."""

from __future__ import annotations

from dataclasses import MISSING, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import FileError
from mbla.results.hdf5.content import content_of
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.results import Results
from tests.results.changed_files import changing
from tests.results.synthetic import full_results, same, same_findings, tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


@pytest.fixture(scope="module")
def image(results: Results) -> bytes:
    return write_results_hdf5(results)


@pytest.fixture
def path(tmp_path: Path, image: bytes) -> Path:
    path = tmp_path / "tower.h5"
    path.write_bytes(image)
    return path


@pytest.mark.parametrize("flow_rule", ["non_associative", "associative"])
def test_everything_comes_back(tmp_path: Path, flow_rule: str) -> None:
    results = tower_results(flow_rule)
    path = tmp_path / "tower.h5"
    path.write_bytes(write_results_hdf5(results))
    back = read_results_hdf5(path)
    assert same_findings(back, results)
    own = back.cases[0].solution.associative is back.cases[0].solution.mechanics
    assert own == (flow_rule == "associative")


def test_every_field_of_every_record_comes_back(tmp_path: Path) -> None:
    results = full_results()
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(results))
    assert same_findings(read_results_hdf5(path), results)


def test_the_full_results_leave_no_field_at_its_default() -> None:
    """So that a field that is added to these records cannot be left out of the file unnoticed."""
    case = full_results().cases[0]
    for record in (case.solution, case.solution.mechanics, case.checks):
        assert record is not None
        for field in fields(record):
            if field.default is not MISSING:
                assert not same(getattr(record, field.name), field.default), field.name
            else:
                assert getattr(record, field.name) is not None, field.name


def test_the_model_is_that_of_the_deck(path: Path, results: Results) -> None:
    """Arrays of the model in the file are for other readers."""
    with changing(path) as file:
        del file["contacts/areas"], file["model/title"]
    back = read_results_hdf5(path)
    assert back.model.title == "Tower and brick"
    assert back.model.blocks.centroids == pytest.approx(results.model.blocks.centroids)
    assert back.contacts.points == pytest.approx(results.contacts.points, abs=1e-12)


@pytest.mark.parametrize("name", ["model/centroids", "contacts/points"])
def test_forces_are_not_put_on_blocks_and_points_that_are_elsewhere(path: Path, name: str) -> None:
    with changing(path) as file:
        file[name][0, 0] += 1e-3
    with pytest.raises(FileError, match=f"{name} are not those that its deck gives"):
        read_results_hdf5(path)
    read_results_hdf5(path, to_verify=True)


@pytest.mark.parametrize(("old", "new"), [("friction: 0.6", "friction: 0.5"), ("=5/9.81", "=6/9.81")])
def test_forces_of_another_deck_text_are_not_read(path: Path, old: str, new: str) -> None:
    """Where blocks and contact points are the same; a verification reads them, to say what differs."""
    with changing(path) as file:
        texts = [text.decode() for text in file["deck/source_texts"]]
        assert old in texts[0]
        del file["deck/source_texts"]
        file["deck/source_texts"] = [text.replace(old, new).encode() for text in texts]
    with pytest.raises(FileError, match="its deck was changed after the run: run the deck again, mbla verify says"):
        read_results_hdf5(path)
    read_results_hdf5(path, to_verify=True)


@pytest.mark.parametrize(
    ("gaps", "words"),
    [(np.ones(3), "contacts/gaps: 3 along interface, which has 2"), (np.ones((2, 1)), "the layout has 1")],
)
def test_results_that_contradict_themselves_are_not_written(gaps: Any, words: str) -> None:
    results = tower_results()
    with pytest.raises(AssertionError, match=words):
        write_results_hdf5(
            replace(results, assembly=replace(results.assembly, contacts=replace(results.contacts, gaps=gaps)))
        )


def test_what_the_layout_does_not_have_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "mbla.results.hdf5.result_file.content_of", lambda results: {**content_of(results), "model/colour": "red"}
    )
    with pytest.raises(AssertionError, match=r"not in the layout: \['model/colour'\]"):
        write_results_hdf5(tower_results())


def test_same_results_give_same_bytes_but_for_the_date(results: Results, image: bytes) -> None:
    assert write_results_hdf5(results) == image
    assert write_results_hdf5(replace(results, created="2026-01-01T00:00:00+00:00")) != image
