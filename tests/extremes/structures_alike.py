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
    associative, other = under_both_rules("radial dome pushed", family, DOME, DOME_FACTOR)
    scenes += [associative, replace(other, expected=None, diagnosis=("solved",))]
    return scenes


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


SCENES = (*_symmetric(), *_arches())
