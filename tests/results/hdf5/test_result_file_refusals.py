"""Result files that are refused: not ours, of another version, incomplete, contradictory or damaged."""

from __future__ import annotations

import os
import random
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.errors import FileError
from mbla.results.hdf5.result_file import read_asked, read_results_hdf5, write_results_hdf5
from mbla.results.results import Results
from mbla.run import RunOptions, run
from mbla.verify import same
from tests.line import BLOCK
from tests.results.changed_files import change, changing, remove, replace_dataset
from tests.results.synthetic import full_results, same_findings, tower_results


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


def refused(path: Path) -> str:
    with pytest.raises(FileError) as caught:
        read_results_hdf5(path)
    assert str(path) in str(caught.value)
    return str(caught.value)


def test_not_hdf5(tmp_path: Path) -> None:
    path = tmp_path / "text.h5"
    path.write_text("mbla: 1\n")
    assert "not an HDF5 file" in refused(path)


def test_other_hdf5_file(tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    with h5py.File(path, "w") as file:
        file["x"] = 1
    assert "not an mbla result file" in refused(path)


def test_other_version_is_named(path: Path) -> None:
    with changing(path) as file:
        file.attrs["version"] = 99
    assert "layout version 99" in refused(path)


def test_an_older_version_says_who_wrote_it_and_what_to_do(path: Path) -> None:
    with changing(path) as file:
        file.attrs["version"] = 1
    words = refused(path)
    assert "layout version 1, written by mbla 0.1.0; this mbla reads version 10" in words
    assert "run the deck again" in words


@pytest.mark.every(4)
@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda p: remove(p, "notices/message"), "notices/message is missing"),
        (lambda p: remove(p, "cases/push_x/modes"), "incomplete"),
        (lambda p: remove(p, "cases/fall/status"), "incomplete"),
        (lambda p: replace_dataset(p, "cases/push_x/contact_forces", np.zeros((4, 3))), "along point"),
        (lambda p: replace_dataset(p, "cases/push_x/contact_forces", np.zeros((8, 2))), "along direction"),
        (lambda p: replace_dataset(p, "cases/push_x/contact_forces", np.zeros(8)), "dimensions"),
        (lambda p: replace_dataset(p, "cases/push_x/contact_forces", np.ones((8, 3), dtype=np.int64)), "type"),
        (lambda p: replace_dataset(p, "cases/push_x/modes", np.zeros(8)), "type"),
        (lambda p: change(p, "cases/push_x/contact_forces", np.inf), "not finite"),
        (lambda p: change(p, "cases/push_x/verified", 2), "neither 0 nor 1"),
        (lambda p: change(p, "deck/file_start", 1), "does not divide file_byte"),
        (lambda p: change(p, "cases/push_x/contact_forces", -1e153), "contact_forces is beyond 1e+152"),
        (lambda p: change(p, "cases/push_x/flow_rule", b"x"), "flow_rule of a load case"),
        (lambda p: change(p, "cases/push_x/contact_model", b"x"), "contact_model of a load case"),
        (lambda p: change(p, "cases/push_x/modes", 7), "contact modes"),
        (lambda p: change(p, "cases/push_x/status", b"fine"), "'fine' is not a valid Status"),
        (lambda p: remove(p, "cases/push_x/path_last"), "incomplete"),
        (lambda p: remove(p, "cases/push_x/programs/solver"), "incomplete: push_x: solution"),
        (lambda p: change(p, "cases/push_x/programs/solver", b"x"), "name of a solver"),
        (lambda p: change(p, "cases/push_x/solver", b"x"), "name of a solver"),
        (lambda p: change(p, "notices/severity", b"x"), "severity"),
    ],
)
def test_contradictions(path: Path, spoil: Any, words: Any) -> None:
    spoil(path)
    assert words in refused(path)


def test_reductions_have_known_names(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    run(deck, RunOptions())
    path = tmp_path / "deck.out" / "deck.h5"
    change(path, "cases/push/reductions/name", b"x")
    assert "name of a reduction" in refused(path)


@pytest.mark.every(4)
@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda p: remove(p, "cases/push_x/least/modes"), "incomplete: push_x: least"),
        (lambda p: remove(p, "cases/push_x/level/load_factor"), "incomplete: push_x: level"),
        (lambda p: remove(p, "cases/push_x/standing/falls"), "incomplete: push_x: standing"),
        (lambda p: remove(p, "cases/push_x/size/parts"), "incomplete: push_x: size"),
        (lambda p: change(p, "cases/push_x/size/dimension", 4), "dimension of the model"),
        (lambda p: change(p, "cases/push_x/standing/verdict", b"maybe"), "'maybe' is not a valid Standing"),
        (lambda p: change(p, "cases/push_x/standing/falls", 3), "points outside block"),
        (lambda p: change(p, "cases/push_x/least/modes", 7), "contact modes"),
        (lambda p: change(p, "cases/push_x/lock", np.nan), "not finite"),
        (lambda p: replace_dataset(p, "cases/push_x/path/open", np.zeros(2, dtype=np.int64)), "along path_row"),
    ],
)
def test_contradictions_of_further_answers(tmp_path: Path, spoil: Any, words: Any) -> None:
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    spoil(path)
    assert words in refused(path)


def test_resultants_without_forces_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    with changing(path) as file:
        for name in ("load_factor", "contact_forces", "contact_velocities", "mechanism", "modes", "residual"):
            del file[f"cases/push_x/least/{name}"]
    assert "resultants without forces: least" in refused(path)


def test_truncated_files_are_refused(path: Path, image: bytes) -> None:
    for length in np.linspace(1, len(image) - 1, 40).astype(int):
        path.write_bytes(image[:length])
        refused(path)


@pytest.mark.long
def test_flipped_bits_are_refused_or_change_nothing(path: Path, image: bytes, results: Results) -> None:
    """Seeded: what no checksum covers is padding and tables of dimensions, which are not read.

    What stands there of the model is read where a verification holds it against the deck.
    """
    generator, cases = random.Random(1), [case.name for case in results.model.load_cases]
    asked = read_asked(path, cases)
    unnoticed = 0
    for _ in range(40):
        spoilt = bytearray(image)
        spoilt[generator.randrange(8, len(image))] ^= 1 << generator.randrange(8)
        path.write_bytes(spoilt)
        try:
            assert same_findings(read_results_hdf5(path), results)
            told = read_asked(path, cases)
            unnoticed += told.keys() == asked.keys() and all(same(told[name], asked[name]) for name in asked)
        except FileError:
            continue
    assert unnoticed < 20


def test_a_dataset_elsewhere_or_none_at_all_is_refused(path: Path, image: bytes) -> None:
    """A group in its place, one of another file, one that says it is far larger than the file."""
    with changing(path) as file:
        del file["cases/push_x/mechanism"]
        file.create_group("cases/push_x/mechanism")
    assert "cases/push_x/mechanism is not a dataset" in refused(path)
    other = path.with_name("other.h5")
    with h5py.File(other, "w") as file:
        file["mechanism"] = np.ones(3)
    path.write_bytes(image)
    with changing(path) as file:
        del file["cases/push_x/mechanism"]
        file["cases/push_x/mechanism"] = h5py.ExternalLink("other.h5", "mechanism")
    assert "cases/push_x/mechanism stands in another file" in refused(path)
    path.write_bytes(image)
    with changing(path) as file:
        del file["cases/push_x/mechanism"]
        file.create_dataset("cases/push_x/mechanism", shape=(10**10,), dtype=float, chunks=(1024,))
    assert "cases/push_x/mechanism claims 80000000000 bytes" in refused(path)


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("name", "array", "words"),
    [
        ("cases/push_x/lock", np.zeros((8, 3)), "forces of another number of contact points and ties"),
        ("cases/push_x/standing/falls", np.array([0, 1]), "more than one block that falls first"),
    ],
)
def test_contradictions_that_no_table_can_tell(tmp_path: Path, name: str, array: Any, words: str) -> None:
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    with changing(path) as file:
        old = file[name][...]
        if array is None:
            array = old[::-1]
        if np.shape(array) in ((), np.shape(old)):
            file[name][...] = array
        else:
            del file[name]
            file[name] = array
    assert words in refused(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_what_is_no_regular_file_is_told_in_plain_words(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for name, words in (("missing.h5", "No such file"), (".", "is a folder"), ("pipe", "is not a regular file")):
        with pytest.raises(FileError, match=words) as caught:
            read_results_hdf5(tmp_path / name)
        assert "synchronously" not in str(caught.value)
