"""What Python users call: the same answers as the command line, in memory or in files, and errors that say where."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.cli import main
from mbla.results.hdf5.result_file import read_results_hdf5
from tests.line import BLOCK, WALL
from tests.results.synthetic import same

SLIDES = BLOCK.replace("h: 2", "h: 1")
"""a cube with friction 0.5 slides at half its weight, before it would rock at 1"""


def test_a_text_gives_its_load_factor_and_writes_and_prints_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    results = mbla.run(SLIDES)
    assert results.records.files == ()
    assert results.load_factor == pytest.approx(0.5, rel=1e-6)
    assert results.verified
    assert results.exit_code == 0
    assert results.case("push").status == "solved"
    assert list(tmp_path.iterdir()) == []
    assert capfd.readouterr() == ("", "")


def test_file_and_folder(tmp_path: Path) -> None:
    """What ``output`` writes is what the command writes, and what is read back is what was returned."""
    deck = tmp_path / "block.yaml"
    deck.write_text(SLIDES, encoding="utf-8")
    results = mbla.run(deck, output=tmp_path / "mine")
    assert main(["run", str(deck), "-q"]) == 0
    assert [p.name for p in sorted((tmp_path / "mine").iterdir())] == [
        p.name for p in sorted((tmp_path / "block.out").iterdir())
    ]
    back = mbla.read_results(tmp_path / "mine" / "block.h5")
    assert back.load_factor == results.load_factor
    assert back.case("push").mechanism is not None
    assert same(back.case("push").mechanism, results.case("push").mechanism)
    assert back.records.files == results.records.files
    with pytest.raises(mbla.FileError, match="exists already"):
        mbla.run(deck, output=tmp_path / "mine")
    mbla.run(deck, output=tmp_path / "mine", force=True)
    by_command = read_results_hdf5(tmp_path / "block.out" / "block.h5")
    assert by_command.cases[0].checks.static_bound == results.case("push").static_bound


@pytest.mark.parametrize("values", [{"parameters.mu": 0.25}, ["parameters.mu=0.25"], {"joints.dry.friction": "=b/4"}])
def test_values_can_be_set(values: dict[str, object] | list[str]) -> None:
    assert mbla.run(SLIDES, set=values).load_factor == pytest.approx(0.25, rel=1e-6)


def test_values_of_numpy_can_be_set() -> None:
    corner = {"blocks.0.box.max": np.array([2, 1, 1]), "parameters.mu": np.float64(0.25)}
    results = mbla.run(SLIDES, set=corner)
    assert results.model.blocks.volumes.tolist() == [2.0]
    assert results.load_factor == pytest.approx(0.25, rel=1e-6)


@pytest.mark.parametrize("values", ["parameters.mu=1", {"parameters.mu": math.nan}, {"parameters.mu": object()}])
def test_what_cannot_be_set_is_told(values: object) -> None:
    with pytest.raises(mbla.UsageError, match="set"):
        mbla.run(SLIDES, set=values)  # type: ignore[arg-type]


def test_cases_by_name() -> None:
    text = SLIDES + "  # two cases\n"
    text = text.replace("load_cases:\n", "load_cases:\n  other: {live: [{acceleration: [0, 1, 0]}]}\n")
    results = mbla.run(text)
    assert list(results.load_factors) == ["other", "push"]
    with pytest.raises(mbla.UsageError, match=r"2 load cases.*other, push"):
        _ = results.load_factor
    assert mbla.run(text, cases="push").load_factor == pytest.approx(results["push"].load_factor)
    with pytest.raises(mbla.UsageError, match="other, push"):
        results.case("pull")
    with pytest.raises(mbla.UsageError, match="pull"):
        mbla.run(text, cases=["pull"])


def test_a_mistake_in_the_deck_comes_with_its_faults() -> None:
    with pytest.raises(mbla.DeckError) as caught:
        mbla.run(SLIDES.replace("mu: 0.5", "mu: -0.5").replace("supports:", "suports:"))
    words = [str(fault) for fault in caught.value.faults]
    assert any("suports" in text and "supports" in text for text in words)
    assert any("friction" in text and "-0.5" in text for text in words)
    assert all(fault.place.file == "deck.yaml" for fault in caught.value.faults)
    assert caught.value.faults[0].place.line > 1


def test_a_text_that_is_no_text_is_a_mistake_in_the_deck() -> None:
    for text in ("mbla: 1\n\udcff", "mbla: 1\n\x00", "\n"):
        with pytest.raises(mbla.DeckError):
            mbla.run(text)


def test_missing_files_are_told(tmp_path: Path) -> None:
    with pytest.raises(mbla.FileError, match=r"none\.yaml"):
        mbla.run(tmp_path / "none.yaml")
    with pytest.raises(mbla.FileError, match="folder"):
        mbla.run(tmp_path)
    with pytest.raises(mbla.FileError, match=r"none\.h5"):
        mbla.read_results(tmp_path / "none.h5")
    assert issubclass(mbla.FileError, mbla.MblaError)


def test_arrays_fit_the_model() -> None:
    results = mbla.run(WALL, set={"parameters.n": 3})
    case = results.case("push")
    model, contacts = results.model, results.contacts
    assert case.mechanism is not None
    assert case.contact_forces is not None
    assert case.contact_modes is not None
    assert case.thrust is not None
    assert case.collapse is not None
    assert case.mechanism.shape == (len(model.blocks), 6)
    assert case.contact_forces.shape == (len(contacts.points), 3)
    assert case.contact_modes.shape == (len(contacts.points),)
    assert len(case.thrust.forces) == len(case.collapse.interfaces.modes) == len(contacts)
    # the live load's power on the mechanism is 1 by definition
    power = np.sum(case.record.load_case.live_load * case.mechanism)
    assert power == pytest.approx(1.0, rel=1e-6)
    assert case.static_bound <= case.load_factor * (1 + 1e-6)
    assert case.kinematic_bound >= case.load_factor * (1 - 1e-6)


def test_a_case_without_load_factor_looks_like_none() -> None:
    """The block hangs in the air beside its ground."""
    results = mbla.run(SLIDES.replace("{z: 0}", "{x: 0}"))
    case = results.case("push")
    assert case.status == "no_equilibrium"
    assert math.isnan(results.load_factor)
    assert (case.mechanism, case.contact_forces, case.thrust, case.collapse) == (None, None, None, None)
    assert case.certificate is not None
    assert not case.verified
    assert "no equilibrium" in case.reason
    assert results.exit_code == 5


def test_names_come_late() -> None:
    """Importing mbla imports nothing but itself; unknown names are refused as usual."""
    code = (
        "import sys, mbla; print('numpy' in sys.modules, *dir(mbla)); print(mbla.run.__name__, 'numpy' in sys.modules)"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.splitlines()
    assert told[0].startswith("False ")
    assert {"run", "read_results", "DeckError"} <= set(told[0].split())
    assert told[1] == "run True"
    assert dir(mbla) == sorted(mbla.__all__)
    assert all(getattr(mbla, name) is not None for name in dir(mbla))
    with pytest.raises(AttributeError, match=r"^module 'mbla' has no attribute 'solve'$"):
        mbla.solve  # type: ignore[attr-defined]  # noqa: B018
