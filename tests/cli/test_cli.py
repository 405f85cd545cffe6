"""The command line as scripts use it: exit status, standard output, files."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from mbla.cli.starters import KINDS
from tests.line import BLOCK

TWO_CASES = BLOCK.replace("load_cases:\n", "load_cases:\n  down: {live: [{acceleration: [0, 0, -1]}]}\n", 1)


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "block.yaml"
    path.write_text(BLOCK, encoding="utf-8")
    return path


def written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def run_json(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> tuple[int, list[dict[str, Any]], str]:
    """Exit status, objects on standard output, standard error; nothing but JSON lines may be on standard output."""
    code = main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return code, [json.loads(line) for line in captured.out.splitlines()], captured.err


def test_run_writes_its_files_and_prints_one_object(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, (record,), _ = run_json(capsys, "run", deck, "--json")
    assert code == record["exit_code"] == 0
    assert record["deck"] == "block.yaml"
    assert record["model"]["blocks"] == record["model"]["free_blocks"] == 1
    assert record["model"]["interfaces"] == 1
    assert record["model"]["contact_points"] == 4
    (case,) = record["cases"]
    assert case["status"] == "solved"
    assert case["load_factor"] == pytest.approx(0.5, rel=1e-7)
    assert case["static_bound"] <= 0.5 + 1e-7
    assert case["kinematic_bound"] >= 0.5 - 1e-7
    stages = {stage for stage in record["time"] if "/" not in stage}
    assert stages == {"read", "contacts", "solve", "write"}
    parts = ("assemble", "programs", "repair", "standing", "verify")
    assert {stage for stage in record["time"] if "/" in stage} == {
        "write/failure",
        *(f"solve/{part}" for part in parts),
    }
    assert sum(record["time"][f"solve/{part}"] for part in parts) < record["time"]["solve"]
    folder = deck.with_suffix(".out")
    expected = {"block.h5", "block.lst", "block.sta", "block.json", "block_push.pvd", "block_push_blocks.vtu"}
    assert expected <= {path.name for path in folder.iterdir()}
    assert json.loads((folder / "block.json").read_text())["cases"] == record["cases"]
    lines = (folder / "block.sta").read_text().splitlines()
    assert sum(line.startswith("push ") for line in lines) > 5


def test_an_earlier_result_is_kept_without_force(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(deck), "-q"]) == 0
    before = (deck.with_suffix(".out") / "block.h5").read_bytes()
    assert main(["run", str(deck), "-q"]) == 6
    assert "--force" in capsys.readouterr().err
    assert (deck.with_suffix(".out") / "block.h5").read_bytes() == before
    assert main(["run", str(deck), "-q", "--force", "--set", "parameters.mu=0.3"]) == 0
    assert (deck.with_suffix(".out") / "block.h5").read_bytes() != before


def test_a_failed_run_leaves_the_earlier_result_alone(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(deck), "-q"]) == 0
    folder = deck.with_suffix(".out")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    written(deck, BLOCK + "surplus: 1\n")
    assert main(["run", str(deck), "-q", "--force"]) == 3
    assert "surplus" in capsys.readouterr().err
    written(deck, BLOCK.replace("[1, 0, 0]", "[0, 0, 0]"))
    assert main(["run", str(deck), "-q", "--force"]) == 3
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_status_of_several_cases_is_that_of_the_gravest(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = written(tmp_path / "two.yaml", TWO_CASES)
    code, (record,), _ = run_json(capsys, "run", deck, "--json")
    assert code == record["exit_code"] == 5
    assert [case["status"] for case in record["cases"]] == ["unbounded", "solved"]
    assert record["cases"][0]["load_factor"] is None
    code, (record,), _ = run_json(capsys, "run", deck, "--json", "--force", "--case", "push")
    assert code == 0
    assert [case["name"] for case in record["cases"]] == ["push"]


def test_options_of_the_command_line_reach_the_analysis(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, (record,), _ = run_json(
        capsys, "run", deck, "--json", "--accuracy", "reference", "--flow-rule", "non_associative"
    )
    assert record["settings"]["tolerance"] == "1e-10"
    assert main(["run", str(deck), "-q", "--force", "--set", "analysis.max_iterations=2"]) == 4
    assert main(["run", str(deck), "-q", "--force", "--time-limit", "1e-9"]) == 7
    assert record["cases"][0]["flow_rule"] == "non_associative"
    assert record["cases"][0]["associative_load_factor"] == pytest.approx(0.5, rel=1e-8)


def test_expected_figures_are_compared(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(deck), "--expected"]) == 2
    assert "no expected section" in capsys.readouterr().err
    expected = "expected:\n  push: {load_factor: %s, tolerance: 1.0e-6, source: closed form}\n"
    written(deck, BLOCK + expected % 0.5)
    assert main(["run", str(deck), "-q", "--expected"]) == 0
    written(deck, BLOCK + expected % 0.51)
    code, (record,), _ = run_json(capsys, "run", deck, "--json", "--expected", "--force")
    assert code == 4
    (notice,) = [notice for notice in record["notices"] if notice["identifier"] == "not-as-expected"]
    assert "expected 0.51" in notice["message"]
    assert main(["verify", str(deck.parent / "block.out" / "block.h5")]) == 4
    assert "expected 0.51" in capsys.readouterr().out


def test_one_bad_deck_does_not_stop_the_next(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bad = written(deck.parent / "bad.yaml", BLOCK.replace("friction", "fricton"))
    missing = deck.parent / "missing.yaml"
    code, records, err = run_json(capsys, "run", bad, missing, deck, "--json")
    assert code == 6
    assert [record["exit_code"] for record in records] == [3, 6, 0]
    assert "did you mean" in records[0]["errors"][0]
    assert "fricton" in err
    assert "Traceback" not in err


def test_check_solves_nothing_and_writes_nothing(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, (record,), _ = run_json(capsys, "check", deck, "--json")
    assert code == 0
    (needs,) = record["needs"].values()
    assert (needs["dimension"], needs["unknown_velocities"], needs["half_lines"]) == (2, 3, 4)
    assert record["model"]["dimension"] == 2
    planar = next(step for step in needs["reductions"] if step["name"] == "planar")
    assert (planar["state"], planar["before"]["unknowns"], planar["after"]["unknowns"]) == ("applied", 6, 3)
    _, (run,), _ = run_json(capsys, "run", deck, "--json", "-o", deck.parent / "elsewhere")
    assert run["cases"][0]["reductions"] == needs["reductions"]
    assert run["model"]["dimension"] == 2
    assert not deck.with_suffix(".out").exists()
    assert main(["check", str(deck), "--vtu"]) == 0
    assert f"files: {deck.with_suffix('.out') / 'block_check_*.vtu'}" in capsys.readouterr().out
    assert {path.suffix for path in deck.with_suffix(".out").iterdir()} == {".vtu"}


def test_show_and_verify_read_the_result_file_alone(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["run", str(deck), "-q"])
    listing = (deck.with_suffix(".out") / "block.lst").read_text()
    moved = deck.with_suffix(".out") / "block.h5"
    moved = moved.rename(deck.parent / "moved.h5")
    deck.unlink()
    assert main(["show", str(moved)]) == 0
    assert capsys.readouterr().out == listing
    code, (record,), _ = run_json(capsys, "show", moved, "--json")
    assert code == 0
    assert record["cases"][0]["status"] == "solved"
    code, (record,), _ = run_json(capsys, "verify", moved, "--json")
    assert code == 0
    assert record["cases"][0]["static_bound"] == pytest.approx(0.5, rel=1e-6)
    assert main(["verify", str(moved)]) == 0


def test_schema_is_the_one_in_the_repository(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    shipped = Path(__file__).parents[2] / "schemas" / "deck.schema.json"
    assert json.loads(capsys.readouterr().out) == json.loads(shipped.read_text())


def test_an_internal_error_is_one_line(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("first\nsecond")

    monkeypatch.setattr(import_module("mbla.run"), "run_and_write", broken)
    for extra in ([], ["-v"], ["-q"]):
        assert main(["run", str(deck), *extra]) == 1
        err = capsys.readouterr().err
        words = "internal error, please report it with the deck: ZeroDivisionError: first second"
        assert err == f"mbla: {words}  [internal-error]\n"
    monkeypatch.setenv("MBLA_TRACEBACK", "1")
    assert main(["run", str(deck)]) == 1
    assert "Traceback" in capsys.readouterr().err


# Knobs of speed against accuracy from the command line: which word wins, and that the run takes it.


def told(
    knobs_deck: Path, capsys: pytest.CaptureFixture[str], *arguments: str
) -> tuple[dict[str, str], dict[str, Any]]:
    """Settings of the listing, and the load case in JSON."""
    assert main(["run", str(knobs_deck), "--force", "--json", *arguments]) == 0
    (case,) = json.loads(capsys.readouterr().out)["cases"]
    listing = (knobs_deck.with_suffix(".out") / f"{knobs_deck.stem}.lst").read_text(encoding="utf-8")
    section = listing.split("Units and analysis settings")[1].split("\n\n")[0]
    rows = [line.split(None, 1) for line in section.splitlines()]
    return {row[0]: row[1] for row in rows if len(row) == 2}, case


@pytest.fixture
def knobs_deck(tmp_path: Path) -> Path:
    path = tmp_path / "block.yaml"
    text = BLOCK.replace("flow_rule: associative", "flow_rule: associative, accuracy: reference, gap: 1.e-6")
    path.write_text(text, encoding="utf-8")
    return path


def test_the_word_of_the_command_line_wins_over_that_of_the_deck_but_not_over_its_knobs(
    knobs_deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own, case = told(knobs_deck, capsys)
    assert (own["accuracy"], own["tolerance"], own["gap"]) == ("reference", "1e-10", "1e-06")
    assert case["standing"]["verdict"] == "yes"
    draft, case = told(knobs_deck, capsys, "--accuracy", "draft")
    assert (draft["accuracy"], draft["tolerance"], draft["gap"]) == ("draft", "1e-08", "1e-06")
    assert draft["standing"] == "false"
    assert case["standing"] is None


def test_a_knob_of_the_command_line_wins_over_all(knobs_deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--set", "analysis.gap=1e-4", "--set", "analysis.standing=true", "--set", "analysis.tolerance=1e-7"]
    knobs, case = told(knobs_deck, capsys, "--accuracy", "draft", *arguments)
    assert (knobs["tolerance"], knobs["gap"]) == ("1e-07", "0.0001")
    assert case["standing"]["verdict"] == "yes"


# The deck that ``mbla new`` writes.


def test_new_writes_a_deck_that_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "house"]) == 0
    assert main(["new", "house"]) == 6
    assert main(["run", "house.yaml", "-q"]) == 0
    assert (tmp_path / "house.out" / "house.h5").is_file()


@pytest.mark.parametrize("kind", list(KINDS))
def test_new_of_every_kind_writes_a_sound_model(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "house", "--kind", kind]) == 0
    assert "NAME" not in Path("house.yaml").read_text()
    assert main(["check", "house.yaml"]) == 0


@pytest.mark.parametrize(
    "kind", ["arch", "vault", *(pytest.param(kind, marks=pytest.mark.long) for kind in ("facade", "bridge", "tower"))]
)
def test_new_of_every_kind_runs(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "house", "--kind", kind]) == 0
    assert main(["run", "house.yaml", "-q"]) == 0


def test_new_points_editors_to_the_schema(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "a b"]) == 0
    first = Path("a b.yaml").read_text().splitlines()[0]
    address = first.removeprefix("# yaml-language-server: $schema=")
    assert json.loads(Path(address.removeprefix("file://")).read_text())["title"]
    assert "mbla run 'a b.yaml'" in capsys.readouterr().out
    assert main(["new", "missing/x"]) == 6
    assert "no folder missing" in capsys.readouterr().err
