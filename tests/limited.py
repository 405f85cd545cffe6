"""A limit on the seconds of the processor that something may take in this process."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any


class Hang(BaseException):
    """Not an Exception: nothing in the program may take it for one of its own."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise ``Hang`` in what takes longer, in processor time."""

    def hang(number: int, frame: FrameType | None) -> Any:
        raise Hang(f"more than {seconds} s of processor time")

    before = signal.signal(signal.SIGPROF, hang)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
