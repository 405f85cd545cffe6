"""Interruptions that wait: until files are complete, until modules are loaded, until foreign code has returned.

Python raises the exception of a signal wherever the program happens to be. In a callback of the cone solver it would be
printed and forgotten, in the building of the deck's types it comes back as their fault, between two renames it leaves
files of two runs.
"""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from types import FrameType
from typing import NoReturn

_HELD = (signal.SIGTERM, signal.SIGINT)
"""given back in this order: where the first interrupts that, the process ends"""


class Terminated(BaseException):
    """SIGTERM arrived; to SIGTERM what KeyboardInterrupt is to SIGINT."""


def hear_termination() -> None:
    """SIGTERM raises Terminated from here on. Where it is ignored from the start it stays so, as SIGINT does."""
    if signal.getsignal(signal.SIGTERM) is not signal.SIG_IGN:
        signal.signal(signal.SIGTERM, _terminate)


def _terminate(number: int, frame: FrameType | None) -> NoReturn:
    raise Terminated


@contextlib.contextmanager
def held_signals() -> Iterator[Callable[[], bool]]:
    """SIGINT and SIGTERM that arrive in the block count at its end, as they would have before it.

    Gives a function that says whether one has arrived. Signals that are ignored stay so, as under nohup. Only the main
    thread is ever interrupted; in others nothing is held.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    arrived: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        arrived.append(number)

    handlers = {number: signal.getsignal(number) for number in _HELD}
    ours = {  # None: a handler that is not of Python
        number: handler for number, handler in handlers.items() if handler is not None and handler != signal.SIG_IGN
    }
    try:
        for number in ours:
            signal.signal(number, note)
        yield lambda: bool(arrived)
    finally:
        for number, handler in ours.items():
            signal.signal(number, handler)
        if arrived:
            signal.raise_signal(arrived[0])
