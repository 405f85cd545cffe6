"""Structures whose standing statics decides, as decks: prisms along y on grounds and fixed blocks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mbla.solution.solution import Standing
from tests.line import HEAD

Outline = Sequence[tuple[float, float]]
YES, SELF_STRESS, NO, DOUBTFUL = Standing.YES, Standing.SELF_STRESS, Standing.NO, Standing.DOUBTFUL


@dataclass(frozen=True)
class Structure:
    """A deck, what it must be found to be, and the blocks that may be named as falling."""

    name: str
    text: str
    verdict: Standing
    blocks: tuple[int, ...] = ()


def prism(outline: Outline, width: float = 1.0, group: str = "block") -> str:
    """An item of ``blocks``: an outline in the x-z plane, extruded along y."""
    n = len(outline)
    corners = [f"[{x!r}, {y!r}, {z!r}]" for y in (0.0, width) for x, z in outline]
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    faces = [list(range(n)), list(range(n, 2 * n)), *sides]
    return (
        f"  - polyhedron: {{group: {group}, material: stone, vertices: [{', '.join(corners)}], "
        f"faces: {str(faces).replace(' ', '')}}}\n"
    )


def box(x0: float, x1: float, z0: float, z1: float, width: float = 1.0, group: str = "block") -> str:
    """A prism with a rectangle as outline."""
    return prism([(x0, z0), (x1, z0), (x1, z1), (x0, z1)], width, group)


def plane(x: float, z: float, nx: float, nz: float) -> str:
    """A rigid ground through (x, z)."""
    return f"  - {{ground: {{point: [{x!r}, 0, {z!r}], normal: [{nx!r}, 0, {nz!r}]}}}}\n"


LEVEL = plane(0, 0, 0, 1)
FIXED = "  - {blocks: fixed}\n"
WALLS = plane(0, 0, 1, 0) + plane(1, 0, -1, 0)


def deck(blocks: str, supports: str = LEVEL, joint: str = "friction: 0.5", dead: str = "") -> str:
    """A deck of those blocks; the live load is of no matter for standing."""
    dead = f"dead: {dead}, " if dead else ""
    return (
        f"{HEAD}joints: {{dry: {{{joint}}}}}\nblocks:\n{blocks}supports:\n{supports}"
        f"load_cases: {{push: {{{dead}live: [{{acceleration: [1, 0, 0]}}]}}}}\n"
    )


def incline(angle: float, friction: float) -> str:
    """A thin block on an inclined plane."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    outline = [(x * c - z * s, x * s + z * c) for x, z in ((0, 0), (1, 0), (1, 0.2), (0, 0.2))]
    return deck(prism(outline), plane(0, 0, -s, c), f"friction: {friction}")


def groove(friction: float) -> str:
    """A wedge resting in a V of two planes at 45 degrees."""
    r = math.sqrt(0.5)
    return deck(prism([(0, 0), (1, 1), (-1, 1)]), plane(0, 0, -r, r) + plane(0, 0, r, r), f"friction: {friction}")


def plug(angle: float, friction: float) -> str:
    """A trapezium between two planes that converge upwards by an angle from the vertical on either side."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    t = s / c
    outline = [(-0.5 - t, 0), (0.5 + t, 0), (0.5, 1), (-0.5, 1)]
    return deck(prism(outline), plane(-0.5, 1, c, -s) + plane(0.5, 1, -c, -s), f"friction: {friction}")


def leaning(friction: float) -> str:
    """A plank with its foot on rough ground and its head on a smooth wall; it needs μ ≥ (xc − a)/(h + c) = 0.1462."""
    outline = [(0, 0), (0.3, 0), (1.2, 1.8), (1.2, 2.0)]
    wall = "  - {ground: {point: [1.2, 0, 0], normal: [-1, 0, 0]}, joint: smooth}\n"
    return deck(prism(outline), LEVEL + wall).replace(
        "joints: {dry: {friction: 0.5}}", f"joints: {{dry: {{friction: {friction}}}, smooth: {{friction: 0}}}}"
    )


def rafters(friction: float) -> str:
    """Two planks leaning against each other; each is half the weight on its foot, thrust over weight is about 0.5."""
    left = [(-1.1, 0), (-0.9, 0), (0, 0.9), (0, 1.1)]
    return deck(prism(left) + prism([(-x, z) for x, z in left]), joint=f"friction: {friction}")


def overhang(reach: float) -> str:
    """Five blocks, each shifted over the one below by ``reach`` of the harmonic limit, on a fixed one."""
    ends = [reach * sum(1 / (2 * k) for k in range(5 - i, 6)) for i in range(5)]
    pile = "".join(box(end - 1, end, 0.2 * (i + 1), 0.2 * (i + 2), 0.5) for i, end in enumerate(ends))
    return deck(box(-1, 0, 0, 0.2, 0.5, "fixed") + pile, FIXED)


def wall_with_opening(lintel: tuple[float, float]) -> str:
    """Two jambs of four courses, and a lintel over the uppermost 0.3 of the opening from x = 1 to 2."""
    courses = [(0, 0.4), (0.4, 0.8), (0.8, 1.1), (1.1, 1.4)]
    blocks = ""
    for z0, z1 in courses:
        left, right = lintel if z0 == 1.1 else (1.0, 2.0)
        blocks += box(0, left, z0, z1, 0.3) + box(right, 3, z0, z1, 0.3)
    return deck(blocks + box(*lintel, 1.1, 1.4, 0.3), joint="friction: 0.8")


def corbel(back: float) -> str:
    """Two blocks reaching out over a fixed one, the lower held down at its back by a load over the weight of the upper.

    Moments about the edge: 1.4·0.4 of the upper block against 1.6·0.2 of the lower, so that a load of 0.171 is enough.
    """
    blocks = box(0, 1, 0, 1, group="fixed") + box(0, 1.6, 1, 1.2, group="low") + box(0.7, 2.1, 1.2, 1.4, group="tip")
    weight = 1.4 * 0.2 * 2000 * 9.81
    force = f"{{force: [0, 0, {-back * weight!r}], on: low, at: [0, 0.5, 1.2]}}"
    return deck(blocks, FIXED, dead=f"[{{gravity: [0, 0, -9.81]}}, {force}]")


def drums(count: int, tilt: float) -> str:
    """A column of eight-sided drums on a floor inclined about y."""
    ring = [(math.cos(math.pi * (2 * i + 1) / 8), math.sin(math.pi * (2 * i + 1) / 8)) for i in range(8)]
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    text = ""
    for k in range(count):
        corners = [(x * c - z * s, y, x * s + z * c) for z in (k, k + 1) for x, y in ring]
        faces = [list(range(8)), list(range(8, 16)), *([i, (i + 1) % 8, 8 + (i + 1) % 8, 8 + i] for i in range(8))]
        vertices = ", ".join(f"[{x!r}, {y!r}, {z!r}]" for x, y, z in corners)
        text += f"  - polyhedron: {{group: drum, material: stone, vertices: [{vertices}], faces: {faces}}}\n"
    return deck(text, plane(0, 0, -s, c), "friction: 0.7")


def arch(thickness: float, friction: float = 0.6) -> str:
    """A semicircular arch of 27 voussoirs, mean radius 1; without sliding it needs a thickness of 0.1067."""
    item = (
        f"  - arch: {{material: stone, shape: semicircular, span: {2 - thickness!r}, thickness: {thickness!r}, "
        "width: 0.2, voussoirs: 27, springers: ground}\n"
    )
    return deck(item, joint=f"friction: {friction}").replace("supports:\n" + LEVEL, "")


def bar(joint: str, dead: str = "", below: str = "") -> str:
    """A bar that exactly fits between two vertical walls; its ends carry 0.2·2000·9.81/0.4 = 9810 Pa of shear."""
    return deck(box(0, 1, 1, 1.4), WALLS + below, joint, dead)


def pressed(force: float) -> str:
    """A block pressed against one vertical wall by a force over its weight; friction 0.5 asks for 2."""
    weight = 0.5 * 0.4 * 2000 * 9.81
    dead = f"[{{gravity: [0, 0, -9.81]}}, {{force: [{-force * weight!r}, 0, 0], on: block, at: [0.5, 0.5, 1.2]}}]"
    return deck(box(0, 0.5, 1, 1.4), plane(0, 0, 1, 0), dead=dead)


def hanging(strength: float) -> str:
    """A block hung under a fixed one by the tensile strength of the joint, which its weight uses to 2000·9.81 Pa."""
    blocks = box(0, 1, 1, 2, group="fixed") + box(0, 1, 0, 1)
    return deck(blocks, FIXED, f"friction: 0.5, cohesion: 20000, tensile_strength: {strength}")


def crushing(strength: float) -> str:
    """A block of 1 m height standing on ground with a compressive strength; it presses with 2000·9.81 Pa."""
    return deck(box(0, 1, 0, 1), joint=f"friction: 0.5, compressive_strength: {strength}")


def trilithon(seat: float) -> str:
    """Two posts and a lintel that rests on each with a share of the post's width, reaching out over neither."""
    return deck(box(0, 0.5, 0, 2) + box(2, 2.5, 0, 2) + box(0.5 - seat, 2 + seat, 2, 2.4))


def bridge_of_bars(count: int) -> str:
    """Bars in a row between two walls, all joints vertical."""
    return deck("".join(box(i / count, (i + 1) / count, 1, 1.6) for i in range(count)), WALLS)


def mixed_weights() -> str:
    """A bar between two fixed blocks that weighs two millionths of the block that stands beside them."""
    fixed = box(-1, 0, 0, 2, group="fixed") + box(1, 2, 0, 2, group="fixed")
    return deck(fixed + box(0, 1, 1, 1.4, width=0.01) + box(3, 8, 0, 5, width=80), LEVEL + FIXED)


def without_weight(resting: bool) -> str:
    """Two stacked blocks of which only the lower has a dead load; the upper one rests on it or hangs between walls."""
    dead = "[{gravity: none}, {force: [0, 0, -1000], on: low, at: [0.5, 0.5, 0.5]}]"
    upper = box(0, 1, 0.5, 1, group="high") if resting else box(0, 1, 2, 2.5, group="high")
    return deck(box(0, 1, 0, 0.5, group="low") + upper, LEVEL + ("" if resting else WALLS), dead=dead)


STRUCTURES = [
    Structure("block on the ground", deck(box(0, 1, 0, 1)), YES),
    Structure("block on smooth ground", deck(box(0, 1, 0, 1), joint="friction: 0"), YES),
    Structure("stack of five", deck("".join(box(0, 1, i, i + 1) for i in range(5))), YES),
    Structure("bar between walls", bar("friction: 0.5"), SELF_STRESS, (0,)),
    Structure("bar between walls, nearly smooth", bar("friction: 0.01"), SELF_STRESS, (0,)),
    Structure("bar between smooth walls", bar("friction: 0"), NO, (0,)),
    Structure("bar between walls, glued", bar("friction: 0.5, cohesion: 9900"), YES),
    Structure("bar between walls, glued too weakly", bar("friction: 0.5, cohesion: 9700"), SELF_STRESS, (0,)),
    Structure("bar between walls on the ground", bar("friction: 0.5", below=plane(0, 1, 0, 1)), YES),
    Structure("three bars between walls", bridge_of_bars(3), SELF_STRESS, (0, 1, 2)),
    Structure("light bar beside a heavy block", mixed_weights(), SELF_STRESS, (2,)),
    Structure("wedge in a smooth groove", groove(0.0), YES),
    Structure("wedge in a groove", groove(0.5), YES),
    Structure("plug that narrows upwards, held by friction", plug(10, 0.5), SELF_STRESS, (0,)),
    Structure("plug that narrows upwards too much", plug(30, 0.5), NO, (0,)),
    Structure(
        "plug that narrows downwards",
        deck(
            prism([(-0.5, 0), (0.5, 0), (0.6, 1), (-0.6, 1)]),
            plane(-0.5, 0, 0.995037190209989, 0.0995037190209989)
            + plane(0.5, 0, -0.995037190209989, 0.0995037190209989),
            "friction: 0",
        ),
        YES,
    ),
    Structure("incline below the angle of friction", incline(26, 0.5), YES),
    Structure("incline above the angle of friction", incline(27, 0.5), NO, (0,)),
    Structure("leaning plank", leaning(0.15), YES),
    Structure("leaning plank, foot too smooth", leaning(0.14), NO, (0,)),
    Structure("rafters", rafters(0.6), YES),
    Structure("rafters on a floor too smooth", rafters(0.3), NO, (0, 1)),
    Structure("harmonic overhang", overhang(0.999), YES),
    Structure("harmonic overhang too far", overhang(1.001), NO, (2, 3, 4, 5)),
    Structure("lintel on its jambs", wall_with_opening((0.8, 2.2)), YES),
    Structure("lintel squeezed between its jambs", wall_with_opening((1.0, 2.0)), SELF_STRESS, (8,)),
    Structure("corbel", corbel(0.18), YES),
    Structure("corbel with too little on its back", corbel(0.16), NO, (1, 2)),
    Structure("trilithon", trilithon(0.2), YES),
    Structure("trilithon on the edges of its posts", trilithon(0.01), YES),
    Structure("column of drums", drums(4, 5), YES),
    Structure("column of drums on too steep a floor", drums(4, 26), NO, (0, 1, 2, 3)),
    Structure("arch", arch(0.15), YES),
    Structure("thin arch near its limit", arch(0.108), YES),
    Structure("thin arch beyond its limit", arch(0.105), NO, tuple(range(27))),
    Structure("arch with joints too smooth", arch(0.15, 0.25), NO, tuple(range(27))),
    Structure("block pressed against a wall", pressed(2.1), YES),
    Structure("block pressed against a wall too weakly", pressed(1.9), NO, (0,)),
    Structure("block hung by tensile strength", hanging(20_000), YES),
    Structure("block hung by too little tensile strength", hanging(19_000), NO, (1,)),
    Structure("block on ground that bears it", crushing(20_000), YES),
    Structure("block on ground that crushes", crushing(19_000), NO, (0,)),
    Structure("block in the air", deck(box(0, 1, 0, 1) + box(0, 1, 3, 4)), NO, (1,)),
    Structure("block without weight on another", without_weight(resting=True), YES),
    Structure("block without weight between walls", without_weight(resting=False), YES),
    Structure("no dead load", bar("friction: 0.5", dead="[{gravity: none}]"), YES),
]
