"""The parent's part: a fresh process for one run, its answers as they come, stopped where its time is over.

The child has a session of its own, so that an interrupt from the keyboard reaches the parent alone, which stops it.
"""

from __future__ import annotations

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
from typing import IO, Any

from mbla.studies.measured_run import Task
from mbla.studies.measurement import Measurement

PACKAGES = Path(__file__).parents[2]
"""folder from which this mbla is imported; the child takes the same"""
PATIENCE = 5.0
"""seconds that a child which has answered is given to end by itself"""
LAST_WORDS = 2000
"""letters of standard error that are kept of a child that broke"""


@dataclass(frozen=True)
class ChildRun:
    """What a child told.

    end    : ``done``; ``failed`` with ``words`` of the error and its exit status; ``stopped`` at its time limit;
             ``died`` without an answer
    """

    measurements: tuple[Measurement, ...]
    end: str
    words: str = ""
    exit_status: int = 0


def run_child(task: Task, seconds: float | None, tell: Callable[[Measurement], None] | None = None) -> ChildRun:
    """Run a task in a fresh process; after ``seconds`` it is stopped. It is gone when this returns or raises."""
    until = None if seconds is None else time.monotonic() + seconds
    with tempfile.TemporaryFile() as errors:
        process = _start(errors)
        try:
            assert process.stdin is not None
            try:
                process.stdin.write(json.dumps(asdict(task)) + "\n")
                process.stdin.flush()
            except BrokenPipeError:
                return _death(process, errors, ())
            return _listen(process, errors, until, tell)
        finally:
            _stop(process)


def _start(errors: IO[bytes]) -> subprocess.Popen[str]:
    paths = [str(PACKAGES), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(path for path in paths if path)}
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "mbla.studies.measured_run"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=errors,
        text=True,
        encoding="utf-8",
        errors="replace",
        env=environment,
        start_new_session=True,
    )


def _listen(
    process: subprocess.Popen[str],
    errors: IO[bytes],
    until: float | None,
    tell: Callable[[Measurement], None] | None,
) -> ChildRun:
    lines: queue.Queue[str | None] = queue.Queue()
    assert process.stdout is not None
    threading.Thread(target=_read, args=(process.stdout, lines), daemon=True).start()
    found: list[Measurement] = []
    while True:
        try:
            line = lines.get(timeout=None if until is None else max(until - time.monotonic(), 0.0))
        except queue.Empty:
            return ChildRun(tuple(found), "stopped")
        if line is None:
            return _death(process, errors, tuple(found))
        record: dict[str, Any] = json.loads(line)
        if "end" in record:
            return ChildRun(tuple(found), record["end"], record.get("words", ""), record.get("exit_status", 0))
        found.append(Measurement(**record["measurement"]))
        if tell is not None:
            tell(found[-1])


def _read(stream: IO[str], lines: queue.Queue[str | None]) -> None:
    try:
        for line in stream:
            lines.put(line)
    except ValueError:  # closed, as the child was stopped
        pass
    lines.put(None)


def _death(process: subprocess.Popen[str], errors: IO[bytes], found: tuple[Measurement, ...]) -> ChildRun:
    """What can be said of a child that ended without a last word."""
    try:
        code = process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        return ChildRun(found, "died", "its process closed its output and did not end")
    errors.seek(0)
    said = errors.read()[-LAST_WORDS:].decode("utf-8", errors="replace").strip().splitlines()
    words = f"its process ended with status {code}" + (f": {said[-1]}" if said else "")
    if code < 0:
        name = signal.Signals(-code).name if -code in list(signal.Signals) else f"signal {-code}"
        memory = ", as the system does where memory runs out" if name == "SIGKILL" else ""
        words = f"its process was ended by {name}{memory}"
    return ChildRun(found, "died", words)


def _stop(process: subprocess.Popen[str]) -> None:
    """Gone for certain; a child that is about to end by itself is waited for only as long as it takes to kill it."""
    process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        try:
            if stream is not None:
                stream.close()
        except OSError:  # what was not read any more
            continue
