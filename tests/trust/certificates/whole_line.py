"""A deck through the whole line, as a user takes it: run, result file, and verify with that file alone."""

from __future__ import annotations

import json
import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

from mbla.cli import main
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.results import Results
from tests.properties.random_items import Tree

Made = TypeVar("Made")
WORKERS = min(2, os.cpu_count() or 1)


@dataclass(frozen=True)
class Outcome:
    """What became of the one load case of a deck.

    code, verify_code : exit statuses of run and verify
    claimed           : the case in the JSON object of run; empty where the deck was refused
    recomputed        : the case in the JSON object of verify; empty as well
    told              : what went to standard error
    """

    name: str
    code: int
    claimed: Tree
    verify_code: int
    recomputed: Tree
    told: str

    @property
    def status(self) -> str:
        """Status by the run; ``refused`` where there is none."""
        return str(self.claimed.get("status", "refused"))


def outcome_of(deck: Tree, *options: str) -> Outcome:
    """Run and verify a deck with one load case.

    options : of ``mbla run``
    """
    with TemporaryDirectory() as folder:
        return _outcome(deck, Path(folder), *options)[0]


def with_results(deck: Tree, *options: str) -> tuple[Outcome, Results | None]:
    """The same, and the result file as it was read back; None where the deck was refused."""
    with TemporaryDirectory() as folder:
        outcome, file = _outcome(deck, Path(folder), *options)
        return outcome, None if file is None else read_results_hdf5(file)


def _outcome(deck: Tree, folder: Path, *options: str) -> tuple[Outcome, Path | None]:
    """What became of a deck, and its result file, which is verified in a folder of its own without the deck."""
    name, path, alone = str(deck["title"]), folder / "deck.yaml", folder / "alone"
    path.write_text(json.dumps(deck), encoding="utf-8")
    code, claimed, told = _command("run", str(path), "--json", "-q", *options)
    file = path.with_suffix(".out") / "deck.h5"
    if not file.exists():
        return Outcome(name, code, {}, code, {}, told), None
    alone.mkdir()
    file = file.rename(alone / "result.h5")
    path.unlink()
    verify_code, recomputed, remarks = _command("verify", str(file), "--json")
    return Outcome(name, code, claimed["cases"][0], verify_code, recomputed["cases"][0], told + remarks), file


def each(make: Callable[[int], Made], seeds: Iterable[int]) -> Iterator[Made]:
    """What is made of every seed, in their order, by several processes."""
    with ProcessPoolExecutor(WORKERS, multiprocessing.get_context("spawn")) as pool:
        yield from pool.map(make, seeds, chunksize=5)


def _command(*arguments: str) -> tuple[int, dict[str, Any], str]:
    """Exit status, JSON object and standard error of a command."""
    out, err = StringIO(), StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        code = main(list(arguments))
    return code, json.loads(out.getvalue()) if out.getvalue() else {}, err.getvalue()
