"""Points in a process of their own: limits of time and memory, and points that end their process.

The process has a session of its own, so that an interrupt from the keyboard reaches the parent alone, which stops it
with all its copies. Plan, tasks and outcomes go over a pipe, whose end each side sees when the other is gone.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from dataclasses import replace
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from typing import IO, Any

from mbla.errors import LimitError, UsageError
from mbla.sweeps.plan import FAILED, MEGABYTE, Plan, PointOutcome, Task

COMMAND = (sys.executable, "-P", "-m", "mbla.sweeps.engine.child")
PACKAGES = Path(__file__).parents[3]
"""folder from which this mbla is imported; the process takes the same"""
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")
"""variables that are set whatever the user's own say: with more than one thread the last digits may be others"""
TRIES = 2
"""of a point whose process dies"""
STARTS = 5
"""of a process that ends before it is ready: no point caused that, and the cause may be temporary"""
START = 120.0
"""seconds in which a process must be ready; importing takes a few, and some more from a busy network disk"""
PATIENCE = 5.0
"""seconds that a process which closed its end of the pipe is given to end"""
LAST_WORDS = 2000
"""bytes of standard error that are read of one that broke"""
NO_MEMORY = ("memory allocation of", "bad_alloc", "Cannot allocate memory", "MemoryError", "emory allocation")
"""what libraries say last when they end a process because an allocation failed"""
STOPPED = "stopped at the end of the time limit"
"""reason of a point that was under way when the time for all of them was over"""


class StoppedError(Exception):
    """The runner was stopped from another thread while it solved a point."""


class SupervisedRunner:
    """Solves points of one plan, one after the other, in a process that is replaced when it must be.

    started : processes begun so far
    stopped : ``close`` was called
    """

    def __init__(
        self, plan: Plan, command: Sequence[str] = COMMAND, *, until: float | None = None, threads: int = 1
    ) -> None:
        """The process is started when it is first needed.

        until : time.monotonic() at which a point is stopped in any case
        """
        self.plan = plan
        self.started = 0
        self.stopped = False
        self._command, self._until = tuple(command), until
        path = os.pathsep.join(each for each in (str(PACKAGES), os.environ.get("PYTHONPATH", "")) if each)
        self._environment = os.environ | dict.fromkeys(THREADS, str(threads)) | {"PYTHONPATH": path}
        self._process: subprocess.Popen[bytes] | None = None
        self._pipe: Connection[Any, Any] | None = None
        self._errors: IO[bytes] | None = None
        self._at_work = threading.Lock()

    def close(self) -> None:
        """End it for good, from whatever thread; ``run`` raises StoppedError where it is under way, and later."""
        self.stopped = True
        if (process := self._process) is not None and process.poll() is None:  # else its number may be another's
            _kill_all(process)
        if self._at_work.acquire(blocking=False):
            self._stop()
            self._at_work.release()

    def run(self, task: Task) -> PointOutcome:
        """Solve one point.

        A process that died is replaced and the point tried once more. So is one that met the limit on memory unless
        the point was its first: whether a point fits must not depend on those before it.

        Raises UsageError: no process can be had, or it is not the mbla, or reads not the deck, of the plan. Raises
        StoppedError: ``close`` was called.
        """
        with self._at_work:
            for tries in range(1, TRIES + 1):
                fresh = self._make_ready()
                outcome, settled = self._attempt(task, fresh)
                if self.stopped:
                    self._stop()
                    raise StoppedError
                if settled or tries == TRIES:
                    return replace(outcome, tries=tries)
        raise AssertionError  # the last try always returns

    def _attempt(self, task: Task, fresh: bool) -> tuple[PointOutcome, bool]:
        """What comes of a point, and whether that is all that can come of it; ``fresh``: it is its process's first."""
        started, limit = time.monotonic(), self.plan.time_limit
        ends = [end for end in (None if limit is None else started + limit, self._until) if end is not None]

        def failed(code: int, words: str) -> PointOutcome:
            return PointOutcome(task.key, FAILED, code, words, {}, 1, time.monotonic() - started)

        try:
            outcome: PointOutcome = self._ask(task, min(ends, default=None))
        except TimeoutError:
            self._stop()
            own = limit is not None and time.monotonic() >= started + limit
            words = f"stopped at the limit of {limit:g} s for a point" if own else STOPPED
            return failed(LimitError.exit_status, words), True
        except (EOFError, OSError):
            said, words = self._last_words(), self._death()
            if self.plan.memory_limit is not None and any(sign in said for sign in NO_MEMORY):
                return failed(LimitError.exit_status, f"{self._memory_words()} ({words})"), fresh
            return failed(1, f"{words}; given up after {TRIES} tries"), False
        if self.plan.memory_limit is not None and outcome.reason == "out of memory":
            self._stop()  # what was left half done when memory ran out is not worth looking through
            return failed(LimitError.exit_status, self._memory_words()), fresh
        return replace(outcome, reason="; ".join(outcome.reason.splitlines())), True  # a deck may have several faults

    def _memory_words(self) -> str:
        assert self.plan.memory_limit is not None
        return f"more than the {self.plan.memory_limit / MEGABYTE:g} MB of memory that a point may take"

    # --- the process ------------------------------------------------------------------------------------------------

    def _make_ready(self) -> bool:
        """Have a process that is ready for a point; whether it is a new one.

        Raises UsageError where none can be had, or it refuses the plan.
        """
        if not self.stopped and self._process is not None and self._process.poll() is None:
            return False
        words = ""
        for _ in range(STARTS):
            self._stop()
            try:
                if not self.stopped:
                    self._start()
                if self.stopped:  # also where ``close`` came before there was anything to kill
                    self._stop()
                    raise StoppedError
                refused: str = self._ask(self.plan, time.monotonic() + START)
            except TimeoutError:
                words = f"not ready after {START:g} s"
            except (EOFError, OSError) as error:
                words = str(error) if self._process is None else self._death()
            else:
                if not refused:
                    return True
                self._stop()
                raise UsageError("worker-refused", refused)
        self._stop()
        raise UsageError("worker-refused", f"the process that solves points cannot be started: {words}")

    def _start(self) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as the process
        self._pipe, theirs = Pipe()
        with theirs:
            self._process = subprocess.Popen(
                (*self._command, str(theirs.fileno())),
                stdin=subprocess.DEVNULL,
                stdout=self._errors,
                stderr=self._errors,
                env=self._environment,
                pass_fds=[theirs.fileno()],
                start_new_session=True,
            )
        self.started += 1

    def _ask(self, question: Plan | Task, until: float | None) -> Any:
        """The answer of the process; TimeoutError after that time.monotonic(), EOFError or OSError where it is gone."""
        assert self._pipe is not None
        self._pipe.send(question)
        if not self._pipe.poll(None if until is None else max(until - time.monotonic(), 0.0)):
            raise TimeoutError
        return self._pipe.recv()

    def _death(self) -> str:
        """How a process ended that closed its end of the pipe, in words."""
        assert self._process is not None
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(PATIENCE)
        status, said = self._process.poll() or 0, self._last_words()
        self._stop()
        if status < 0:
            name = signal.Signals(-status).name if -status in list(signal.Signals) else f"signal {-status}"
            memory = ", as the system does where memory runs out" if name == "SIGKILL" else ""
            return f"its process was ended by {name}{memory}"
        return f"its process ended with status {status}{f': {said}' if said else ''}"

    def _last_words(self) -> str:
        """The last line that it wrote to standard error; empty where there is none."""
        assert self._errors is not None
        size = self._errors.seek(0, os.SEEK_END)
        self._errors.seek(max(size - LAST_WORDS, 0))
        said = self._errors.read().decode("utf-8", errors="replace").strip().splitlines()
        return said[-1] if said else ""

    def _stop(self) -> None:
        """Gone for certain, with all copies."""
        process, self._process = self._process, None
        if process is not None:
            _kill_all(process)
            process.wait()
        for stream in (self._pipe, self._errors):
            if stream is not None:
                stream.close()
        self._pipe = self._errors = None


def _kill_all(process: subprocess.Popen[bytes]) -> None:
    """End a process that leads a session, with all its copies."""
    with contextlib.suppress(OSError):  # no such process any more
        os.killpg(process.pid, signal.SIGKILL)
