"""Joints: friction from none to unlimited, dilatancy up to that of associative flow, strengths beside self-weight."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import ARCH, BLOCK, FLOW_RULES, WALL, ruled, smoothed, worded
from tests.extremes.outcome import Scene

FRICTIONS = ("0", "1.0e-12", "1.0e-9", "1.0e-6", "1.0e-3", "0.01", "0.1", "10", "1.0e3", "1.0e6", "1.0e9", "1.0e15")
HINGES = 0.4354047711
"""Of the arch whose joints do not slide."""


def frictions() -> Iterator[Scene]:
    """Block: min(mu, b/h). Wall: slides on the ground at mu where that is small. Arch: falls, or has its hinges."""
    for rule in FLOW_RULES:
        for mu in FRICTIONS:
            value, overrides = float(mu), (f"parameters.mu={mu}", ruled(rule))
            name = f"{worded(rule)}, friction {mu}"
            said = ("load-factor-rounding",) if value <= 1e-6 else ()
            if mu == "1.0e-9":  # next to which what the programs leave is more than all that friction carries
                said = (*said, "not_verified")
            near = smoothed(1e-6, 0.05, rule)
            yield Scene(f"block, {name}", "friction", BLOCK, overrides, min(value, 0.5), near, diagnosis=said)
            if value <= 0.1:
                long = mu not in ("0", "1.0e-9")
                yield Scene(f"wall, {name}", "friction", WALL, overrides, value, diagnosis=said, long=long)
                yield Scene(f"arch, {name}", "friction", ARCH, overrides, None, diagnosis=("no_equilibrium",))
            else:
                yield Scene(f"arch, {name}", "friction", ARCH, overrides, HINGES, long=mu not in ("10", "1.0e15"))


DILATANT_BLOCK = BLOCK.replace('friction: "=mu"', 'friction_angle: 20, dilatancy: "=psi"').replace(
    "parameters: {", "parameters: {psi: 0, "
)


def dilatancies() -> Iterator[Scene]:
    """A block slides at mu whatever its dilatancy."""
    for psi in ("0", "1.0e-9", "1.0e-3", "1", "10", "19.999999", "20"):
        yield Scene(
            f"block, dilatancy {psi} of 20 degrees",
            "dilatancy",
            DILATANT_BLOCK,
            (f"parameters.psi={psi}", ruled("dilatancy")),
            0.3639702342662024,
        )


STRONG = """\
mbla: 1
parameters: {b: 0.5, c: 0, ft: 0, mu: 0.4}
materials: {stone: {unit_weight: 20000}}
joints: {dry: {friction: "=mu", cohesion: "=20000*c", tensile_strength: "=20000*ft"}}
contacts: {joint: dry}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
supports: [{ground: {z: 0}}]
blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 1, 1]}}]
"""
"""Stress of self-weight 20 kPa; strengths are multiples of it."""

SAID = ("magnitudes-far-apart",)

CRUSHING = STRONG.replace('tensile_strength: "=20000*ft"', 'compressive_strength: "=20000*fc"').replace(
    "ft: 0", "fc: 1"
)


def cohesive() -> Iterator[Scene]:
    """Sliding at mu + c/sigma, or rocking at b/h, which cohesion alone does not change."""
    for rule in FLOW_RULES:
        for k in range(-9, 10):
            for b in ("0.5", "1.0e4"):
                yield Scene(
                    f"block {b} wide and 1 high, {worded(rule)}, cohesion 1e{k} of the weight stress",
                    "strength of joints",
                    STRONG,
                    (f"parameters.c=1.0e{k}", f"parameters.b={b}", ruled(rule)),
                    min(0.4 + 10.0**k, float(b)),
                    diagnosis=SAID if k >= 8 else (),
                )


def tensile() -> Iterator[Scene]:
    """Rocking at (b/h) (1 + ft/sigma): points at the edge stand for half of the area each."""
    for rule in FLOW_RULES:
        for k in range(-9, 10):
            yield Scene(
                f"block, {worded(rule)}, tensile strength 1e{k} of the weight stress",
                "strength of joints",
                STRONG,
                (f"parameters.ft=1.0e{k}", f"parameters.c={20.0 + 20 * 10.0**k}", "parameters.mu=2", ruled(rule)),
                0.5 * (1 + 10.0**k),
                diagnosis=SAID if k >= 8 else (),
            )


def crushing() -> Iterator[Scene]:
    """Over a stress block of the width b sigma/fc: b/h (1 - sigma/fc) where fc is beyond the weight stress.

    A path is solved to some 2e-7 of the weight: what stands at its limit has no load factor, or an approximate one.
    """
    for rule in FLOW_RULES:
        limit, path = ((), 0.0) if rule == "associative" else (("approximate", "not_verified"), 4e-7)
        for k in range(-6, 7):
            value = 10.0**k
            yield Scene(
                f"block, {worded(rule)}, compressive strength 1e{k} of the weight stress",
                "strength of joints",
                CRUSHING,
                (f"parameters.fc=1.0e{k}", "parameters.mu=2", ruled(rule)),
                None if value < 1 else 0.5 * (1 - 1 / value),
                diagnosis=("no_equilibrium",) if value < 1 else limit if k == 0 else (),
            )
        for k in (-9, -6, -3):
            yield Scene(
                f"block, {worded(rule)}, compressive strength 1 + 1e{k} of the weight stress",
                "strength of joints",
                CRUSHING,
                (f"parameters.fc={1 + 10.0**k!r}", "parameters.mu=2", ruled(rule)),
                0.5 * 10.0**k / (1 + 10.0**k),
                1e-3 if k == -9 else 1e-5 + path / 10.0**k,
                diagnosis=("load-factor-rounding", *limit) if k < -6 else limit if k < -3 else (),
            )


SCENES = (*frictions(), *dilatancies(), *cohesive(), *tensile(), *crushing())
