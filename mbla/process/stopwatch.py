"""Where the time of a run goes: seconds by stage, each without what the stages inside it take.

A run opens a stopwatch (``timing``); whatever does a stage's work names it (``stage``, around a block or on a
function). Without a stopwatch open it does nothing.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass, field


@dataclass
class Stopwatch:
    """Seconds by stage, in the order in which stages first ended.

    inside : seconds that the stages inside each open one have taken so far, outermost first
    """

    seconds: dict[str, float] = field(default_factory=dict)
    inside: list[float] = field(default_factory=list)


_running: ContextVar[Stopwatch | None] = ContextVar("stopwatch", default=None)


@contextlib.contextmanager
def timing() -> Iterator[Stopwatch]:
    """A stopwatch for the stages of a ``with`` block; one that was open waits meanwhile."""
    stopwatch = Stopwatch()
    token = _running.set(stopwatch)
    try:
        yield stopwatch
    finally:
        _running.reset(token)


@contextlib.contextmanager
def stage(name: str) -> Iterator[None]:
    """Add the seconds of a ``with`` block to a stage of the open stopwatch."""
    stopwatch = _running.get()
    if stopwatch is None:
        yield
        return
    started = time.perf_counter()
    stopwatch.inside.append(0.0)
    try:
        yield
    finally:
        total = time.perf_counter() - started
        own = total - stopwatch.inside.pop()
        stopwatch.seconds[name] = stopwatch.seconds.get(name, 0.0) + own
        if stopwatch.inside:
            stopwatch.inside[-1] += total
