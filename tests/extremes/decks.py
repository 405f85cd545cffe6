"""Deck texts that several families of scenes share, their load factors, and scenes under both flow rules."""

from __future__ import annotations

from tests.extremes.outcome import Scene

HEAD = """\
mbla: 1
parameters: {s: 1, rho: 2000, mu: 0.65, d: 0}
materials: {stone: {density: "=rho"}}
joints: {dry: {friction: "=mu"}}
contacts: {joint: dry}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
supports: [{ground: {z: "=d"}, joint: dry}]
"""

PLACED = 'transform: {translate: ["=d", "=0.7*d", "=d"]}'

BLOCK = (
    HEAD
    + f'blocks: [{{box: {{group: block, material: stone, min: [0, 0, 0], max: ["=0.5*s", "=s", "=s"], {PLACED}}}}}]\n'
)
"""Rocks at b/h = 0.5."""

WALL = (
    HEAD
    + f"""\
blocks:
  - wall: {{group: wall, material: stone, unit: ["=0.4*s", "=0.2*s", "=0.175*s"], length: "=2*s", courses: 8,
           {PLACED}}}
"""
)

ARCH = (
    HEAD
    + f"""\
blocks:
  - arch: {{group: arch, material: stone, shape: semicircular, span: "=10*s", thickness: "=1.5*s", width: "=s",
           voussoirs: 20, {PLACED}}}
"""
)

PUSH = "{push: {live: [{acceleration: [1, 0, 0]}]}}"
GROUND = "[{ground: {z: 0}}]"


def deck(
    blocks: str,
    parameters: str = "",
    joint: str = 'friction: "=mu"',
    supports: str = GROUND,
    load_cases: str = PUSH,
    contacts: str = "",
) -> str:
    """A deck of blocks of one stone with one joint law; without ``supports`` the blocks bring their own."""
    lines = [
        "mbla: 1",
        "materials: {stone: {density: 2000}}",
        f"contacts: {{joint: dry{contacts}}}",
        f"parameters: {{{parameters}}}",
        f"joints: {{dry: {{{joint}}}}}",
        f"blocks:\n{blocks.rstrip()}",
        *([f"supports: {supports}"] if supports else []),
        f"load_cases: {load_cases}",
    ]
    return "\n".join(lines) + "\n"


FLOW_RULES = ("associative", "non_associative")

FACTORS = {
    ("block", "associative"): (BLOCK, 0.5, 1e-7),
    ("block", "non_associative"): (BLOCK, 0.5, 1e-6),
    ("wall", "associative"): (WALL, 0.6222993027, 1e-7),
    ("wall", "non_associative"): (WALL, 0.61489, 3e-4),
    ("arch", "associative"): (ARCH, 0.3854019171, 1e-7),
    ("arch", "non_associative"): (ARCH, 0.3854019171, 1e-6),
}
"""Deck, load factor and tolerance by structure and flow rule. The block is a closed form; the others are what the
program itself gives at the size of a metre at the origin: the scenes hold the rest to it. The path of the wall takes
other steps with other rounding."""

SMOOTHED = 5e-6
"""What a smoothed path leaves of load factors without dilatancy that are next to nothing."""


def smoothed(tolerance: float, expected: float | None, rule: str) -> float:
    """A relative tolerance, as wide as what is smoothed where the load factor is next to nothing."""
    return max(tolerance, SMOOTHED / (expected or 1.0)) if rule != "associative" else tolerance


def ruled(rule: str) -> str:
    """The override that sets a flow rule."""
    return f"analysis.flow_rule={rule}"


def worded(rule: str) -> str:
    """A flow rule as names of scenes have it."""
    return rule.replace("_", "-")


def under_both_rules(
    name: str,
    family: str,
    deck: str,
    expected: float | None,
    tolerance: float = 1e-6,
    diagnosis: tuple[str, ...] = (),
    overrides: tuple[str, ...] = (),
    *,
    long: bool = False,
) -> list[Scene]:
    """With associative flow and without dilatancy."""
    return [
        Scene(
            f"{name}, {rule}",
            family,
            deck,
            (*overrides, ruled(rule)),
            expected,
            smoothed(tolerance, expected, rule),
            diagnosis,
            long,
        )
        for rule in FLOW_RULES
    ]
