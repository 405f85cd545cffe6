"""Reactions of supports that give way, in the listing."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.results.listing.answers import answer_facts
from mbla.run import RunOptions, run

ARCH = """mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.7}}
blocks:
  - arch: {material: stone, shape: semicircular, span: 4, thickness: 0.6, width: 1, voussoirs: 9, springers: blocks}
contacts: {joint: dry}
load_cases:
  push: {settlement: {on: {group: arch_springers, index: 1}, direction: [SENSE, 0, 0]}}
analysis: {flow_rule: associative}
"""


@pytest.mark.parametrize(("sense", "negative"), [("1", False), ("-1", True)])
def test_what_a_negative_reaction_means(tmp_path: Path, sense: str, negative: bool) -> None:
    """Springings that spread are pushed out by the arch, those that close in are pushed in against it."""
    path = tmp_path / "arch.yaml"
    path.write_text(ARCH.replace("SENSE", sense))
    results = run(path, RunOptions())
    facts = answer_facts(results.model, results.cases[0])
    told = [fact for fact in facts if "negative: the support must be pushed" in fact.value]
    assert len(told) == negative
    assert ("-" in facts[0].value.split("N")[0]) == negative
