"""Files that are meant to hurt are refused: in the documented way, at once, in little memory, with nothing written."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.hostile import hostile_amounts, hostile_files, hostile_meshes, hostile_sweeps, hostile_texts
from tests.trust.hostile.case import Case
from tests.trust.processes import Commands, Ended

CASES: list[Case] = [
    *hostile_texts.DECKS,
    *hostile_files.CASES,
    *hostile_amounts.CASES,
    *hostile_meshes.CASES,
    *hostile_sweeps.CASES,
]
FEW = (
    "NUL bytes",
    "1,000,000 brackets",
    "1 TB of zeros behind a deck",
    "aliases of aliases",
    "an expression: a tower of powers",
    "a pipe",
    "including itself",
    "10^10 boxes",
    "msh: a point tag of 10^10",
    "sweep: 10^15 random points",
)
"""those of the short form"""
SECONDS, MEGABYTES = 1.0, 200.0
IMPORTED = (
    *("ezdxf.path", "meshio", "pint", "mbla.cli.check", "mbla.results.listing.listing", "mbla.results.listing.summary"),
    *("mbla.run", "mbla.sweeps.command", "tests.trust.hostile.subject:build_types"),
)
LIMITS = {"RLIMIT_AS": 8 * 1024**3, "RLIMIT_CPU": 60}
"""addresses enough for what libraries reserve without ever using it"""
MOST_LINES = 1010


@pytest.fixture(scope="module")
def running() -> Iterator[Commands]:
    with Commands(IMPORTED, LIMITS) as process:
        yield process


def refused(case: Case, running: Commands, folder: Path) -> Ended:
    """Run a case and hold it to everything but time and memory."""
    folder.mkdir()
    case.write(folder)
    before = sorted(folder.rglob("*"))
    ended = running.run(*case.arguments, folder=folder)
    assert ended.status == case.status, ended
    assert sorted(folder.rglob("*")) == before
    assert ended.out == ""
    lines = ended.err.removesuffix("\n").split("\n")
    assert 1 <= len(lines) <= MOST_LINES
    assert all(line.isprintable() and line for line in lines)
    assert "internal error" not in ended.err
    assert "Traceback" not in ended.err
    return ended


def too_much(case: Case, ended: Ended) -> list[str]:
    """What a command took too much of."""
    found = [f"{case.name}: {ended.seconds:.1f} s"] if ended.seconds > SECONDS else []
    return found + ([f"{case.name}: {ended.memory:.0f} MB"] if ended.memory > MEGABYTES else [])


def test_names_are_different() -> None:
    assert len({case.name for case in CASES}) == len(CASES) >= 100
    assert set(FEW) <= {case.name for case in CASES}


@pytest.mark.every(2)
@pytest.mark.parametrize("case", [case for case in CASES if case.name in FEW], ids=lambda case: case.name)
def test_a_hostile_file_is_refused_at_once(case: Case, running: Commands, tmp_path: Path) -> None:
    assert too_much(case, refused(case, running, tmp_path / "in")) == []


@pytest.mark.trust
def test_every_hostile_file_is_refused_at_once(running: Commands, tmp_path: Path) -> None:
    excess, worst = [], [0.0, 0.0]
    for number, case in enumerate(CASES):
        ended = refused(case, running, tmp_path / str(number))
        excess += too_much(case, ended)
        worst = [max(worst[0], ended.seconds), max(worst[1], ended.memory)]
    assert excess == []
    record_counts(
        "hostile-files",
        31,
        "Decks, sweep files and geometry files that are meant to hurt are refused with the documented exit status, "
        "with one line per fault and nothing written, in less than a second beyond start-up and 200 MB",
        {"files": len(CASES), "milliseconds at worst": round(1000 * worst[0]), "MB at worst": round(worst[1])},
    )
