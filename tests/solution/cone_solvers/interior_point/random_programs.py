"""Random assemblies from a seed, and what two solvers make of them.

::

    python -m tests.solution.cone_solvers.interior_point.random_programs FIRST LAST

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
from collections.abc import Sequence
from dataclasses import dataclass

from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.proof.bounds import ProvedBounds, factor_size, proved_bounds
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.thresholds import ZERO_FACTOR
from tests.line import line_of
from tests.solution.cone_solvers.interior_point.random_assemblies import (
    FRICTION,
    KINDS,
    number,
)
from tests.solution.structures import (
    Point,
)
from tests.solution.structures import numbers as listed

DECIDED = (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED)

TOLERANCE = 1e-9
"""Of the solvers; that of standard accuracy."""


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
    bounds: ProvedBounds | None

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
    return Outcome(result, None if result.state is None else proved_bounds(program, result.state))


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
"""Share of a load factor that the residual of repaired forces (repair.EQUILIBRIUM_TOLERANCE) leaves open."""


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
