"""Many alike: equal parts, several mechanisms at once, blocks that meet in edges and corners only."""

from __future__ import annotations

from dataclasses import replace

from tests.extremes.decks import under_both_rules
from tests.extremes.outcome import Scene
from tests.extremes.structures_many import HEAD, PUSH

COLUMNS = (
    HEAD
    + """\
parameters: {n: 100, h: 2, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: column, material: stone, min: [0, 0, 0], max: [0.5, 0.5, "=h"],
          repeat: {count: "=n", translate: [1, 0, 0]}}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""n columns side by side that do not touch, all with the load factor min(mu, 0.5/h)."""


FOUR = (
    HEAD
    + """\
parameters: {h: 2, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: column, material: stone, min: [0, 0, 0], max: [0.5, 0.5, "=h"],
          repeat: [{count: 2, translate: [2, 0, 0]}, {count: 2, translate: [0, 2, 0]}]}
  - box: {group: slab, material: stone, min: [0, 0, "=h"], max: [2.5, 2.5, "=h + 0.25"]}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""Four equal columns under one slab."""


SLIDERS = (
    HEAD
    + """\
parameters: {n: 200, mu: 0.25}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: slider, material: stone, min: [0, 0, 0], max: [1, 1, 0.2],
          repeat: {count: "=n", translate: [0, 0, 0.2]}}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""A stack so low that every joint slides at the same factor mu where it does not rock."""


ROW = (
    HEAD
    + """\
parameters: {n: 200, mu: 0.5}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: row, material: stone, min: [0, 0, 0], max: [1, 1, 1], repeat: {count: "=n", translate: [1, 0, 0]}}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""Blocks in a row, each against the next, pushed along it: all slide, mu."""


PYRAMIDS = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - polyhedron: {group: tip, material: stone, vertices: [[0.5, 0.5, 1], [0, 0, 2], [1, 0, 2], [1, 1, 2], [0, 1, 2]],
                 faces: [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""A pyramid that stands on its apex: no surface in common, no contact."""


EDGE = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - polyhedron: {group: roof, material: stone, vertices: [[0, 0.5, 1], [1, 0.5, 1], [0, 0, 2], [1, 0, 2], [1, 1, 2],
                 [0, 1, 2]], faces: [[2, 3, 4, 5], [0, 1, 3, 2], [0, 5, 4, 1], [0, 2, 5], [1, 4, 3]]}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""A prism that stands on its edge."""


CORNER = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: one, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: two, material: stone, min: [1, 1, 0], max: [2, 2, 1]}
  - box: {group: three, material: stone, min: [2, 2, 1], max: [3, 3, 2]}
  - box: {group: floor, material: stone, min: [2, 2, 0], max: [3, 3, 1]}
supports: [{ground: {z: 0}}]
"""
    + PUSH
)
"""Blocks that meet along an edge or at a corner only: they do not touch, every one slides by itself."""


DOME = (
    HEAD
    + """\
parameters: {segments: 12, rings: 4}
joints: {dry: {friction: 0.65}}
blocks:
  - dome: {group: dome, material: stone, span: 4, thickness: 0.6, rings: "=rings", segments: "=segments", oculus: 0.6,
           bond: stack, springers: ground}
"""
    + PUSH
)


DOME_FACTOR = 0.57273048334
"""Associative; from linear programs whose planes are cut to the friction cones, see ``test_expected``."""


def _symmetric() -> list[Scene]:
    family = "symmetric, several mechanisms at once"
    scenes = []
    for n, long in ((2, False), (10, False), (100, True), (1000, True)):
        for h, word in ((0.5, "slide"), (2.0, "rock")):
            scenes += under_both_rules(
                f"{n} equal columns, {word}",
                family,
                COLUMNS,
                min(0.5, 0.5 / h),
                overrides=(f"parameters.n={n}", f"parameters.h={h!r}"),
                long=long,
            )
    scenes += under_both_rules("four columns under a slab", family, FOUR, four_factor())
    scenes += under_both_rules(
        "stack of which every joint slides", family, SLIDERS, 0.25, overrides=("parameters.n=19",)
    )
    scenes += under_both_rules("row of 200 blocks that all slide", family, ROW, 0.5)
    associative, other = under_both_rules("radial dome pushed", family, DOME, DOME_FACTOR)
    scenes += [associative, replace(other, expected=None, diagnosis=("solved",))]
    return scenes


def four_factor() -> float:
    """As for the beam: a quarter of the slab rides on the upper edge of each column."""
    b, h = 0.5, 2.0
    w, q = b * b * h, 2.5 * 2.5 * 0.25 / 4
    return (w * b / 2 + q * b) / (w * h / 2 + q * h)


def _touching() -> list[Scene]:
    family = "contact in edges and points only"
    return [
        *under_both_rules("pyramid on its apex", family, PYRAMIDS, None, diagnosis=("no_equilibrium",)),
        *under_both_rules("prism on its edge", family, EDGE, None, diagnosis=("no_equilibrium",)),
        *under_both_rules("blocks that meet in edges and corners", family, CORNER, 0.5),
    ]


SCENES = (*_symmetric(), *_touching())
