"""Lengths and densities: a block, a wall and an arch are the same structure at every size and weight."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.outcome import Scene

HEAD = """\
mbla: 1
parameters: {s: 1, rho: 2000, mu: 0.65}
materials: {stone: {density: "=rho"}}
joints: {dry: {friction: "=mu"}}
contacts: {joint: dry}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
supports: [{ground: {z: 0}, joint: dry}]
"""

BLOCK = HEAD + 'blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: ["=0.5*s", "=s", "=s"]}}]\n'
"""Rocks at b/h = 0.5."""

WALL = (
    HEAD
    + """\
blocks:
  - wall: {group: wall, material: stone, unit: ["=0.4*s", "=0.2*s", "=0.175*s"], length: "=2*s", courses: 8}
"""
)

ARCH = (
    HEAD
    + """\
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: "=10*s", thickness: "=1.5*s", width: "=s",
           voussoirs: 20}
"""
)

FACTORS = {
    ("block", "associative"): (BLOCK, 0.5, 1e-7),
    ("block", "non_associative"): (BLOCK, 0.5, 1e-6),
    ("wall", "associative"): (WALL, 0.6222993027, 1e-7),
    ("wall", "non_associative"): (WALL, 0.6158882193, 1e-4),
    ("arch", "associative"): (ARCH, 0.3854019171, 1e-7),
    ("arch", "non_associative"): (ARCH, 0.3854019171, 1e-6),
}
"""Deck, load factor and tolerance by structure and flow rule. The block is a closed form; the others are what the
program itself gives at the size of a metre: the scenes hold the rest to it. Forces of the wall without dilatancy are
not unique, and its factor follows rounding."""

DECADES = range(-6, 7)


def scenes() -> Iterator[Scene]:
    """Decades of length, of density, and both together, in like and in opposite direction."""
    families = {
        "lengths": [(f"lengths 1e{k} m", f"1.0e{k}", "2000") for k in DECADES],
        "densities": [(f"density 1e{k}", "1", f"1.0e{k}") for k in range(-9, 10)],
        "lengths and densities": [
            (f"lengths 1e{k} m, density 1e{sign * round(1.5 * k)}", f"1.0e{k}", f"1.0e{sign * round(1.5 * k)}")
            for k in (-6, -4, -2, 2, 4, 6)
            for sign in (1, -1)
        ],
    }
    for family, values in families.items():
        for (structure, rule), (deck, expected, tolerance) in FACTORS.items():
            for name, length, density in values:
                yield Scene(
                    f"{structure}, {rule.replace('_', '-')}, {name}",
                    family,
                    deck,
                    (f"parameters.s={length}", f"parameters.rho={density}", f"analysis.flow_rule={rule}"),
                    expected,
                    tolerance,
                    long=structure != "block" and name not in (values[0][0], values[-1][0]),
                )


SCENES = tuple(scenes())
