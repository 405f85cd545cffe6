"""Listings of decks of every kind: nothing raises, nothing is wider than a page, no number or table without content."""

import re
from pathlib import Path

import pytest

from mbla import run
from mbla.results.listing.figures import PURPOSES
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import WIDTH

DECKS = Path("decks")
KINDS = {
    "tutorials/wall": ("Part 1, the upper right corner", "The whole structure (52 blocks) turns about -x"),
    "benchmarks/closed_forms/spreading_arch": (
        "on the extrados between parts 1 and 2",
        "is a lower limit",
    ),
    "benchmarks/closed_forms/tilting_block": ("It slides over ground z = 0 along +x", "degrees of tilt"),
    "benchmarks/closed_forms/overhang_too_far": (
        "No equilibrium",
        "over base[0], on a hinge from (0, 0, 0.2)",
        "Nothing slides.",
    ),
    "benchmarks/closed_forms/incline_too_steep": (
        "moves along (-0.894, 0, 0.447), without turning.",
        "It slides over",
        "need not be the way in which it falls",
    ),
    "benchmarks/closed_forms/groove_locked": ("No collapse", "Locked: these forces"),
    "tutorials/travelling_load": ("any multiple", "on the extrados"),
    "benchmarks/closed_forms/leaves": ("Part 1, thin[0]",),
    "benchmarks/closed_forms/guided_blocks": ("was not determined, as blocks are guided",),
    "benchmarks/closed_forms/glued_lintel": ("turns about",),
    "benchmarks/closed_forms/torque_convex": ("twists",),
    "benchmarks/published/ferris_wall_1": (
        "Collapses between 0.638982 g (least found) and ",
        "0.641541 g, verified",
    ),
    "benchmarks/closed_forms/plank_in_clamp": ("the peak of its load path",),
}
"""quick decks, one of each kind, and what must be read in their listings"""


@pytest.mark.parametrize("deck", KINDS)
def test_a_listing_of_every_kind(deck: str) -> None:
    results = run(DECKS / f"{deck}.yaml").records
    assert {program.kind for case in results.cases for program in case.solution.programs} <= set(PURPOSES)
    for text in (listing(results), "\n".join(summary_lines(results))):
        lines = text.splitlines()
        assert max(map(len, lines)) <= WIDTH
        assert not re.search(r"\b(nan|inf|None|array)\b", text)
        assert not re.search(r"\(\)|, ,|  ,| \.$|[a-z]\.\.$", text, re.MULTILINE)
        heads = [i for i, line in enumerate(lines) if re.match(r"  (part  |hinge lines|sliding planes|cracks  )", line)]
        assert all(i + 1 < len(lines) and lines[i + 1].strip() for i in heads)  # no table without rows
    words = " ".join(listing(results).split())
    for each in KINDS[deck]:
        assert each in words
