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
    "benchmarks/experiments",
    "structures",
    "bridges",
    "time_histories",
    "regressions",
    "tradeoff",
    "sweeps/base",
)
PATHS = tuple(sorted(path for folder in FOLDERS for path in DECKS.glob(f"{folder}/*.yaml")))
BENCHMARKS = {path.stem: path for path in PATHS if path.parts[-3] == "benchmarks"}
"""decks of closed forms and published cases by their names"""
LONG = (
    "benchmarks/closed_forms/acceleration_by_height",
    "benchmarks/closed_forms/arch_50_voussoirs",
    "benchmarks/closed_forms/arch_basket",
    "benchmarks/closed_forms/arch_catenary_thin",
    "benchmarks/closed_forms/arch_elliptic",
    "benchmarks/closed_forms/beam_under_travelling_load",
    "benchmarks/closed_forms/dome_24_voussoirs",
    "benchmarks/closed_forms/dome_of_slices_falls",
    "benchmarks/closed_forms/drum_column",
    "benchmarks/closed_forms/eccentric_compression_convex",
    "benchmarks/closed_forms/eccentric_compression_spacing",
    "benchmarks/closed_forms/incline_tilted_gravity",
    "benchmarks/closed_forms/leaning_block_rough_wall",
    "benchmarks/closed_forms/leaves_rough",
    "benchmarks/closed_forms/two_piers",
    "benchmarks/closed_forms/wall_10x10",
    "benchmarks/closed_forms/wall_20x20",
    "benchmarks/experiments/prestwood",
    "benchmarks/experiments/walls_sw",
    "benchmarks/experiments/walls_ws",
    "benchmarks/published/cocchetti_rizzi_mu_310_falls",
    "benchmarks/published/cocchetti_rizzi_mu_310_stands",
    "benchmarks/published/cocchetti_rizzi_mu_350_falls",
    "benchmarks/published/cocchetti_rizzi_mu_350_stands",
    "benchmarks/published/ferris_wall_1_slope",
    "benchmarks/published/ferris_wall_3",
    "benchmarks/published/ferris_wall_3_associative",
    "benchmarks/published/ferris_wall_3_dilatancy",
    "benchmarks/published/ferris_wall_3_slope",
    "benchmarks/published/ferris_wall_5",
    "benchmarks/published/ferris_wall_5_associative",
    "benchmarks/published/ferris_wall_5_slope",
    "bridges/lorry_on_soil",
    "bridges/partial_factors",
    "structures/arch_bridge",
    "structures/colonnade",
    "structures/cross_vault_on_piers",
    "structures/dome_on_drum",
    "structures/facade_to_strengthen",
    "structures/filled_bridge",
    "structures/house",
    "structures/retaining_wall",
    "structures/room",
    "structures/spiral_stair",
    "sweeps/base/block_that_rocks",
    "time_histories/block_under_pulses",
    "time_histories/column_of_drums",
    "time_histories/facade_under_record",
    "tutorials/arch_in_soil",
    "tutorials/arch_on_piers",
    "tutorials/arch_that_spreads",
    "tutorials/assessed_facade",
    "tutorials/battlements",
    "tutorials/bridge_with_parapets",
    "tutorials/buttressed_wall",
    "tutorials/column_with_entasis",
    "tutorials/corner",
    "tutorials/cross_vault",
    "tutorials/crossvault",
    "tutorials/crossvault_without_dilatancy",
    "tutorials/dolmen",
    "tutorials/dome",
    "tutorials/facade_of_stones",
    "tutorials/gable_wall",
    "tutorials/half_of_a_front",
    "tutorials/haunches",
    "tutorials/lintels_and_arches",
    "tutorials/measured_arch",
    "tutorials/obj_wall",
    "tutorials/pavilion_vault",
    "tutorials/random_wall",
    "tutorials/rocking_block",
    "tutorials/room_to_strengthen",
    "tutorials/segmental_domes",
    "tutorials/settling_wall",
    "tutorials/spiral_stair_round",
    "tutorials/square_silo",
    "tutorials/two_leaf_walls",
    "tutorials/vault_in_rings",
    "tutorials/walls_at_a_corner",
)  # fmt: skip
"""take long, or show once more what another shows: run by ``pytest -m long`` only, as the folder of regressions is"""
EACH = 8
"""of the other benchmarks, most of whose closed forms ``tests/analytic`` holds, each of so many is short"""


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


def is_long(name: str) -> bool:
    """Whether only the long tests run the deck of that name."""
    return name in LONG or name.startswith("regressions/") or name in _often_shown()


@cache
def _often_shown() -> frozenset[str]:
    closed = [path for path in BENCHMARKS.values() if path.parent.name != "experiments"]
    names = [name for path in closed if (name := name_of(path)) not in LONG]
    return frozenset(names) - frozenset(names[::EACH])


def as_parameters() -> list[ParameterSet]:
    """Every deck, those that take long with their mark."""
    names = [(path, name_of(path)) for path in PATHS]
    return [pytest.param(path, id=name, marks=pytest.mark.long if is_long(name) else ()) for path, name in names]


every_deck = pytest.mark.parametrize("path", as_parameters())


@cache
def deck_of(path: Path) -> Deck:
    """The deck as read."""
    return read_deck(path)


@cache
def outcome_of(path: Path) -> Outcome:
    """Run a deck in this process; large ones without the paths with torsion, which take several times as long."""
    large = name_of(path) in LONG and path.parent.name != "published" and "piers" not in path.stem
    torsion = large and deck_of(path).analysis.flow_rule == "non_associative"
    return run_deck(path, *(("--set", "analysis.torsion=false") if torsion else ()))


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
