"""Guides and settlements of structures with glued blocks."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.errors import DeckError
from mbla.results.listing.answers import reaction_of
from mbla.results.results import Results
from mbla.run import RunOptions, run

DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, -1], max: [3, 1, 0]}
  - box: {group: far, material: stone, min: [4, 0, -1], max: [5, 1, 0]}
  - box: {group: lower, material: stone, min: [0.5, 0, 0], max: [1.5, 1, 1]}
  - box: {group: upper, material: stone, min: [0.5, 0, 1], max: [1.5, 1, 2]}
  - box: {group: beam, material: stone, min: [2, 0, 0], max: [3.5, 1, 0.5]}
  - box: {group: beam, material: stone, min: [3.5, 0, 0], max: [5, 1, 0.5]}
contacts: {joint: dry, overrides: [{between: [lower, upper], joint: glued}, {between: [beam, beam], joint: glued}%s]}
supports:
  - {blocks: [base, far]}
  - {blocks: %s, turn: {axis: [0, 1, 0], about: [1.5, 0, 0]}}%s
load_cases:
  push: {live: [{acceleration: [1, 0, 0], on: [lower, upper]}]}
  settle: {settlement: {on: far, direction: [0, 0, -1]}}
analysis: {flow_rule: associative}
output: {vtu: false}
"""


def results_of(tmp_path: Path, joints: str, blocks: str, more: str) -> Results:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK % (joints, blocks, more), encoding="utf-8")
    return run(path, RunOptions(folder=tmp_path / "out", force=True))


@pytest.mark.parametrize("blocks", ["lower", "upper", "[lower, upper]"])
def test_a_solid_moves_as_its_guided_block_may(tmp_path: Path, blocks: str) -> None:
    together = ", together: true" if "[" in blocks else ""
    path = tmp_path / "deck.yaml"
    path.write_text((DECK % ("", blocks, "")).replace("0, 0]}}", f"0, 0]}}{together}}}", 1), encoding="utf-8")
    results = run(path, RunOptions(folder=tmp_path / "out", force=True))
    push, settle = results.case("push"), results.case("settle")
    assert push.checks.verified
    assert push.solution.mechanics is not None
    assert push.solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-7)  # b/h, about the hinge at its edge
    # the beam of 3 m turns about the edge of the base, 0.5 m from its middle and 2 m from the far end
    assert reaction_of(settle) == pytest.approx(3 * 0.5 * 2000 * 9.81 / 4, rel=1e-7)


def test_guides_that_glue_makes_contradict_each_other_are_refused(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match=r"lower\[0\] and upper\[0\] are glued to one rigid body, but"):
        results_of(tmp_path, "", "lower", "\n  - {blocks: upper, slide: [1, 0, 0]}")


def test_blocks_glued_to_supports_do_not_settle(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match=r"settle.*on = far: beam\[1\] held by glue on a support that gives way"):
        results_of(tmp_path, ", {between: [base, beam], joint: glued}", "lower", "")


def test_a_guided_block_that_is_glued_to_a_support_is_refused(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match=r"lower\[0\] may move in some way, but glue holds it to a support"):
        results_of(tmp_path, ", {between: [base, lower], joint: glued}", "lower", "")
