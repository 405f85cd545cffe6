"""The parent's part: tasks go to a process that measures, answers come back, and it is stopped where time is over.

The process has a session of its own, so that an interrupt from the keyboard reaches the parent alone, which stops it
with all its copies.
"""

from __future__ import annotations

import contextlib
import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from types import TracebackType
from typing import IO, Any

from mbla.studies.measured_run import Task
from mbla.studies.measurement import Measurement

PACKAGES = Path(__file__).parents[2]
"""folder from which this mbla is imported; the process takes the same"""
COMMAND = (sys.executable, "-P", "-m", "mbla.studies.measuring_process")
PATIENCE = 5.0
"""seconds that a process which closed its output is given to end"""
LAST_WORDS = 2000
"""bytes of standard error that are read of one that broke"""


@dataclass(frozen=True)
class ChildRun:
    """What came of a task.

    end         : ``done``; ``failed`` with ``words`` and exit status of the error; ``stopped`` as its time was over;
                  ``died`` without an answer, with ``words``
    """

    measurements: tuple[Measurement, ...]
    end: str
    words: str = ""
    exit_status: int = 0


class MeasuringProcess:
    """Context manager; the process is started when first needed, and gone with its copies when the block is left."""

    def __init__(self, command: tuple[str, ...] = COMMAND) -> None:
        self._command = command
        self._process: subprocess.Popen[str] | None = None
        self._errors: IO[bytes] | None = None
        self._lines: queue.Queue[str | None] = queue.Queue()

    def __enter__(self) -> MeasuringProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._stop()

    def run(
        self,
        task: Task,
        until: float | None = None,
        seconds: float | None = None,
        report: Callable[[Measurement], None] | None = None,
    ) -> ChildRun:
        """Measure one task.

        until   : time.monotonic() at which it is stopped
        seconds : after which it is stopped, not counting the start of the process
        report  : called with each measurement as it comes
        """
        found: list[Measurement] = []
        last: ChildRun | None = None
        try:
            if not self._ready(until):
                return self._death(found)
            ends = [time.monotonic() + seconds] if seconds is not None else []
            until = min([*ends, *([] if until is None else [until])], default=None)
            self._send(task)
            while (line := self._next(until)) is not None:
                record: dict[str, Any] = json.loads(line)
                if "gone" in record:
                    return last or ChildRun(tuple(found), "died", self._words_of(record["gone"]))
                if "end" in record:
                    last = ChildRun(tuple(found), record["end"], record.get("words", ""), record.get("exit_status", 0))
                    continue
                found.append(Measurement(**record["measurement"]))
                if report is not None:
                    report(found[-1])
            return self._death(found)
        except TimeoutError:
            self._stop()
            return ChildRun(tuple(found), "stopped")

    # --- the process ------------------------------------------------------------------------------------------------

    def _ready(self, until: float | None) -> bool:
        """Whether it is there with everything imported."""
        if self._process is not None and self._process.poll() is None:
            return True
        self._stop()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as the process
        paths = [str(PACKAGES), os.environ.get("PYTHONPATH", "")]
        self._process = subprocess.Popen(
            self._command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            text=True,
            encoding="utf-8",
            errors="replace",
            env=os.environ | {"PYTHONPATH": os.pathsep.join(path for path in paths if path)},
            start_new_session=True,
        )
        assert self._process.stdout is not None
        self._lines = queue.Queue()
        threading.Thread(target=_read, args=(self._process.stdout, self._lines), daemon=True).start()
        return self._next(until) is not None

    def _send(self, task: Task) -> None:
        assert self._process is not None
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError):  # its output ends then, which is told
            self._process.stdin.write(json.dumps(asdict(task)) + "\n")
            self._process.stdin.flush()

    def _next(self, until: float | None) -> str | None:
        """The next line; None where there will be no more. Raises TimeoutError."""
        try:
            return self._lines.get(timeout=None if until is None else max(until - time.monotonic(), 0.0))
        except queue.Empty:
            raise TimeoutError from None

    def _death(self, found: list[Measurement]) -> ChildRun:
        """What can be said of a process that ended without a last word."""
        assert self._process is not None
        try:
            code = self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            code = 0
        words = self._words_of(code)
        self._stop()
        return ChildRun(tuple(found), "died", words)

    def _words_of(self, code: int) -> str:
        """How a process ended, from its exit status, negative for a signal, and from what it said last."""
        if code < 0:
            name = signal.Signals(-code).name if -code in list(signal.Signals) else f"signal {-code}"
            memory = ", as the system does where memory runs out" if name == "SIGKILL" else ""
            return f"its process was ended by {name}{memory}"
        assert self._errors is not None
        size = self._errors.seek(0, os.SEEK_END)
        self._errors.seek(max(size - LAST_WORDS, 0))
        said = self._errors.read().decode("utf-8", errors="replace").strip().splitlines()
        return f"its process ended with status {code}" + (f": {said[-1]}" if said else "")

    def _stop(self) -> None:
        """Gone for certain, with all copies."""
        process, errors = self._process, self._errors
        self._process = self._errors = None
        if process is not None:
            with contextlib.suppress(OSError):  # no such process any more
                _kill_all(process)
            process.wait()
            for stream in (process.stdin, process.stdout):
                with contextlib.suppress(OSError):  # what was not read any more
                    if stream is not None:
                        stream.close()
        if errors is not None:
            errors.close()


def _kill_all(process: subprocess.Popen[str]) -> None:
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)  # it leads a session and a group of its own
    else:
        process.kill()


def _read(stream: IO[str], lines: queue.Queue[str | None]) -> None:
    with contextlib.suppress(ValueError):  # closed, as the process was stopped
        for line in stream:
            lines.put(line)
    lines.put(None)
