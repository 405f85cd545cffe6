"""Points in a process of their own: limits of time and memory, and what becomes of a point that its process dies of."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, replace
from types import TracebackType

from mbla.errors import LimitError, UsageError
from mbla.sweeps.engine.line_process import LineProcess
from mbla.sweeps.plan import FAILED, Outcome, Plan, Task, outcome_of, record_of

COMMAND = (sys.executable, "-P", "-m", "mbla.sweeps.engine.child")
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")
"""variables that are set whatever the user's own say: with more than one thread the last digits may be others"""
TRIES = 2
"""of a point whose process dies"""
STARTS = 20
"""of a process that is ended by a signal before it is ready: no point is to blame, and what sent it may be over soon;
one that ends by itself then would do so again"""
GROWTH = 3.0
"""a process that holds so many times what it held after its first point is replaced"""
START = 120.0
"""seconds in which a process must be ready; importing takes a few, and some more from a busy network disk"""
NO_MEMORY = ("memory allocation of", "bad_alloc", "Cannot allocate memory", "MemoryError", "emory allocation")
"""what libraries say last when they end a process because an allocation failed"""
MEGABYTE = 1e6
STOPPED = "stopped at the end of the time limit"
"""reason of a point that was under way when the time for all of them was over"""


class StoppedError(Exception):
    """The runner was stopped from another thread while it solved a point."""


@dataclass(frozen=True)
class Attempt:
    """What came of a point once.

    outcome : None where the process died, with ``words``
    memory  : the limit on memory was met
    """

    outcome: Outcome | None
    words: str = ""
    memory: bool = False


class SupervisedRunner:
    """Context manager; solves points of one plan, one after the other, in a process that is replaced when it must be.

    started : processes begun so far
    stopped : ``kill`` was called
    """

    def __init__(
        self, plan: Plan, command: tuple[str, ...] = COMMAND, *, until: float | None = None, threads: int = 1
    ) -> None:
        """The process is started when it is first needed.

        until : time.monotonic() at which a point is stopped in any case
        """
        self.plan = plan
        self._until = until
        self.started = 0
        self._process = LineProcess(command, dict.fromkeys(THREADS, str(threads)))
        self._fresh = True
        self._first = self._held = 0.0
        self.stopped = False

    def __enter__(self) -> SupervisedRunner:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._process.stop()

    def kill(self) -> None:
        """End what is under way, from another thread; ``run`` raises StoppedError there, now and later."""
        self.stopped = True
        self._process.kill()

    def run(self, task: Task) -> Outcome:
        """Solve one point.

        A process that died is replaced and the point tried once more. So is one that met the limit on memory unless
        the point was its first: whether a point fits must not depend on those before it.

        Raises
        ------
        UsageError
            no process can be had, or it is not the mbla, or reads not the deck, of the plan
        StoppedError
            ``kill`` was called
        """
        started = time.perf_counter()
        for number in range(1, TRIES + 1):
            self._prepare()
            fresh, started = self._fresh, time.perf_counter()
            attempt = self._attempt(task)
            if self.stopped:
                raise StoppedError
            settled = fresh if attempt.memory else attempt.outcome is not None
            if settled or number == TRIES:
                return self._told(task, attempt, number, time.perf_counter() - started)
        raise AssertionError  # the last try always returns

    # --- one try ----------------------------------------------------------------------------------------------------

    def _attempt(self, task: Task) -> Attempt:
        limit, process, started = self.plan.time_limit, self._process, time.monotonic()
        process.send(record_of(task))
        self._fresh = False
        try:
            ends = [] if limit is None else [started + limit]
            answer = process.next(min([*ends, *([] if self._until is None else [self._until])], default=None))
        except TimeoutError:
            process.stop()
            own = limit is not None and time.monotonic() >= started + limit
            words = f"stopped at the limit of {limit:g} s for a point" if own else STOPPED
            seconds = time.monotonic() - started
            return Attempt(Outcome(task.key, FAILED, LimitError.exit_status, words, {}, 1, seconds))
        if answer is None:
            said = process.last_words()
            words = process.death()
            memory = self.plan.memory_limit is not None and any(sign in said for sign in NO_MEMORY)
            return Attempt(None, words, memory)
        outcome = outcome_of(answer["outcome"])
        self._held = answer["held"]
        self._first = self._first or self._held
        memory = self.plan.memory_limit is not None and outcome.reason == "out of memory"
        if memory:
            process.stop()  # what was left half done when memory ran out is not worth looking through
        return Attempt(outcome, memory=memory)

    def _told(self, task: Task, attempt: Attempt, tries: int, seconds: float) -> Outcome:
        if attempt.memory:
            assert self.plan.memory_limit is not None
            words = f"more than the {self.plan.memory_limit / MEGABYTE:g} MB of memory that a point may take"
            words += f" ({attempt.words})" if attempt.words else ""
            return Outcome(task.key, FAILED, LimitError.exit_status, words, {}, tries, seconds)
        if attempt.outcome is None:
            words = f"{attempt.words}; given up after {tries} tries"
            return Outcome(task.key, FAILED, 1, words, {}, tries, seconds)
        reason = "; ".join(attempt.outcome.reason.splitlines())  # a deck may have several faults
        return replace(attempt.outcome, reason=reason, tries=tries)

    # --- the process ------------------------------------------------------------------------------------------------

    def _prepare(self) -> None:
        """A process that is ready for a point; one that has grown too much is replaced."""
        if self._process.runs() and not self._held > GROWTH * self._first:
            return
        words = ""
        for number in range(1, STARTS + 1):
            if self.stopped:
                raise StoppedError
            words = self._begin()
            if not words:
                return
            if self._process.status >= 0 and number >= TRIES:
                break
        raise UsageError("worker-refused", f"the process that solves points cannot be started: {words}")

    def _begin(self) -> str:
        """Start a process; what went wrong in words. Raises UsageError where it refuses the plan."""
        process = self._process
        self._fresh, self._first, self._held = True, 0.0, 0.0
        until = time.monotonic() + START
        try:
            process.start()
            self.started += 1
            if self.stopped:  # ``kill`` may have come before there was anything to kill
                process.stop()
                raise StoppedError
            if process.next(until) is not None:
                process.send(record_of(self.plan))
                if (answer := process.next(until)) is not None:
                    if "refused" in answer:
                        process.stop()
                        raise UsageError("worker-refused", answer["refused"])
                    return ""
        except OSError as error:  # a TimeoutError is one
            process.stop()
            process.status = 0
            return str(error) or f"not ready after {START:g} s"
        return process.death()
