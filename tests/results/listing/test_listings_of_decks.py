"""Listings of decks of every kind: nothing raises, nothing is wider than a page, no number or table without content."""

import re
from pathlib import Path

import pytest

from mbla import run
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import WIDTH

DECKS = Path("decks")
KINDS = {
    "tutorials/wall": ("Part 1 (12 blocks of wall", "Everything that is free (52 blocks) turns about -x"),
    "benchmarks/closed_forms/spreading_arch": (
        "2/1 (2, 1, 2.6) 1 -y extrados",
        "is an upper limit to all",
    ),
    "benchmarks/closed_forms/tilting_block": ("moves along +x", "degrees of tilt"),
    "benchmarks/closed_forms/overhang_too_far": ("No equilibrium",),
    "benchmarks/closed_forms/incline_too_steep": (
        "moves along (-0.89, 0, 0.45).",
        "need not be the way in which it falls",
    ),
    "benchmarks/closed_forms/groove_locked": ("No collapse", "Locked: these forces"),
    "tutorials/travelling_load": ("any multiple", "extrados"),
    "benchmarks/closed_forms/leaves": ("(thin[0]",),
    "benchmarks/closed_forms/guided_blocks": ("was not determined, as blocks are guided",),
    "benchmarks/closed_forms/glued_lintel": ("turns about",),
    "benchmarks/closed_forms/torque_convex": ("twists",),
    "benchmarks/published/ferris_wall_1": (
        "Starts to move at",
        "Least found: 0.638982 g, a state of rigid joints, verified",
    ),
    "benchmarks/closed_forms/plank_in_clamp": (
        "; while it moves, ",
        "only another history than this loading leads to it",
    ),
}
"""quick decks, one of each kind, and what must be read in their listings"""


@pytest.mark.every(3)
@pytest.mark.parametrize("deck", KINDS)
def test_a_listing_of_every_kind(deck: str) -> None:
    results = run(DECKS / f"{deck}.yaml").records
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
