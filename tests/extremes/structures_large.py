"""Long chains, high stacks, large walls and many load cases."""

from __future__ import annotations

import numpy as np

from tests.extremes.decks import under_both_rules
from tests.extremes.outcome import Scene

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
contacts: {joint: dry}
"""

ROW = (
    HEAD
    + """\
parameters: {n: 2000, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: row, material: stone, min: [0, 0, 0], max: [1, 1, 1], repeat: {count: "=n", translate: [1, 0, 0]}}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""Blocks in a row, each against the next, every one pushed along it: mu."""

SHOVED = ROW.replace(
    "acceleration: [1, 0, 0]", 'force: ["=2000*9.81", 0, 0], on: {group: row, index: 0}, at: [0, 0.5, 0.4]'
)
"""Only the first is pushed, by its weight times the load factor, and shoves all others: n mu."""

STACK = (
    HEAD
    + """\
parameters: {n: 1000, h: 0.1, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - stack: {group: stack, material: stone, block: [1, 1, "=h"], count: "=n"}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""It rocks about its toe: min(mu, 1/(n h))."""

TOP = STACK.replace("acceleration: [1, 0, 0]", "acceleration: [1, 0, 0], on: {group: stack, drum: -1}")
"""Only the top block is pushed: it slides at mu or the stack rocks, b/2 n = factor (n - 1/2) h."""

HANGING = (
    HEAD
    + """\
parameters: {n: 200, w: "=2000*9.81*0.1*0.1*0.1"}
joints: {dry: {friction: 0.5, cohesion: "=10*n*w/0.01", tensile_strength: "=2*n*w/0.01"}}
blocks:
  - box: {group: chain, material: stone, min: [0, 0, -0.1], max: [0.1, 0.1, 0],
          repeat: {count: "=n", translate: [0, 0, -0.1]}}
  - box: {group: ceiling, material: stone, min: [0, 0, 0], max: [0.1, 0.1, 0.1]}
supports: [{blocks: ceiling}]
load_cases: {pull: {live: [{acceleration: [0, 0, -1], on: chain}]}}
"""
)
"""Blocks that hang from a ceiling by joints that bear twice the weight of all: the load factor is 1."""

WALL = (
    HEAD
    + """\
parameters: {n: 20}
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.175], length: "=0.4*n", courses: "=n"}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)


def top_factor(n: int, height: float = 0.1, mu: float = 0.5) -> float:
    """The top block alone slides, or the upper k blocks turn about the edge of a joint: k/2 = factor (k - 1/2) h."""
    k = np.arange(1, n + 1)
    return min(mu, float((k / 2 / ((k - 0.5) * height)).min()))


def _scenes() -> list[Scene]:
    family, scenes = "chains and stacks", []
    for n, long in ((200, False), (2000, True)):
        size = f"parameters.n={n}"
        scenes += under_both_rules(f"row of {n} blocks, all pushed", family, ROW, 0.5, overrides=(size,), long=long)
        scenes += under_both_rules(
            f"row of {n} blocks, the first shoves all", family, SHOVED, 0.5 * n, overrides=(size,), long=long
        )
        scenes += under_both_rules(f"hanging chain of {n} blocks", family, HANGING, 1.0, overrides=(size,), long=long)
    for n, long in ((100, False), (1000, True)):
        size = f"parameters.n={n}"
        scenes += under_both_rules(
            f"stack of {n} blocks", family, STACK, min(0.5, 1 / (n * 0.1)), overrides=(size,), long=long
        )
        scenes += under_both_rules(
            f"stack of {n} blocks, the top pushed", family, TOP, top_factor(n), overrides=(size,), long=long
        )
    return scenes


def _walls() -> list[Scene]:
    """Planar walls whose factor the verification proves from both sides; 0.42267551 is the middle of those bounds,
    1.8e-8 apart. Smaller walls lead up to it: 0.453068, 0.437461, 0.426794 of 40, 60 and 100 courses."""
    size = ("parameters.n=141", "analysis.flow_rule=associative")
    return [Scene("wall of 19,951 blocks, associative", "large walls", WALL, size, 0.42267551, 1e-5, long=True)]


SCENES = (*_scenes(), *_walls())
