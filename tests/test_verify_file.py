"""``mbla verify`` agrees with what a run wrote, and with nothing else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.errors import FileError
from mbla.process.run_options import RunOptions
from mbla.results.hdf5.layout import MOST
from mbla.results.quantities.quantity import UNVERIFIED
from mbla.run import run
from mbla.verify import verify_file
from tests.decks.folder import BENCHMARKS
from tests.line import BLOCK, WALL
from tests.results.changed_files import change, changing, image_of_run, remove, with_case, written
from tests.solution.convex_structures import TWIST
from tests.trust.corrupted.files import SEVERAL, write_decks

NON_ASSOCIATIVE = BLOCK.replace("flow_rule: associative", "flow_rule: non_associative")
LARGE = MOST / 2
CUBE = SEVERAL["parts/block.obj"]


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return image_of_run(tmp_path_factory.mktemp("verify"), NON_ASSOCIATIVE, "parameters.mu=0.4")


@pytest.fixture
def path(tmp_path: Path, image: bytes) -> Path:
    path = tmp_path / "deck.h5"
    path.write_bytes(image)
    return path


def differences(path: Path) -> str:
    """What verification finds wrong with a file; its exit status must tell."""
    results, disagreements = verify_file(path)
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
    results, disagreements = verify_file(path)
    assert disagreements == ()
    assert results.exit_code == 0


@pytest.mark.every(4)
@pytest.mark.parametrize(
    ("name", "factor", "words"),
    [
        ("model/densities", 1.01, "model/densities is not what the deck in the file gives"),
        ("model/friction", 1.01, "model/friction is not what the deck in the file gives"),
        ("cases/push/live_load", 1.01, "cases/push/live_load is not what the deck in the file gives"),
        ("cases/push/associative/load_factor", 1.01, "is not between its bounds"),
        ("cases/push/contact_velocities", 1.01, "cases/push/contact_velocities is not what follows"),
        ("cases/push/live_power", 1.01, "cases/push/live_power is 1 recomputed, the file says 1.01"),
    ],
)
def test_what_the_deck_or_the_mechanism_does_not_give(path: Path, name: str, factor: float, words: str) -> None:
    scaled(path, name, factor)
    assert words in differences(path)


@pytest.mark.every(4)
@pytest.mark.parametrize(
    "name",
    [
        "model/friction",
        "cases/push/contact_velocities",
        "cases/push/mechanism",
        "cases/push/associative/contact_forces",
        "cases/push/load_factor",
        "contacts/points",
    ],
)
def test_numbers_near_the_end_of_all_are_disagreed_with(path: Path, name: str) -> None:
    """Without a warning on the way."""
    enlarged(path, name, LARGE)
    assert differences(path)


@pytest.mark.long
def test_resultants_and_motions_of_interfaces_near_the_end_of_all_numbers_are_disagreed_with(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(TWIST, encoding="utf-8")
    run(deck, RunOptions(overrides=("parameters.e1=0.3",)))
    path = tmp_path / "deck.out" / "deck.h5"
    image = path.read_bytes()
    for name in ("load_factor", "resultants", "torsion_motions", "mechanism"):
        path.write_bytes(image)
        enlarged(path, f"cases/couple/{name}", 1e200 if name == "load_factor" else LARGE)
        assert differences(path), name


@pytest.mark.parametrize("part", ["", "associative/"])
def test_load_factors_whose_squares_are_beyond_numbers_are_disagreed_with(path: Path, part: str) -> None:
    """A program that diverged may have any; files with them are read."""
    change(path, f"cases/push/{part}load_factor", 1e200)
    assert differences(path)


@pytest.mark.every(4)
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("model/vertices", 1e130),
        ("model/volumes", 0.0),
        ("model/volumes", np.nan),
        ("model/densities", 1e-300),
        ("model/fixed", 1),
        ("model/loops", 24),
        ("model/vertex_start", 5),
        ("model/units", b"x"),
        ("model/load_cases", b"x"),
        ("model/ground_joints", b"x"),
        ("contacts/areas", 1.01),
        ("contacts/frames", 0.0),
        ("contacts/bodies", -1),
        ("contacts/outline", 5),
        ("contacts/joint_names", b"x"),
        ("cases/push/dead_load", -1e130),
        ("cases/push/live_load", 0.0),
    ],
)
def test_arrays_of_model_and_contacts_are_held_against_the_deck(path: Path, name: str, value: Any) -> None:
    """The model is built from the deck in the file: what these arrays say changes no other figure."""
    change(path, name, value)
    assert differences(path) == f"{name} is not what the deck in the file gives"


def test_arrays_of_model_and_contacts_that_are_missing_or_of_another_type_are_told(path: Path) -> None:
    names = ("model/vertices", "contacts/areas", "cases/push/dead_load")
    for name in names:
        remove(path, name)
    missing = differences(path)
    with changing(path) as file:
        for name in names:
            file[name] = b"text"
    other = differences(path)
    for name in names:
        assert f"{name} is not what the deck in the file gives" in missing
        assert f"{name} is not what the deck in the file gives" in other


def test_a_deck_that_is_not_valid_is_not_read(path: Path) -> None:
    change(path, "deck/source_texts", b"mbla: 1")
    with pytest.raises(FileError, match="the deck in the file is not valid: "):
        differences(path)


def test_a_deck_of_another_structure_is_not_read(path: Path) -> None:
    """One line tells it, whatever the arrays are."""
    box = "  - box: {group: more, material: stone, min: [9, 0, 0], max: [10, 1, 1]}\n"
    with changing(path) as file:
        text = file["deck/source_texts"][0].decode()
        del file["deck/source_texts"]
        file["deck/source_texts"] = [text.replace("supports:", f"{box}supports:").encode()]
    with pytest.raises(FileError, match="its arrays are not of what its deck gives: 1 along block, not 2"):
        differences(path)


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("cases/push/verified", 0, "cases/push/verified is 1 recomputed, the file says 0"),
        ("provenance/exit_code", 5, "provenance/exit_code is 0 recomputed, the file says 5"),
        ("deck/overrides", b"parameters.mu=0.5", "the hash of the deck is not that of its text"),
        ("cases/push/modes", 2, "cases/push/modes is not what follows"),
    ],
)
def test_what_the_file_says_of_itself(path: Path, name: str, value: Any, words: str) -> None:
    change(path, name, value)
    assert words in differences(path)


def test_another_least_state_is_not_believed(tmp_path: Path) -> None:
    deck, path = WALL.replace("associative}", "non_associative}"), tmp_path / "deck.h5"
    image = image_of_run(tmp_path, deck, "parameters.n=3")
    path.write_bytes(image)
    assert differences(path) == ""
    for name in ("contact_forces", "mechanism", "load_factor"):
        path.write_bytes(image)
        scaled(path, f"cases/push/least/{name}", 1.01)
        assert "cases/push/least_load_factor" in differences(path), name


LEFT_OUT: dict[str, dict[str, Any]] = {
    "standing": {"standing": None},
}


def test_what_the_deck_asks_for_is_there(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(NON_ASSOCIATIVE, encoding="utf-8")
    results = run(deck, RunOptions(overrides=("parameters.mu=0.4",)))
    assert verify_file(tmp_path / "deck.out" / "deck.h5")[1] == ()
    for what, changes in LEFT_OUT.items():
        lacks = f"push: the deck asks for the {what}, which the file does not have"
        assert lacks in differences(written(tmp_path, with_case(results, **changes)))


@pytest.mark.long
def test_the_load_across_that_a_level_table_bears_is_proved(tmp_path: Path) -> None:
    run(BENCHMARKS["tilting_block_cohesion"], RunOptions(folder=tmp_path / "out"))
    path = tmp_path / "out" / "tilting_block_cohesion.h5"
    assert differences(path) == ""
    for upright in (1e9, np.inf):
        change(path, "cases/tips/tilt/upright", upright)
        assert "cases/tips/tilt/upright is 0.432335 recomputed" in differences(path)


def test_a_deck_of_another_version_is_built_again(path: Path) -> None:
    with changing(path) as file:
        names = [name.decode() for name in file["provenance/names"][()]]
        values = file["provenance/values"][()]
        values[names.index("mbla")] = b"0.0.9"
        file["provenance/values"][...] = values
        file.attrs["mbla_version"] = "0.0.9"
        file["model/friction"][...] = 0.9
    assert "model/friction is not what the deck in the file gives" in differences(path)


@pytest.fixture(scope="module")
def image_of_several_files(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Of a block of a mesh, with the joint law of an included file in another folder; the files are gone."""
    folder = tmp_path_factory.mktemp("several")
    image = write_decks(folder, ("several",))["several"].read_bytes()
    for name in ("several.yaml", "parts/dry.yaml", "parts/block.obj"):
        (folder / name).unlink()
    return image


@pytest.fixture
def of_several_files(tmp_path: Path, image_of_several_files: bytes) -> Path:
    (path := tmp_path / "several.h5").write_bytes(image_of_several_files)
    return path


def test_a_deck_of_several_files_is_built_again_from_the_file(of_several_files: Path) -> None:
    assert differences(of_several_files) == ""
    with h5py.File(of_several_files) as file:
        assert [name.decode() for name in file["deck/source_names"]] == ["several.yaml", "parts/dry.yaml"]
        assert [name.decode() for name in file["deck/file_names"]] == ["parts/block.obj"]
        assert file["deck/file_bytes"][()].tobytes() == CUBE.encode()


@pytest.mark.every(2)
@pytest.mark.parametrize("name", ["model/friction", "model/vertices", "deck/file_bytes"])
def test_what_stands_in_other_files_is_verified_too(name: str, of_several_files: Path) -> None:
    with changing(of_several_files) as file:
        values = file[name][()]
        file[name][...] = np.where(values == ord("."), ord("5"), values) if values.dtype.kind == "u" else 3 * values
    assert "is not what the deck in the file gives" in differences(of_several_files)


def test_files_of_a_deck_stay_in_their_folder(of_several_files: Path) -> None:
    for name in ("../several.yaml", "other.yaml"):
        with changing(of_several_files) as file:
            names = file["deck/source_names"][()].astype("S40")
            names[1] = name.encode()
            del file["deck/source_names"]
            file["deck/source_names"] = names
        with pytest.raises(FileError, match="the deck in the file is not valid"):
            differences(of_several_files)


@pytest.mark.every(4)
@pytest.mark.parametrize(
    "name",
    [
        "parts",
        "interfaces/modes",
        "interfaces/rotations",
        "interfaces/translations",
        "interfaces/hinge_points",
        "interfaces/work",
        "least/modes",
        "flow_rule",
        "solver",
    ],
)
def test_what_follows_is_found_again(name: str, path: Path) -> None:
    with changing(path) as file:
        values = file[f"cases/push/{name}"][()]
        changed = np.nan_to_num(np.asarray(values), nan=0.0) + 1 if not isinstance(values, bytes) else b"livesley"
        del file[f"cases/push/{name}"]
        file[f"cases/push/{name}"] = b"clarabel" if name == "solver" else changed
    assert f"cases/push/{name} is " in differences(path)


def test_threads_are_those_that_the_programs_ran_on(path: Path) -> None:
    with changing(path) as file:
        names = [name.decode() for name in file["provenance/setting_names"]]
        file["provenance/setting_values"][names.index("threads")] = b"64"
    assert differences(path) == "provenance/setting_values is not what the deck in the file gives"


def test_datasets_and_attributes_that_nothing_reads_are_compared(path: Path) -> None:
    with changing(path) as file:
        file["cases/push/collapse_load"] = 9.81
        file["model/weights"].attrs["units"] = "MN"
        del file["model/vertices"].attrs["long_name"]
    found = differences(path)
    assert "cases/push/collapse_load does not follow from what the file holds" in found
    assert "the attribute units of model/weights is not as it should be" in found
    assert "the attribute long_name of model/vertices is not as it should be" in found


def test_what_the_run_alone_can_tell_is_marked(path: Path) -> None:
    with changing(path) as file:
        assert file["cases/push/reason"].attrs["verification"] == f"not verified: {UNVERIFIED['words']}".encode()
        assert file["cases/push/remembered"].attrs["verification"] == f"not verified: {UNVERIFIED['history']}".encode()
        assert "verification" not in file["cases/push/load_factor"].attrs
        file["cases/push/seconds"][...] = 3600.0
    assert differences(path) == ""
