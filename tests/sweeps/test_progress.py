"""The line of progress: counts, rate over the last points, time left."""

from __future__ import annotations

import pytest

from mbla.sweeps.words import Progress, duration_words, rate_words


def test_a_line_has_counts_rate_and_time_left() -> None:
    progress = Progress(total=100)
    for number in range(1, 11):
        progress.add(failed=number == 3, seconds=0.5 * number)
    assert progress.words() == "10 of 100 points, 1 failed, 2 points/s, 45 s left"
    assert progress.bar() == "[##......................] 10 of 100 points, 1 failed, 2 points/s, 45 s left"


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
