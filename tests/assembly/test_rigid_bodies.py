"""Rigid bodies of glued blocks: loads, motions and guides of bodies and of their blocks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.assembly.lift import motions_of_blocks, motions_of_bodies
from mbla.model.model import LoadCase
from mbla.results.outcome import answer_of
from mbla.run import RunOptions, run
from tests.assembly.towers import glued


def test_nothing_glued_is_the_same_model() -> None:
    assembly = glued()
    bodies = assembly.glued()
    assert bodies.model.blocks is assembly.model.blocks
    assert bodies.contacts is assembly.contacts
    assert assembly.contacts.solid_of_block is None
    loads = np.ones((5, 6))
    assert np.array_equal(bodies.loads(loads), loads)
    assert np.array_equal(motions_of_blocks(bodies, loads), loads)


def test_glued_blocks_are_one_body() -> None:
    bodies = glued(("b", "c"), ("c", "d")).glued()
    assert len(bodies.model.blocks) == 3
    np.testing.assert_allclose(bodies.model.blocks.volumes, [1, 3, 1])
    np.testing.assert_allclose(bodies.model.blocks.centroids[:, 2], [0.5, 2.5, 4.5])
    assert bodies.contacts.bodies.tolist() == [[0, 1], [1, 2], [3, 0]]
    assert [bodies.model.blocks.name(body) for body in range(3)] == ["a[0]", "b[0]", "e[0]"]


def test_loads_and_motions_keep_their_power() -> None:
    rng = np.random.default_rng(3)
    case = LoadCase("x", rng.normal(size=(5, 6)), rng.normal(size=(5, 6)), (), ())
    bodies = glued(("b", "c"), ("d", "e")).of(case)
    motions = rng.normal(size=(3, 6))
    on_blocks = motions_of_blocks(bodies, motions)
    np.testing.assert_allclose(motions_of_bodies(bodies, on_blocks), motions, atol=1e-14)
    of_bodies = bodies.load_case(case)
    assert np.sum(of_bodies.dead_load * motions) == pytest.approx(np.sum(case.dead_load * on_blocks), rel=1e-12)
    assert np.sum(of_bodies.live_load * motions) == pytest.approx(np.sum(case.live_load * on_blocks), rel=1e-12)


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


@pytest.mark.parametrize("blocks", ["lower", "upper", "[lower, upper]"])
def test_a_body_moves_as_its_guided_block_may(tmp_path: Path, blocks: str) -> None:
    together = ", together: true" if "[" in blocks else ""
    path = tmp_path / "deck.yaml"
    path.write_text((DECK % ("", blocks, "")).replace("0, 0]}}", f"0, 0]}}{together}}}", 1), encoding="utf-8")
    results = run(path, RunOptions(folder=tmp_path / "out", force=True))
    push, settle = results.case("push"), results.case("settle")
    assert push.checks.verified
    assert push.solution.mechanics is not None
    assert push.solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-7)  # b/h, about the hinge at its edge
    # the beam of 3 m turns about the edge of the base, 0.5 m from its middle and 2 m from the far end
    assert answer_of(settle) == pytest.approx(3 * 0.5 * 2000 * 9.81 / 4, rel=1e-7)
