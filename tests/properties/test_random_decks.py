"""Random decks: no internal error, exit status and files that agree with each other, faults told by their place."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.cli import main
from mbla.results.exit_status import EXIT_CODES, GRAVEST_FIRST
from mbla.solution.solution import PROVED_STANDING, Status
from tests.properties.random_decks import random_deck
from tests.properties.run_deck import run_deck, write_deck

pytestmark = pytest.mark.long

FEW = (0, 3, 10, 13, 23, 39, 46, 49)
"""one each of solved, without equilibrium, unbounded, convex, a dome on a tilting table, dilatancy and mortar"""
SEEDS = (*FEW, *range(60, 110))


def check(seed: int, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_deck(random_deck(seed), folder)
    run = run_deck(path, capsys)
    assert run.code in (0, 3, 4, 5), run.errors
    checked = main(["check", str(path), "--vtu"])
    told = capsys.readouterr()
    if run.code == 3:
        assert checked == 3
        assert run.record.get("exit_code", 3) == 3
        assert all(f"{path.name}:1:" in line for line in run.errors.splitlines())
        assert not path.with_suffix(".out").exists()
        return
    assert checked == 0, told.err
    codes = {EXIT_CODES[Status(case["status"])] for case in run.cases}
    assert run.code == run.record["exit_code"] == next((code for code in GRAVEST_FIRST if code in codes), 0)
    assert all((case["load_factor"] is None) != (case["status"] in ("solved", "approximate")) for case in run.cases)
    file = str(path.with_suffix(".out") / "deck.h5")
    verdicts = {case["standing"]["verdict"] for case in run.cases if case["standing"] is not None}
    unproved = not verdicts <= {str(verdict) for verdict in PROVED_STANDING}
    assert main(["verify", file]) in ({run.code, 4} if unproved else {run.code}), capsys.readouterr().out
    assert main(["show", file]) == 0


@pytest.mark.parametrize("seed", SEEDS)
def test_random_decks(seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    check(seed, tmp_path, capsys)
