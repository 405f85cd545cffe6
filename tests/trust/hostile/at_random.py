"""Files changed at random, by a generator of random numbers and by hypothesis.

::

    python -m tests.trust.hostile.at_random FOLDER [RUNS] [SEED]
    python -m tests.trust.hostile.at_random --hypothesis FOLDER [RUNS] [SEED]

Each file is made from a seed of its own, or with its like of one batch of hypothesis, so that a run that was
interrupted goes on where its record in ``FOLDER`` ends. What breaks the program goes to ``FOLDER/finds``.
"""

from __future__ import annotations

import resource
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import hypothesis
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from tests.trust.hostile import subject
from tests.trust.hostile.finds import Finds
from tests.trust.hostile.mutations import changed
from tests.trust.hostile.samples import ROOT, seeds, small_files

SEEDS = seeds()
DECKS = [seed for seed in SEEDS if seed[0] == "deck"]
REFUSED = set(small_files(ROOT / "tests" / "invalid_decks"))
VALID = [seed for seed in DECKS if seed[1] not in REFUSED]
SWEEPS = [seed for seed in SEEDS if seed[0] == "sweep"]
GEOMETRY = [seed for seed in SEEDS if seed[0] not in ("deck", "sweep")]
FAMILIES = (VALID, DECKS, SWEEPS, GEOMETRY)
"""what a file is made of: half of them are decks, and half of these are valid before they are changed"""
RUNS = 100_000
BATCH = 500
"""files between two records"""
MOST_RESERVED = 4 * 1024**3
"""bytes of addresses, beyond which memory runs out: that is a find, too"""

Give = Callable[[Finds, Path, int, int], None]
"""gives files: finds, folder for the files, how many, and the seed of the run"""


def at_random(finds: Finds, folder: Path, runs: int, seed: int) -> None:
    """Files changed up to five times, each from another seed, on from those that were given before."""
    for number in range(finds.runs, finds.runs + runs):
        rng = Random(seed * 10**9 + number)
        kind, content = rng.choice(rng.choice(FAMILIES))
        for _ in range(rng.choice((1, 1, 2, 3, 5))):
            content = changed(kind, content, rng.choice)
        finds.give(kind, content, folder)


@st.composite
def files(draw: st.DrawFn) -> tuple[str, bytes]:
    """Kind and content of a file changed up to four times."""
    kind, content = draw(st.sampled_from(draw(st.sampled_from(FAMILIES))))
    for _ in range(draw(st.integers(1, 4))):
        content = changed(kind, content, lambda options: draw(st.sampled_from(options)))
    return kind, content


def by_hypothesis(finds: Finds, folder: Path, runs: int, seed: int) -> None:
    """Files that hypothesis draws, on from those that were given before; only how many it gives itself is counted."""

    @hypothesis.seed(seed * 10**9 + finds.runs)
    @settings(
        max_examples=runs,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(file=files())
    def one(file: tuple[str, bytes]) -> None:
        finds.give(*file, folder)

    one()


def give_in_batches(give: Give, place: Path, runs: int, seed: int) -> Finds:
    """Give so many files, those included that an interrupted run gave; keep a record after each batch."""
    place.mkdir(parents=True, exist_ok=True)
    record = place / f"{give.__name__}.json"
    finds = Finds.resumed(record, place / "finds")
    with TemporaryDirectory() as folder:
        subject.prepare_folder(Path(folder))
        while finds.runs < runs:
            give(finds, Path(folder), min(BATCH, runs - finds.runs), seed)
            finds.write(record)
    return finds


def main() -> None:
    """Give the files; exit status 1 where one broke the program."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_RESERVED, MOST_RESERVED))
    arguments = [argument for argument in sys.argv[1:] if argument != "--hypothesis"]
    give = by_hypothesis if "--hypothesis" in sys.argv else at_random
    numbers = [int(argument) for argument in arguments[1:]]
    runs, seed = [*numbers, *(RUNS, 1)[len(numbers) :]]
    finds = give_in_batches(give, Path(arguments[0]), runs, seed)
    sys.exit(1 if finds.found else 0)


if __name__ == "__main__":
    main()
