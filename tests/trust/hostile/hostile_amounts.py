"""Decks of a few lines that ask for more than anybody can mean: 10^12 blocks, points, positions."""

from __future__ import annotations

from tests.line import BLOCK, HEAD
from tests.trust.hostile.case import deck

SPACE = "joints: {dry: {friction: 0.6}}\nsupports: [{ground: {z: 0}}]\n"
LOADS = "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"

ITEMS = {
    "a wall of 10^12 units": "wall: {unit: [0.001, 0.1, 0.001], length: 1000, courses: 1000000}",
    "walls of 10^12 units": (
        "walls: {unit: [0.4, 0.2, 0.1], courses: 1000000, plan: [[0, 0], [400000, 0], [400000, 400000]]}"
    ),
    "10^10 boxes": (
        "box: {min: [0, 0, 0], max: [1, 1, 1], "
        "repeat: [{count: 100000, translate: [2, 0, 0]}, {count: 100000, translate: [0, 2, 0]}]}"
    ),
    "10^500 boxes": (
        "box: {min: [0, 0, 0], max: [1, 1, 1], repeat: ["
        + ", ".join(["{count: 100000, translate: [2, 0, 0]}"] * 100)
        + "]}"
    ),
    "a repeat of 10^12": "box: {min: [0, 0, 0], max: [1, 1, 1], repeat: {count: 1000000000000, translate: [2, 0, 0]}}",
    "100,000 boxes in one place": (
        "box: {min: [0, 0, 0], max: [1, 1, 1], repeat: {count: 100000, translate: [0, 0, 1.e-9]}}"
    ),
    "an arch of 10^12 voussoirs": (
        "arch: {shape: semicircular, span: 4, thickness: 0.3, width: 1, voussoirs: 1000000000000}"
    ),
    "a bridge of 10^12 voussoirs": (
        "bridge: {spans: [5], shape: semicircular, thickness: 0.4, width: 3, voussoirs: 1000000, rings: 1000000, "
        "abutments: {width: 2}, spandrels: none}"
    ),
    "a column of 10^12 drums": "column: {radius: 0.5, height: 1.e+12, drums: 1000000000000}",
    "a dome of 10^11 facets": "dome: {span: 10, thickness: 0.5, courses: 10000, segments: 10000, facets: 1000}",
    "a barrel vault of 10^10 blocks": (
        "barrel_vault: {span: 4, length: 1.e+6, thickness: 0.3, courses: 100000, unit: 0.001}"
    ),
    "a stair of 10^12 treads": "spiral_stair: {treads: 1000000000000, radius: 1, rise: 0.2, angle: 15}",
    "a wall as long as numbers go": "wall: {unit: [0.4, 0.2, 0.1], length: 1.e+308, courses: 1}",
    "a box as large as numbers go": "box: {min: [-1.e+308, -1.e+308, 0], max: [1.e+308, 1.e+308, 1.e+308]}",
}

GRID = ", ".join(
    f"{{wall: {{material: stone, group: w{n}, unit: [0.4, 0.2, 0.1], length: 360, courses: 1000, "
    f"transform: {{translate: [0, {n}, 0]}}}}}}"
    for n in range(60)
)
"""each of them is allowed, 50 million units together are not"""


def of_item(item: str) -> str:
    """A deck of one item, given without its material."""
    kind, _, rest = item.partition("{")
    return HEAD + SPACE + LOADS + f"blocks: [{{{kind}{{material: stone, {rest}}}]\n"


CASES = [
    *(deck(name, of_item(item)) for name, item in ITEMS.items()),
    deck("60 walls of a million units each", HEAD + SPACE + LOADS + f"blocks: [{GRID}]\n"),
    deck(
        "contact points without end",
        BLOCK.replace("contacts: {joint: dry}", "contacts: {joint: dry, points: {spacing: 1.e-12}}"),
    ),
    deck(
        "10^12 positions of a load",
        BLOCK.replace(
            "[{acceleration: [1, 0, 0]}]",
            "[{force: [1, 0, 0], travel: {from: [0, 0, 2], to: [1, 0, 2], positions: 1000000000000}}]",
        ),
    ),
    deck(
        "a list of 100,000 selectors of nothing",
        BLOCK.replace("[{acceleration: [1, 0, 0]}]", "[{force: [1, 0, 0], on: [" + "nothing, " * 100_000 + "]}]"),
    ),
    deck(
        "a parameter that makes 10^12 blocks",
        BLOCK.replace("parameters: {", "parameters: {n: 1.e+12, ").replace(
            'max: ["=b", 1, "=h"]', 'max: ["=b", 1, "=h"], repeat: {count: "=n", translate: [9, 0, 0]}'
        ),
    ),
]
"""All of them."""
