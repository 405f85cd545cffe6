"""What every engine promises: tasks go in, outcomes come out as they are done, each exactly once."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import Protocol

from mbla.sweeps.plan import Outcome, Plan, Task


class Engine(Protocol):
    """Hands tasks to workers."""

    def expect(self, plan: Plan, points: int) -> None:
        """Say, before the context is entered, that so many points of a plan will come: what takes long may begin."""
        ...

    def run(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        """Outcomes in the order in which they are done; one for every task, also where its worker died.

        Closing the iterator stops what is under way.

        Raises
        ------
        UsageError
            no worker can be had, or one has another mbla or reads another base deck
        """
        ...
