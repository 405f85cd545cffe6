from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest

from mbla.solution.signals import signals_held


@pytest.fixture
def delivered() -> Iterator[list[int]]:
    """Numbers of the signals that reach the handler of SIGTERM."""
    numbers: list[int] = []
    earlier = signal.signal(signal.SIGTERM, lambda number, frame: numbers.append(number))
    yield numbers
    signal.signal(signal.SIGTERM, earlier)


def test_a_signal_is_delivered_when_the_block_is_left(delivered: list[int]) -> None:
    with signals_held() as signalled:
        assert not signalled()
        signal.raise_signal(signal.SIGTERM)
        assert signalled()
        assert delivered == []
    assert delivered == [signal.SIGTERM]


def test_an_ignored_signal_stays_ignored() -> None:
    earlier = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with signals_held() as signalled:
            signal.raise_signal(signal.SIGINT)
            assert not signalled()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, earlier)
