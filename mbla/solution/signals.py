"""Signals while foreign code runs: noted, and delivered when it has returned.

A signal that arrives while the cone solver is at work is handled by Python at the start of the solver's next callback,
where the exception it raises would be printed and forgotten.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

HELD = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def signals_held() -> Iterator[Callable[[], bool]]:
    """Within the block SIGINT and SIGTERM are only noted; on leaving it they go to the handlers that were there before.

    Gives a function that tells whether one has arrived. Threads other than the main one get no signals: nothing to do.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    arrived: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        arrived.append(number)

    heeded = [number for number in HELD if signal.getsignal(number) is not signal.SIG_IGN]  # nohup, background jobs
    earlier: dict[signal.Signals, Any] = {number: signal.signal(number, note) for number in heeded}
    try:
        yield lambda: bool(arrived)
    finally:
        for number, handler in earlier.items():
            signal.signal(number, handler)
        if arrived:
            signal.raise_signal(arrived[0])
