"""Result files changed after they were written."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py

from mbla.process.run_options import RunOptions
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.results import CaseResult, Results
from mbla.run import run
from mbla.solution.pushover.curve_rows import CurveRow


@contextlib.contextmanager
def changing(path: Path) -> Iterator[h5py.File]:
    """The file, open to be changed."""
    with h5py.File(path, "r+") as file:
        yield file


def change(path: Path, name: str, value: Any) -> None:
    with changing(path) as file:
        file[name][...] = value


def remove(path: Path, name: str) -> None:
    with changing(path) as file:
        del file[name]


def replace_dataset(path: Path, name: str, array: Any) -> None:
    with changing(path) as file:
        del file[name]
        file[name] = array


def image_of_run(folder: Path, text: str, *overrides: str) -> bytes:
    """The result file of a deck that was run in a folder."""
    deck = folder / "deck.yaml"
    deck.write_text(text, encoding="utf-8")
    run(deck, RunOptions(overrides=overrides))
    return (folder / "deck.out" / "deck.h5").read_bytes()


def written(tmp_path: Path, results: Results) -> Path:
    """A file of changed results: whole, and consistent in all that a writer derives."""
    path = tmp_path / "forged.h5"
    path.write_bytes(write_results_hdf5(results))
    return path


def with_curve(case: CaseResult, curve: tuple[CurveRow, ...]) -> CaseResult:
    """A load case with other rows of its capacity curve."""
    further = case.solution.further
    return case.with_further(replace(further, pushover=replace(further.pushover, curve=curve)), ())


def with_case(results: Results, **changed: Any) -> Results:
    """Results whose first case has another solution, told with the status and the exit status of a good one."""
    (case, *others) = results.cases
    solution = replace(case.solution, **changed)
    checks = replace(case.checks, verified=True, failures=())
    forged = replace(case, solution=solution, checks=checks, status=solution.status)
    return replace(results, cases=(forged, *others), exit_code=0)
