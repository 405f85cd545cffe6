"""Commands of mbla, each in a copy of a process that has the program imported: soon there, and none harms another.

::

    python -m tests.trust.processes MODULE[:FUNCTION] ...

imports the modules, calls the functions, then runs the commands that it is told on standard input, a line of JSON each,
and answers with two lines: the copy's process, and how it ended.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

LIMIT = 120.0
"""seconds in which the process must end that runs the commands, on the busiest machine"""
MB = 1e6


@dataclass(frozen=True)
class Ended:
    """How a command ended.

    status   : exit status, negative for a signal
    out, err : what it printed
    seconds  : of the processor that it took
    memory   : the most that was resident [MB]
    """

    status: int
    out: str
    err: str
    seconds: float
    memory: float


class Begun:
    """A command at work."""

    def __init__(self, pid: int, commands: Commands) -> None:
        self.pid, self._commands = pid, commands

    def send(self, number: int) -> None:
        """A signal, where it has not ended."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, number)

    def processor_time(self) -> float:
        """What it took until now [s]; zero where it has ended."""
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):
            times = Path(f"/proc/{self.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[11:13]
            return sum(map(int, times)) / os.sysconf("SC_CLK_TCK")
        return 0.0

    def end(self) -> Ended:
        """Wait for it."""
        return self._commands.ended()


class Commands:
    """Context manager: runs commands one after the other.

    imported : modules and functions of the process that runs them
    limits   : for every command, those of the ``resource`` module, such as RLIMIT_CPU; RLIMIT_AS is above what a
               process has that has all imported
    """

    def __init__(self, imported: Sequence[str], limits: Mapping[str, int] | None = None) -> None:
        self._imported, self._limits = imported, dict(limits or {})
        self._folder = tempfile.TemporaryDirectory()

    def __enter__(self) -> Commands:
        self._process = subprocess.Popen(
            [sys.executable, "-m", __name__, *self._imported],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | {"MPLBACKEND": "agg"},
            text=True,
            start_new_session=True,
        )
        return self

    def __exit__(self, *_: object) -> None:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.close()
        self._process.wait(LIMIT)
        self._process.stdout.close()
        self._folder.cleanup()

    def begin(
        self, *arguments: str | Path, folder: Path | None = None, limits: Mapping[str, int] | None = None
    ) -> Begun:
        """Begin a command, in a folder."""
        command = {
            "arguments": [str(argument) for argument in arguments],
            "folder": str(folder or Path.cwd()),
            "limits": self._limits | dict(limits or {}),
            "files": [os.devnull, *(str(self._printed(name)) for name in ("out", "err"))],
        }
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()
        return Begun(int(self._answer()), self)

    def run(self, *arguments: str | Path, folder: Path | None = None, limits: Mapping[str, int] | None = None) -> Ended:
        """Run a command to its end."""
        return self.begin(*arguments, folder=folder, limits=limits).end()

    def ended(self) -> Ended:
        """How the command ended that was begun."""
        answer = json.loads(self._answer())
        out, err = (self._printed(name).read_text("utf-8", errors="replace") for name in ("out", "err"))
        return Ended(**answer, out=out, err=err)

    def _printed(self, name: str) -> Path:
        return Path(self._folder.name) / name

    def _answer(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        assert line, "the process that runs commands has ended"
        return line


# --- the process that runs them ---------------------------------------------------------------------------------------


def _command(command: dict[str, Any]) -> None:
    """One command, in a copy of the process."""
    from mbla.cli import main
    from mbla.process.signals import hear_termination

    os.setsid()
    os.chdir(command["folder"])
    for number, path in enumerate(command["files"]):
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC if number else os.O_RDONLY, 0o666)
        os.dup2(descriptor, number)
        os.close(descriptor)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    hear_termination()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    for name, most in command["limits"].items():
        limit = most + (pages * os.sysconf("SC_PAGE_SIZE") if name == "RLIMIT_AS" else 0)
        resource.setrlimit(getattr(resource, name), (limit, limit))
    try:
        sys.exit(main(command["arguments"]))
    except SystemExit as ended:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(ended.code if isinstance(ended.code, int) else 1)


def serve(imported: Sequence[str]) -> None:
    """Run the commands of standard input until it ends."""
    for name in imported:
        module, _, function = name.partition(":")
        found = importlib.import_module(module)
        if function:
            getattr(found, function)()
    output = sys.stdout
    while line := sys.stdin.readline():
        pid = os.fork()
        if pid == 0:
            sys.stdin = Path(os.devnull).open()  # noqa: SIM115 - nothing of what is told may be read twice
            _command(json.loads(line))
        print(pid, file=output, flush=True)
        _, status, used = os.wait4(pid, 0)
        answer = {
            "status": os.waitstatus_to_exitcode(status),
            "seconds": used.ru_utime + used.ru_stime,
            "memory": used.ru_maxrss * 1024 / MB,
        }
        print(json.dumps(answer), file=output, flush=True)


if __name__ == "__main__":
    serve(sys.argv[1:])
