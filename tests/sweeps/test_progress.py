"""The line of progress: counts, rate over the last points, time left."""

from __future__ import annotations

import pytest

from mbla.sweeps.words import WINDOW, Progress, duration_words, rate_words


def test_a_line_has_counts_rate_and_time_left() -> None:
    progress = Progress(total=100)
    for number in range(1, 11):
        progress.add(failed=number == 3, seconds=0.5 * number)
    assert progress.words() == "10 of 100 points, 1 failed, 2 points/s, 45 s left"
    assert progress.bar() == "[##......................] 10 of 100 points, 1 failed, 2 points/s, 45 s left"


def test_nothing_is_left_at_the_end() -> None:
    progress = Progress(total=2)
    progress.add(failed=False, seconds=1.0)
    progress.add(failed=False, seconds=2.0)
    assert progress.words() == "2 of 2 points, 1 points/s"
    assert progress.bar().startswith("[########################]")


def test_the_rate_follows_the_last_points() -> None:
    progress = Progress(total=2000)
    for number in range(1, 1001):
        progress.add(failed=False, seconds=0.01 * number)
    for number in range(1, WINDOW + 1):
        progress.add(failed=False, seconds=10 + number)
    assert progress.rate == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("rate", "words"),
    [(25.04, "25 points/s"), (0.5, "30 points/min"), (0.001, "3.6 points/h"), (1e-5, "0.036 points/h")],
)
def test_slow_rates_are_told_by_the_minute_or_the_hour(rate: float, words: str) -> None:
    assert rate_words(rate) == words


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.2, "1 s"),
        (59.4, "59 s"),
        (61, "1 min 1 s"),
        (3599, "59 min 59 s"),
        (3600, "1 h 0 min"),
        (90061, "25 h 1 min"),
    ],
)
def test_durations_have_two_units_at_most(seconds: float, words: str) -> None:
    assert duration_words(seconds) == words
