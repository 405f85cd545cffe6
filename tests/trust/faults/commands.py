"""Commands that run into faults: what they are given, what they said, and what they left."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from mbla.results.disk import PREFIX
from tests.line import BLOCK
from tests.trust.faults.shim import CALLS, built

ERRORS = ("ENOSPC", "EIO", "EACCES")
DECK = BLOCK + "output: {vtu: true, frames: 2}\n"
LIMIT = 120.0
"""seconds that no command may take, on the busiest machine"""


@dataclass(frozen=True)
class Fault:
    """A call below a folder that fails, or that brings a signal; none unless given.

    stays : every later call of the kind fails as well
    """

    folder: Path
    call: str = CALLS[0]
    number: int = 0
    error: int = 0
    stays: bool = False
    signal: int = 0


@dataclass(frozen=True)
class Ended:
    """A command that ended.

    status         : as the shell has it, negative for a signal
    counts         : calls by kind, and ``came``: whether the fault did
    processor_time : that it took in all [s]
    """

    status: int
    said: str
    processor_time: float
    counts: Mapping[str, int] = field(default_factory=dict)


class Begun:
    """A command at work."""

    def __init__(self, pid: int, server: Commands) -> None:
        self.pid = pid
        self._server = server

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
        return self._server.ended()


class Commands:
    """Context manager: runs commands one after the other, each in a copy of a process that has all imported."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.shim = built(folder)

    def __enter__(self) -> Commands:
        environment = os.environ | {"MPLBACKEND": "agg"}
        if self.shim is not None:
            environment["LD_PRELOAD"] = str(self.shim)
        command = [sys.executable, "-m", "tests.trust.faults.server"]
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment, text=True, start_new_session=True
        )
        warm = written(self.folder / "warm" / "warm.yaml")
        self._tell(["run", str(warm), "-q"], None, {})
        return self

    def __exit__(self, *_: object) -> None:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.close()
        self._process.wait(LIMIT)
        self._process.stdout.close()

    def begin(
        self, *arguments: str | Path, fault: Fault | None = None, limits: Mapping[str, int] | None = None
    ) -> Begun:
        """Begin a command; ``limits`` are those of the ``resource`` module, such as RLIMIT_FSIZE.

        RLIMIT_AS is above what a process has that has the program imported.
        """
        self._tell([str(argument) for argument in arguments], fault, limits or {})
        return Begun(int(self._answer()), self)

    def run(self, *arguments: str | Path, fault: Fault | None = None, limits: Mapping[str, int] | None = None) -> Ended:
        """Run a command to its end."""
        return self.begin(*arguments, fault=fault, limits=limits).end()

    def ended(self) -> Ended:
        """How the command ended that was begun."""
        answer = json.loads(self._answer())
        said = self._errors.read_text(encoding="utf-8", errors="replace")
        return Ended(answer["status"], said, answer["processor_time"], answer["counts"])

    @property
    def _errors(self) -> Path:
        return self.folder / "stderr.txt"

    def _tell(self, arguments: Sequence[str], fault: Fault | None, limits: Mapping[str, int]) -> None:
        fault = fault or Fault(Path("/nowhere"))
        command = {
            "arguments": arguments,
            "fault": vars(fault) | {"folder": str(fault.folder)},
            "limits": dict(limits),
            "stdin": os.devnull,
            "stdout": os.devnull,
            "stderr": str(self._errors),
        }
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()

    def _answer(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        assert line, "the process that runs commands has ended"
        return line


def written(path: Path, text: str = DECK) -> Path:
    """A deck, with its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def content(folder: Path) -> dict[str, bytes]:
    """Files of a folder byte for byte, hidden ones as well; empty where there is no folder."""
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())} if folder.is_dir() else {}


PARTIAL = ("block.partial.h5", "block.partial.lst", "block.partial.json")


def without_partial(found: dict[str, bytes]) -> dict[str, bytes]:
    """Files of a folder without those that a stopped run left, which are all there or none."""
    left = {name: data for name, data in found.items() if name not in PARTIAL}
    assert len(found) - len(left) in (0, len(PARTIAL))
    return left


def hidden(folder: Path) -> list[str]:
    """Temporaries and locks in a folder."""
    return [name for name in content(folder) if name.startswith((PREFIX, "."))]


def restored(folder: Path, files: Mapping[str, bytes]) -> None:
    """The folder with these files and no others."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, data in files.items():
        (folder / name).write_bytes(data)


def is_one_plain_line(said: str) -> bool:
    """Whether an error was told in one line and without a traceback."""
    return said.count("\n") == 1 and said.startswith("mbla: ") and "Traceback" not in said


@contextlib.contextmanager
def ended_in_time(seconds: float) -> Iterator[None]:
    """What the block does takes no longer."""
    begun = time.monotonic()
    yield
    assert time.monotonic() - begun < seconds


SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143}
"""and the exit status of a command that they end"""
