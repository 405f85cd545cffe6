"""Random assemblies of blocks, of many kinds; every random number comes from the generator given."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tests.solution.structures import (
    HEIGHT,
    LENGTH,
    THICKNESS,
    Point,
    barrel,
    box,
    dome,
    flat_arch,
    room,
    units,
    wedge,
)

FRICTION = (0.0, 1e-6, 0.05, 0.2, 0.4, 0.5, 0.6, 0.65, 0.7, 0.84, 1.0, 2.0, 10.0, 1e3, 1e6)
"""Coefficients that the joints of a deck are given."""


def number(value: float) -> str:
    """A float in YAML, which wants a point in front of an exponent."""
    return f"{value:.12e}"


def spatial_blocks(text: str) -> list[str]:
    """The blocks of another case's deck."""
    lines = text.split("\n")
    return [line[4:] for line in lines if line.startswith(("  - box", "  - poly"))]


def supports_of(text: str) -> str:
    """The supports of another case's deck."""
    return next(line for line in text.split("\n") if line.startswith("supports"))


@dataclass(frozen=True)
class Assembly:
    """Blocks as lines of a deck, each with the group ``g``, and what holds them."""

    kind: str
    blocks: list[str]
    supports: str = "supports: [{ground: {z: 0}}]"


def _wall(rng: random.Random) -> Assembly:
    length, courses = rng.randint(1, 4), rng.randint(1, 5)
    shift = rng.uniform(0.15, 0.4)
    blocks = []
    for c in range(courses):
        for a, b in units(0.0, length * LENGTH, LENGTH if c % 2 == 0 else shift):
            blocks.append(box("g", (a, 0.0, c * HEIGHT), (b, THICKNESS, (c + 1) * HEIGHT)))
    if rng.random() < 0.3 and len(blocks) > 3:
        missing = rng.randrange(len(blocks))
        if missing > 0 or length > 1:  # something has to stand on the ground
            blocks.pop(missing)
    return Assembly("wall", blocks)


def _arch(rng: random.Random) -> Assembly:
    thickness = rng.choice([0.1, 0.105, 0.11, 0.15, 0.25])
    voussoirs = rng.randint(3, 25)
    fields = f"shape: semicircular, span: 2.0, thickness: {thickness}, width: 0.5, voussoirs: {voussoirs}"
    return Assembly("arch", [f"arch: {{group: g, material: stone, {fields}, springers: ground}}"])


def _stack(rng: random.Random) -> Assembly:
    blocks, x, y, z = [], 0.0, 0.0, 0.0
    for _ in range(rng.randint(1, 8)):
        height, slip = rng.uniform(0.1, 0.8), rng.uniform(0.0, 0.4)
        blocks.append(box("g", (x, y, z), (x + 1.0, y + rng.uniform(0.5, 1.0), z + height)))
        x, y, z = x + rng.uniform(-slip, slip), y + rng.uniform(-slip, slip), blocks_top(blocks)
    return Assembly("stack", blocks)


def blocks_top(blocks: Sequence[str]) -> float:
    """Height of the last box, as it was written."""
    return float(blocks[-1].split("max: [")[1].split("]")[0].split(",")[2])


def _heap(rng: random.Random) -> Assembly:
    """Boxes let down one after the other on the highest one below them, on a grid so that sides touch too."""
    placed: list[tuple[Point, Point]] = []
    for _ in range(rng.randint(2, 14)):
        x, y = 0.5 * rng.randint(0, 4), 0.5 * rng.randint(0, 3)
        dx, dy, dz = 0.5 * rng.randint(1, 3), 0.5 * rng.randint(1, 3), 0.25 * rng.randint(1, 4)
        below = [high[2] for low, high in placed if low[0] < x + dx and high[0] > x and low[1] < y + dy and high[1] > y]
        z = max(below, default=0.0)
        placed.append(((x, y, z), (x + dx, y + dy, z + dz)))
    return Assembly("heap", [box("g", low, high) for low, high in placed])


def _towers(rng: random.Random) -> Assembly:
    """Stacks apart from each other: as many independent mechanisms, some of them alike."""
    blocks, alike = [], rng.random() < 0.5
    width = rng.uniform(0.3, 1.0)
    for tower in range(rng.randint(2, 5)):
        width = width if alike else rng.uniform(0.3, 1.0)
        for level in range(rng.randint(1, 3)):
            blocks.append(box("g", (3.0 * tower, 0.0, float(level)), (3.0 * tower + round(width, 3), 0.5, level + 1.0)))
    return Assembly("towers", blocks)


def _other(kind: str, text: str) -> Assembly:
    return Assembly(kind, spatial_blocks(text), supports_of(text))


def _room(rng: random.Random) -> Assembly:
    return _other("room", room(rng.choice(["sw", "swe"]), 2, rng.randint(1, 2), rng.randint(1, 4), (1, 0, 0)))


def _vault(rng: random.Random) -> Assembly:
    return _other("vault", barrel(rng.randint(1, 2), rng.randint(3, 9), rng.uniform(0.12, 0.3), (1, 0, 0)))


def _dome(rng: random.Random) -> Assembly:
    return _other("dome", dome(rng.randint(1, 3), rng.randint(4, 8), (1, 0, 0)))


def _wedge(rng: random.Random) -> Assembly:
    return _other("wedge", wedge(rng.randrange(1000), 0.5))


def _flat_arch(rng: random.Random) -> Assembly:
    return _other("flat arch", flat_arch(rng.randint(1, 7), (1, 0, 0), 0.5, rng.uniform(0.05, 0.5)))


KINDS: tuple[Callable[[random.Random], Assembly], ...] = (
    _wall,
    _wall,
    _arch,
    _stack,
    _heap,
    _heap,
    _towers,
    _room,
    _vault,
    _dome,
    _wedge,
    _flat_arch,
)
