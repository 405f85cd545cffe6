"""Many alike: equal parts, several mechanisms at once, arches under a load at the crown.

The load factors of arches are those of a second formulation, the linear program of ``tests.analytic.planar``;
``test_expected`` works them out again. With much friction they fall by hinges, with any flow rule.
"""

from __future__ import annotations

from dataclasses import replace

from tests.extremes.decks import FLOW_RULES, deck, ruled, under_both_rules
from tests.extremes.outcome import Scene

COLUMNS = deck(
    """\
  - box: {group: column, material: stone, min: [0, 0, 0], max: [0.5, 0.5, "=h"],
          repeat: {count: "=n", translate: [1, 0, 0]}}
""",
    "n: 100, h: 2, mu: 0.5",
)
"""n columns side by side that do not touch, all with the load factor min(mu, 0.5/h)."""


FOUR = deck(
    """\
  - box: {group: column, material: stone, min: [0, 0, 0], max: [0.5, 0.5, "=h"],
          repeat: [{count: 2, translate: [2, 0, 0]}, {count: 2, translate: [0, 2, 0]}]}
  - box: {group: slab, material: stone, min: [0, 0, "=h"], max: [2.5, 2.5, "=h + 0.25"]}
""",
    "h: 2, mu: 0.5",
)
"""Four equal columns under one slab."""


SLIDERS = deck(
    """\
  - box: {group: slider, material: stone, min: [0, 0, 0], max: [1, 1, 0.2],
          repeat: {count: "=n", translate: [0, 0, 0.2]}}
""",
    "n: 200, mu: 0.25",
)
"""A stack so low that every joint slides at the same factor mu where it does not rock."""


DOME = deck(
    """\
  - dome: {group: dome, material: stone, span: 4, thickness: 0.6, rings: "=rings", segments: "=segments", oculus: 0.6,
           bond: stack, springers: ground}
""",
    "segments: 12, rings: 4",
    joint="friction: 0.65",
    supports="",
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
    associative, other = under_both_rules("radial dome pushed", family, DOME, DOME_FACTOR)
    scenes += [associative, replace(other, expected=None, diagnosis=("solved",))]
    return scenes


def four_factor() -> float:
    """As for the beam: a quarter of the slab rides on the upper edge of each column."""
    b, h = 0.5, 2.0
    w, q = b * b * h, 2.5 * 2.5 * 0.25 / 4
    return (w * b / 2 + q * b) / (w * h / 2 + q * h)


ARCH = """\
  - arch: {group: arch, material: stone, shape: semicircular, span: "=2 - t", thickness: "=t", width: 0.3,
           voussoirs: "=n", springers: ground}
"""
CROWN = deck(
    ARCH,
    "n: 21, t: 0.3",
    joint="friction: 5",
    supports="",
    load_cases="""{crown: {live: [{force: [0, 0, "=-2000*9.81*0.3"], on: {group: arch, index: "=(n - 1)/2"},
                             at: ["=1 - t/2", 0.15, 1]}]}}""",
)
"""The keystone of an arch of mean radius 1, pressed down by the weight of one square metre of its elevation."""

PUSHED = deck(ARCH, "n: 21, t: 0.3", joint="friction: 5", supports="")

APART = PUSHED.replace("parameters: {n: 21, t: 0.3}", "parameters: {n: 21, t: 0.3, apart: 10, turn: 0}").replace(
    "springers: ground}",
    """springers: ground}
  - arch: {group: other, material: stone, shape: semicircular, span: "=2 - t", thickness: "=t", width: 0.3,
           voussoirs: "=n", springers: ground, transform: [{rotate: {axis: [0, 0, 1], angle: "=turn"}},
           {translate: ["=apart", 0, 0]}]}""",
)
"""Two of the same arch; turned by half a turn the other is pushed the other way about, which is all one to it."""

CROWNS = {(21, 0.3): 13.02883201174, (99, 0.3): 2.8791706705987}
PUSHES = {(21, 0.3): 0.52062466103388, (2000, 0.3): 0.518069053659506}
"""Load factors by voussoirs and thickness."""


def _arches() -> list[Scene]:
    family, scenes = "symmetric arches", []
    for rule in FLOW_RULES:
        asked = ruled(rule)
        for (n, t), factor in CROWNS.items():
            size = (f"parameters.n={n}", f"parameters.t={t}", asked)
            for reductions in ("true", "false"):
                name = f"{n} voussoirs pressed at the crown, reductions {reductions}, {rule}"
                overrides = (*size, f"analysis.reductions={reductions}")
                scenes.append(Scene(name, family, CROWN, overrides, factor, long=n > 21))
        for (n, t), factor in PUSHES.items():
            size = (f"parameters.n={n}", f"parameters.t={t}", asked)
            scenes.append(Scene(f"{n} voussoirs, pushed, {rule}", family, PUSHED, size, factor, long=n > 21))
    return scenes


def _apart() -> list[Scene]:
    family = "two alike apart"
    return [
        Scene(
            f"arches {apart:g} m apart, the other turned by {turn} degrees, {rule}",
            family,
            APART,
            (f"parameters.apart={apart!r}", f"parameters.turn={turn}", ruled(rule)),
            PUSHES[21, 0.3],
            long=apart > 1e3 or (turn > 0 and rule != "associative"),
        )
        for rule in FLOW_RULES
        for apart in (10.0, 1e6)
        for turn in (0, 180)
    ]


SCENES = (*_symmetric(), *_arches(), *_apart())
