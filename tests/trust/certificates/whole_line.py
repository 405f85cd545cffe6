"""A deck through the whole line, as a user takes it: run, result file, and verify with that file alone.

What a run claims is judged by what ``mbla verify`` found in the result file alone.
"""

from __future__ import annotations

import json
import math
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


# --- claims ---------------------------------------------------------------------------------------------------------

WITHIN = 1e-5
"""distance of static and kinematic bound, over the load factor, of what may be called solved"""
NEAR_ZERO = 1e-3
"""load factors below this are compared with it: next to zero nothing is relative"""
SETTLED = ("solved", "no_equilibrium", "unbounded")
RESIDUALS = ("equilibrium", "yield", "tension", "penetration", "complementarity", "slip")
SOLVED_RESIDUAL = 1e-4


def broken_claims(outcome: Outcome) -> list[str]:
    """What is claimed and not kept, a sentence each; nothing where all is."""
    if not outcome.claimed:
        return [f"{outcome.name}: refused: {outcome.told}"]
    claimed, recomputed = outcome.claimed, outcome.recomputed
    faults = []
    if outcome.code != outcome.verify_code or claimed["status"] != recomputed["status"]:
        faults.append(f"run says {claimed['status']}, verify {recomputed['status']}")
    if claimed["status"] in SETTLED and not recomputed["verified"]:
        faults.append(f"{claimed['status']} without verification: {recomputed['failures']}")
    if claimed["status"] not in ("solved", "approximate") and claimed["load_factor"] is not None:
        faults.append(f"a load factor with status {claimed['status']}")
    if claimed["status"] == "solved":
        if claimed["load_factor"] is None and claimed["standing"]["verdict"] == "yes":
            faults.append("solved without a load factor")
        faults_of = _associative_faults if claimed["flow_rule"] == "associative" else _other_faults
        faults += faults_of(recomputed)
    return [f"{outcome.name}: {fault}" for fault in faults]


def _associative_faults(case: Tree) -> list[str]:
    """The bounds enclose the load factor and lie within 1e-5 of each other."""
    static, kinematic, factor = case["static_bound"], case["kinematic_bound"], case["load_factor"]
    if None in (static, kinematic, factor):
        return [f"load factor {factor} with bounds {static}, {kinematic}"]
    room = WITHIN * max(abs(kinematic), NEAR_ZERO)
    if not abs(kinematic - static) <= room:
        return [f"bounds {static} and {kinematic} lie apart"]
    if not static - room <= factor <= kinematic + room:
        return [f"load factor {factor} is not between {static} and {kinematic}"]
    return []


def _other_faults(case: Tree) -> list[str]:
    """Residuals are there and small, and the load factor is at or below the associative one.

    Where the associative load factor has no bound, nothing can be above it.
    """
    faults = []
    elastic = case["residuals"]["elastic"] is not None
    residuals = [case["residuals"][name] for name in (("equilibrium", "yield", "elastic") if elastic else RESIDUALS)]
    if any(value is None or not math.isfinite(value) or value > SOLVED_RESIDUAL for value in residuals):
        faults.append(f"residuals {case['residuals']}")
    factor, bound = case["load_factor"], case["kinematic_bound"]
    if factor is not None and bound is not None:
        allowed = SOLVED_RESIDUAL * max(abs(bound), NEAR_ZERO)
        if factor > bound + allowed:
            faults.append(f"load factor {factor} above the bound {bound} of associative flow")
    return faults
