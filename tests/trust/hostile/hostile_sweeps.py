"""Sweep files that ask for more points than there are atoms, or for another file than their deck."""

from __future__ import annotations

from tests.line import WALL
from tests.trust.hostile.case import NOT_READ, Case, sweep, write_all
from tests.trust.hostile.hostile_texts import LAUGHS
from tests.trust.hostile.samples import SWEEP

MEGABYTE = 1024 * 1024
MANY = "\n".join(f"  p{n}: {{key: blocks.0.wall.courses, linear: {{from: 1, to: 2, points: 1000}}}}" for n in range(5))


def changed(old: str, new: str) -> str:
    """The sample with something else in one place."""
    assert old in SWEEP
    return SWEEP.replace(old, new, 1)


TEXTS: dict[str, bytes | str] = {
    "a NUL": "mbla_sweep: 1\0",
    "aliases of aliases": LAUGHS,
    "1,000,000 brackets": "[" * 1_000_000,
    "a tag of Python": "mbla_sweep: !!python/object/apply:os.system ['touch written']\n",
    "10^15 points of a grid": (
        SWEEP[: SWEEP.index("parameters:")]
        + "parameters:\n"
        + MANY
        + "\ndesign:\n  - grid: {of: [p0, p1, p2, p3, p4]}\n"
    ),
    "10^15 points of a range": changed("values: [2, 3]", "linear: {from: 2, to: 3, points: 1000000000000000}"),
    "10^15 random points": changed("points: 4", "points: 1000000000000000"),
    "random points that grids multiply": changed("points: 4", "points: 900000").replace("[2, 3]", "[2, 3, 4, 5]"),
    "a deviation as large as numbers go": changed("deviation: 0.08", "deviation: 1.e+308"),
    "a constraint that is Python": SWEEP + 'where: [\'__import__("os").system("touch written")\']\n',
    "a deck up": changed("deck: deck.yaml", "deck: ../../../../etc/passwd"),
    "a deck that is a device": changed("deck: deck.yaml", "deck: /dev/zero"),
    "a deck that is itself": changed("deck: deck.yaml", "deck: sweep.yaml"),
    "a key of a slot of Python": changed("key: parameters.n", "key: parameters.__class__"),
    "a key with an index of 10^12": changed("key: parameters.n", "key: blocks.1000000000000.wall.courses"),
    "a name of a parameter up": changed("  n: {key", '  "../n": {key'),
    "files elsewhere": SWEEP + "output: {folder: ../elsewhere}\n",
    "50,000 parameters": SWEEP.replace(
        "design:", "".join(f"  q{n}: {{values: [1, 2]}}\n" for n in range(50_000)) + "design:"
    ),
}

CASES = [
    *(sweep(f"sweep: {name}", text, deck__yaml=WALL) for name, text in TEXTS.items()),
    Case("sweep: a device", lambda folder: write_all(folder, {}), ("sweep", "/dev/zero"), NOT_READ),
    sweep("sweep: a deck that is a bomb", SWEEP, deck__yaml=LAUGHS),
]
"""All of them."""
