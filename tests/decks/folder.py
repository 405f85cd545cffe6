"""Every deck under decks/, run through the command line once and kept for all tests."""

from __future__ import annotations

import contextlib
import io
import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from _pytest.mark import ParameterSet

from mbla.cli import main
from mbla.deck import Deck, read_deck

ROOT = Path(__file__).parents[2]
DECKS = ROOT / "decks"
FOLDERS = (
    "tutorials",
    "benchmarks/closed_forms",
    "benchmarks/published",
    "benchmarks/formats",
    "structures",
    "regressions",
    "tradeoff",
    "sweeps/base",
)
PATHS = tuple(sorted(path for folder in FOLDERS for path in DECKS.glob(f"{folder}/*.yaml")))
BENCHMARKS = {path.stem: path for path in PATHS if path.parts[-3] == "benchmarks"}
"""decks of closed forms and published cases by their names"""
LONG = (
    "benchmarks/closed_forms/beam_under_travelling_load",
    "benchmarks/closed_forms/drum_column",
    "regressions/bridge_axle_crushing",
    "regressions/ground_given_twice_crushing",
    "regressions/nave_crushing",
    "regressions/shelf",
    "regressions/shelf_across",
    "regressions/trapezium_crushing",
    "regressions/two_footings_crushing",
    "regressions/vehicle_beside_its_path",
    "structures/arch_bridge",
    "structures/colonnade",
    "structures/dome_on_drum",
    "structures/house",
    "structures/retaining_wall",
    "structures/room",
    "structures/spiral_stair",
    "tutorials/bridge_with_parapets",
    "tutorials/buttressed_wall",
    "tutorials/corner",
    "tutorials/crossvault",
    "tutorials/crossvault_without_dilatancy",
    "tutorials/gable_wall",
    "tutorials/lintels_and_arches",
    "tutorials/segmental_domes",
    "tutorials/two_leaf_walls",
    "tutorials/vault_in_rings",
    "tutorials/walls_at_a_corner",
)  # fmt: skip
"""take long: run by ``pytest -m long`` only"""


@dataclass(frozen=True)
class Outcome:
    """What ``mbla run DECK --expected --json --force`` left behind."""

    exit_status: int
    output: str
    messages: str
    files: tuple[str, ...]

    @property
    def record(self) -> dict[str, Any]:
        """The JSON object."""
        loaded: dict[str, Any] = json.loads(self.output, parse_constant=_refused)
        return loaded


def name_of(path: Path) -> str:
    """``tutorials/arch``: how tests and tables call a deck."""
    return path.relative_to(DECKS).with_suffix("").as_posix()


def as_parameters() -> list[ParameterSet]:
    """Every deck, those that take long with their mark."""
    names = [(path, name_of(path)) for path in PATHS]
    return [pytest.param(path, id=name, marks=pytest.mark.long if name in LONG else ()) for path, name in names]


every_deck = pytest.mark.parametrize("path", as_parameters())


@cache
def deck_of(path: Path) -> Deck:
    """The deck as read."""
    return read_deck(path)


@cache
def outcome_of(path: Path) -> Outcome:
    """Run a deck in this process."""
    return run_deck(path)


def run_deck(path: Path, *options: str) -> Outcome:
    """Run a deck in this process, results in a folder of its own."""
    output, messages = io.StringIO(), io.StringIO()
    with TemporaryDirectory() as folder:
        few = ("--set", "output.frames=2")  # the frames of a film are a tenth of the time, and tested elsewhere
        arguments = ["run", str(path), "--expected", "--json", "--force", "-o", folder, *few, *options]
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(messages):
            status = main(arguments)
        files = tuple(sorted(file.name for file in Path(folder).iterdir()))
    return Outcome(status, output.getvalue(), messages.getvalue(), files)


def _refused(constant: str) -> None:
    raise ValueError(f"{constant} is not JSON")
