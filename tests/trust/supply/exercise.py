"""Commands that use every dependency of mbla at least once, run by any Python that has it, without a network."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

GUARD = Path(__file__).parent / "guard"
SWEEP = """\
mbla_sweep: 1
deck: decks/tutorials/block.yaml
parameters: {mu: {key: joints.dry.friction, values: [0.3, 0.5]}}
"""
EXPECTED = (
    "tutorials/block",
    "benchmarks/formats/arch_from_dxf",
    "benchmarks/formats/arch_from_gltf",
    "benchmarks/formats/arch_from_vtu",
    "benchmarks/closed_forms/dome_of_slices_falls",
    "benchmarks/published/ferris_wall_3",
    "benchmarks/closed_forms/wall_10x10_highs",
)
"""decks whose load factors must be those that they expect"""
WALL, DOME = "out/ferris_wall_3.h5", "out/dome_of_slices_falls.h5"
BESIDE = (
    (0, ("show", WALL)),
    (0, ("verify", WALL)),
    (0, ("plot", WALL, "--kind", "mechanism", "-o", "out/wall.svg")),
    (0, ("plot", DOME, "--kind", "model", "-o", "out/dome.png")),
    (0, ("plot", WALL, "--animate", "mp4", "-o", "out/films")),
    (0, ("report", WALL, "-o", "out/wall.html")),
    (0, ("export", WALL, "--csv", "--parquet", "-o", "out/tables")),
    (0, ("sweep", "sweep.yaml", "-j", "2", "-q")),
)
"""exit status, and arguments"""


@dataclass(frozen=True)
class Exercised:
    """What was done.

    failed   : commands that ended with another exit status than they must, with what they said
    attempts : ways to another machine that were tried
    """

    commands: int
    failed: tuple[str, ...]
    attempts: tuple[str, ...]


def exercise(python: Path, folder: Path, environment: Mapping[str, str]) -> Exercised:
    """Run all commands in a folder that has ``decks``; ``environment`` is beside the variables of this process."""
    (folder / "sweep.yaml").write_text(SWEEP, encoding="utf-8")
    decks = [(_status(deck), ("run", f"decks/{deck}.yaml", "--expected", "-o", "out", "-q")) for deck in EXPECTED]
    asked: list[tuple[int, tuple[str, ...]]] = [*decks, *BESIDE]
    done = [guarded(python, ("-m", "mbla", *arguments), folder, environment) for _, arguments in asked]
    failed = [
        f"mbla {' '.join(arguments)}: {ended.returncode}: {ended.stderr}"
        for (status, arguments), ended in zip(asked, done, strict=True)
        if ended.returncode != status
    ]
    return Exercised(len(asked), tuple(failed), attempts_in(folder))


def _status(deck: str) -> int:
    """Exit status of a deck; falling under its own weight is an answer."""
    return 5 if deck.endswith("_falls") else 0


def guarded(
    python: Path, arguments: Sequence[str], folder: Path, environment: Mapping[str, str]
) -> subprocess.CompletedProcess[str]:
    """Run Python in a folder, with every way to another machine refused."""
    paths = [str(GUARD), *filter(None, [environment.get("PYTHONPATH")])]
    guard = {"PYTHONPATH": os.pathsep.join(paths), "MBLA_ATTEMPTS": str(folder / "attempts.txt"), "MPLBACKEND": "agg"}
    return subprocess.run(
        [python, *arguments],
        cwd=folder,
        env=os.environ | dict(environment) | guard,
        capture_output=True,
        text=True,
        check=False,
    )


def attempts_in(folder: Path) -> tuple[str, ...]:
    """What was refused."""
    path = folder / "attempts.txt"
    return tuple(path.read_text(encoding="utf-8").splitlines()) if path.exists() else ()
