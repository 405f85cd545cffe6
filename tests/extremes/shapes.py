"""Slender and flat blocks, small interfaces beside large ones, gaps and overlaps."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import FLOW_RULES, ruled, worded
from tests.extremes.outcome import Scene

HEAD = """\
mbla: 1
parameters: {b: 1, a: 1, g: 0, mu: 0.6}
materials: {stone: {density: 2000}}
joints: {dry: {friction: "=mu"}}
contacts: {joint: dry}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
supports: [{ground: {z: 0}}]
blocks:
"""
SLENDER = HEAD + '  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 1, 1]}\n'
STACKED = (
    HEAD
    + """\
  - box: {group: blocks, material: stone, min: [0, 0, 0], max: ["=b", 1, 0.5]}
  - box: {group: blocks, material: stone, min: [0, 0, 0.5], max: ["=b", 1, 1]}
"""
)
ON_FOOT = (
    HEAD
    + """\
  - box: {group: foot, material: stone, min: ["=-a/2", "=-a/2", 0], max: ["=a/2", "=a/2", 0.1]}
  - box: {group: block, material: stone, min: [-0.5, -0.5, 0.1], max: [0.5, 0.5, 1.1]}
"""
)
"""A cube of 1 m on a foot of a x a x 0.1 m: over before anything slides."""
ON_THIN_FOOT = ON_FOOT.replace("b: 1,", "b: 1, t: 0.1,").replace("0.1", '"=t"').replace("1.1", '"=1 + t"')
"""The foot 0.3 m wide and t high: over about its edge, unless the cube is taken to rest on the ground beside it."""
LAYERS = (
    HEAD.replace("g: 0,", "t: 1.0e-4,")
    + """\
  - box: {group: layer, material: stone, min: [0, 0, 0], max: [0.3, 1, "=t"],
          repeat: {count: 4, translate: [0, 0, "=0.5 + t"]}}
  - box: {group: course, material: stone, min: [0, 0, "=t"], max: [0.3, 1, "=0.5 + t"],
          repeat: {count: 4, translate: [0, 0, "=0.5 + t"]}}
"""
)
"""Four blocks with a layer below each, all of one density: b/h of the whole."""
PEBBLE = (
    HEAD.replace("[1, 0, 0]}", "[1, 0, 0], on: pebble}")
    + """\
  - box: {group: slab, material: stone, min: [-1, -1, 0], max: [1, 1, 0.5]}
  - box: {group: pebble, material: stone, min: [0, 0, 0.5], max: ["=0.4*a", "=a", "=0.5+a"]}
"""
)
"""A pebble on a slab of 2 x 2 m, rocking at 0.4."""
GAP = (
    HEAD
    + """\
  - box: {group: blocks, material: stone, min: [0, 0, 0], max: [0.5, 1, 1]}
  - box: {group: blocks, material: stone, min: [0, 0, "=1+g"], max: [0.5, 1, "=2+g"]}
"""
)
"""Two blocks, one on the other with a gap: b/(2 h) = 0.25 for the two together."""
FAR_APART = "magnitudes-far-apart"
SIZE = 0.5 ** (1 / 3)
"""Of these blocks, to which contacts.tolerance is relative."""


def slender() -> Iterator[Scene]:
    """min(mu, b/h), with friction that slides and friction that does not."""
    for rule in FLOW_RULES:
        for k in range(-4, 5):
            for deck, what in ((SLENDER, "block"), (STACKED, "two blocks")):
                for mu in ("0.6", "1.0e5"):
                    yield Scene(
                        f"{what}, {worded(rule)}, width 1e{k} of the height, friction {mu}",
                        "slenderness",
                        deck,
                        (f"parameters.b=1.0e{k}", f"parameters.mu={mu}", ruled(rule)),
                        min(float(mu), 10.0**k),
                        long=what == "two blocks" and -4 < k < 4,
                    )


def small() -> Iterator[Scene]:
    """Interfaces of 1e-2 to 1e-12 of the largest area."""
    for rule in FLOW_RULES:
        for k in range(-6, 0):
            a = 10.0**k
            overrides = (f"parameters.a=1.0e{k}", ruled(rule))
            name = f"{worded(rule)}, interface 1e{2 * k} of the largest"
            lever = (0.1 * a**2 * 0.05 + 0.6) / (1 + 0.1 * a**2)
            said = (FAR_APART,) if k <= -4 or (k == -3 and rule != "associative") else ()
            said = (*said, "standing-doubtful") if k <= -2 and rule != "associative" else said
            foot = a / 2 / lever
            yield Scene(f"cube on a foot, {name}", "small interfaces", ON_FOOT, overrides, foot, diagnosis=said)
            yield Scene(f"pebble on a slab, {name}", "small interfaces", PEBBLE, overrides, 0.4, diagnosis=said)


def thin() -> Iterator[Scene]:
    """Feet and layers down to 1e-6 and less of the blocks that rest on them, far below the tolerance of contacts."""
    for rule in FLOW_RULES:
        for k in (-1, -2, -3, -4, -6, -9):
            t = 10.0**k
            overrides = (f"parameters.t=1.0e{k}", ruled(rule))
            foot = 0.3**2 * t
            lever = (foot * t / 2 + 0.5 + t) / (1 + foot)
            said = (FAR_APART,) if k < -6 else ("approximate",) if k == -6 else ()
            name = f"{worded(rule)}, 1e{k} thick"
            yield Scene(
                f"cube on a foot, {name}",
                "thin blocks",
                ON_THIN_FOOT,
                (*overrides, "parameters.a=0.3"),
                0.15 / lever,
                diagnosis=said,
            )
            total = 4 * (0.5 + t)
            yield Scene(f"layers in a stack, {name}", "thin blocks", LAYERS, overrides, 0.3 / total, diagnosis=said)


def flat() -> Iterator[Scene]:
    """As thick as the rounding of coordinates: refused, with the place."""
    for rule in FLOW_RULES:
        for deck, what in ((ON_THIN_FOOT, "cube on a foot"), (LAYERS, "layers in a stack")):
            overrides = ("parameters.t=1.0e-12", "parameters.a=0.3", ruled(rule))
            name = f"{what}, {worded(rule)}, 1e-12 thick"
            yield Scene(name, "thin blocks", deck, overrides, None, diagnosis=("lie at the same place",))


def gaps() -> Iterator[Scene]:
    """Up to the tolerance a gap is rounding, and moves the answer by no more than itself; beyond it is named."""
    for rule in FLOW_RULES:
        for k in range(-12, -1):
            for sign, what in ((1, "gap"), (-1, "overlap")):
                share = 10.0**k
                diagnosis = (
                    () if share < 1e-3 else ("near-misses", "isolated-blocks", "overlap by", "pairs of blocks overlap")
                )
                yield Scene(
                    f"two blocks, {worded(rule)}, {what} 1e{k} of their size",
                    "gaps and overlaps",
                    GAP,
                    (f"parameters.g={sign * share * SIZE!r}", ruled(rule)),
                    0.25 if share <= 1e-3 else None,
                    1e-6 + 2 * share,
                    diagnosis,
                )


SCENES = (*slender(), *small(), *thin(), *flat(), *gaps())
