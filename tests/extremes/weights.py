"""Weights of neighbours 1e2 to 1e8 apart: towers of three blocks, a lintel on two piers, a wall under a slab."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import FLOW_RULES, ruled, worded
from tests.extremes.outcome import Scene

WIDTH, HEIGHT, FRICTION = 0.6, 0.5, 5.0

SAID = ("magnitudes-far-apart",)
DOUBTFUL = ("approximate", "standing-doubtful")
"""What is said from 1e4 on, where the step of the heavy ones leaves of the light ones more than may be left."""

TOWER = f"""\
mbla: 1
parameters: {{a: 1, b: 1, c: 1}}
materials: {{one: {{density: "=a"}}, two: {{density: "=b"}}, three: {{density: "=c"}}}}
joints: {{dry: {{friction: {FRICTION}}}}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
blocks:
  - box: {{group: one, material: one, min: [0, 0, 0], max: [{WIDTH}, 1, {HEIGHT}]}}
  - box: {{group: two, material: two, min: [0, 0, {HEIGHT}], max: [{WIDTH}, 1, {2 * HEIGHT}]}}
  - box: {{group: three, material: three, min: [0, 0, {2 * HEIGHT}], max: [{WIDTH}, 1, {3 * HEIGHT}]}}
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
"""

PORTAL = """\
mbla: 1
parameters: {pier: 1, lintel: 1}
materials: {pier: {density: "=pier"}, lintel: {density: "=lintel"}}
joints: {dry: {friction: 5}}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
blocks:
  - box: {group: piers, material: pier, min: [0, 0, 0], max: [0.3, 1, 1]}
  - box: {group: piers, material: pier, min: [2, 0, 0], max: [2.3, 1, 1]}
  - box: {group: lintel, material: lintel, min: [0, 0, 1], max: [2.3, 1, 1.4]}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
"""Piers rock about their toes and carry the lintel on their heels: b/h = 0.3 whatever the weights."""

SIDE_BY_SIDE = """\
mbla: 1
parameters: {heavy: 1, light: 1}
materials: {heavy: {density: "=heavy"}, light: {density: "=light"}}
joints: {dry: {friction: 0.4}}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
blocks:
  - box: {group: heavy, material: heavy, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: light, material: light, min: [1, 0, 0], max: [2, 1, 1]}
  - box: {group: heavy, material: heavy, min: [2, 0, 0], max: [3, 1, 1]}
load_cases: {push: {live: [{acceleration: [1, 0, 0], on: heavy}]}}
"""
"""The block on the left is pushed through the one in the middle; or it slides alone: never beyond
mu (1 + light / heavy / 2), and never below mu."""


def tower_factor(weights: tuple[float, float, float]) -> float:
    """Overturning about the bed below each block; no bed slides at this friction."""
    factors = []
    for first in range(3):
        above = weights[first:]
        moment = sum(weight * HEIGHT * (i + 0.5) for i, weight in enumerate(above))
        factors.append(sum(above) * WIDTH / 2 / moment)
    return min(factors)


def scenes() -> Iterator[Scene]:
    """Each order of heavy and light, and each ratio."""
    orders = {
        "heavy on light": (0, 0, 1),
        "light on heavy": (1, 0, 0),
        "light between heavy": (1, 0, 1),
        "heavy between light": (0, 1, 0),
        "each heavier than the one below": (0, 1, 2),
        "each lighter than the one below": (2, 1, 0),
    }
    for rule in FLOW_RULES:
        for k in (2, 4, 6, 8, 12):
            said = SAID if k > 8 or (k == 8 and rule != "associative") else ()
            said = (*said, *DOUBTFUL) if k >= 4 else said
            for name, powers in orders.items():
                weights = (10.0 ** (k * powers[0]), 10.0 ** (k * powers[1]), 10.0 ** (k * powers[2]))
                values = [f"parameters.{key}={weight:.1e}" for key, weight in zip("abc", weights, strict=True)]
                yield Scene(
                    f"tower, {worded(rule)}, {name}, 1e{k} apart",
                    "weights of neighbours",
                    TOWER,
                    (*values, ruled(rule)),
                    tower_factor(weights),
                    diagnosis=(*SAID, *said) if k >= 6 and 2 in powers else said,
                )
            for name, pier, lintel in (("heavy lintel", 1.0, 10.0**k), ("heavy piers", 10.0**k, 1.0)):
                values = [f"parameters.pier={pier:.1e}", f"parameters.lintel={lintel:.1e}"]
                yield Scene(
                    f"lintel on piers, {worded(rule)}, {name}, 1e{k} apart",
                    "weights of neighbours",
                    PORTAL,
                    (*values, ruled(rule)),
                    0.3,
                    diagnosis=said,
                )
            for name, heavy, light in (("light in the middle", 10.0**k, 1.0), ("heavy in the middle", 1.0, 10.0**k)):
                values = [f"parameters.heavy={heavy:.1e}", f"parameters.light={light:.1e}"]
                yield Scene(
                    f"blocks side by side, {worded(rule)}, {name}, 1e{k} apart",
                    "weights of neighbours",
                    SIDE_BY_SIDE,
                    (*values, ruled(rule)),
                    0.4,
                    diagnosis=said,
                )


SCENES = tuple(scenes())
