"""Friction from none to unlimited, and dilatancy from none to that of associative flow."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import ARCH, BLOCK, FLOW_RULES, WALL, ruled, worded
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
            yield Scene(f"block, {name}", "friction", BLOCK, overrides, min(value, 0.5), diagnosis=said)
            if value <= 0.1:
                long = mu not in ("0", "1.0e-9")
                yield Scene(f"wall, {name}", "friction", WALL, overrides, value, diagnosis=said, long=long)
                yield Scene(f"arch, {name}", "friction", ARCH, overrides, None, diagnosis=("no_equilibrium",))
            else:
                yield Scene(f"arch, {name}", "friction", ARCH, overrides, HINGES, long=mu not in ("10", "1.0e15"))


DILATANT = WALL.replace('friction: "=mu"', 'friction_angle: 33, dilatancy: "=psi"').replace(
    "parameters: {", "parameters: {psi: 0, "
)
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


SCENES = (*frictions(), *dilatancies())
