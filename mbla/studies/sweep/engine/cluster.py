"""Points on the workers of a Dask scheduler, of this machine or a cluster (only importer of distributed).

A sliding window of batches is under way, so that neither the scheduler nor this process holds more than that of a
sweep of any length. Nothing waits without end: a scheduler that is gone ends the run, and what was delivered stays.
"""

from __future__ import annotations

import json
import logging
import queue
import threading
import time
import uuid
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from types import SimpleNamespace, TracebackType
from typing import Any, TypeVar

from mbla.errors import FileError, UsageError
from mbla.studies.sweep.engine.batches import STRIKES, Batches
from mbla.studies.sweep.engine.options import EngineOptions
from mbla.studies.sweep.outcome import FAILED, Outcome
from mbla.studies.sweep.plan import Plan, Task
from mbla.studies.sweep.program import library_versions, program_identity
from mbla.studies.sweep.worker.batch import describe, difference, end_processes, run_batch
from mbla.studies.sweep.worker.messages import outcome_of, record_of

WINDOW = 2
"""batches under way for each thread of the workers: one is solved, the next waits beside it"""
LOOK = 1.0
"""seconds between looks at whether scheduler and workers are still there"""
REPLY = 30.0
"""seconds in which a scheduler must answer a question; a busy one takes a few"""
PARTING = 1.0
"""seconds for taking leave of a scheduler; one that does not answer is left without"""
Answer = TypeVar("Answer")


@dataclass(frozen=True)
class Batch:
    """One batch under way."""

    tasks: tuple[Task, ...]
    future: Any


@dataclass
class Window:
    """Batches under way, and those of them that are finished."""

    running: dict[str, Batch] = field(default_factory=dict)
    finished: queue.Queue[str] = field(default_factory=queue.Queue)


class ClusterEngine:
    """Context manager; the local workers, or the connection, are there inside the block and gone after it."""

    def __init__(self, options: EngineOptions) -> None:
        """UsageError where the extra is not installed."""
        self._options = options
        self._dask = dask_parts()
        self._stack = ExitStack()
        self._client: Any = None
        self._libraries = library_versions()
        self._threads = 0
        self._looked = self._seen = 0.0

    def __enter__(self) -> ClusterEngine:
        """Start or connect; raises UsageError where there is no scheduler, no worker, or one with another mbla."""
        with self._stack:
            self._stack.enter_context(silenced())
            self._client = self._local() if not self._options.cluster else self._remote()
            self._await_workers()
            self._check_workers()
            self._stack = self._stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._stack.close()

    @property
    def threads(self) -> int:
        """Points that can be solved together, as last seen."""
        return self._threads

    def run(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        """Outcomes as they are done; raises as ``Engine.run`` does, and FileError where the scheduler is gone."""
        batches, window = Batches(tasks), Window()
        try:
            while batches or window.running:
                while batches and len(window.running) < WINDOW * max(self._threads, 1):
                    self._submit(plan, batches.take(WINDOW * max(self._threads, 1)), window)
                for outcome in self._next(batches, window):
                    batches.learn(outcome)
                    yield outcome
        finally:
            self._end(window)

    # --- batches ----------------------------------------------------------------------------------------------------

    def _submit(self, plan: Plan, tasks: tuple[Task, ...], window: Window) -> None:
        key = f"mbla-points-{uuid.uuid4().hex}"
        with self._lost_where_it_fails():
            future = self._client.submit(
                run_batch, record_of(plan), [record_of(task) for task in tasks], self._libraries, key=key, pure=False
            )
        window.running[key] = Batch(tasks, future)
        future.add_done_callback(lambda future: window.finished.put(future.key))

    def _next(self, batches: Batches, window: Window) -> list[Outcome]:
        """Outcomes of the next batch that is finished; none where none was in a while."""
        try:
            key = window.finished.get(timeout=LOOK)
        except queue.Empty:
            self._look()
            return []
        if time.monotonic() - self._looked > LOOK:
            self._look()
        batch = window.running.pop(key)
        try:
            answer = batch.future.result(timeout=REPLY)
        except self._dask.KilledWorker:
            return [_given_up(task) for task in batches.died(batch.tasks)]
        except (OSError, *self._dask.cancelled) as error:
            self._refuse_lost(error)
            batches.give_back(batch.tasks)  # its worker is gone with the answer
            return []
        except Exception as error:
            raise UsageError(f"a worker cannot solve points: {type(error).__name__}: {_line(error)}") from error
        if "refused" in answer:
            raise UsageError(f"a worker cannot solve points of this sweep: {answer['refused']}")
        outcomes = [outcome_of(record) for record in answer["outcomes"]]
        batches.give_back(batch.tasks[len(outcomes) :])
        return outcomes

    def _end(self, window: Window) -> None:
        """Nothing goes on for nobody: what is under way is cancelled, the processes of the workers are ended."""
        futures = [batch.future for batch in window.running.values()]
        window.running.clear()
        if self._client is None or self._client.status != "running":
            return
        with suppress(Exception):
            within(PARTING, lambda: self._client.cancel(futures, force=True) if futures else None)
        with suppress(Exception):
            within(PARTING, lambda: self._client.run(end_processes, on_error="ignore"))

    # --- scheduler and workers --------------------------------------------------------------------------------------

    def _local(self) -> Any:
        """Workers of this process, without a port that others could connect to: each has a process for its points."""
        dask = self._dask
        self._stack.enter_context(dask.configured({"distributed.worker.daemon": True}))
        cluster = dask.LocalCluster(
            n_workers=self._options.workers,
            threads_per_worker=1,
            processes=False,
            protocol="inproc://",
            dashboard_address=None,
            memory_limit=0,
            silence_logs=logging.CRITICAL,
        )
        self._stack.callback(_quietly, lambda: cluster.close(timeout=PARTING))
        client = dask.Client(cluster, set_as_default=False)
        self._stack.callback(_quietly, lambda: client.close(timeout=PARTING))
        return client

    def _remote(self) -> Any:
        options, dask = self._options, self._dask
        address = options.scheduler or self._address_in_file()
        security = {"tls_ca_file": "--tls-ca-file", "tls_client_cert": "--tls-cert", "tls_client_key": "--tls-key"}
        files = {key: str(options.tls_files[name]) for key, name in security.items() if name in options.tls_files}
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
            raise UsageError(message + remedy) from error
        self._stack.callback(_quietly, lambda: client.close(timeout=PARTING))
        return client

    def _address_in_file(self) -> str:
        """The address that a scheduler wrote, waited for as long as for the scheduler itself."""
        path, until = self._options.scheduler_file, time.monotonic() + self._options.patience
        assert path is not None
        while True:
            try:
                return str(json.loads(path.read_text(encoding="utf-8"))["address"])
            except FileNotFoundError:
                words = "there is no such file; `dask scheduler --scheduler-file` writes it"
            except OSError as error:
                raise UsageError(f"--scheduler-file {path}: {error.strerror}") from error
            except (ValueError, KeyError, TypeError):
                words = "not a file that `dask scheduler --scheduler-file` wrote"  # or not yet the whole of it
            if time.monotonic() > until:
                raise UsageError(f"--scheduler-file {path}: {words}")
            time.sleep(LOOK / 10)

    def _await_workers(self) -> None:
        until = time.monotonic() + self._options.patience
        while not self._look():
            if time.monotonic() > until:
                raise UsageError(self._no_worker())
            time.sleep(LOOK / 10)

    def _check_workers(self) -> None:
        """UsageError naming each worker that has another mbla or other libraries than this process."""
        client = self._client
        try:
            answers = within(REPLY, lambda: client.run(describe, on_error="return"))
        except TimeoutError:
            raise UsageError(f"a worker of {self._name()} does not answer within {REPLY:g} s: restart it") from None
        faults = []
        for worker, answer in sorted(answers.items()):
            if isinstance(answer, ImportError):
                faults.append(f"worker {worker} cannot import this mbla: {_line(answer)}")
            elif isinstance(answer, Exception):
                if not isinstance(answer, OSError):  # that is one that has just gone
                    faults.append(f"worker {worker}: {type(answer).__name__}: {_line(answer)}")
            elif words := difference({"mbla": program_identity()} | self._libraries, _versions(answer)):
                faults.append(f"worker {worker} on {answer['machine']}: {words}")
        if faults:
            raise UsageError("\n".join([*faults, "install the same versions in the workers' environment"]))

    def _look(self) -> int:
        """Threads of the workers; FileError where the scheduler is gone, UsageError where no worker is left."""
        now = self._looked = time.monotonic()
        if self._client.status != "running":
            self._refuse_lost(None)
        try:
            self._threads = sum(within(REPLY, self._client.nthreads).values())
        except (OSError, *self._dask.cancelled) as error:  # a TimeoutError is one
            raise self._lost() from error
        if self._threads or not self._seen:
            self._seen = now
        elif now - self._seen > self._options.patience:
            raise UsageError(self._no_worker())
        return self._threads

    def _no_worker(self) -> str:
        return (
            f"{self._name()} has had no worker for {self._options.patience:g} s: "
            "start some with `dask worker`, then again with --resume"
        )

    def _name(self) -> str:
        named = self._options.scheduler or self._options.scheduler_file
        return f"the scheduler {named}" if named else "this machine"

    def _refuse_lost(self, cause: BaseException | None) -> None:
        if self._client.status != "running":
            raise self._lost() from cause

    def _lost(self) -> FileError:
        return FileError(f"{self._name()} is gone; finished points are in the journal, --resume goes on with the rest")

    @contextmanager
    def _lost_where_it_fails(self) -> Iterator[None]:
        try:
            yield
        except (OSError, RuntimeError, *self._dask.cancelled) as error:
            raise self._lost() from error


def dask_parts() -> Any:
    """What is used of Dask, by name; UsageError where the extra is not installed."""
    try:
        from asyncio import CancelledError as Cancelled
        from concurrent.futures import CancelledError

        from dask import config
        from distributed import Client, LocalCluster, Security
        from distributed.scheduler import KilledWorker
    except ImportError as error:
        raise UsageError(
            "several processes and clusters need an extra that is not installed: pip install 'mbla[dask]'"
        ) from error
    return SimpleNamespace(
        Client=Client,
        LocalCluster=LocalCluster,
        Security=Security,
        KilledWorker=KilledWorker,
        cancelled=(Cancelled, CancelledError),
        configured=config.set,
    )


@contextmanager
def silenced() -> Iterator[None]:
    """What Dask remarks on lost workers and connections is told in words of this program instead."""
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
    """The answer; TimeoutError where it does not come in time, whatever the library waits for."""
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


def _given_up(task: Task) -> Outcome:
    words = f"its worker was ended, as was that of each try before; given up after {STRIKES} tries"
    return Outcome(task.key, FAILED, 1, words, {}, STRIKES, 0.0)


def _versions(answer: dict[str, Any]) -> dict[str, str]:
    return {"mbla": answer["program"], **answer["libraries"]}


def _line(error: BaseException) -> str:
    return " ".join(str(error).split())
