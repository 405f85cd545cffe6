"""Very many load cases in one deck: each gets its own load factor."""

from __future__ import annotations

import io
import math
import time
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.process.run_options import RunOptions
from mbla.results.sta import StatusFile
from mbla.run import solve_deck

pytestmark = pytest.mark.long

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: block, material: stone, min: [-0.5, -0.5, 0], max: [0.5, 0.5, 0.2]}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
analysis: {flow_rule: associative}
load_cases:
"""


def test_a_block_pushed_in_many_directions_and_sizes(tmp_path: Path) -> None:
    """Thirteen sizes of the load, from a millionth to a million, each in another direction."""
    count = 100
    angles = [2 * math.pi * k / count for k in range(count)]
    sizes = [10.0 ** (k % 13 - 6) for k in range(count)]
    lines = [
        f"  case_{k}: {{live: [{{acceleration: [{size * math.cos(angle)!r}, {size * math.sin(angle)!r}, 0]}}]}}"
        for k, (angle, size) in enumerate(zip(angles, sizes, strict=True))
    ]
    path = tmp_path / "cases.yaml"
    path.write_text(HEAD + "\n".join(lines) + "\n", encoding="utf-8")
    results = solve_deck(read_deck(path), RunOptions(), StatusFile(io.StringIO(), "cases"), None, time.perf_counter())
    assert [case.load_case.name for case in results.cases] == [f"case_{k}" for k in range(count)]
    for case, size in zip(results.cases, sizes, strict=True):
        assert case.status == "solved"
        assert case.solution.mechanics is not None
        assert case.solution.mechanics.load_factor == pytest.approx(0.5 / size, rel=1e-6)
