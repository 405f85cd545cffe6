"""Points one after the other in this process."""

from __future__ import annotations

from collections.abc import Generator, Sequence

from mbla.studies.sweep.outcome import Outcome
from mbla.studies.sweep.plan import Plan, Task
from mbla.studies.sweep.worker.runner import PointRunner


class HereEngine:
    """An engine without workers."""

    def run(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        """Outcomes in the order of the tasks."""
        runner = PointRunner(plan)
        for task in tasks:
            yield runner.run(task)
