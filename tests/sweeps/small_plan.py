"""A plan over one block, and what its points answer: the least of friction and of width over height."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from mbla.sweeps.identity import fingerprint_of
from mbla.sweeps.plan import Plan, Task
from tests.line import BLOCK

ROW = (
    BLOCK.replace("parameters: {", "parameters: {n: 1, ").split("blocks:\n", maxsplit=1)[0]
    + """\
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: "=n*0.4", courses: "=n"}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)
"""a wall of n by n blocks: as long a point as a test wants"""


def plan_over(folder: Path, text: str = BLOCK, **changes: Any) -> Plan:
    """A plan over a deck of that text."""
    deck = folder / "base.yaml"
    deck.write_text(text, encoding="utf-8")
    plan = Plan(
        deck=str(deck),
        fingerprint=fingerprint_of(deck, changes.get("fixed", ())),
        fixed=(),
        cases=("push",),
        results=("load_factor",),
        folder=str(folder / "sweep.out"),
    )
    return replace(plan, **changes)


def frictions(number: int) -> tuple[Task, ...]:
    """Points of friction 0.01, 0.02, ...: so much is the load factor up to 0.5, where the block rocks."""
    return tuple(Task(f"key{i}", i, {"parameters.mu": i / 100}) for i in range(1, number + 1))
