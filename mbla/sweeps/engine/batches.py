"""Tasks in batches of about equal time, so that handing them out costs little and none waits long for another.

A task that is handed to a worker costs a few thousandths of a second, whatever it does; points of a small model take
not much more.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from mbla.sweeps.plan import Outcome, Task

SECONDS = 1.0
"""that a batch should take: hundreds of times what handing it out costs"""
MOST = 200
"""points of a batch, so that a line of the journal is never long in coming"""
MEMORY = 0.1
"""share of the last point in the mean time of a point"""
STRIKES = 2
"""workers that may die of a point before it is given up"""


class Batches:
    """What is left to be handed out, and in which portions."""

    def __init__(self, tasks: Sequence[Task]) -> None:
        """All of them are left."""
        self._left = deque(tasks)
        self._alone: deque[Task] = deque()
        self._strikes: dict[str, int] = {}
        self._mean: float | None = None

    def __bool__(self) -> bool:
        return bool(self._left or self._alone)

    def take(self, places: int) -> tuple[Task, ...]:
        """The next batch: single points until one is done, then about a second, less where they are near their end.

        places : batches that are under way together
        """
        if self._alone:
            return (self._alone.popleft(),)
        fair = math.ceil(len(self._left) / max(places, 1))
        second = 1 if self._mean is None else int(SECONDS / max(self._mean, SECONDS / MOST))
        return tuple(self._left.popleft() for _ in range(max(1, min(second, fair))))

    def learn(self, outcome: Outcome) -> None:
        """Note how long a point took."""
        seconds = outcome.seconds
        self._mean = seconds if self._mean is None else (1.0 - MEMORY) * self._mean + MEMORY * seconds

    def give_back(self, tasks: Sequence[Task]) -> None:
        """They were not begun: they come next."""
        self._left.extendleft(reversed(tasks))

    def died(self, tasks: Sequence[Task]) -> tuple[Task, ...]:
        """Its workers died of this batch: points are handed out alone, once; returns those that are given up."""
        hopeless = []
        for task in tasks:
            self._strikes[task.key] = self._strikes.get(task.key, 0) + 1
            if self._strikes[task.key] >= STRIKES:
                hopeless.append(task)
            else:
                self._alone.append(task)
        return tuple(hopeless)
