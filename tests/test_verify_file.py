"""``mbla verify`` agrees with what a run wrote, and with nothing else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import FileError
from mbla.results.hdf5.reading import MOST
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.run_deck import run
from mbla.run_options import RunOptions
from mbla.verify_file import verify_results
from tests.line import BLOCK
from tests.results.changed_files import change, changing
from tests.solution.convex_structures import TWIST

NON_ASSOCIATIVE = BLOCK.replace("flow_rule: associative", "flow_rule: non_associative")
LARGE = MOST / 2


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    deck = tmp_path_factory.mktemp("verify") / "deck.yaml"
    deck.write_text(NON_ASSOCIATIVE, encoding="utf-8")
    run(deck, RunOptions(overrides=("parameters.mu=0.4",)))
    return (deck.parent / "deck.out" / "deck.h5").read_bytes()


@pytest.fixture
def path(tmp_path: Path, image: bytes) -> Path:
    path = tmp_path / "deck.h5"
    path.write_bytes(image)
    return path


def differences(path: Path) -> str:
    """What verification finds wrong with a file; its exit status must tell."""
    results, disagreements = verify_results(read_results_hdf5(path))
    assert (results.exit_code == 0) == (not disagreements)
    return "\n".join(disagreements)


def scaled(path: Path, name: str, factor: float) -> None:
    with changing(path) as file:
        file[name][...] = file[name][()] * factor


def enlarged(path: Path, name: str, largest: float) -> None:
    with changing(path) as file:
        values = np.asarray(file[name][()])
        file[name][...] = values * (largest / np.abs(values).max())


def test_a_file_as_it_was_written_agrees(path: Path) -> None:
    results, disagreements = verify_results(read_results_hdf5(path))
    assert disagreements == ()
    assert results.exit_code == 0
    assert "deck-not-rebuilt" not in {notice.identifier for notice in results.notices}


@pytest.mark.parametrize(
    ("name", "factor", "words"),
    [
        ("model/densities", 1.01, "model/densities is not what the deck in the file gives"),
        ("model/friction", 1.01, "model/friction is not what the deck in the file gives"),
        ("cases/push/live_load", 1.01, "cases/push/live_load is not what the deck in the file gives"),
        ("cases/push/associative/load_factor", 1.01, "is not between its bounds"),
        ("cases/push/contact_velocities", 1.01, "contact velocities (mechanics) are not those of the mechanism"),
        ("cases/push/live_power", 1.01, "live power is 1 recomputed, the file says 1.01"),
    ],
)
def test_what_the_deck_or_the_mechanism_does_not_give(path: Path, name: str, factor: float, words: str) -> None:
    scaled(path, name, factor)
    assert words in differences(path)


@pytest.mark.parametrize("largest", [1e50, 1e100, LARGE])
@pytest.mark.parametrize(
    "name",
    [
        "model/friction",
        "cases/push/contact_forces",
        "cases/push/contact_velocities",
        "cases/push/mechanism",
        "cases/push/associative/contact_forces",
        "cases/push/associative/mechanism",
        "cases/push/load_factor",
        "cases/push/associative/load_factor",
    ],
)
def test_numbers_near_the_end_of_all_are_disagreed_with(path: Path, name: str, largest: float) -> None:
    """Without a warning on the way."""
    enlarged(path, name, largest)
    assert differences(path)


@pytest.mark.parametrize("name", ["load_factor", "resultants", "torsion_motions", "mechanism"])
def test_resultants_and_motions_of_interfaces_near_the_end_of_all_numbers_are_disagreed_with(
    tmp_path: Path, name: str
) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(TWIST, encoding="utf-8")
    run(deck, RunOptions(overrides=("parameters.e1=0.3",)))
    path = tmp_path / "deck.out" / "deck.h5"
    enlarged(path, f"cases/couple/{name}", 1e200 if name == "load_factor" else LARGE)
    assert differences(path)


@pytest.mark.parametrize("part", ["", "associative/"])
def test_load_factors_whose_squares_are_beyond_numbers_are_disagreed_with(path: Path, part: str) -> None:
    """A program that diverged may have any; files with them are read."""
    change(path, f"cases/push/{part}load_factor", 1e200)
    assert differences(path)


def test_points_of_contact_near_the_end_of_all_numbers_are_disagreed_with(path: Path) -> None:
    enlarged(path, "contacts/points", LARGE)
    assert differences(path)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("model/vertices", "volumes of blocks are not those within their faces"),
        ("contacts/areas", "areas of interfaces are not those of their contact points"),
    ],
)
def test_arrays_that_contradict_each_other_are_not_even_read(path: Path, name: str, words: str) -> None:
    scaled(path, name, 1.01)
    with pytest.raises(FileError, match=words):
        differences(path)


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("cases/push/verified", 0, "the file says not verified, recomputed it is verified"),
        ("provenance/exit_code", 5, "the exit status is 0 recomputed, the file says 5"),
        ("deck/overrides", b"parameters.mu=0.5", "the hash of the deck is not that of its text"),
        ("deck/source_texts", b"mbla: 1", "the deck in the file is not valid"),
        ("cases/push/modes", 2, "contact modes (mechanics) are not those of forces and velocities"),
    ],
)
def test_what_the_file_says_of_itself(path: Path, name: str, value: Any, words: str) -> None:
    change(path, name, value)
    assert words in differences(path)


def test_a_deck_of_another_version_is_not_built_again(path: Path) -> None:
    with changing(path) as file:
        names = [name.decode() for name in file["provenance/names"][()]]
        values = file["provenance/values"][()]
        values[names.index("mbla")] = b"0.0.9"
        file["provenance/values"][...] = values
    results, disagreements = verify_results(read_results_hdf5(path))
    assert disagreements == ()
    (notice,) = [notice for notice in results.notices if notice.identifier == "deck-not-rebuilt"]
    assert notice.message.endswith("from the deck in the file: it was written by mbla 0.0.9")
