"""``mbla verify`` agrees with no file in which something is left out, put in or exchanged, however whole it is."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import pytest

from mbla.errors import FileError
from mbla.results.results import Results
from mbla.verify import verify_file
from tests.trust.corrupted.claims import DECKS, FORGERIES, sound_files, written_anew
from tests.trust.counts import record_counts

NUMBER = 300
SMALL = ("small_block", "small_beam", "small_wall")


def became(path: Path) -> str:
    """What verification makes of a forged file."""
    try:
        results, disagreements = verify_file(path)
    except FileError:
        return "refused"
    assert (results.exit_code in (0, 5)) == (not disagreements and not results.unconfirmed)
    return "disagreed" if disagreements else "unconfirmed" if results.unconfirmed else "agreed"


def forged_files(
    folder: Path, sound: Mapping[str, Results], number: int, seed: int
) -> tuple[Counter[str], Counter[str], list[str]]:
    """So many forgeries, kinds in turn: what became of them, how many of each kind, and what was agreed with."""
    generator, path = random.Random(seed), folder / "forged.h5"
    counts, kinds, wrong = Counter[str](), Counter[str](), list[str]()
    while kinds.total() < number:
        kind = min(FORGERIES, key=lambda each: (kinds[each], generator.random()))
        name = generator.choice(sorted(sound))
        forged = FORGERIES[kind](sound[name], generator)
        if forged is None:
            continue
        written_anew(path, kind, forged)
        kinds[kind] += 1
        counts[said := became(path)] += 1
        wrong += [f"{kind}, {name}"] if said == "agreed" else []
    return counts, kinds, wrong


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Results]:
    return sound_files(tmp_path_factory.mktemp("sound"), SMALL)


@pytest.mark.every(6)
@pytest.mark.parametrize("kind", FORGERIES)
def test_a_forged_file_is_not_agreed_with(kind: str, small: dict[str, Results], tmp_path: Path) -> None:
    """Of the first deck in which there is something to forge in that way."""
    generator = random.Random(7)
    forged = next((file for each in small.values() if (file := FORGERIES[kind](each, generator)) is not None), None)
    assert forged is not None, "no deck for it"
    written_anew(tmp_path / "forged.h5", kind, forged)
    assert became(tmp_path / "forged.h5") in ("disagreed", "unconfirmed")


def test_sound_files_written_anew_are_agreed_with(small: dict[str, Results], tmp_path: Path) -> None:
    for name, results in small.items():
        written_anew(tmp_path / "sound.h5", "nothing", results)
        assert became(tmp_path / "sound.h5") == "agreed", name


@pytest.mark.trust
def test_three_hundred_files_forged_as_a_whole(tmp_path: Path) -> None:
    sound = sound_files(tmp_path, tuple(DECKS))
    counts, kinds, wrong = forged_files(tmp_path, sound, NUMBER, seed=3)
    assert not wrong, "\n".join([f"{len(wrong)} agreed with", *wrong])
    record_counts(
        "forged-claims",
        62,
        "`mbla verify` agrees with no result file in which cases, positions, ends of an objective, rows or end of a "
        "pushover, parts of an answer, remarks, an angle or the deck's own text were left out, put in or exchanged and "
        "all that follows made anew",
        {
            "forgeries": kinds.total(),
            "kinds": len(kinds),
            "decks with curves, codes, objectives, ties, travel, slopes": len(sound),
            "files that verify disagrees with": counts["disagreed"],
            "files that lack what their deck asks for, named as not confirmed, exit status 4": counts["unconfirmed"],
            "files refused": counts["refused"],
            "files that verify agreed with": len(wrong),
        },
    )
