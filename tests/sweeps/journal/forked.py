"""A copy of this process for tests that kill one: it has everything imported, and says what it did line by line."""

from __future__ import annotations

import contextlib
import os
import signal
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Forked:
    """The process, and the end of the pipe on which it reports."""

    pid: int
    reports: int

    def lines(self) -> list[str]:
        """Everything it reports until its end."""
        said = b""
        while part := os.read(self.reports, 65536):
            said += part
        return said.decode("utf-8").splitlines()

    def line(self) -> str:
        """The next thing it reports; empty at its end."""
        said = b""
        while (sign := os.read(self.reports, 1)) not in (b"", b"\n"):
            said += sign
        return said.decode("utf-8")

    def kill(self) -> None:
        """As the system does where memory runs out."""
        os.kill(self.pid, signal.SIGKILL)


@contextlib.contextmanager
def forked(work: Callable[[Callable[[str], None]], None]) -> Iterator[Forked]:
    """The work in a process of its own; it is gone when the block is left."""
    reports, told = os.pipe()
    pid = os.fork()
    if pid == 0:
        status = 1
        try:
            os.close(reports)
            stream = os.fdopen(told, "w", encoding="utf-8")  # not os.write, which tests replace
            work(lambda line: print(line, file=stream, flush=True))
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(status)
    os.close(told)
    try:
        yield Forked(pid, reports)
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        os.close(reports)
