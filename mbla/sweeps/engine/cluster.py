"""The workers of a Dask scheduler as an executor (only importer of distributed).

Dask is configured as Dask is (https://docs.dask.org/en/stable/configuration.html): certificates, how often the worker
of a point may be lost, how long is waited for workers that went.
"""

from __future__ import annotations

import concurrent.futures
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any

import distributed
from distributed.scheduler import KilledWorker

from mbla.errors import FileError, MblaError, UsageError
from mbla.sweeps.engine.engine import EngineOptions, Pool
from mbla.sweeps.engine.processes import end_on_worker, run_on_worker
from mbla.sweeps.identity import library_versions
from mbla.sweeps.plan import Plan

dask: Any = distributed  # without types


@contextmanager
def pool_of_cluster(options: EngineOptions, plan: Plan) -> Iterator[Pool]:
    """The workers, once there is one; what they do for the plan is stopped after the block.

    Raises UsageError: there is no scheduler or no worker, or one cannot solve points of the plan. Raises FileError: the
    scheduler is gone.
    """
    with connected(options) as client:
        executor = client.get_executor(pure=False)
        run = partial(run_on_worker, libraries=library_versions())
        try:
            yield Pool(executor, run, lambda: sum(client.nthreads().values()), (KilledWorker,))
        except MblaError:
            raise
        except (Exception, concurrent.futures.CancelledError) as error:
            if client.status != "running" or isinstance(error, (OSError, concurrent.futures.CancelledError)):
                raise lost(options) from error
            words = f"a worker cannot solve points of this sweep: {' '.join(str(error).split())}"
            raise UsageError("worker-refused", words) from error
        finally:
            if client.status == "running":
                with suppress(Exception):
                    executor.shutdown(wait=False)
                    client.run(end_on_worker, plan, wait=False, on_error="ignore")


def connected(options: EngineOptions) -> Any:
    """A client of the scheduler with its first worker; raises UsageError where either is missing."""
    where: dict[str, Any] = {"address": options.scheduler}
    if options.scheduler_file is not None:
        if not options.scheduler_file.is_file():
            words = "there is no file with an address; `dask scheduler --scheduler-file` writes it"
            raise UsageError("scheduler-file", f"--scheduler-file {options.scheduler_file}: {words}")
        where = {"scheduler_file": str(options.scheduler_file)}
    try:
        client = dask.Client(**where, timeout=options.patience, set_as_default=False)
    except Exception as error:
        said = " ".join(str(error.__cause__ or error).split()) or type(error).__name__
        raise UsageError("scheduler-lost", f"no connection to the scheduler {_where(options)}: {said}") from error
    try:
        client.wait_for_workers(1, timeout=options.patience)
    except TimeoutError:
        client.close()
        words = f"has had no worker for {options.patience:g} s: start some with `dask worker`"
        raise UsageError("scheduler-lost", f"the scheduler {_where(options)} {words}") from None
    return client


def lost(options: EngineOptions) -> FileError:
    """That the scheduler is gone."""
    words = "is gone; finished points are in the journal, --resume continues with the rest"
    return FileError("scheduler-lost", f"the scheduler {_where(options)} {words}")


def _where(options: EngineOptions) -> str:
    return options.scheduler or str(options.scheduler_file)
