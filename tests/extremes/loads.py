"""Huge and tiny loads, dead and live."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import FLOW_RULES, ruled, worded
from tests.extremes.outcome import Scene

LOADED = """\
mbla: 1
parameters: {live: 1, dead: 9.81, f: 1, more: 0}
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.7}}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [0.5, 1, 0.5]}
  - box: {group: high, material: stone, min: [0, 0, 0.5], max: [0.5, 1, 1]}
load_cases:
  push:
"""
ACCELERATED = LOADED + '    dead: [{gravity: [0, 0, "=-dead"]}]\n    live: [{acceleration: ["=live", 0, 0]}]\n'
"""Rocks at b/h = 0.5 times g over both."""
PUSHED = LOADED + '    live: [{force: ["=f", 0, 0], on: high, at: [0, 0.5, 1]}]\n'
"""Force at the top: W b/2 = factor f h with W = 9810 N."""
WEIGHTED = (
    LOADED
    + """\
    dead: [{gravity: [0, 0, -9.81]}, {force: [0, 0, "=-more"], on: high, at: [0.25, 0.5, 1]}]
    live: [{force: ["=f", 0, 0], on: high, at: [0, 0.5, 1]}]
"""
)


def scenes() -> Iterator[Scene]:
    """Each load by decades."""
    for rule in FLOW_RULES:
        for k in (-12, -9, -6, -3, 3, 6, 9, 12):
            x = 10.0**k
            for name, deck, override, expected in (
                (f"live acceleration 1e{k} g", ACCELERATED, f"live=1.0e{k}", 0.5 / x),
                (f"gravity 1e{k} g", ACCELERATED, f"dead={9.81 * x!r}", 0.5 * x),
                (f"live force 1e{k} N on 9.8 kN", PUSHED, f"f=1.0e{k}", 9810 * 0.25 / x),
                (f"dead force 1e{k} N on 9.8 kN", WEIGHTED, f"more=1.0e{k}", (9810 + x) * 0.25),
            ):
                yield Scene(
                    f"two blocks, {worded(rule)}, {name}",
                    "loads",
                    deck,
                    (f"parameters.{override}", ruled(rule)),
                    expected,
                    long=k not in (-12, -6, 9, 12),
                )


SCENES = tuple(scenes())
