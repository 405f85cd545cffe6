"""The same deck gives the same files to the last byte, in whatever way it is run."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.determinism.decks import DECKS, FEW, commands
from tests.trust.determinism.ways import FIRST, Left, Way, comma_locale, differences, other_ways, ran

CLAIM = (
    "With a clock that stands still a deck gives the same files to the last byte: again, in another folder, with "
    "another hash seed, locale (decimal comma, POSIX), time zone, umask, with two threads, and beside other decks in "
    "one process; a search that is told to end by the clock is none of them"
)
AT_ONCE = 5
"""processes"""


def test_there_are_fifty_decks() -> None:
    assert len(set(DECKS)) == 50


def test_a_difference_is_found() -> None:
    first = Left((0, 5), {"a.h5": b"1", "b.lst": b"2"}, frozenset({0o644}))
    assert differences(first, first) == []
    assert differences(first, replace(first, files={"a.h5": b"1", "b.lst": b"3"})) == ["b.lst differs"]
    assert differences(first, replace(first, files={"a.h5": b"1"})) == ["b.lst is missing in one"]
    assert differences(first, replace(first, statuses=(0, 0))) == ["exit statuses (0, 5), (0, 0)"]


def test_one_deck_with_everything_changed_at_once(tmp_path: Path) -> None:
    """All ways together: what one of them changes is not put right by another."""
    locale = comma_locale(tmp_path) or {"LC_ALL": "POSIX"}
    environment = {"PYTHONHASHSEED": "4711", "TZ": "Pacific/Kiritimati", **locale}
    changed = Way("changed", environment, "wo anders/Größe 2", umask=0o077, threads=2)
    asked = commands(FEW, beside=False)
    first, other = ran(FIRST, tmp_path, asked), ran(changed, tmp_path, asked)
    assert first.statuses == (0,)
    assert {Path(name).suffix for name in first.files} == {".h5", ".lst", ".sta", ".json", ".vtu", ".pvd", ".py"}
    assert differences(first, other) == []
    assert (first.modes, other.modes) == (frozenset({0o644}), frozenset({0o600}))


@pytest.mark.trust
def test_fifty_decks_in_every_way(tmp_path: Path) -> None:
    locale = comma_locale(tmp_path)
    assert locale is not None, "no locale with a decimal comma: localedef and its sources are missing"
    ways, asked = (FIRST, *other_ways(locale)), commands(DECKS, beside=True)
    with ThreadPoolExecutor(AT_ONCE) as at_once:
        first, *others = at_once.map(
            lambda way: ran(way, tmp_path, asked[: len(DECKS)] if way.backwards else asked), ways
        )
    assert set(first.statuses) <= {0, 4, 5}
    compared = 0
    found: list[str] = []
    for way, other in zip(ways[1:], others, strict=True):
        expected = _of_decks_alone(first) if way.backwards else first
        found += [f"{way.name}: {difference}" for difference in differences(expected, other)]
        compared += len(expected.files)
    assert found == []
    counts = {"decks": len(DECKS), "ways": len(others), "files compared": compared, "files that differ": len(found)}
    record_counts("determinism", 80, CLAIM, counts)


def _of_decks_alone(left: Left) -> Left:
    """Without pictures, tables and reports, which need results of decks that are run before."""
    files = {name: data for name, data in left.files.items() if name.split("/")[0] in DECKS}
    return replace(left, statuses=left.statuses[: len(DECKS)], files=files)
