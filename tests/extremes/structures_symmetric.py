"""Arches under a load at the crown, an arch of 2,000 voussoirs, two alike that stand apart.

Their load factors are those of a second formulation, the linear program of ``tests.analytic.planar``; ``test_expected``
works them out again. With much friction they fall by hinges, with any flow rule.
"""

from __future__ import annotations

from tests.extremes.decks import FLOW_RULES, ruled
from tests.extremes.outcome import Scene

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 5}}
contacts: {joint: dry}
"""

CROWN = (
    HEAD
    + """\
parameters: {n: 21, t: 0.3}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: "=2 - t", thickness: "=t", width: 0.3,
           voussoirs: "=n", springers: ground}
load_cases: {crown: {live: [{force: [0, 0, "=-2000*9.81*0.3"], on: {group: arch, index: "=(n - 1)/2"},
                             at: ["=1 - t/2", 0.15, 1]}]}}
"""
)
"""The keystone of an arch of mean radius 1, pressed down by the weight of one square metre of its elevation."""

PUSHED = CROWN[: CROWN.index("load_cases")] + "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"

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


SCENES = (*_arches(), *_apart())
