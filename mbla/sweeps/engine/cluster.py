"""Points on the workers of a Dask scheduler (only importer of distributed).

A sliding window of points is under way, so that neither the scheduler nor this process holds more than that of a sweep
of any length. What was delivered stays, whatever happens to the rest. Nothing waits without end: a scheduler or workers
that are gone are reported in words, with the remedy.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import json
import logging
import queue
import threading
import time
import uuid
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from typing import Any, TypeVar

import distributed
from distributed.scheduler import KilledWorker

from mbla.errors import FileError, UsageError
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.engine.on_worker import describe, end_processes, run_point
from mbla.sweeps.engine.supervised import StoppedError
from mbla.sweeps.identity import difference, library_versions, program_identity
from mbla.sweeps.plan import FAILED, Outcome, Plan, Task

dask: Any = distributed  # without types
LOOK = 1.0
"""seconds between looks at whether scheduler and workers are still there"""
REPLY = 30.0
"""seconds in which a scheduler must answer a question; a busy one takes a few"""
PARTING = 1.0
"""seconds for disconnecting from a scheduler; without an answer the client leaves"""
CANCELLED = (asyncio.CancelledError, concurrent.futures.CancelledError)
WINDOW = 2
"""points under way for each thread of the workers: one is solved, the next waits with it"""
TRIES = 2
"""times that Dask may find a point to have ended its workers before it is given up: one of its neighbours may have"""
GIVEN_UP = "its worker was ended, as was that of each try before; given up"
Answer = TypeVar("Answer")


def outcomes_of_cluster(options: EngineOptions, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
    """As ``outcomes_of`` of the engine; raises FileError where the scheduler is gone."""
    left, strikes = deque(tasks), dict.fromkeys((task.key for task in tasks), 0)
    running: dict[str, tuple[Task, Any]] = {}  # and its future, by the key that Dask has for it
    finished: queue.Queue[str] = queue.Queue()
    with Connection(options) as connection:
        try:
            while left or running:
                while left and len(running) < WINDOW * max(connection.threads, 1):
                    task, key = left.popleft(), f"mbla-point-{uuid.uuid4().hex}"
                    with connection.lost_where_it_fails():
                        arguments = plan, task, connection.libraries
                        future = connection.client.submit(run_point, *arguments, key=key, pure=False)
                    running[key] = task, future
                    future.add_done_callback(lambda future: finished.put(future.key))
                connection.look(every=LOOK)
                with suppress(queue.Empty):
                    task, future = running.pop(finished.get(timeout=LOOK))
                    try:
                        yield future.result(timeout=REPLY)
                    except KilledWorker:
                        strikes[task.key] += 1
                        if strikes[task.key] < TRIES:
                            left.append(task)
                        else:
                            yield Outcome(task.key, FAILED, 1, GIVEN_UP, {}, TRIES, 0.0)
                    except (OSError, StoppedError, *CANCELLED) as error:  # the worker is gone with its answer
                        connection.refuse_lost(error)
                        left.appendleft(task)
                    except Exception as error:
                        words = f"a worker cannot solve points of this sweep: {' '.join(str(error).split())}"
                        raise UsageError("worker-refused", words) from error
        finally:  # nothing runs without a reader: what is under way is cancelled, processes of the workers are ended
            if running:
                futures = [future for _, future in running.values()]
                connection.ask_quietly(lambda client: client.cancel(futures, force=True))
            connection.ask_quietly(lambda client: client.run(end_processes, on_error="ignore"))


class Connection:
    """Context manager; the client of a scheduler is there inside the block and gone after it.

    client    : of Dask
    threads   : points that can be solved together, as last seen
    libraries : versions that every worker must have
    """

    def __init__(self, options: EngineOptions) -> None:
        """The scheduler is asked when the block is entered."""
        self.client: Any = None
        self.threads = 0
        self.libraries = library_versions()
        self._options = options
        self._stack = ExitStack()
        self._looked = self._seen = 0.0

    def __enter__(self) -> Connection:
        """Connect; raises UsageError where there is no scheduler, no worker, or one with another mbla."""
        with self._stack:
            self._stack.enter_context(silenced())
            self.client = self._connected()
            for _ in self._pauses():
                self.look()
                if self.threads:
                    break
            else:
                raise UsageError("scheduler-lost", self._no_worker())
            self._check_workers()
            self._stack = self._stack.pop_all()
        return self

    def __exit__(self, *error: object) -> None:
        self._stack.close()

    def _pauses(self) -> Iterator[None]:
        """Looks at something that may come, until there was time enough for it."""
        until = time.monotonic() + self._options.patience
        yield
        while time.monotonic() < until:
            time.sleep(LOOK / 10)
            yield

    def look(self, every: float = 0.0) -> None:
        """See what workers there are, unless that was done a few seconds ago.

        Raises
        ------
        FileError
            the scheduler is gone
        UsageError
            no worker has been there for a while
        """
        now = time.monotonic()
        if now - self._looked < every:
            return
        self._looked = now
        self.refuse_lost()
        with self.lost_where_it_fails():
            self.threads = sum(within(REPLY, self.client.nthreads).values())
        if self.threads or not self._seen:
            self._seen = now
        elif now - self._seen > self._options.patience:
            raise UsageError("scheduler-lost", self._no_worker())

    def refuse_lost(self, cause: BaseException | None = None) -> None:
        """Raises FileError where the scheduler is gone."""
        if self.client.status != "running":
            raise self._lost() from cause

    @contextmanager
    def lost_where_it_fails(self) -> Iterator[None]:
        """A failed request means that the scheduler is gone: raises FileError."""
        try:
            yield
        except (OSError, RuntimeError, *CANCELLED) as error:  # a TimeoutError is one
            raise self._lost() from error

    def ask_quietly(self, ask: Callable[[Any], Any]) -> None:
        """Request of the client that is of use only while the scheduler is there, with a short timeout."""
        if self.client is not None and self.client.status == "running":
            with suppress(Exception):
                within(PARTING, lambda: ask(self.client))

    # --- opening ------------------------------------------------------------------------------------------------------

    def _connected(self) -> Any:
        options = self._options
        address = options.scheduler or self._address_in_file()
        files = {key: str(path) for key, path in options.tls.items()}
        try:
            client = dask.Client(
                address,
                security=dask.Security(**files, require_encryption=True if address.startswith("tls://") else None),
                timeout=options.patience,
                set_as_default=False,
            )
        except Exception as error:
            said = str(error.__cause__ or error) or type(error).__name__
            message = f"no connection to the scheduler {address}: {' '.join(said.split())}"
            remedy = "; a tls:// address needs --tls-ca-file, --tls-cert and --tls-key" if address[:3] == "tls" else ""
            raise UsageError("scheduler-lost", message + remedy) from error
        self._stack.callback(_quietly, lambda: client.close(timeout=PARTING))
        return client

    def _address_in_file(self) -> str:
        """The address that a scheduler wrote, waited for as long as for the scheduler itself."""
        path = self._options.scheduler_file
        assert path is not None
        for _ in self._pauses():
            with suppress(OSError, ValueError, KeyError, TypeError):  # or not yet complete
                return str(json.loads(path.read_text(encoding="utf-8"))["address"])
        words = "there is no file with an address; `dask scheduler --scheduler-file` writes it"
        raise UsageError("scheduler-file", f"--scheduler-file {path}: {words}")

    def _check_workers(self) -> None:
        """UsageError naming each worker that has another mbla or other libraries than this process."""
        client = self.client
        try:
            answers = within(REPLY, lambda: client.run(describe, on_error="return"))
        except TimeoutError:
            raise UsageError(
                "scheduler-lost", f"a worker of {self._name()} does not answer within {REPLY:g} s: restart it"
            ) from None
        ours = {"mbla": program_identity()} | self.libraries
        faults = []
        for worker, answer in sorted(answers.items()):
            if isinstance(answer, dict):
                words = difference(ours, {"mbla": answer["program"], **answer["libraries"]})
                faults += [f"worker {worker} on {answer['machine']}: {words}"] if words else []
            elif not isinstance(answer, OSError):  # that is one that has just gone
                faults.append(f"worker {worker}: {type(answer).__name__}: {_line(answer)}")
        if faults:
            remedy = "install the same versions in the workers' environment"
            raise UsageError("workers-differ", "\n".join([*faults, remedy]))

    def _no_worker(self) -> str:
        return (
            f"{self._name()} has had no worker for {self._options.patience:g} s: "
            "start some with `dask worker`; what was solved is in the journal, --resume continues from it"
        )

    def _name(self) -> str:
        return f"the scheduler {self._options.scheduler or self._options.scheduler_file}"

    def _lost(self) -> FileError:
        return FileError(
            "scheduler-lost",
            f"{self._name()} is gone; finished points are in the journal, --resume continues with the rest",
        )


@contextmanager
def silenced() -> Iterator[None]:
    """What Dask remarks on lost workers and connections is reported in words of this program instead."""
    names = [name for name in logging.root.manager.loggerDict if name.split(".")[0] in ("distributed", "tornado")]
    loggers = [logging.getLogger(name) for name in names]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def within(seconds: float, ask: Callable[[], Answer]) -> Answer:
    """The answer; raises TimeoutError where it does not come in time, whatever the library waits for."""
    answers: queue.Queue[tuple[Answer | None, BaseException | None]] = queue.Queue()

    def answer() -> None:
        try:
            answers.put((ask(), None))
        except BaseException as error:
            answers.put((None, error))

    threading.Thread(target=answer, daemon=True).start()
    try:
        value, error = answers.get(timeout=seconds)
    except queue.Empty:
        raise TimeoutError from None
    if error is not None:
        raise error
    return value  # type: ignore[return-value]


def _quietly(close: Callable[[], Any]) -> None:
    with suppress(Exception):
        within(2 * PARTING, close)


def _line(error: BaseException) -> str:
    return " ".join(str(error).split())
