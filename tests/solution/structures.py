"""Structures of units as deck texts: walls, rooms, vaults, domes, flat arches and wedges under an acceleration."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from itertools import pairwise

LENGTH, THICKNESS, HEIGHT = 0.4, 0.2, 0.175
"""of a unit, m"""

Point = tuple[float, float, float]


def deck(
    blocks: Sequence[str],
    live: Sequence[float],
    joint: str = "friction: 0.65",
    contacts: str = "{joint: dry}",
    joints: Sequence[str] = (),
    supports: str = "{ground: {z: 0}}",
) -> str:
    """A deck of blocks under an acceleration."""
    return "\n".join(
        [
            "mbla: 1",
            "materials: {stone: {density: 2000}}",
            "joints:",
            f"  dry: {{{joint}}}",
            *(f"  {line}" for line in joints),
            "blocks:",
            *(f"  - {block}" for block in blocks),
            f"contacts: {contacts}",
            f"supports: [{supports}]",
            f"load_cases: {{push: {{live: [{{acceleration: {numbers(live)}}}]}}}}",
            "",
        ]
    )


def numbers(values: Sequence[float]) -> str:
    """A list of numbers in YAML, rounded to what a builder could measure."""
    return "[" + ", ".join(f"{round(value, 6) + 0.0!r}" for value in values) + "]"


def box(group: str, low: Point, high: Point) -> str:
    """A box between two corners."""
    return f"box: {{group: {group}, material: stone, min: {numbers(low)}, max: {numbers(high)}}}"


def prism(group: str, lower: Sequence[Point], upper: Sequence[Point]) -> str:
    """A polyhedron between two faces of as many corners each, numbered alike."""
    n = len(lower)
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    vertices = ", ".join(numbers(vertex) for vertex in (*lower, *upper))
    faces = [list(range(n))[::-1], list(range(n, 2 * n)), *sides]
    return f"polyhedron: {{group: {group}, material: stone, vertices: [{vertices}], faces: {faces}}}"


def units(start: float, end: float, first: float) -> list[tuple[float, float]]:
    """Units from start to end, the first as long as given, no remainder shorter than a tenth."""
    cuts = [start, start + first]
    while cuts[-1] + LENGTH < end - 1e-9:
        cuts.append(cuts[-1] + LENGTH)
    if end - cuts[-1] > 1e-9:
        cuts.append(end)
    return list(pairwise(cuts))


def running_bond(length: int, courses: int) -> list[str]:
    """A wall in the x-z plane, every block a group ``b<course>_<number>``."""
    return [
        box(f"b{c}_{i}", (a, 0.0, c * HEIGHT), (b, THICKNESS, (c + 1) * HEIGHT))
        for c in range(courses)
        for i, (a, b) in enumerate(units(0.0, length * LENGTH, LENGTH if c % 2 == 0 else LENGTH / 2))
    ]


def random_friction(seed: int, length: int, courses: int, live: Sequence[float]) -> str:
    """A wall whose courses and head joints have each their own friction, 0.3 to 0.9."""
    rng = random.Random(seed)
    blocks = running_bond(length, courses)
    names = [block.split("group: ")[1].split(",")[0] for block in blocks]
    joints, overrides = [], []
    for i, first in enumerate(names):
        for second in names[i + 1 :]:
            if abs(course(first) - course(second)) <= 1:
                name = f"j_{first}_{second}"
                joints.append(f"{name}: {{friction: {round(rng.uniform(0.3, 0.9), 3)}}}")
                overrides.append(f"{{between: [{first}, {second}], joint: {name}}}")
    return deck(blocks, live, contacts=f"{{joint: dry, overrides: [{', '.join(overrides)}]}}", joints=joints)


def course(name: str) -> int:
    """Course of a block of ``running_bond``."""
    return int(name[1:].split("_")[0])


def room(plan: str, nx: int, ny: int, courses: int, live: Sequence[float], joint: str = "friction: 0.65") -> str:
    """Walls over the sides of a rectangle that ``plan`` names (s, w, e, n), interlocking at the corners."""
    lx, ly, t = nx * LENGTH + THICKNESS, ny * LENGTH + THICKNESS, THICKNESS
    blocks = []
    for c in range(courses):
        through = c % 2 == 0  # walls along x go through the corners in even courses, those along y in odd ones
        z = (c * HEIGHT, (c + 1) * HEIGHT)
        for side in plan:
            if side in "sn":
                low = 0.0 if through or "w" not in plan else t
                high = lx if through or "e" not in plan else lx - t
                y = (0.0, t) if side == "s" else (ly - t, ly)
                blocks += [box(side, (a, y[0], z[0]), (b, y[1], z[1])) for a, b in units(low, high, start(through))]
            else:
                low = 0.0 if not through or "s" not in plan else t
                high = ly if not through or "n" not in plan else ly - t
                x = (0.0, t) if side == "w" else (lx - t, lx)
                blocks += [box(side, (x[0], a, z[0]), (x[1], b, z[1])) for a, b in units(low, high, start(not through))]
    return deck(blocks, live, joint)


def start(through: bool) -> float:
    """Length of the first unit, so that head joints lie over the middle of units."""
    return LENGTH if through else LENGTH / 2 + THICKNESS / 2


def barrel(rows: int, voussoirs: int, thickness: float, live: Sequence[float], joint: str = "friction: 0.65") -> str:
    """Half a circle of radius 1 inside, rows of voussoirs 0.3 wide staggered by half a voussoir."""
    blocks = []
    for row in range(rows):
        cuts = [i * math.pi / voussoirs for i in range(voussoirs + 1)]
        if row % 2:
            cuts = [0.0, *(angle + math.pi / voussoirs / 2 for angle in cuts[:-1]), math.pi]
        for a, b in pairwise(cuts):
            ring = [
                (math.cos(f) * r, math.sin(f) * r)
                for f, r in ((a, 1.0), (a, 1 + thickness), (b, 1 + thickness), (b, 1.0))
            ]
            near = [(x, 0.3 * row, z) for x, z in ring]
            far = [(x, 0.3 * (row + 1), z) for x, z in ring]
            blocks.append(prism("vault", far, near))
    return deck(blocks, live, joint)


def dome(rings: int, sectors: int, live: Sequence[float], joint: str = "friction: 0.65") -> str:
    """Part of a dome with an eye: faces plane, radius 1 inside and 0.2 thick."""
    blocks = []
    tilt = [math.radians(65.0 * i / rings) for i in range(rings + 1)]
    for ring in range(rings):
        for sector in range(sectors):
            turn = 2 * math.pi / sectors
            first = turn * (sector + 0.5 * (ring % 2))

            def corner(angle: float, elevation: float, radius: float) -> Point:
                along = radius * math.cos(elevation)
                return (along * math.cos(angle), along * math.sin(angle), radius * math.sin(elevation))

            inside = [corner(a, e, 1.0) for a, e in sector_corners(first, turn, tilt[ring], tilt[ring + 1])]
            outside = [corner(a, e, 1.2) for a, e in sector_corners(first, turn, tilt[ring], tilt[ring + 1])]
            blocks.append(prism("dome", inside, outside))
    return deck(blocks, live, joint)


def sector_corners(first: float, turn: float, low: float, high: float) -> list[tuple[float, float]]:
    """Angles and elevations of the corners of a block of a dome."""
    return [(first, low), (first + turn, low), (first + turn, high), (first, high)]


def flat_arch(voussoirs: int, live: Sequence[float], friction: float, lean: float = 0.35) -> str:
    """Voussoirs between two fixed skewbacks, all joints leaning towards the middle, ``lean`` at the ends."""
    half = voussoirs / 2
    blocks = []
    for i in range(-1, voussoirs + 1):
        below, above = (
            [(i + k - half) * 0.2 for k in (0, 1)],
            [(i + k - half) * (0.2 + 0.4 * lean / half) for k in (0, 1)],
        )
        if i in (-1, voussoirs):  # the skewbacks
            end = -0.2 if i < 0 else 0.2
            outer, inner = (0, 1) if i < 0 else (1, 0)
            below[outer], above[outer] = below[inner] + 2 * end, below[inner] + 2 * end
            if abs(above[outer]) <= abs(above[inner]):
                below[outer] = above[outer] = above[inner] + end
        section = [(below[0], 0.0), (below[1], 0.0), (above[1], 0.4), (above[0], 0.4)]
        group = "skewback" if i in (-1, voussoirs) else "voussoir"
        blocks.append(prism(group, [(x, 0.3, z) for x, z in section], [(x, 0.0, z) for x, z in section]))
    return deck(blocks, live, f"friction: {friction}", supports="{blocks: skewback}")


def wedge(seed: int, friction: float) -> str:
    """A prism in a groove of two planes of random inclinations, pushed in a random direction along it."""
    rng = random.Random(seed)
    left, right = (math.radians(rng.uniform(15, 40)) for _ in range(2))
    turn = math.radians(rng.uniform(-35, 35))
    h, k = math.tan(left), math.tan(right)
    corners = [(0.0, 0.0), (1.0, k), (-1.0, h)]
    body = prism("wedge", [(0.0, y, z) for y, z in corners], [(3.0, y, z) for y, z in corners])
    planes = (
        f"{{ground: {{point: [0, 0, 0], normal: {numbers((0, math.sin(left), math.cos(left)))}}}}}, "
        f"{{ground: {{point: [0, 0, 0], normal: {numbers((0, -math.sin(right), math.cos(right)))}}}}}"
    )
    return deck([body], (math.cos(turn), math.sin(turn), 0), f"friction: {friction}", supports=planes)


def wall(length: int, courses: int, live: Sequence[float], joint: str) -> str:
    """A wall in running bond of one joint law."""
    return deck(running_bond(length, courses), live, joint)


def push(degrees: float, upwards: float = 0.0) -> Point:
    """Direction in plan, with a share upwards."""
    return (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), upwards)
