from __future__ import annotations

import signal
import threading

import pytest

from mbla.results.held_signals import held_signals


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
