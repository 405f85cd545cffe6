import os
import random
from dataclasses import MISSING, fields, replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.deck.units import Units
from mbla.errors import FileError
from mbla.results.hdf5 import read_results_hdf5, write_results_hdf5
from mbla.results.json_record import results_json
from mbla.results.results import Results

from .synthetic import full_results, same, tower_results


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
    assert same(back, results)
    own = back.cases[0].solution.associative is back.cases[0].solution.mechanics
    assert own == (flow_rule == "associative")


def test_every_field_of_every_record_comes_back(tmp_path: Path) -> None:
    results = full_results()
    path = tmp_path / "full.h5"
    path.write_bytes(write_results_hdf5(results))
    assert same(read_results_hdf5(path), results)


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


def test_a_file_that_does_not_say_who_solved_is_read(path: Path, results: Results) -> None:
    """The first files of this layout version did not."""
    for case in results.cases:
        for name in ("solver", "programs/solver", "programs/factorization"):
            remove(path, f"cases/{case.load_case.name}/{name}")
    case = read_results_hdf5(path).cases[0]
    assert case.solution.solver == ""
    assert {(program.solver, program.factorization) for program in case.solution.programs} == {("", "")}
    assert same(case.solution.iterations, results.cases[0].solution.iterations)
    assert results_json(read_results_hdf5(path))["cases"][0]["solver"] == {
        "asked": None,
        "used": [],
        "factorization": [],
    }


def test_lists_that_are_empty_come_back(tmp_path: Path, results: Results) -> None:
    bare = replace(
        results,
        model=replace(results.model, grounds=(), notices=(), title=""),
        contacts=replace(
            results.contacts,
            bodies=np.zeros((0, 2), dtype=np.int64),
            normals=np.zeros((0, 3)),
            areas=np.zeros(0),
            centroids=np.zeros((0, 3)),
            gaps=np.zeros(0),
            joints=np.zeros(0, dtype=np.int64),
            joint_names=(),
            point_start=np.zeros(1, dtype=np.int64),
            outline=np.zeros(0, dtype=np.int64),
            points=np.zeros((0, 3)),
            frames=np.zeros((0, 3, 3)),
            point_areas=np.zeros(0),
        ),
        cases=(),
        notices=(),
        settings={},
        time={},
    )
    path = tmp_path / "bare.h5"
    path.write_bytes(write_results_hdf5(bare))
    assert same(read_results_hdf5(path), bare)


def test_ragged_reports_come_back(tmp_path: Path, results: Results) -> None:
    report = replace(
        results.contacts.report,
        unsupported=(np.array([0, 2]), np.array([1])),
        slivers=np.array([[0, 1]]),
        sliver_widths=np.array([1e-4]),
        isolated=np.array([2]),
    )
    changed = replace(results, contacts=replace(results.contacts, report=report))
    path = tmp_path / "ragged.h5"
    path.write_bytes(write_results_hdf5(changed))
    assert same(read_results_hdf5(path), changed)


def test_units_of_the_deck_come_back_and_label_the_data(tmp_path: Path, results: Results) -> None:
    changed = replace(results, model=replace(results.model, units=Units("mm", "kN", "t")))
    path = tmp_path / "units.h5"
    path.write_bytes(write_results_hdf5(changed))
    assert read_results_hdf5(path).model.units == Units("mm", "kN", "t")
    with h5py.File(path) as file:
        assert file["model/vertices"].attrs["units"] == b"mm"
        assert file["contacts/areas"].attrs["units"] == b"mm2"


def test_same_results_give_same_bytes_but_for_the_date(results: Results, image: bytes) -> None:
    assert write_results_hdf5(results) == image
    assert write_results_hdf5(replace(results, created="2026-01-01T00:00:00+00:00")) != image


def test_deck_text_is_readable_without_mbla(path: Path, results: Results) -> None:
    with h5py.File(path) as file:
        assert file["deck/source_texts"][0].decode() == results.deck.sources[0][1]
        assert float(file["cases/push_x/load_factor"][()]) == 0.5


def test_what_follows_from_the_mechanism_is_there_for_others(path: Path, results: Results) -> None:
    with h5py.File(path) as file:
        case = file["cases/push_x"]
        assert case["parts"][()].tolist() == [0, 1, 0]
        assert case["interfaces/modes"][()].tolist() == [3, 0]
        assert case["interfaces/hinge_points"][0].tolist() == [1, 0.5, 1]
        assert case["interfaces/hinge_directions"][0].tolist() == [0, 1, 0]
        assert np.isnan(case["interfaces/hinge_points"][1]).all()
        assert case["interfaces/rotations"].attrs["units"] == b"1/(N m)"


def test_what_follows_from_the_mechanism_is_found_anew(path: Path, results: Results) -> None:
    """So that a file cannot contradict itself there."""
    change(path, "cases/push_x/parts", 7)
    change(path, "cases/push_x/interfaces/modes", 2)
    assert same(read_results_hdf5(path), results)


def test_a_changed_value_is_read_as_changed(path: Path) -> None:
    """Checksums guard against damage, not against someone's own edits: those are for ``verify`` to judge."""
    with h5py.File(path, "r+") as file:
        file["cases/push_x/load_factor"][()] = 0.75
        file["cases/push_x/contact_forces"][0, 0] = 99.0
    mechanics = read_results_hdf5(path).cases[0].solution.mechanics
    assert mechanics is not None
    assert mechanics.load_factor == 0.75
    assert mechanics.contact_forces[0, 0] == 99.0


# --- what is refused ----------------------------------------------------------------------------------------------


def refused(path: Path) -> str:
    with pytest.raises(FileError) as caught:
        read_results_hdf5(path)
    assert str(path) in str(caught.value)
    return str(caught.value)


def test_missing_file(tmp_path: Path) -> None:
    assert "No such file" in refused(tmp_path / "none.h5")


def test_folder(tmp_path: Path) -> None:
    refused(tmp_path)


def test_not_hdf5(tmp_path: Path) -> None:
    path = tmp_path / "text.h5"
    path.write_text("mbla: 1\n")
    assert "not an HDF5 file" in refused(path)


def test_empty_file(tmp_path: Path) -> None:
    path = tmp_path / "empty.h5"
    path.touch()
    refused(path)


def test_other_hdf5_file(tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    with h5py.File(path, "w") as file:
        file["x"] = 1
    assert "not an mbla result file" in refused(path)


def test_other_version_is_named(path: Path) -> None:
    with h5py.File(path, "r+") as file:
        file.attrs["version"] = 99
    assert "layout version 99" in refused(path)


def test_an_older_version_says_who_wrote_it_and_what_to_do(path: Path) -> None:
    with h5py.File(path, "r+") as file:
        file.attrs["version"] = 1
    words = refused(path)
    assert "layout version 1, written by mbla 0.1.0; this mbla reads version 4" in words
    assert "run the deck again" in words


def test_incomplete_file(path: Path) -> None:
    with h5py.File(path, "r+") as file:
        file.attrs["complete"] = 0
    assert "incomplete" in refused(path)


def change(path: Path, name: str, value: Any) -> None:
    with h5py.File(path, "r+") as file:
        file[name][...] = value


def remove(path: Path, name: str) -> None:
    with h5py.File(path, "r+") as file:
        del file[name]


def replace_dataset(path: Path, name: str, array: Any) -> None:
    with h5py.File(path, "r+") as file:
        del file[name]
        file[name] = array


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
        (lambda p: change(p, "model/fixed", 2), "neither 0 nor 1"),
        (lambda p: change(p, "model/loops", 24), "points outside vertex"),
        (lambda p: change(p, "contacts/bodies", -1), "points outside body"),
        (lambda p: change(p, "contacts/bodies", 5), "points outside body"),
        (lambda p: change(p, "model/vertex_start", [0, 16, 8, 24]), "does not divide vertex"),
        (lambda p: change(p, "contacts/point_start", [0, 4, 7]), "does not divide point"),
        (lambda p: change(p, "contacts/outline", 5), "outline"),
        (lambda p: change(p, "cases/push_x/modes", 7), "contact modes"),
        (lambda p: change(p, "cases/push_x/status", b"fine"), "'fine' is not a valid Status"),
        (lambda p: remove(p, "cases/push_x/range"), "incomplete"),
        (lambda p: replace_dataset(p, "cases/push_x/range", np.zeros(3)), "along end"),
        (lambda p: remove(p, "cases/push_x/programs/solver"), "incomplete: push_x: solvers"),
        (lambda p: change(p, "cases/push_x/programs/solver", b"x"), "name of a solver"),
        (lambda p: change(p, "cases/push_x/solver", b"x"), "name of a solver"),
        (lambda p: change(p, "model/units", b"x"), "units"),
        (lambda p: change(p, "notices/severity", b"x"), "severity"),
        (lambda p: change(p, "model/ground_joints", b"x"), "joint law"),
    ],
)
def test_contradictions(path: Path, spoil: Any, words: Any) -> None:
    spoil(path)
    assert words in refused(path)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda p: remove(p, "cases/push_x/lower/modes"), "incomplete: push_x: lower"),
        (lambda p: remove(p, "cases/push_x/outer/load_factor"), "incomplete: push_x: outer"),
        (lambda p: remove(p, "cases/push_x/standing/falls"), "incomplete: push_x: standing"),
        (lambda p: remove(p, "cases/push_x/size/parts"), "incomplete: push_x: size"),
        (lambda p: change(p, "cases/push_x/size/dimension", 4), "dimension of the model"),
        (lambda p: change(p, "cases/push_x/standing/verdict", b"maybe"), "'maybe' is not a valid Standing"),
        (lambda p: change(p, "cases/push_x/standing/falls", 3), "points outside block"),
        (lambda p: change(p, "cases/push_x/upper/modes", 7), "contact modes"),
        (lambda p: change(p, "cases/push_x/lock", np.nan), "not finite"),
        (lambda p: replace_dataset(p, "cases/push_x/force_ranges", np.zeros((3, 2))), "along interface"),
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
    with h5py.File(path, "r+") as file:
        for name in ("load_factor", "contact_forces", "contact_velocities", "mechanism", "modes"):
            del file[f"cases/push_x/upper/{name}"]
    assert "resultants without forces: upper" in refused(path)


def test_truncated_files_are_refused(path: Path, image: bytes) -> None:
    for length in np.linspace(1, len(image) - 1, 40).astype(int):
        path.write_bytes(image[:length])
        refused(path)


def test_flipped_bits_are_refused_or_without_effect(path: Path, image: bytes, results: Results) -> None:
    """Seeded; every flip is either found out or lies where nothing is read."""
    generator = random.Random(1)
    found = 0
    for _ in range(200):
        damaged = bytearray(image)
        damaged[generator.randrange(len(image))] ^= 1 << generator.randrange(8)
        path.write_bytes(damaged)
        try:
            back = read_results_hdf5(path)
        except FileError:
            found += 1
        else:
            assert same(back, results)
    assert found > 25


def test_overwritten_stretches_are_refused_or_without_effect(path: Path, image: bytes, results: Results) -> None:
    generator = random.Random(2)
    for _ in range(50):
        damaged = bytearray(image)
        begin = generator.randrange(len(image) - 64)
        damaged[begin : begin + 64] = generator.randbytes(64)
        path.write_bytes(damaged)
        try:
            back = read_results_hdf5(path)
        except FileError:
            continue
        assert same(back, results)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_what_is_no_regular_file_is_told_in_plain_words(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for name, words in (("missing.h5", "No such file"), (".", "is a folder"), ("pipe", "is not a regular file")):
        with pytest.raises(FileError, match=words) as caught:
            read_results_hdf5(tmp_path / name)
        assert "synchronously" not in str(caught.value)


def test_a_file_that_was_cut_off_says_so(tmp_path: Path) -> None:
    path = tmp_path / "cut.h5"
    path.write_bytes(write_results_hdf5(tower_results())[:2000])
    with pytest.raises(FileError, match=r"damaged: truncated file"):
        read_results_hdf5(path)
