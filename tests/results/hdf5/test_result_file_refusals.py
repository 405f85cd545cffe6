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
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.results import Results
from mbla.run import RunOptions, run
from tests.line import BLOCK
from tests.results.changed_files import change, changing, remove, replace_dataset
from tests.results.synthetic import full_results, same, tower_results


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
        (lambda p: remove(p, "model/vertices"), "model/vertices is missing"),
        (lambda p: remove(p, "cases/push_x/modes"), "incomplete"),
        (lambda p: remove(p, "cases/fall/status"), "incomplete"),
        (lambda p: replace_dataset(p, "model/volumes", np.ones(4)), "along block"),
        (lambda p: replace_dataset(p, "model/vertices", np.zeros((7, 3))), "does not divide vertex"),
        (lambda p: replace_dataset(p, "model/vertices", np.zeros((24, 2))), "along axis"),
        (lambda p: replace_dataset(p, "model/vertices", np.zeros(24)), "dimensions"),
        (lambda p: replace_dataset(p, "model/volumes", np.ones(3, dtype=np.int64)), "type"),
        (lambda p: replace_dataset(p, "contacts/joints", np.zeros(2)), "type"),
        (lambda p: change(p, "model/volumes", np.nan), "not finite"),
        (lambda p: change(p, "cases/push_x/contact_forces", np.inf), "not finite"),
        (lambda p: change(p, "cases/push_x/dead_load", -1e130), "beyond 1e+120"),
        (lambda p: change(p, "cases/push_x/contact_forces", -1e153), "contact_forces is beyond 1e+152"),
        (lambda p: change(p, "model/volumes", 1e200), "volumes is beyond 1e+152"),
        (lambda p: change(p, "cases/push_x/live_load", 0.0), "push_x: no live load on blocks that can move"),
        (lambda p: change(p, "cases/push_x/flow_rule", b"x"), "flow_rule of a load case"),
        (lambda p: change(p, "cases/push_x/contact_model", b"x"), "contact_model of a load case"),
        (lambda p: change(p, "model/volumes", 0.0), "blocks are no solids"),
        (lambda p: change(p, "model/densities", 1e-300), "density of a block"),
        (lambda p: change(p, "model/centroids", 1e130), "centroids of blocks are not those within their faces"),
        (lambda p: change(p, "model/vertices", 1e130), "volumes of blocks are not those within their faces"),
        (lambda p: change(p, "contacts/areas", 1.01), "areas of interfaces are not those of their contact points"),
        (lambda p: change(p, "contacts/frames", 0.0), "frames of contact points are not orthonormal"),
        (lambda p: change(p, "contacts/normals", 2.0), "do not follow the normals of interfaces"),
        (lambda p: change(p, "model/fixed", 2), "neither 0 nor 1"),
        (lambda p: change(p, "model/loops", 24), "points outside vertex"),
        (lambda p: change(p, "contacts/bodies", -1), "points outside body"),
        (lambda p: change(p, "contacts/bodies", 5), "points outside body"),
        (lambda p: change(p, "model/vertex_start", [0, 16, 8, 24]), "does not divide vertex"),
        (lambda p: change(p, "contacts/point_start", [0, 4, 7]), "does not divide point"),
        (lambda p: change(p, "contacts/outline", 5), "outline"),
        (lambda p: change(p, "cases/push_x/modes", 7), "contact modes"),
        (lambda p: change(p, "cases/push_x/status", b"fine"), "'fine' is not a valid Status"),
        (lambda p: remove(p, "cases/push_x/path_last"), "incomplete"),
        (lambda p: remove(p, "cases/push_x/programs/solver"), "incomplete: push_x: solution"),
        (lambda p: change(p, "cases/push_x/programs/solver", b"x"), "name of a solver"),
        (lambda p: change(p, "cases/push_x/solver", b"x"), "name of a solver"),
        (lambda p: change(p, "model/units", b"x"), "units"),
        (lambda p: change(p, "notices/severity", b"x"), "severity"),
        (lambda p: change(p, "model/ground_joints", b"x"), "joint law of a ground plane"),
        (lambda p: change(p, "contacts/joint_names", b"x"), "joint law of an interface"),
        (lambda p: change(p, "model/fixed", 1), "no block can move"),
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
    """Seeded: what no checksum covers is padding and tables of dimensions, which are not read."""
    generator = random.Random(1)
    unnoticed = 0
    for _ in range(40):
        spoilt = bytearray(image)
        spoilt[generator.randrange(8, len(image))] ^= 1 << generator.randrange(8)
        path.write_bytes(spoilt)
        try:
            assert same(read_results_hdf5(path), results)
            unnoticed += 1
        except FileError:
            continue
    assert unnoticed < 20


def test_a_dataset_elsewhere_or_none_at_all_is_refused(path: Path, image: bytes) -> None:
    """A group in its place, one of another file, one that says it is far larger than the file."""
    with changing(path) as file:
        del file["model/volumes"]
        file.create_group("model/volumes")
    assert "model/volumes is not a dataset" in refused(path)
    other = path.with_name("other.h5")
    with h5py.File(other, "w") as file:
        file["volumes"] = np.ones(3)
    path.write_bytes(image)
    with changing(path) as file:
        del file["model/volumes"]
        file["model/volumes"] = h5py.ExternalLink("other.h5", "volumes")
    assert "model/volumes stands in another file" in refused(path)
    path.write_bytes(image)
    with changing(path) as file:
        del file["model/volumes"]
        file.create_dataset("model/volumes", shape=(10**10,), dtype=float, chunks=(1024,))
    assert "model/volumes claims 80000000000 bytes" in refused(path)


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("name", "array", "words"),
    [
        ("model/load_cases", b"fall", "two load cases of one name"),
        ("model/guided_bodies", np.array([1]), "guided blocks and bodies"),
        ("model/position_names", None, "names of the positions of blocks"),
        ("contacts/solid_of_block", np.array([0, 1, 3]), "numbers of rigid bodies"),
        ("cases/push_x/settlement/unit", 0.0, "settlement of a support"),
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
