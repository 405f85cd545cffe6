"""Many contacts: indeterminate to the thousands, hundreds of contact points in one interface."""

from __future__ import annotations

import math

from tests.extremes.decks import under_both_rules
from tests.extremes.outcome import Scene

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
contacts: {joint: dry}
"""


PUSH = "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"


OUTLINES = "outlines-simplified"


SPATIAL = ("analysis.reductions=false",)


ON_MANY = (
    HEAD
    + """\
parameters: {n: 30, h: 1, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: ["=1/n", "=1/n", 0.1],
          repeat: [{count: "=n", translate: ["=1/n", 0, 0]}, {count: "=n", translate: [0, "=1/n", 0]}]}
  - box: {group: block, material: stone, min: [0, 0, 0.1], max: [1, 1, "=0.1 + h"]}
supports: [{blocks: base}]
"""
    + PUSH
)
"""A block on a floor of n x n fixed blocks: min(mu, 1/h)."""


ON_LOOSE = ON_MANY.replace("supports: [{blocks: base}]", "supports: [{ground: {z: 0}}]").replace(
    "push: {live: [{acceleration: [1, 0, 0]}]}", "push: {live: [{acceleration: [1, 0, 0], on: block}]}"
)
"""The same floor, loose on the ground; only the block above is pushed. Its factor is that of ``tests.analytic.planar``:
the tile under the toe tips with the block, and without dilatancy the block slides off it by a thousandth sooner."""


POINTS = (
    HEAD.replace("contacts: {joint: dry}", 'contacts: {joint: dry, points: {per_edge: "=k"}}')
    + """\
parameters: {k: 50, h: 1, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, "=h"]}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)


CORNERS = (
    HEAD
    + """\
parameters: {n: 360, h: 1, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - column: {group: column, material: stone, radius: 0.5, height: "=h", drums: 2, sides: "=n", polygon: inscribed}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""Two drums with faces of n corners: it slides at mu, or rocks about the edge at +x, at the distance r cos(pi/n)."""


BEAM = (
    HEAD
    + """\
parameters: {n: 1000, h: 2, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: column, material: stone, min: [0, 0, 0], max: [0.5, 0.5, "=h"],
          repeat: {count: "=n", translate: [1, 0, 0]}}
  - box: {group: beam, material: stone, min: [0, 0, "=h"], max: ["=n - 0.5", 0.5, "=h + 0.5"]}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""n columns of weight w under one beam of weight W: all rock together, the beam riding on their edges."""


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
                overrides=(f"parameters.n={n}", f"parameters.h={h!r}"),
                long=long,
            )
    for h, word in ((1.0, "slides"), (4.0, "rocks")):
        scenes += under_both_rules(
            f"block on 100 loose blocks, {word}",
            family,
            ON_LOOSE,
            0.5 if word == "slides" else 0.238369047619,
            1e-6 if word == "slides" else 1e-3,
            overrides=("parameters.n=10", f"parameters.h={h!r}"),
        )
    for n, long in ((100, False), (2000, True)):
        scenes += under_both_rules(
            f"beam on {n} columns",
            family,
            BEAM,
            beam_factor(n),
            overrides=(f"parameters.n={n}",),
            long=long,
        )
    return scenes


def beam_factor(n: int) -> float:
    """Columns 0.5 by 2 turn about their feet, the beam moves along with their upper edges; forces by moments.

    One column of weight w, the share q of the beam on its upper left corner and lambda q along its head: moments about
    its right foot w b/2 + q b = lambda (w h/2 + q h), with friction 0.5 at head and foot enough.
    """
    b, h, depth = 0.5, 2.0, 0.5
    w, q = b * h, (n - 0.5) * depth / n
    return (w * b / 2 + q * b) / (w * h / 2 + q * h)


def _points() -> list[Scene]:
    family = "hundreds of contact points in one interface"
    scenes = []
    for k in (10, 50):
        for h, word in ((1.0, "slides"), (4.0, "rocks")):
            scenes += under_both_rules(
                f"{k} points on every edge, {word}",
                family,
                POINTS,
                min(0.5, 1 / h),
                overrides=(f"parameters.k={k}", f"parameters.h={h!r}"),
                long=k > 10,
            )
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


SCENES = (*_statics(), *_points())
