"""Many contacts and blocks: indeterminate to the thousands, hundreds of points in one interface, chains, one wall."""

from __future__ import annotations

import math

from tests.extremes.decks import deck, under_both_rules
from tests.extremes.outcome import Scene

OUTLINES = "outlines-simplified"
DOUBTFUL = ("standing-doubtful",)
RISES = "elastic-path-rises"
"""The load gains on hundreds of interfaces that open or slide one after the other, far beyond the end of a path."""


ON_MANY = deck(
    """\
  - box: {group: base, material: stone, min: [0, 0, 0], max: ["=1/n", "=1/n", 0.1],
          repeat: [{count: "=n", translate: ["=1/n", 0, 0]}, {count: "=n", translate: [0, "=1/n", 0]}]}
  - box: {group: block, material: stone, min: [0, 0, 0.1], max: [1, 1, "=0.1 + h"]}
""",
    "n: 30, h: 1, mu: 0.5",
    supports="[{blocks: base}]",
)
"""A block on a floor of n x n fixed blocks: min(mu, 1/h)."""


CORNERS = deck(
    """\
  - column: {group: column, material: stone, radius: 0.5, height: "=h", drums: 2, sides: "=n", polygon: inscribed}
""",
    "n: 360, h: 1, mu: 0.5",
)
"""Two drums with faces of n corners: it slides at mu, or rocks about the edge at +x, at the distance r cos(pi/n)."""


def _statics() -> list[Scene]:
    family = "statically indeterminate to the thousands"
    scenes = []
    for n, long in ((16, False), (32, True)):
        for h, word in ((1.0, "slides"), (4.0, "rocks")):
            scenes += under_both_rules(
                f"block on {n * n} fixed blocks, {word}",
                family,
                ON_MANY,
                min(0.5, 1 / h),
                diagnosis=(RISES,) if h > 2 else (),
                overrides=(f"parameters.n={n}", f"parameters.h={h!r}"),
                long=long,
            )
    return scenes


def _points() -> list[Scene]:
    family = "hundreds of contact points in one interface"
    scenes = []
    for n in (100, 360):
        for h, word in ((1.0, "slides"), (4.0, "rocks")):
            scenes += under_both_rules(
                f"faces of {n} corners, {word}",
                family,
                CORNERS,
                0.5 if h == 1.0 else 0.25 * math.cos(math.pi / n),
                diagnosis=(OUTLINES,),
                overrides=(f"parameters.n={n}", f"parameters.h={h!r}"),
            )
    return scenes


ROW = deck(
    """\
  - box: {group: row, material: stone, min: [0, 0, 0], max: [1, 1, 1], repeat: {count: "=n", translate: [1, 0, 0]}}
""",
    "n: 2000, mu: 0.5",
)
"""Blocks in a row, each against the next, every one pushed along it: mu."""

SHOVED = ROW.replace(
    "acceleration: [1, 0, 0]", 'force: ["=2000*9.81", 0, 0], on: {group: row, index: 0}, at: [0, 0.5, 0.4]'
)
"""Only the first is pushed, by its weight times the load factor, and shoves all others: n mu."""

STACK = deck(
    """\
  - stack: {group: stack, material: stone, block: [1, 1, "=h"], count: "=n"}
""",
    "n: 1000, h: 0.1, mu: 0.5",
)
"""It rocks about its toe: min(mu, 1/(n h))."""


WALL = deck(
    """\
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.175], length: "=0.4*n", courses: "=n"}
""",
    "n: 20",
    joint="friction: 0.65",
)


def _chains() -> list[Scene]:
    family, scenes = "chains and stacks", []
    for n, long in ((200, False), (2000, True)):
        size = f"parameters.n={n}"
        scenes += under_both_rules(f"row of {n} blocks, all pushed", family, ROW, 0.5, overrides=(size,), long=long)
        scenes += under_both_rules(
            f"row of {n} blocks, the first shoves all",
            family,
            SHOVED,
            0.5 * n,
            diagnosis=(RISES,),
            overrides=(size,),
            long=long,
        )
    for n, long in ((100, False), (1000, True)):
        size = f"parameters.n={n}"
        scenes += under_both_rules(
            f"stack of {n} blocks",
            family,
            STACK,
            min(0.5, 1 / (n * 0.1)),
            diagnosis=DOUBTFUL if long else (),
            overrides=(size,),
            long=long,
        )
    return scenes


def _walls() -> list[Scene]:
    """Planar walls whose factor the verification proves from both sides; 0.42267551 is the middle of those bounds,
    1.8e-8 apart. Smaller walls lead up to it: 0.453068, 0.437461, 0.426794 of 40, 60 and 100 courses."""
    size = ("parameters.n=141", "analysis.flow_rule=associative")
    return [Scene("wall of 19,951 blocks, associative", "large walls", WALL, size, 0.42267551, 1e-5, long=True)]


SCENES = (*_statics(), *_points(), *_chains(), *_walls())
