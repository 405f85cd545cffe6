"""Points one after the other in one process beside this one; needs no extra."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from types import TracebackType

from mbla.sweeps.plan import Outcome, Plan, Task
from mbla.sweeps.worker.supervised import SupervisedRunner


class SerialEngine:
    """Context manager; tasks are done in their order."""

    def __init__(self) -> None:
        """Nothing begun."""
        self._outcomes: Generator[Outcome, None, None] | None = None

    def expect(self, plan: Plan, points: int) -> None:
        """Nothing: its process has nothing to wait for."""

    def __enter__(self) -> SerialEngine:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if self._outcomes is not None:
            self._outcomes.close()

    def run(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        """Outcomes in the order of the tasks; raises as ``Engine.run`` does."""
        self._outcomes = _solved(plan, tasks)
        return self._outcomes


def _solved(plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
    with SupervisedRunner(plan) as runner:
        for task in tasks:
            yield runner.run(task)
