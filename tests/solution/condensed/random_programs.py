"""Random assemblies from a seed, and what two solvers make of them.

::

    python -m tests.solution.condensed.random_programs FIRST LAST

Walls, arches, stacks, heaps of boxes, towers apart, rooms, vaults, domes, wedges in grooves and flat arches, planar and
in space; dry, cohesive, tensile and crushing joints with a friction from none to a million; accelerations and forces at
points, some tiny or huge; gravity that is tilted, upside down or a ten millionth; blocks a hundred million times as
heavy as others. Many do not stand, others have no mechanism. Every random number comes from the seed.
"""

from __future__ import annotations

import math
import random
import re
import statistics
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mbla.deck.analysis import ReductionSwitches
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.solution.associative import AssociativeResult, solve_associative
from mbla.solution.bounds import ZERO_FACTOR, CertifiedGap, certified_gap, factor_size
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import line_of
from tests.solution.nonassociative_cases import (
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
from tests.solution.nonassociative_cases import numbers as listed

FRICTION = (0.0, 1e-6, 0.05, 0.2, 0.4, 0.5, 0.6, 0.65, 0.7, 0.84, 1.0, 2.0, 10.0, 1e3, 1e6)
"""Coefficients that the joints of a deck are given."""

DECIDED = (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED)

TOLERANCE = 1e-9
"""Of the solvers; that of standard accuracy."""


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


def _joint(rng: random.Random) -> str:
    """A joint law; three of five are dry."""
    mu = rng.choice(FRICTION) if rng.random() < 0.5 else rng.uniform(0.1, 1.0)
    law = f"friction: {number(mu)}"
    if rng.random() < 0.35:
        cohesion = 10 ** rng.uniform(0, 5)
        law += f", cohesion: {number(cohesion)}"
        if rng.random() < 0.6:  # no more than where the cone ends
            tension = min(rng.choice([0.3, 0.999]) * cohesion / max(mu, 1e-9), 1e6)
            law += f", tensile_strength: {number(tension)}"
    if rng.random() < 0.2:
        law += f", compressive_strength: {number(10 ** rng.uniform(4, 7))}"
    return law


def _direction(rng: random.Random, planar: bool) -> Point:
    angle, up = rng.uniform(0, 2 * math.pi), rng.uniform(-1, 1) if rng.random() < 0.4 else 0.0
    if planar:
        return (rng.choice([-1.0, 1.0]), 0.0, round(up, 3))
    return (round(math.cos(angle), 6), round(math.sin(angle), 6), round(up, 3))


def _gravity(rng: random.Random, planar: bool) -> Point:
    chance = rng.random()
    tilt = 0.0 if chance < 0.6 else rng.uniform(0.0, 0.3) if chance < 0.85 else rng.uniform(0.3, 3.0)
    turn = 0.0 if planar else rng.uniform(0, 2 * math.pi)
    size = 9.81 if rng.random() < 0.95 else 1e-6
    x, y = math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn)
    return (round(size * x, 12), round(size * y, 12), round(-size * math.cos(tilt), 12))


def _loads(rng: random.Random, planar: bool) -> list[str]:
    size = 1.0 if rng.random() < 0.9 else 10.0 ** rng.choice([-8, -4, 4, 8])
    if rng.random() < 0.7:
        return [f"acceleration: {_vector(size, _direction(rng, planar))}"]
    at = "" if rng.random() < 0.5 else f", at: {listed([rng.uniform(0.0, 1.5), 0.1, rng.uniform(0.0, 1.0)])}"
    force = f"force: {_vector(1e3 * size, _direction(rng, planar))}, on: {{group: g, index: 0}}{at}"
    return [force] if rng.random() < 0.7 else [force, f"acceleration: {_vector(1.0, _direction(rng, planar))}"]


def _vector(size: float, direction: Sequence[float]) -> str:
    return "[" + ", ".join(number(size * part) for part in direction) + "]"


def _renamed(rng: random.Random, block: str, with_heavy: bool) -> str:
    """Most blocks in group g, some in h, some of the heavy stone; skewbacks stay."""
    if "group: skewback" in block:
        return block
    group = "g" if rng.random() < 0.8 else "h"
    if with_heavy and rng.random() < 0.3:
        block = block.replace("material: stone", "material: heavy")
    return re.sub(r"group: \w+", f"group: {group}", block)


@dataclass(frozen=True)
class RandomCase:
    """A deck, and how its program is formed: by the whole model, or its largest part after all reductions."""

    seed: int
    kind: str
    text: str
    reduced: bool

    @property
    def program(self) -> Program:
        """The program that is solved."""
        line = line_of(self.text)
        if not self.reduced:
            return line.program
        parts = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True).parts
        return max(parts, key=lambda part: part.n_points if part.live_load.any() else -1)


def random_case(seed: int) -> RandomCase:
    """The case of a seed."""
    rng = random.Random(seed)
    assembly = rng.choice(KINDS)(rng)
    planar = rng.random() < 0.4
    heavy = 10.0 ** rng.choice([2, 4, 8]) if rng.random() < 0.15 else 1.0
    blocks = [_renamed(rng, block, heavy > 1.0) for block in assembly.blocks]
    rng.shuffle(blocks)
    first = next((i for i, block in enumerate(blocks) if "group: skewback" not in block), 0)
    blocks[first] = blocks[first].replace("group: h", "group: g")
    mixed = any("group: h" in block for block in blocks) and rng.random() < 0.7
    overrides = ", overrides: [{between: [g, h], joint: other}]" if mixed else ""
    live = _loads(rng, planar)
    text = "\n".join(
        [
            "mbla: 1",
            f"materials: {{stone: {{density: 2000}}, heavy: {{density: {number(2000 * heavy)}}}}}",
            "joints:",
            f"  dry: {{{_joint(rng)}}}",
            *([f"  other: {{{_joint(rng)}}}"] if mixed else []),
            "blocks:",
            *(f"  - {block}" for block in blocks),
            f"contacts: {{joint: dry{overrides}}}",
            assembly.supports,
            f"load_cases: {{push: {{dead: [{{gravity: {_vector(1.0, _gravity(rng, planar))}}}],",
            f"  live: [{', '.join('{' + load + '}' for load in live)}]}}}}",
            "",
        ]
    )
    return RandomCase(seed, assembly.kind, text, rng.random() < 0.5)


@dataclass(frozen=True)
class Outcome:
    """What a solver made of a program; bounds are NaN where there is no load factor."""

    result: AssociativeResult
    bounds: CertifiedGap | None

    @property
    def is_decided(self) -> bool:
        """Whether it says what is, and proves it."""
        return self.result.status in DECIDED

    @property
    def gap(self) -> float:
        """Distance of the bounds, relative; NaN without load factor."""
        return math.nan if self.bounds is None else self.bounds.gap


def outcome_of(program: Program, solver: str) -> Outcome:
    """The associative load factor by a solver, and the bounds that its state proves."""
    result = solve_associative(program, SolverSettings(TOLERANCE, solver=solver), lambda record: None)
    return Outcome(result, None if result.state is None else certified_gap(program, result.state))


def contradiction(program: Program, first: Outcome, second: Outcome) -> str:
    """In words, how two outcomes contradict each other; empty where they do not.

    Each load factor lies between its bounds, so that two may differ by the sum of the distances of the bounds.
    """
    one, other = first.bounds, second.bounds
    if one is not None and other is not None:
        if not (first.gap >= 0.0 and second.gap >= 0.0):  # a bound is missing, which the status says
            return ""
        room = abs(one.kinematic - one.static) + abs(other.kinematic - other.static)
        size = max(abs(one.load_factor), abs(other.load_factor), ZERO_FACTOR * factor_size(program))
        apart = abs(one.load_factor - other.load_factor)
        return (
            ""
            if apart <= room + ROUNDING * size
            else f"load factors {apart / size:.1e} apart, bounds {room / size:.1e}"
        )
    if not (first.is_decided and second.is_decided) or first.result.status is second.result.status:
        return ""
    return f"{first.result.status} and {second.result.status}"


ROUNDING = 1e-9
"""Share of a load factor that the residual of repaired forces (force_repair.EQUILIBRIUM_TOLERANCE) leaves open."""


@dataclass
class Count:
    """What comes of many programs."""

    outcomes: dict[str, Counter[str]]
    gaps: dict[str, list[float]]
    contradictions: list[str]
    undecided: dict[str, list[int]]

    def words(self) -> str:
        """A line for each solver, and one for each contradiction."""
        lines = []
        for solver, outcomes in self.outcomes.items():
            known = [gap for gap in self.gaps[solver] if gap == gap]
            counts = ", ".join(f"{status} {count}" for status, count in sorted(outcomes.items()))
            gaps = f"gap median {statistics.median(known):.1e}, worst {max(known):.1e}" if known else "no gaps"
            lines.append(f"{solver:9s} {counts}; {gaps}; not decided: {self.undecided[solver]}")
        return "\n".join([*lines, *self.contradictions])


def compared(seeds: Sequence[int], solvers: Sequence[str] = ("mbla", "clarabel")) -> Count:
    """Solve the programs of these seeds with each solver."""
    count = Count({s: Counter() for s in solvers}, {s: [] for s in solvers}, [], {s: [] for s in solvers})
    for seed in seeds:
        case = random_case(seed)
        program = case.program
        outcomes = {solver: outcome_of(program, solver) for solver in solvers}
        for solver, outcome in outcomes.items():
            count.outcomes[solver][str(outcome.result.status)] += 1
            count.gaps[solver].append(outcome.gap)
            if not outcome.is_decided:
                count.undecided[solver].append(seed)
        words = contradiction(program, *(outcomes[solver] for solver in solvers[:2]))
        if words:
            count.contradictions.append(f"seed {seed} ({case.kind}): {words}")
    return count


def main(first: int, last: int) -> None:
    """Count what comes of the programs of these seeds."""
    sys.stdout.write(compared(range(first, last)).words() + "\n")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
