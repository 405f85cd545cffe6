"""Points on the workers of a Dask scheduler, of this machine or a cluster.

A sliding window of batches is under way, so that neither the scheduler nor this process holds more than that of a
sweep of any length. What was delivered stays, whatever becomes of the rest.
"""

from __future__ import annotations

import math
import queue
import uuid
from collections import deque
from collections.abc import Generator, Sequence
from contextlib import suppress
from types import TracebackType
from typing import Any, Self

from mbla.errors import UsageError
from mbla.sweeps.engine.connection import LOOK, REPLY, Connection
from mbla.sweeps.engine.engine import Engine, EngineOptions
from mbla.sweeps.engine.on_worker import end_processes, run_batch
from mbla.sweeps.plan import FAILED, Outcome, Plan, Task

SECONDS = 1.0
"""that a batch should take: hundreds of times what handing it out costs"""
MOST = 200
"""points of a batch, so that a line of the journal is never long in coming"""
MEMORY = 0.1
"""share of the last point in the mean time of a point"""
STRIKES = 2
"""workers that may die of a point before it is given up"""
GIVEN_UP = f"its worker was ended, as was that of each try before; given up after {STRIKES} tries"


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


WINDOW = 2
"""batches under way for each thread of the workers: one is solved, the next waits beside it"""


class ClusterEngine(Engine):
    """The local workers, or the connection, are there inside the block and gone after it."""

    def __init__(self, options: EngineOptions) -> None:
        """UsageError where the extra is not installed."""
        self._connection = Connection(options)

    def __enter__(self) -> Self:
        """Start or connect; raises UsageError where there is no scheduler, no worker, or one with another mbla."""
        self._connection.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        super().__exit__(kind, error, traceback)
        self._connection.__exit__(kind, error, traceback)

    def _solved(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        connection, batches = self._connection, Batches(tasks)
        running: dict[str, tuple[tuple[Task, ...], Any]] = {}  # tasks and future by the key of the batch
        finished: queue.Queue[str] = queue.Queue()
        try:
            while batches or running:
                places = WINDOW * max(connection.threads, 1)
                while batches and len(running) < places:
                    batch, key = batches.take(places), f"mbla-points-{uuid.uuid4().hex}"
                    with connection.lost_where_it_fails():
                        arguments = plan, batch, connection.libraries
                        future = connection.client.submit(run_batch, *arguments, key=key, pure=False)
                    running[key] = batch, future
                    future.add_done_callback(lambda future: finished.put(future.key))
                connection.look(every=LOOK)
                with suppress(queue.Empty):
                    for outcome in self._outcomes_of(*running.pop(finished.get(timeout=LOOK)), batches):
                        batches.learn(outcome)
                        yield outcome
        finally:  # nothing goes on for nobody: what is under way is cancelled, the processes of the workers are ended
            if running:
                futures = [future for _, future in running.values()]
                connection.ask_quietly(lambda client: client.cancel(futures, force=True))
            connection.ask_quietly(lambda client: client.run(end_processes, on_error="ignore"))

    def _outcomes_of(self, tasks: tuple[Task, ...], future: Any, batches: Batches) -> list[Outcome]:
        """Outcomes of a finished batch; what of it was not solved is given back."""
        connection = self._connection
        try:
            outcomes: list[Outcome]
            outcomes, refused = future.result(timeout=REPLY)
        except connection.dask.KilledWorker:
            return [Outcome(task.key, FAILED, 1, GIVEN_UP, {}, STRIKES, 0.0) for task in batches.died(tasks)]
        except (OSError, *connection.dask.cancelled) as error:
            connection.refuse_lost(error)
            batches.give_back(tasks)  # the worker is gone with its answer
            return []
        except Exception as error:
            words = f"{type(error).__name__}: {' '.join(str(error).split())}"
            raise UsageError("worker-refused", f"a worker cannot solve points: {words}") from error
        if refused:
            raise UsageError("worker-refused", f"a worker cannot solve points of this sweep: {refused}")
        batches.give_back(tasks[len(outcomes) :])
        return outcomes
