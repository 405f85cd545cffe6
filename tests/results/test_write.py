import json
from pathlib import Path

import pytest

from mbla.deck.content import OutputSection
from mbla.results.files import OutputFolder
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.listing.listing import listing
from mbla.results.results import Results
from mbla.results.write import write_results
from tests.results.outputs import write_outputs
from tests.results.synthetic import same_findings, tower_results, with_model_of

CASE_FILES = {"blocks.vtu", "contacts.vtu", "interfaces.vtu", "frame_000.vtu", "frame_001.vtu", "frame_002.vtu"}
CASE_FILES |= {"loads.vtu"}
SOLVED_FILES = CASE_FILES | {"thrust.vtu", "hinges.vtu"}


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_all_files_of_a_run(tmp_path: Path, results: Results) -> None:
    written = write_outputs(results, tmp_path, "tower", False, OutputSection(vtu=True, frames=3, plots=False))
    expected = {"tower.h5", "tower.lst", "tower.json", "tower_supports.vtu", "tower_paraview.py"}
    for case, files in (("push_x", SOLVED_FILES), ("fall", CASE_FILES)):
        expected |= {f"tower_{case}_{name}" for name in files} | {f"tower_{case}.pvd"}
    assert names(tmp_path) == expected == set(written)


def test_files_agree_with_each_other(tmp_path: Path, results: Results) -> None:
    with OutputFolder(tmp_path, "tower") as out:
        final = write_results(results, out, OutputSection(vtu=True, frames=2, plots=False))
    back = read_results_hdf5(tmp_path / "tower.h5")
    assert same_findings(back, final)
    assert listing(with_model_of(back, final)) == (tmp_path / "tower.lst").read_text(encoding="utf-8")
    record = json.loads((tmp_path / "tower.json").read_text(encoding="utf-8"))
    assert set(record["files"]) == names(tmp_path)
    assert final.time["write"] > 0
    assert record["time"]["write"] == final.time["write"]


def test_without_vtu_there_is_none(tmp_path: Path, results: Results) -> None:
    write_outputs(results, tmp_path, "tower", False, OutputSection(vtu=False, frames=3, plots=False))
    assert names(tmp_path) == {"tower.h5", "tower.lst", "tower.json"}
