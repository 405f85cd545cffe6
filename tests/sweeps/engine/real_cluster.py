"""A scheduler and workers of Dask as processes of their own on loopback, as they are on a cluster."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mbla.sweeps.engine.supervised import PACKAGES
from tests.sweeps.engine.test_supervised import wait_for


@dataclass
class RealCluster:
    """Processes that lead a session each."""

    folder: Path
    environment: dict[str, str] = field(default_factory=dict)
    scheduler: subprocess.Popen[bytes] | None = None
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)

    @property
    def file(self) -> Path:
        """Where the scheduler wrote its address."""
        return self.folder / "scheduler.json"

    @property
    def address(self) -> str:
        """Of the scheduler."""
        return str(json.loads(self.file.read_text(encoding="utf-8"))["address"])

    def start_scheduler(self) -> None:
        """Begin it and wait until it has an address."""
        place = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(self.file))
        self.scheduler = self._begin("scheduler", *place)
        wait_for(lambda: self.file.exists() and self.file.read_text(encoding="utf-8").endswith("}"))

    def start_worker(self, **environment: str) -> subprocess.Popen[bytes]:
        """Begin one with a thread."""
        place = ("--host", "127.0.0.1", "--nthreads", "1", "--no-dashboard", "--no-nanny", "--memory-limit", "0")
        worker = self._begin("worker", "--scheduler-file", str(self.file), *place, **environment)
        self.workers.append(worker)
        return worker

    def _begin(self, kind: str, *options: str, **environment: str) -> subprocess.Popen[bytes]:
        with (self.folder / f"{kind}{len(self.workers)}.log").open("wb") as log:
            return subprocess.Popen(
                (sys.executable, "-m", f"distributed.cli.dask_{kind}", *options),
                stdout=log,
                stderr=log,
                cwd=self.folder,
                env=os.environ | {"PYTHONPATH": str(PACKAGES)} | environment,
                start_new_session=True,
            )


@contextmanager
def real_cluster(folder: Path, workers: int = 2) -> Iterator[RealCluster]:
    """One with so many workers; gone after the block."""
    cluster = RealCluster(folder)
    try:
        cluster.start_scheduler()
        for _ in range(workers):
            cluster.start_worker()
        yield cluster
    finally:
        for process in (*cluster.workers, cluster.scheduler):
            if process is not None:
                kill(process)


def kill(process: subprocess.Popen[Any]) -> None:
    """Gone with all it began in its session."""
    with suppress(OSError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
