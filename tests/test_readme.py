"""The README tells the truth: its deck and its sweep run and print what it says, its commands and pictures exist."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mbla
from mbla.cli import build_parser, main
from tests.line import BLOCK

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
SWEEPS = (ROOT / "decks" / "sweeps" / "README.md").read_text(encoding="utf-8")
MOST_LINES = 250
"""of the README"""


def block(start: str, page: str = README) -> str:
    """Text of the first code block after a piece of text."""
    return page.split(start, 1)[1].split("```", 2)[1].split("\n", 1)[1]


def test_the_deck_of_the_readme_prints_what_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wall.yaml").write_text(block("`wall.yaml`:"), encoding="utf-8")
    assert main(["run", "wall.yaml"]) == 0
    assert capsys.readouterr().out.splitlines() == block("`mbla run wall.yaml` prints").splitlines()
    written = {path.name for path in Path("wall.out").iterdir()}
    for name in re.findall(r"`(wall[\w.]+\.(?:lst|h5|json|sta|vtu|pvd))`", README):
        assert name in written
    rows = README.split("## Result files", 1)[1].split("\n## ", 1)[0].splitlines()
    listed = {name for row in rows for name in re.findall(r"`([\w.…]+)`", row.partition(" | ")[0])}
    listed = {name.replace("…", "wall_push_x") for name in listed}
    frames = sorted(name for name in written if "_frame_" in name)
    assert written - set(frames) | {frames[0], frames[-1]} <= listed


def test_python_of_the_readme_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the figures that its comments give; without output it leaves no files."""
    monkeypatch.chdir(tmp_path)
    Path("wall.yaml").write_text(block("`wall.yaml`:"), encoding="utf-8")
    names: dict[str, Any] = {}
    exec(block("<!-- python:begin -->"), names)
    push = names["push"]
    assert f"# {push.load_factor:.6g}, {push.verified};" in README
    assert push.mechanism.shape == (49, 6)
    assert push.contact_forces.shape == (460, 3)
    assert capsys.readouterr().out.startswith("push_x: starts to move at 0.583861 g, verified")
    assert f"a search found: {push.least_load_factor:.6g}\n" in README
    assert [path.name for path in tmp_path.iterdir()] == ["wall.yaml"]


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """The folder in which the sweep of the README was run, and what it printed."""
    folder = tmp_path_factory.mktemp("readme")
    (folder / "wall.yaml").write_text(block("`wall.yaml`:"), encoding="utf-8")
    (folder / "door.yaml").write_text(block("`door.yaml`, next to", SWEEPS), encoding="utf-8")
    printed = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(printed):
        assert main(["sweep", "door.yaml"]) == 0
    return folder, printed.getvalue().splitlines()


def but_times(lines: list[str]) -> list[str]:
    return [line for line in lines if not line.startswith("  time ")]


def test_the_sweep_of_the_readme_prints_what_it_says(swept: tuple[Path, list[str]]) -> None:
    folder, printed = swept
    assert but_times(printed) == but_times(block("`mbla sweep door.yaml` prints", SWEEPS).splitlines())
    written = {path.name for path in (folder / "door.out").iterdir() if not path.name.startswith(".")}
    listed = set(re.findall(r"^\| `([\w.]+)` \|", SWEEPS.split("| file in `door.out/`", 1)[1], flags=re.MULTILINE)[:6])
    assert listed == written | {"sweep.parquet"}  # that one only where it is asked for


def test_tables_of_the_sweep_are_read_as_the_readme_says(
    swept: tuple[Path, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("pandas")
    monkeypatch.chdir(swept[0])
    names: dict[str, Any] = {}
    exec(block("<!-- tables:begin -->", SWEEPS), names)
    medians = names["table"].groupby("length [m]")["load_factor"].median()
    assert f"# {', '.join(f'{value:.4f}' for value in medians)}\n" in SWEEPS
    data = names["sweep"]
    assert data.load_factor.sel(length=2.4).shape == data.mu.shape == (8,)
    assert data.load_factor.quantile(0.05, "random").shape == (3,)
    data.close()


def test_the_sweep_from_python_is_that_of_the_command(
    swept: tuple[Path, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It goes on with the journal of the command, so that nothing is solved again."""
    monkeypatch.chdir(swept[0])
    names: dict[str, Any] = {"mbla": mbla}
    exec(block("<!-- python sweep:begin -->", SWEEPS), names)
    table = names["table"]
    assert table["load_factor"].shape == table["length"].shape == (24,)
    assert set(table["state"]) == {"done"}
    assert np.array_equal(mbla.read_sweep("door.out")["load_factor"], table["load_factor"])


@pytest.mark.long
def test_the_job_array_solves_every_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each line of the script as Slurm would run it, in an array of two jobs; the second writes the table."""
    (tmp_path / "wall.yaml").write_text(BLOCK, encoding="utf-8")
    sweep = "mbla_sweep: 1\ndeck: wall.yaml\nparameters: {mu: {values: [0.3, 0.4, 0.6]}}\n"
    (tmp_path / "door.yaml").write_text(sweep, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    script = block("<!-- sbatch:begin -->", SWEEPS).splitlines()
    assert script[0] == "#!/bin/bash"
    (command,) = [line for line in script if not line.startswith("#")]
    monkeypatch.setenv("SLURM_ARRAY_TASK_COUNT", "2")
    for task in ("1", "2"):
        monkeypatch.setenv("SLURM_ARRAY_TASK_ID", task)
        program, *arguments = [os.path.expandvars(word) for word in shlex.split(command)]
        assert program == ".venv/bin/mbla"
        assert main(arguments) == 0
        assert (tmp_path / "door.out" / "sweep.csv").exists() == (task == "2")
    assert list(mbla.read_sweep("door.out")["load_factor"]) == pytest.approx([0.3, 0.4, 0.5], rel=1e-6)


def test_commands_in_blocks_are_understood() -> None:
    """Of sweeps, and of the recipes for engineers, whose decks are there."""
    lines = [line.partition("  #")[0] for line in SWEEPS.splitlines() if re.match(r"mbla (sweep|interact) .*-", line)]
    recipes = [line for line in (ROOT / "decks" / "README.md").read_text("utf-8").splitlines() if line[:5] == "mbla "]
    assert lines
    assert recipes
    for line in (*lines, *recipes):
        build_parser().parse_args(shlex.split(line)[1:])
    assert all((ROOT / deck).is_file() for line in recipes for deck in re.findall(r"decks/\S+", line))


def test_commands_of_the_readme_are_those_of_the_program() -> None:
    commands = re.findall(r"^mbla ([\w-]+)", block("## Commands"), flags=re.MULTILINE)
    help_text = build_parser().format_help()
    listed = re.findall(r"^    ([\w-]+)(?: |$)", help_text, flags=re.MULTILINE)
    assert commands == listed


PAGES = [ROOT / "README.md", *(ROOT / folder for folder in ("decks", "schemas", "tests"))]


def anchors(page: Path) -> set[str]:
    """Names of the headings of a page, as links have them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", [PAGES[0], *(page for folder in PAGES[1:] for page in sorted(folder.rglob("*.md")))])
def test_links_pictures_and_modules_exist(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    for target, heading in re.findall(r"\]\(([^)#]*)#?([^)]*)\)", text):
        if not target.startswith("http"):
            linked = page.parent / target if target else page
            assert linked.exists(), target
            assert not heading or heading in anchors(linked), f"{target}#{heading}"
    for module in re.findall(r"`(mbla/[\w/.]+)`", text):
        assert (ROOT / module).exists(), module


def test_the_readme_is_short() -> None:
    assert len(README.splitlines()) <= MOST_LINES


def test_the_sweep_of_the_readme_is_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "wall.yaml").write_text(block("`wall.yaml`:"), encoding="utf-8")
    (tmp_path / "door.yaml").write_text(block("## Sweeps"), encoding="utf-8")
    assert main(["sweep", str(tmp_path / "door.yaml"), "--dry-run"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["24", "0.73531", "2.8"] in lines


def test_nothing_was_left_to_fill_in() -> None:
    assert not re.search(r"@[A-Z]+@", README)
