"""A process that is told its work, and answers, in lines of JSON: started, stopped for certain, its death in words.

The process has a session of its own, so that an interrupt from the keyboard reaches the parent alone, which stops it
with all its copies. It is started by the thread that reads its answers and lives as long as these: a process may ask
the system to be ended with the thread that started it (prctl(2), PR_SET_PDEATHSIG), and that must not be one of a pool.
"""

from __future__ import annotations

import contextlib
import json
import os
import queue
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO, Any

PACKAGES = Path(__file__).parents[3]
"""folder from which this mbla is imported; the process takes the same"""
PATIENCE = 5.0
"""seconds that a process which closed its output is given to end"""
LAST_WORDS = 2000
"""bytes of standard error that are read of one that broke"""


class LineProcess:
    """One process after the other under one command; ``stop`` must be called in the end.

    status : exit status of the last one of which ``death`` was asked, negative for a signal; 0 where it had to be
             stopped
    """

    def __init__(self, command: Sequence[str], environment: Mapping[str, str] | None = None) -> None:
        """Starts nothing yet.

        environment : variables set beside those of this process
        """
        self._command = tuple(command)
        self._environment = dict(environment or {})
        self._process: subprocess.Popen[str] | None = None
        self._errors: IO[bytes] | None = None
        self._lines: queue.Queue[str | None] = queue.Queue()
        self.status = 0

    def runs(self) -> bool:
        """Whether a process is there and has not ended."""
        return self._process is not None and self._process.poll() is None

    def start(self) -> None:
        """Begin a new one, the one before gone for certain; OSError where the system has no process for it."""
        self.stop()
        self._lines, self._errors = queue.Queue(), tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as it
        begun, refused = threading.Event(), list[Exception]()
        arguments = (self._lines, self._errors, begun, refused)
        threading.Thread(target=self._serve, args=arguments, daemon=True).start()
        begun.wait()
        if refused:
            self.stop()
            raise refused[0]

    def send(self, record: Mapping[str, Any]) -> None:
        """One line of JSON to it; where it is gone, its output ends, which is told."""
        assert self._process is not None
        assert self._process.stdin is not None
        with contextlib.suppress(OSError, ValueError):
            self._process.stdin.write(json.dumps(record) + "\n")
            self._process.stdin.flush()

    def next(self, until: float | None = None) -> dict[str, Any] | None:
        """The next answer; None where there will be no more.

        until : time.monotonic() after which TimeoutError is raised
        """
        try:
            line = self._lines.get(timeout=None if until is None else max(until - time.monotonic(), 0.0))
        except queue.Empty:
            raise TimeoutError from None
        if line is None:
            return None
        record: dict[str, Any] = json.loads(line)
        return record

    def death(self) -> str:
        """How one ended that closed its output without a last answer; it is stopped then."""
        assert self._process is not None
        try:
            self.status = self._process.wait(PATIENCE)
            words = self.words_of(self.status)
        except subprocess.TimeoutExpired:
            self.status = 0
            words = self._with_last_words("its process closed its output and did not end")
        self.stop()
        return words

    def words_of(self, code: int) -> str:
        """How a process ended, from its exit status, negative for a signal, and from what it said last."""
        if code < 0:
            name = signal.Signals(-code).name if -code in list(signal.Signals) else f"signal {-code}"
            memory = ", as the system does where memory runs out" if name == "SIGKILL" else ""
            return f"its process was ended by {name}{memory}"
        return self._with_last_words(f"its process ended with status {code}")

    def _with_last_words(self, words: str) -> str:
        return f"{words}: {said}" if (said := self.last_words()) else words

    def last_words(self) -> str:
        """The last line that it wrote to standard error; empty where there is none."""
        if self._errors is None:
            return ""
        size = self._errors.seek(0, os.SEEK_END)
        self._errors.seek(max(size - LAST_WORDS, 0))
        said = self._errors.read().decode("utf-8", errors="replace").strip().splitlines()
        return said[-1] if said else ""

    def stop(self) -> None:
        """Gone for certain, with all copies."""
        process, errors = self._process, self._errors
        self._process = self._errors = None
        if process is not None:
            kill_all(process)
            process.wait()
            for stream in (process.stdin, process.stdout):
                with contextlib.suppress(OSError, ValueError):  # what was not read any more
                    if stream is not None:
                        stream.close()
        if errors is not None:
            errors.close()

    def kill(self) -> None:
        """End it at once, from whatever thread: the one that waits for its answer sees its output end."""
        if (process := self._process) is not None and process.poll() is None:  # else its number may be another's
            kill_all(process)

    def _serve(
        self, lines: queue.Queue[str | None], errors: IO[bytes], begun: threading.Event, refused: list[Exception]
    ) -> None:
        paths = [str(PACKAGES), os.environ.get("PYTHONPATH", "")]
        own = {"PYTHONPATH": os.pathsep.join(path for path in paths if path)}
        try:
            process = self._process = subprocess.Popen(
                self._command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
                encoding="utf-8",
                errors="replace",
                env=os.environ | own | self._environment,
                start_new_session=True,
            )
        except Exception as error:
            refused.append(error)
            return
        finally:
            begun.set()
        assert process.stdout is not None
        with contextlib.suppress(ValueError):  # closed, as the process was stopped
            for line in process.stdout:
                lines.put(line)
        lines.put(None)


def kill_all(process: subprocess.Popen[str]) -> None:
    """End a process that leads a session, with all its copies."""
    with contextlib.suppress(OSError):  # no such process any more
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
