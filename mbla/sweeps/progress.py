"""How far a sweep is, in one line: a bar on a terminal, plain words elsewhere."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

BAR = 24
"""characters"""
WINDOW = 200
"""points over which the rate is taken: it follows when points become harder, and does not jump with each of them"""
MINUTE, HOUR = 60.0, 3600.0


@dataclass
class Progress:
    """Count of finished points; times are seconds since the first point was handed out.

    The rate is that from the first finished point on: before it, processes begin.

    total   : points to be solved in this run
    earlier : points that the journal had already
    """

    total: int
    earlier: int = 0
    done: int = 0
    failed: int = 0
    _times: deque[float] = field(default_factory=lambda: deque(maxlen=WINDOW + 1))

    def add(self, failed: bool, seconds: float) -> None:
        """One more point is finished."""
        self.done += 1
        self.failed += failed
        self._times.append(seconds)

    @property
    def rate(self) -> float:
        """Points a second over the last of them; 0 where nothing is known yet."""
        passed = self._times[-1] - self._times[0] if self._times else 0.0
        return (len(self._times) - 1) / passed if passed > 0 else 0.0

    def words(self) -> str:
        """``312 of 1000 points, 2 failed, 23.4 points/s, 29 s left``."""
        words = [f"{self.done} of {self.total} points"]
        if self.failed:
            words.append(f"{self.failed} failed")
        if self.rate:
            words.append(rate_words(self.rate))
            if self.done < self.total:
                words.append(f"{duration_words((self.total - self.done) / self.rate)} left")
        return ", ".join(words)

    def bar(self) -> str:
        """The same behind a bar, for a line that rewrites itself."""
        full = BAR * self.done // self.total if self.total else BAR
        return f"[{'#' * full}{'.' * (BAR - full)}] {self.words()}"


def rate_words(rate: float) -> str:
    """Points a second, or a minute or an hour where they are slow."""
    for seconds, name in ((1.0, "s"), (MINUTE, "min"), (HOUR, "h")):
        if rate * seconds >= 1 or name == "h":
            return f"{rate * seconds:.3g} points/{name}"
    raise AssertionError


def duration_words(seconds: float) -> str:
    """``29 s``, ``4 min 10 s``, ``3 h 20 min``."""
    if seconds < MINUTE:
        return f"{max(int(seconds), 1)} s"
    if seconds < HOUR:
        return f"{int(seconds // MINUTE)} min {int(seconds % MINUTE)} s"
    return f"{int(seconds // HOUR)} h {int(seconds % HOUR // MINUTE)} min"
