from __future__ import annotations

import signal
import threading
from collections.abc import Iterator

import pytest

from mbla.process.signals import held_signals


def test_a_signal_counts_at_the_end_of_the_block() -> None:
    done: list[str] = []

    def work() -> None:
        with held_signals():
            signal.raise_signal(signal.SIGINT)
            done.append("whole")

    with pytest.raises(KeyboardInterrupt):
        work()
    assert done == ["whole"]


def test_handlers_are_as_they_were_and_blocks_may_stand_in_blocks() -> None:
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    done: list[str] = []

    def work() -> None:
        with held_signals():
            with held_signals():
                signal.raise_signal(signal.SIGINT)
            done.append("the outer block goes on")

    with pytest.raises(KeyboardInterrupt):
        work()
    assert done == ["the outer block goes on"]
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before


def test_other_threads_are_never_interrupted() -> None:
    done: list[str] = []

    def work() -> None:
        with held_signals():
            done.append("whole")

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert done == ["whole"]


@pytest.fixture
def delivered() -> Iterator[list[int]]:
    """Numbers of the signals that reach the handler of SIGTERM."""
    numbers: list[int] = []
    earlier = signal.signal(signal.SIGTERM, lambda number, frame: numbers.append(number))
    yield numbers
    signal.signal(signal.SIGTERM, earlier)


def test_whether_a_signal_has_arrived_is_known_in_the_block(delivered: list[int]) -> None:
    with held_signals() as signalled:
        assert not signalled()
        signal.raise_signal(signal.SIGTERM)
        assert signalled()
        assert delivered == []
    assert delivered == [signal.SIGTERM]


def test_an_ignored_signal_stays_ignored() -> None:
    earlier = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with held_signals() as signalled:
            signal.raise_signal(signal.SIGINT)
            assert not signalled()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, earlier)
