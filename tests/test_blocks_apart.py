"""Runs of structures with blocks that touch nothing: exit status 4 and the cause first, unless the deck allows them."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.results.listing.summary import summary_lines
from mbla.results.results import Results
from mbla.run import RunOptions, run
from mbla.verify import verify_file

DECK = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: block, material: stone, min: [0, 0, 1.02], max: [1, 1, 2]}
contacts: {joint: dry}
supports: [{ground: {z: 0}, blocks: {group: block, index: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
output: {vtu: false}
"""
HELD = "supports=[{ground: {z: 0}, blocks: {group: block, index: 0}}, {blocks: {group: block, index: 1}}]"


def results_of(folder: Path, *overrides: str) -> Results:
    path = folder / "deck.yaml"
    path.write_text(DECK)
    return run(path, RunOptions(folder=folder / "out", overrides=overrides, force=True))


@pytest.mark.parametrize(
    ("overrides", "status", "fails", "allowed"), [((), "no_equilibrium", 4, 5), ((HELD,), "solved", 4, 0)]
)
def test_exit_status(tmp_path: Path, overrides: tuple[str, ...], status: str, fails: int, allowed: int) -> None:
    results = results_of(tmp_path, *overrides)
    assert [case.status.value for case in results.cases] == [status]
    assert results.exit_code == fails
    assert results_of(tmp_path, "contacts.isolated=allow", *overrides).exit_code == allowed


@pytest.mark.parametrize("isolated", ["fail", "allow"])
def test_the_exit_status_is_found_again_from_the_file(tmp_path: Path, isolated: str) -> None:
    results = results_of(tmp_path, f"contacts.isolated={isolated}")
    again, disagreements = verify_file(tmp_path / "out" / "deck.h5")
    assert disagreements == ()
    assert again.exit_code == results.exit_code


def test_the_tolerance_that_the_message_names_is_a_way_out(tmp_path: Path) -> None:
    results = results_of(tmp_path, "contacts.tolerance=0.021")
    assert results.exit_code == 0
    assert len(results.contacts) == 2


def test_the_cause_is_told_once_with_the_verdict(tmp_path: Path) -> None:
    lines = summary_lines(results_of(tmp_path))
    words = " ".join(" ".join(lines).split())
    assert "warning [isolated-blocks]: 1 of 2 blocks touch nothing: block[1]; exit status 4" in words
    assert "tolerance above 0.021 all of them are" in words
    assert sum("touch nothing" in line for line in lines) == 1
    assert any("NO EQUILIBRIUM" in line for line in lines)
