"""Arrays of a result file with wrong values or a wrong shape: ``mbla verify`` refuses the file, or disagrees with it.

It ends in no other way, whatever the array: the bytes of the file are sound, and only what stands in them can tell.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import FileError
from mbla.process.run_options import RunOptions
from mbla.results.listing.listing import verification_lines
from mbla.run import run
from mbla.verify import verify_file
from tests.decks.folder import BENCHMARKS, PATHS
from tests.line import BLOCK, WALL
from tests.results.changed_files import changing, image_of_run
from tests.test_verify_pushover import ROCKS
from tests.trust.corrupted.spoiling import datasets

NUMBER = 4
"""of damaged arrays in the short test"""
DAMAGE: Mapping[str, Callable[[Any], Any]] = {
    "negative": lambda values: np.full_like(values, -5),
    "large": lambda values: np.full_like(values, 10**6),
    "beyond all": lambda values: np.full_like(
        values, 1e150 if values.dtype.kind == "f" else np.iinfo(values.dtype).max
    ),
    "no number": lambda values: np.full_like(values, np.nan) if values.dtype.kind == "f" else values - 1,
    "one negative": lambda values: np.where(np.arange(values.size).reshape(values.shape) == 0, -values - 1, values),
    "zero": np.zeros_like,
    "one more": lambda values: np.concatenate([values, values[-1:]]) if values.ndim else np.array([values]),
    "none": lambda values: values[:0] if values.ndim else np.array([values, values]),
}
"""what becomes of an array, by its name"""
DECKS: Mapping[str, tuple[str, ...]] = {
    "settling_wall": ("parameters.n=4", "load_cases.sinks.settlement.amount=0.02"),
    "tied_wall": (),
    "block_crushing_a_corner": (),
    "torque_convex": (),
    "wall_5x5": (),
    "tilting_block": (),
}
"""decks of each kind of answer, and what is changed in them"""


def faults(image: bytes, path: Path, chosen: Iterable[tuple[str, str]]) -> list[str]:
    """Arrays and damage with which verification ends in another way than it may."""
    found = []
    for name, kind in chosen:
        path.write_bytes(image)
        with changing(path) as file:
            values = DAMAGE[kind](file[name][()])
            del file[name]
            file[name] = values
        try:
            results, differing = verify_file(path)
            verification_lines(results, differing)
        except FileError as error:
            found += [] if str(error).startswith(f"{path}: ") and "\n" not in str(error) else [f"{name}: {error}"]
        except Exception as error:
            found.append(f"{name}, {kind}: {type(error).__name__}: {error}")
    return found


def damages(path: Path) -> list[tuple[str, str]]:
    """Each array of numbers of load cases with each damage."""
    with changing(path) as file:
        numbers = [name for name in datasets_of_cases(path) if file[name].dtype.kind in "fi"]
    return [(name, kind) for name in numbers for kind in DAMAGE]


def datasets_of_cases(path: Path) -> list[str]:
    """Paths of the datasets of load cases."""
    return [name for name in datasets(path) if name.startswith("cases/")]


def test_some_damaged_arrays_of_a_pushover(tmp_path: Path) -> None:
    image, path = image_of_run(tmp_path, BLOCK, *ROCKS), tmp_path / "damaged.h5"
    path.write_bytes(image)
    chosen = random.Random(5).sample(damages(path), NUMBER)
    assert not (wrong := faults(image, path, chosen)), "\n".join(wrong)


@pytest.mark.trust
@pytest.mark.parametrize("name", ["rocks", "wall", *DECKS])
def test_every_array_damaged_in_every_way(name: str, tmp_path: Path) -> None:
    known = {path.stem: path for path in PATHS} | BENCHMARKS
    if name in known:
        run(known[name], RunOptions(folder=tmp_path, overrides=(*DECKS[name], "output.vtu=false")))
        image = (tmp_path / f"{name}.h5").read_bytes()
    else:
        image = image_of_run(tmp_path, BLOCK, *ROCKS) if name == "rocks" else image_of_run(tmp_path, WALL)
    path = tmp_path / "damaged.h5"
    path.write_bytes(image)
    assert not (wrong := faults(image, path, damages(path))), "\n".join(wrong)
