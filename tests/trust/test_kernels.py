"""Every deck has the same statuses and the same proved figures whatever kernel of OpenBLAS rounds them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.decks.folder import ROOT
from tests.trust.kernels import ALIKE, KERNELS, Compared, apart, compared, kernel, lines_of, record, table


def line(way: str, **figures: Any) -> dict[str, Any]:
    rest = dict.fromkeys(("least_load_factor", "torsion_load_factor", "angle", "reaction"))
    case = {"status": "solved", "normal": False, "associative_load_factor": 0.5, "load_factor": 0.4, **rest}
    return {"deck": "wall", "way": way, "cases": {"push": case | figures}}


def beside(**figures: Any) -> Compared:
    """A load case by two kernels, of which the second has these figures."""
    return compared([line("Haswell"), line("Nehalem", **figures)])


def test_what_is_not_the_same_is_found() -> None:
    assert (beside().statuses, beside().proved, beside().others) == ([], [0.0], [])
    assert beside(status="approximate").statuses == ["wall/push: solved (Haswell), approximate (Nehalem)"]
    assert beside(associative_load_factor=0.4).proved == [pytest.approx(0.2)]
    assert table(beside(load_factor=0.3)).splitlines()[2:] == ["| wall/push | load factor | 0.4 | 0.3 | 2.5e-01 |"]
    assert "| 0.4 | none | inf |" in table(beside(load_factor=None))
    assert not beside(normal=True).others


def test_a_figure_that_is_nothing_is_compared_with_the_size_of_ratios() -> None:
    assert apart([4e-10, -4e-10]) < ALIKE
    assert apart([None, None]) == 0.0


@pytest.mark.parametrize("chosen", ["Haswell", "Nehalem"])
def test_the_kernel_is_the_one_asked_for(chosen: str) -> None:
    if not kernel():
        pytest.skip("the library does not tell its kernel")
    environment = os.environ | {"OPENBLAS_CORETYPE": chosen}
    command = [sys.executable, "-m", "tests.trust.kernels"]
    told = subprocess.run(command, env=environment, cwd=ROOT, capture_output=True, text=True, check=True)
    assert told.stdout.strip() == chosen


@pytest.mark.trust
def test_all_decks_under_every_kernel(tmp_path: Path) -> None:
    ways = [(each, "1") for each in KERNELS] + [(kernel(), "2")]
    running = []
    for number, (core, threads) in enumerate(ways):
        variables = {"OPENBLAS_CORETYPE": core, **dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), threads)}
        command = [sys.executable, "-m", "tests.trust.kernels", str(tmp_path / f"{number}.jsonl")]
        running.append(subprocess.Popen(command, env=os.environ | variables, cwd=ROOT))
    assert [each.wait() for each in running] == [0] * len(ways)
    found = record([line for number in range(len(ways)) for line in lines_of(tmp_path / f"{number}.jsonl")])
    assert found.statuses == []
    assert max(found.proved) <= ALIKE
