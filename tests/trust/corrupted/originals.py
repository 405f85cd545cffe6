"""The result files that are spoilt: small, with every kind of answer and proof between them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from mbla.process.run_options import RunOptions
from mbla.run import run

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
supports: [{ground: {z: 0}, joint: dry}]
"""
DECKS = {
    "tower": HEAD
    + """\
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: high, material: stone, min: [0.1, 0, 1], max: [1.1, 1, 2.5]}
  - box: {group: lean, material: stone, min: [1.1, 0, 0], max: [1.6, 1, 1.6]}
load_cases:
  push_x: {live: [{acceleration: [1, 0, 0]}]}
  press: {live: [{force: [0, 0, -1000], on: low, at: [0.5, 0.5, 1]}]}
""",
    "arch": HEAD
    + """\
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.6, width: 1, voussoirs: 7}
load_cases:
  push_x: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
""",
    "overhang": HEAD
    + """\
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: high, material: stone, min: [0.6, 0, 1], max: [1.9, 1, 1.5]}
load_cases:
  push_x: {live: [{acceleration: [1, 0, 0]}]}
""",
}


def write_originals(folder: Path, names: Iterable[str] = tuple(DECKS)) -> dict[str, Path]:
    """Decks run in a folder: path of each result file by the name of its deck."""
    paths = {}
    for name in names:
        deck = folder / f"{name}.yaml"
        deck.write_text(DECKS[name], encoding="utf-8")
        run(deck, RunOptions())
        paths[name] = folder / f"{name}.out" / f"{name}.h5"
    return paths
